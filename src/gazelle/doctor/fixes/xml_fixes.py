"""Tags and attributes that a finding says to write, put where it says they belong."""

from __future__ import annotations

import re
from collections.abc import Iterator

from gazelle.diagnostics import Diagnostic
from gazelle.doctor.fixes.edits import Edit, SourceText
from gazelle.doctor.fixes.xml_places import Tag, children, closing_tag, element_end, tag_at

__all__ = ["as_written", "pasted", "removed"]

_ATTRIBUTE = re.compile(r"([\w:]+)=\"([^\"…]*)\"")
_WRITE_ATTRIBUTES = re.compile(r"\b(?:write|add) ((?:[\w:]+=\"[^\"…]*\"(?:, | and | )?)+)")
_WRITE_ELEMENT = re.compile(
    r"\b(write|add|such as) ((?:<([\w:]+)(?:\s[^<>…]*)?(?:/>|>[^…\n]*?</\3>))+)"
)
_REMOVE = re.compile(r"\bor remove <([\w:]+)>")
_PASTE = re.compile(r"paste into <([\w:]+)[^<>]*>\n")


def as_written(finding: Diagnostic, source: SourceText, at: int) -> Iterator[tuple[Edit, ...]]:
    """Return the ways to write what a finding says to write or to add."""
    tag = tag_at(source.text, at)
    if tag is None:
        return
    for found in _WRITE_ATTRIBUTES.finditer(finding.fix):
        values = _ATTRIBUTE.findall(found[1])
        yield tuple(_with_attribute(source.text, tag, *pair) for pair in values)
        around = _children_with(source.text, tag, values[0][0])
        for child in around:
            yield tuple(_with_attribute(source.text, child, *pair) for pair in values)
    for found in _WRITE_ELEMENT.finditer(finding.fix):
        if found[1] == "add":
            yield (_inserted(source, tag, found[2].replace("><exec_depend>", ">\n<exec_depend>")),)
        else:
            yield from _with_element(source, tag, found[3], found[2])


def removed(finding: Diagnostic, source: SourceText, at: int) -> Iterator[tuple[Edit, ...]]:
    """Take an element out that has no effect as it is."""
    found, tag = _REMOVE.search(finding.fix), tag_at(source.text, at)
    if found is None or tag is None:
        return
    for one in (tag, *children(source.text, tag)):
        if one.name == found[1]:
            yield (Edit(one.begin, element_end(source.text, one), ""),)


def pasted(finding: Diagnostic, source: SourceText, at: int) -> Iterator[tuple[Edit, ...]]:
    """Return the ways to paste the lines of a fix into the element that a finding tells of."""
    found = _PASTE.match(finding.fix)
    tag = tag_at(source.text, at)
    if found is None or tag is None:
        return
    block = finding.fix[found.end() :]
    name = re.match(r"\s*<([\w:]+)", block)
    if name is not None:
        for outer in _around(source.text, tag, found[1]):
            yield from _with_element(source, outer, name[1], block)


def _around(text: str, tag: Tag, name: str) -> Iterator[Tag]:
    """Return the element of a name that a tag begins or stands in, innermost first."""
    while True:
        if tag.name == name:
            yield tag
        begin = text.rfind("<", 0, tag.begin)
        outer = None
        while begin >= 0 and outer is None:
            before = tag_at(text, begin)
            if before is None:
                return
            begin = before.begin - 1
            if element_end(text, before) > tag.begin:
                outer = before
        if outer is None:
            return
        tag = outer


def _children_with(text: str, tag: Tag, attribute: str) -> list[Tag]:
    pattern = re.compile(rf"\b{re.escape(attribute)}\s*=")
    found = []
    for child in children(text, tag):
        if pattern.search(text, child.begin, child.end):
            found.append(child)
        found += _children_with(text, child, attribute)
    return found


def _with_attribute(text: str, tag: Tag, name: str, value: str) -> Edit:
    """Return the edit that gives an attribute a value, whether it is there or not."""
    pattern = re.compile(rf"\b{re.escape(name)}\s*=\s*(\"[^\"]*\"|'[^']*')")
    found = pattern.search(text, tag.begin, tag.end)
    if found is not None:
        return Edit(found.start(1) + 1, found.end(1) - 1, value)
    end = tag.end - (2 if tag.is_empty else 1)
    while text[end - 1].isspace():
        end -= 1
    return Edit(end, end, f' {name}="{value}"')


def _with_element(
    source: SourceText, tag: Tag, name: str, element: str
) -> Iterator[tuple[Edit, ...]]:
    """Write an element in place of the tag, or of one of the same name in it, or as the last."""
    text = source.text
    if tag.name == name:
        yield (Edit(tag.begin, element_end(text, tag), element),)
        return
    for child in children(text, tag):
        if child.name == name:
            lines = _indented(element, source.indentation(child.begin)).lstrip()
            yield (Edit(child.begin, element_end(text, child), lines),)
            return
    yield (_inserted(source, tag, element),)


def _inserted(source: SourceText, tag: Tag, element: str) -> Edit:
    """Put an element at the end of another."""
    text = source.text
    outer = source.indentation(tag.begin)
    kind = re.match(r"\s*<\w*?_?(depend)>", element)
    alike = [item for item in children(text, tag) if kind and item.name.endswith(kind[1])]
    if alike:
        # A dependency stands with the others.
        end = element_end(text, alike[-1])
        return Edit(end, end, "\n" + _indented(element, source.indentation(alike[-1].begin)))
    first = next(children(text, tag), None)
    inner = f"{outer}  " if first is None else source.indentation(first.begin)
    lines = _indented(element, inner if inner != outer else f"{outer}  ")
    closing = closing_tag(text, tag)
    if closing is None:
        return Edit(tag.end - 2, tag.end, f">\n{lines}\n{outer}</{tag.name}>")
    begin = source.line_begin(closing.begin)
    if text[begin : closing.begin].strip():
        return Edit(closing.begin, closing.begin, f"\n{lines}\n{outer}")
    return Edit(begin, begin, f"{lines}\n")


def _indented(block: str, indentation: str) -> str:
    lines = [line.rstrip() for line in block.strip("\n").split("\n")]
    common = min((len(line) - len(line.lstrip()) for line in lines if line), default=0)
    return "\n".join(indentation + line[common:] if line else "" for line in lines)
