"""A unified patch that puts computed ``<inertial>`` blocks into the files links come from."""

from __future__ import annotations

import difflib
import os
import re
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.parsers import expat

from gazelle.description.checks.inertia import InertiaFinding, inertial_block
from gazelle.description.checks.written_inertials import LinkRecord
from gazelle.diagnostics import SourceSpan
from gazelle.geometry import MassProperties

__all__ = ["Patch", "make_patch"]

# Conditions leave an element as it was written, once; all others copy or make it.
_HARMLESS = frozenset({"xacro:if", "xacro:unless"})
_START_TAG = re.compile(rb"<[^<>\"']*(?:\"[^\"]*\"[^<>\"']*|'[^']*'[^<>\"']*)*>")
_STEP = "  "


@dataclass(frozen=True, slots=True)
class Patch:
    """A patch and what it does not do.

    Attributes:
        text: unified diff; empty when there is nothing to change.
        folder: where ``patch -p0`` has to run.
        notes: one line for every link that is left as it is, with the reason.
        links: names of the links that are changed.
    """

    text: str
    folder: Path
    notes: tuple[str, ...] = ()
    links: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class _Element:
    """Bytes of an element: its start tag, and all of it; names of the elements around it."""

    start: int
    head_end: int
    end: int
    around: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class _Edit:
    start: int
    end: int
    text: bytes


class _NoSpanError(Exception):
    """The element cannot be changed in its file."""


def make_patch(findings: Iterable[InertiaFinding], *, folder: Path | None = None) -> Patch:
    """Return the patch that ends all findings which have mass properties to offer.

    Args:
        findings: of any number of links and files; the first one of a link counts.
        folder: names in the patch are relative to it; when a file lies elsewhere, to the folder
            that all files share. The current folder when None.
    """
    wanted: dict[SourceSpan | str, tuple[LinkRecord, MassProperties]] = {}
    notes = []
    for finding in findings:
        record, body = finding.record, finding.body
        key = record.span or record.name
        if body is not None:
            wanted.setdefault(key, (record, body))
    edits: dict[Path, list[_Edit]] = {}
    links = []
    for record, body in wanted.values():
        try:
            file, edit = _edit_of(record, body)
        except _NoSpanError as error:
            notes.append(f"{record.span or record.name}: link '{record.name}' stays: {error}")
            continue
        if edit not in edits.setdefault(file, []):
            edits[file].append(edit)
        links.append(record.name)
    base = _base(edits, (folder or Path()).resolve())
    text = "".join(_diff(file, edits[file], base) for file in sorted(edits))
    return Patch(text, base, tuple(notes), tuple(links))


def _base(files: Iterable[Path], wanted: Path) -> Path:
    # patch refuses absolute names and those with '..'.
    outside = [file.parent for file in files if wanted not in file.parents]
    return Path(os.path.commonpath([wanted, *outside])) if outside else wanted


def _edit_of(record: LinkRecord, body: MassProperties) -> tuple[Path, _Edit]:
    """Return the change of one link's file."""
    span = record.written.span if record.written is not None else record.span
    if span is None or not span.line:
        raise _NoSpanError("its place in a file is not known")
    file = Path(span.file).resolve()
    try:
        data = file.read_bytes()
    except OSError as error:
        raise _NoSpanError(f"'{span.file}' cannot be read: {error.strerror}") from error
    element = _element_at(data, span)
    makers = [
        name for name in element.around if name.startswith("xacro:") and name not in _HARMLESS
    ]
    if makers:
        raise _NoSpanError(
            f"it comes from <{makers[-1]}> at {span}, which may make several; change it there"
        )
    newline = "\r\n" if b"\r\n" in data else "\n"
    block = inertial_block(body, record.source_format)
    indent = _indent_at(data, element.start)
    if record.written is not None:
        text = _indented(block, indent, newline).lstrip()
        return file, _Edit(element.start, element.end, text.encode("utf-8"))
    inner = newline + _indented(block, indent + _STEP, newline)
    head = data[element.start : element.head_end]
    if head.endswith(b"/>"):
        opened = head[:-2].rstrip().decode("utf-8") + ">"
        text = f"{opened}{inner}{newline}{indent}</link>"
        return file, _Edit(element.start, element.head_end, text.encode("utf-8"))
    return file, _Edit(element.head_end, element.head_end, inner.encode("utf-8"))


def _element_at(data: bytes, span: SourceSpan) -> _Element:
    finder = _Finder(data, span)
    found = finder.find()
    if found is None:
        raise _NoSpanError(f"no element starts at {span}; the file is no plain XML")
    return found


class _Finder:
    """Finds the element that starts at a line and column."""

    def __init__(self, data: bytes, span: SourceSpan) -> None:
        stripped = data.lstrip(b" \t\r\n")
        self._shift = len(data) - len(stripped)
        self._lines = data[: self._shift].count(b"\n")
        self._data = data
        self._place = span
        self._stack: list[tuple[str, int | None]] = []
        self._found: _Element | None = None
        self._parser: Any = expat.ParserCreate()
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = self._end

    def find(self) -> _Element | None:
        try:
            self._parser.Parse(self._data[self._shift :], True)
        except expat.ExpatError:
            return None
        return self._found

    def _start(self, name: str, _attributes: dict[str, str]) -> None:
        line = self._parser.CurrentLineNumber + self._lines
        here = (line, self._parser.CurrentColumnNumber + 1)
        index = self._parser.CurrentByteIndex + self._shift
        is_it = here == (self._place.line, self._place.column)
        self._stack.append((name, index if is_it else None))

    def _end(self, _name: str) -> None:
        _, start = self._stack.pop()
        if start is None:
            return
        head = _START_TAG.match(self._data, start)
        if head is None:
            return
        index = self._parser.CurrentByteIndex + self._shift
        is_empty = head[0].endswith(b"/>")
        end = head.end() if is_empty else self._data.index(b">", index) + 1
        around = tuple(name for name, _ in self._stack)
        self._found = _Element(start, head.end(), end, around)


def _indent_at(data: bytes, start: int) -> str:
    line = data[data.rfind(b"\n", 0, start) + 1 : start]
    return line.decode("utf-8", "replace") if not line.strip() else ""


def _indented(block: str, indent: str, newline: str) -> str:
    return newline.join(indent + line for line in block.splitlines())


def _diff(file: Path, edits: list[_Edit], base: Path) -> str:
    before = file.read_bytes()
    after = before
    for edit in sorted(edits, key=lambda item: item.start, reverse=True):
        after = after[: edit.start] + edit.text + after[edit.end :]
    name = file.relative_to(base).as_posix()
    lines = difflib.unified_diff(_lines(before), _lines(after), name, name)
    return "".join(
        line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n" for line in lines
    )


def _lines(data: bytes) -> list[str]:
    # Not splitlines: patch counts line feeds only.
    return re.findall(r"[^\n]*\n|[^\n]+", data.decode("utf-8", "surrogateescape"))
