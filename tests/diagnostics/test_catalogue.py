from __future__ import annotations

import re

import pytest

from gazelle.diagnostics.catalogue import Entry, all_entries, entry_for
from gazelle.diagnostics.documentation import catalogue_markdown


def test_codes_are_sorted_and_well_formed():
    codes = list(all_entries())
    assert codes == sorted(codes)
    assert not [
        code for code in codes if not re.fullmatch(r"[a-z0-9_]+\.[a-z0-9]+(-[a-z0-9]+)*", code)
    ]


@pytest.mark.parametrize("entry", all_entries().values(), ids=lambda entry: entry.code)
def test_every_entry_says_what_why_and_how(entry: Entry):
    assert entry.severity in {"info", "warning", "error"}
    assert entry.title
    assert not entry.title.endswith(".")
    assert entry.why.endswith(".")
    assert entry.fix
    assert entry_for(entry.code) is entry


def test_an_unknown_code_is_refused():
    with pytest.raises(KeyError):
        entry_for("no.such-code")


def test_two_definitions_of_one_code_are_refused(monkeypatch):
    from gazelle.diagnostics.catalogue import documents, workspace

    monkeypatch.setattr(workspace, "ENTRIES", documents.ENTRIES[:1])
    all_entries.cache_clear()
    try:
        with pytest.raises(ValueError, match=r"'xml\.malformed' is defined twice"):
            all_entries()
    finally:
        monkeypatch.undo()
        all_entries.cache_clear()


def test_the_docs_page_has_every_code():
    page = catalogue_markdown()
    for code, entry in all_entries().items():
        assert f"### `{code}` ({entry.severity})" in page
        assert entry.title in page


def test_no_phrase_holds_a_word_that_stands_for_a_name() -> None:
    """People search for what ROS prints, which has the case's own name there."""
    assert [
        entry.code
        for entry in all_entries().values()
        if re.search(r"\bNAME\b|<name>", entry.phrase)
    ] == []
