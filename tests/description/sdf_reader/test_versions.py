from __future__ import annotations

import pytest

from gazelle.description.sdf_reader.versions import version_from, version_of


@pytest.mark.parametrize(
    ("text", "expected"),
    [("1.4", (1, 4)), (" 1.10", (1, 10)), ("two", None), (None, None), ("", None)],
)
def test_texts(text, expected):
    assert version_from(text) == expected


@pytest.mark.parametrize(
    ("attribute", "version", "words"),
    [
        ("", (1, 6), "there is no version"),
        ("version='new'", (1, 6), "'new' is no version"),
        ("version='1.2'", (1, 4), "older than 1.4"),
        ("version='1.13'", (1, 13), "newer than 1.12"),
    ],
)
def test_odd_versions_are_told_of(tag, context, diagnostics, attribute, version, words):
    assert version_of(tag(f"<sdf {attribute}/>"), context) == version
    assert words in diagnostics.by_code("sdf.version")[0].message


@pytest.mark.parametrize("minor", range(4, 13))
def test_known_versions_are_not_mentioned(tag, context, diagnostics, minor):
    assert version_of(tag(f"<sdf version='1.{minor}'/>"), context) == (1, minor)
    assert not len(diagnostics)
