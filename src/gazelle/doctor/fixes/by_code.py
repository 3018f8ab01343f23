"""Fixes that only one kind of finding has."""

from __future__ import annotations

import re
from collections.abc import Iterator

from gazelle.diagnostics import Diagnostic
from gazelle.doctor.fixes.edits import Edit, SourceText
from gazelle.doctor.fixes.xml_places import children, element_end, tag_at, tags

__all__ = ["install_rule", "number_written", "xacro_closed", "xacro_command", "xacro_included"]

_NUMBERS = re.compile(r"^write ((?:-?[\d.]+(?:[eE]-?\d+)?\s?)+)(?: or ((?:-?[\d.]+\s?)+))?")
_QUOTED_NUMBERS = re.compile(r"'([-+\d.,\seE]+)'")
_TEXTFILE = re.compile(r"\btextfile\s*=\s*(\"|')(.*?)\1", re.DOTALL)
_OPEN_EXPRESSION = re.compile(r"\$\{[^{}\"']*(?=\$\{|[\"'])")
_CMAKE_END = re.compile(r"^[ \t]*(?:ament_package|ament_auto_package)\s*\(", re.MULTILINE)
_DATA_FILES = re.compile(r"\bdata_files\s*=\s*\[")


def number_written(finding: Diagnostic, source: SourceText, at: int) -> Iterator[tuple[Edit, ...]]:
    """Write the numbers that a finding offers in place of those that it quotes."""
    found, quoted = _NUMBERS.match(finding.fix), _QUOTED_NUMBERS.search(finding.message)
    tag = tag_at(source.text, at)
    if found is None or quoted is None or tag is None:
        return
    end = element_end(source.text, tag)
    begin = source.text.find(quoted[1], min(at, tag.begin), end)
    for written in found.groups():
        if written and begin >= 0:
            yield (Edit(begin, begin + len(quoted[1]), written.strip()),)


def xacro_closed(finding: Diagnostic, source: SourceText, at: int) -> Iterator[tuple[Edit, ...]]:
    """Close an expression behind each of its words."""
    tag = tag_at(source.text, at)
    if tag is None or finding.fix != "add '}'":
        return
    for found in _OPEN_EXPRESSION.finditer(source.text, tag.begin, element_end(source.text, tag)):
        words = [word.end() for word in re.finditer(r"\S+", found[0])]
        # Most stand for one number; what is left of it behind the brace is numbers, too.
        for end in sorted(words, reverse=source.text[found.end()] != "$"):
            yield (Edit(found.start() + end, found.start() + end, "}"),)
        # A name that goes on as text: ${side}_wheel.
        for part in re.finditer(r"_", found[0]):
            yield (Edit(found.start() + part.start(), found.start() + part.start(), "}"),)


def xacro_command(_finding: Diagnostic, source: SourceText, at: int) -> Iterator[tuple[Edit, ...]]:
    """Have a description expanded that a launch file takes as it is."""
    tag = tag_at(source.text, at)
    found = tag and _TEXTFILE.search(source.text, tag.begin, tag.end)
    if found:
        command = f"command={found[1]}$(find xacro)/xacro {found[2]}{found[1]}"
        yield (Edit(found.start(), found.end(), command),)


def xacro_included(finding: Diagnostic, source: SourceText, _at: int) -> Iterator[tuple[Edit, ...]]:
    """Include the file that defines a macro, above everything else."""
    found = re.search(r"include that file above: (<xacro:include [^<>]*/>)", finding.fix)
    first = next((tag for tag in tags(source.text) if not tag.closes), None)
    if found is not None and first is not None:
        inner = next(children(source.text, first), None)
        indentation = source.indentation(inner.begin) if inner is not None else "  "
        yield (Edit(first.end, first.end, f"\n{indentation}{found[1]}"),)


def install_rule(finding: Diagnostic, source: SourceText, at: int) -> Iterator[tuple[Edit, ...]]:
    """Write a rule into CMakeLists.txt or setup.py."""
    text = source.text
    rule = re.match(r"install\(.*\)", finding.fix)
    if rule is not None:
        found = _CMAKE_END.search(text)
        end = len(text) if found is None else found.start()
        before = "" if text[:end].endswith("\n") else "\n"
        yield (Edit(end, end, f"{before}{rule[0]}\n"),)
    row = re.match(r"add to data_files: (.*)", finding.fix)
    opened = _DATA_FILES.search(text)
    if row is not None and opened is not None:
        inner = source.indentation(opened.start()) + "    "
        line = (
            row[1]
            if re.search(r"\bpackage_name\s*=", text)
            else row[1].replace("package_name", f"'{_package_in(finding)}'")
        )
        edits = [Edit(opened.end(), opened.end(), f"\n{inner}{line}")]
        for module, line in (("glob", "from glob import glob\n"), ("os", "import os\n")):
            if not re.search(rf"^(?:import|from) {module}\b", text, re.MULTILINE):
                edits.append(Edit(0, 0, line))
        yield tuple(edits)


def _package_in(finding: Diagnostic) -> str:
    found = re.search(r"share/(\w+)/|package '(\w+)'", finding.message)
    return "" if found is None else found[1] or found[2]
