"""Files that cannot be read: a tag, a quote, a bracket, a comma that is missing."""

from __future__ import annotations

import re
from collections.abc import Iterator

from gazelle.diagnostics import Diagnostic
from gazelle.doctor.fixes.edits import Edit, SourceText
from gazelle.doctor.fixes.xml_places import Tag, tag_at, tags

__all__ = ["python_closed", "xml_closed", "xml_escaped", "yaml_closed"]

_END_WORD = re.compile(r"write </([\w:.-]+)>( where it ends)?")
_QUOTED_VALUE = re.compile(r"write ([\"'])([^\"'\n]*)\1")
_EMPTY_TAG = re.compile(r"write <([\w:]+) …/>")
_BARE_AMPERSAND = re.compile(r"&(?!#?\w+;)")
_MAX_PLACES = 8


def xml_closed(finding: Diagnostic, source: SourceText, at: int) -> Iterator[tuple[Edit, ...]]:
    """Return the ways to end a tag, a value or an element."""
    text = source.text
    found = _QUOTED_VALUE.match(finding.fix)
    if found is not None:
        begin = at + 1
        yield (Edit(begin + len(found[2]), begin + len(found[2]), found[1]),)
    if _EMPTY_TAG.match(finding.fix):
        end = text.find(">", at)
        yield (Edit(end, end, "/"),)
    found = _END_WORD.match(finding.fix)
    if found is None:
        return
    if not found[2]:
        yield (Edit(at, text.index(">", at) + 1, f"</{found[1]}>"),)
        return
    tag = tag_at(text, at)
    if tag is not None:
        yield from _ended(source, tag)


def _ended(source: SourceText, tag: Tag) -> Iterator[tuple[Edit, ...]]:
    """End an element on its own line, or before the first line that is not indented below it."""
    text, depth = source.text, len(source.indentation(tag.begin))
    closing = f"</{tag.name}>"
    same_line = text[tag.end : source.line_end(tag.begin)]
    if same_line.strip():
        end = source.line_end(tag.begin)
        yield from ((Edit(end, end, closing),),)
    last = source.line_end(tag.begin)
    for begin in source.lines_after(tag.begin):
        line = text[begin : source.line_end(begin)]
        if not line.strip():
            continue
        if len(line) - len(line.lstrip()) <= depth:
            indentation = source.indentation(tag.begin)
            yield (Edit(last, last, f"\n{indentation}{closing}"),)
            return
        last = source.line_end(begin)
    # Where nothing is indented: before the next element of the same kind.
    for other in tags(text, tag.end):
        if other.name == tag.name and not other.closes:
            yield (Edit(other.begin, other.begin, f"{closing}\n"),)
            return


def xml_escaped(_finding: Diagnostic, source: SourceText, at: int) -> Iterator[tuple[Edit, ...]]:
    """Write ``&amp;`` for the bare ``&`` of a line, and single dashes in a comment."""
    begin, end = source.line_begin(at), source.line_end(at)
    edits = tuple(
        Edit(found.start(), found.end(), "&amp;")
        for found in _BARE_AMPERSAND.finditer(source.text, begin, end)
    )
    if edits:
        yield edits
    opened = source.text.rfind("<!--", 0, end)
    closed = source.text.find("-->", opened + 4)
    if opened >= 0 and closed > at:
        dashes = re.compile(r"-{2,}").finditer(source.text, opened + 4, closed)
        edits = tuple(Edit(found.start(), found.end(), "-") for found in dashes)
        if edits:
            yield edits


def yaml_closed(_finding: Diagnostic, source: SourceText, at: int) -> Iterator[tuple[Edit, ...]]:
    """Return the ways to write a line's missing colon, space, bracket or quote, or its tabs."""
    text = source.text
    for begin in _lines_around(source, at):
        end = source.line_end(begin)
        line = text[begin:end]
        yield from _untabbed(source, begin, line)
        colon = re.match(r"\s*(?:- )?[\w/~]+(:)(?=[^\s:])", line)
        if colon:
            yield (Edit(begin + colon.end(1), begin + colon.end(1), " "),)
        if re.fullmatch(r"\s*[\w/~]+\s*", line):
            last = begin + len(line.rstrip())
            yield (Edit(last, last, ":"),)
        missing = re.match(r"(\s*[\w/~]+)( +)[^\s:]+\s*$", line)
        if missing:
            yield (Edit(begin + missing.end(1), begin + missing.end(1), ":"),)
        yield from _bracketed(line, begin)


def _lines_around(source: SourceText, at: int) -> Iterator[int]:
    begin = source.line_begin(at)
    yield begin
    if begin:
        yield source.line_begin(begin - 1)
    yield from (line for line, _ in zip(source.lines_after(at), range(1), strict=False))


def _untabbed(source: SourceText, begin: int, line: str) -> Iterator[tuple[Edit, ...]]:
    """Write the spaces of the lines around for the tabs that a line begins with."""
    white = line[: len(line) - len(line.lstrip())]
    if "\t" not in white:
        return
    above = source.indentation(max(begin - 1, 0)).replace("\t", "")
    below = next((source.indentation(at) for at in source.lines_after(begin)), above).replace(
        "\t", ""
    )
    seen = dict.fromkeys((below, above, f"{above}  ", white.replace("\t", "  "), above[:-2]))
    for spaces in seen:
        yield (Edit(begin, begin + len(white), spaces),)


def _bracketed(line: str, begin: int) -> Iterator[tuple[Edit, ...]]:
    """Close the innermost bracket of a line before each comma or bracket, or at its end."""
    for opening, closing in ("[]", "{}"):
        if line.count(opening) <= line.count(closing):
            continue
        first = line.rindex(opening) if closing not in line else line.index(opening)
        places = [found.start() for found in re.finditer(r",\s*[\[{]|[\]}]|$|\s+#", line)]
        for place in [item for item in places if item > first][:_MAX_PLACES]:
            yield (Edit(begin + place, begin + place, closing),)


def python_closed(finding: Diagnostic, source: SourceText, at: int) -> Iterator[tuple[Edit, ...]]:
    """Return the ways to write the colon, comma or indentation that Python misses."""
    line = source.line_begin(at)
    end = source.line_end(at)
    code = len(re.sub(r"\s*(#.*)?$", "", source.text[line:end]))
    if "expected ':'" in finding.message:
        yield (Edit(line + code, line + code, ":"),)
    told = re.search(r"write a comma at the end of line (\d+)", finding.fix)
    if told:
        begin = source.line_begins[int(told[1]) - 1]
        stop = begin + len(re.sub(r"\s*(#.*)?$", "", source.text[begin : source.line_end(begin)]))
        yield (Edit(stop, stop, ","),)
    if "tabs" in finding.message:
        yield from _untabbed(source, line, source.text[line:end])
    elif "indent" in finding.message:
        yield from _reindented(source, line)


def _reindented(source: SourceText, line: int) -> Iterator[tuple[Edit, ...]]:
    """Indent a line, and the one above it, as a line near it is indented."""
    near = [line]
    if line:
        near.append(source.line_begin(line - 1))
    depths = {
        source.indentation(begin)
        for begin in (*source.lines_after(line), *source.line_begins)
        if source.text[begin : source.line_end(begin)].strip()
    }
    for begin in near:
        now = source.indentation(begin)
        for other in sorted(depths, key=lambda item: abs(len(item) - len(now)))[:4]:
            if other != now:
                yield (Edit(begin, begin + len(now), other),)
