"""Names that are replaced by those that a finding asks about: did you mean …?"""

from __future__ import annotations

import re
from collections.abc import Iterator

from gazelle.diagnostics import Diagnostic
from gazelle.diagnostics.suggestions import likeness
from gazelle.doctor.fixes.edits import Edit, SourceText
from gazelle.doctor.fixes.xml_places import closing_tag, element_end, tag_at

__all__ = ["suggestions", "with_names_replaced"]

_ASKED = re.compile(r"did you mean ((?:'[^'\n]+'(?: or )?)+)")
_QUOTED = re.compile(r"'([^'\n]+)'")
# What counts as a word: paths and types first, then file names, then plain names.
_WORDS = (
    re.compile(r"[\w./:+-]*[\w+-]"),
    re.compile(r"[\w.+-]*[\w+-]"),
    re.compile(r"\w+"),
)
_LEAST_LIKENESS = 0.55
_STATEMENT_LINES = 12


def suggestions(finding: Diagnostic) -> tuple[str, ...]:
    """Return the names that a finding asks about, the nearest first."""
    found = _ASKED.search(finding.fix) or _ASKED.search(finding.message)
    return tuple(_QUOTED.findall(found[1])) if found else ()


def with_names_replaced(
    finding: Diagnostic, source: SourceText, at: int
) -> Iterator[tuple[Edit, ...]]:
    """Return the ways to write a suggested name in place of one that the finding tells of."""
    seen = set()
    for wanted in suggestions(finding)[:2]:
        for region in _regions(source, at):
            for edits in _replaced(finding, source, region, wanted):
                if edits not in seen:
                    seen.add(edits)
                    yield edits


def _regions(source: SourceText, at: int) -> Iterator[tuple[int, int]]:
    """Return where the wrong name may stand, the nearest first."""
    text = source.text
    yield at, source.line_end(at)
    tag = tag_at(text, at) if "<" in text else None
    if tag is not None and source.line_begin(at) <= tag.begin:
        yield tag.begin, tag.end
        yield tag.begin, element_end(text, tag)
    yield source.line_begin(at), source.line_end(at)
    end, indentation = source.line_end(at), len(source.indentation(at))
    for number, begin in enumerate(source.lines_after(at)):
        line = text[begin : source.line_end(begin)]
        if number >= _STATEMENT_LINES or (
            line.strip() and len(line) - len(line.lstrip()) < indentation
        ):
            break
        end = source.line_end(begin)
    yield at, end


def _replaced(
    finding: Diagnostic, source: SourceText, region: tuple[int, int], wanted: str
) -> Iterator[tuple[Edit, ...]]:
    told = f"{finding.message}\n{finding.fix}"
    for pattern in _WORDS:
        if not pattern.fullmatch(wanted):
            continue
        words = {word for word in pattern.findall(told) if word != wanted}
        found = [
            item
            for item in pattern.finditer(source.text, *region)
            if item[0] in words and _alike(item[0], wanted) >= _LEAST_LIKENESS
        ]
        found.sort(key=lambda item: -_alike(item[0], wanted))
        for item in found:
            yield _everywhere(source, Edit(item.start(), item.end(), wanted))


def _alike(word: str, wanted: str) -> float:
    return likeness(word.casefold(), wanted.casefold())


def _everywhere(source: SourceText, edit: Edit) -> tuple[Edit, ...]:
    """Return an edit, with that of the end of the element when it is a tag's name."""
    text = source.text
    if text[edit.begin - 1 : edit.begin] != "<":
        return (edit,)
    tag = tag_at(text, edit.begin)
    closing = closing_tag(text, tag) if tag is not None else None
    if closing is None:
        return (edit,)
    name = closing.begin + 2
    return edit, Edit(name, name + edit.end - edit.begin, edit.text)
