"""Changes of a text, by place."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

from gazelle.diagnostics import SourceSpan

__all__ = ["Edit", "SourceText", "difference", "edited"]


class Edit(NamedTuple):
    """What is written in place of a part of a text.

    Attributes:
        begin, end: the part, in characters; the same where something is inserted.
        text: what stands there afterwards.
    """

    begin: int
    end: int
    text: str


@dataclass(frozen=True)
class SourceText:
    """A text with its lines.

    Attributes:
        file: as findings name it.
        text: what is in it.
    """

    file: str
    text: str

    @cached_property
    def line_begins(self) -> tuple[int, ...]:
        """Where each line begins, in characters."""
        return (0, *(found.end() for found in re.finditer("\n", self.text)))

    def offset(self, span: SourceSpan) -> int:
        """Where a place is, in characters; that of the line where the column is not known."""
        line = min(max(span.line, 1), len(self.line_begins)) - 1
        at = self.line_begins[line]
        if span.column > 1:
            return min(at + span.column - 1, self.line_end(at))
        return at + len(self.indentation(at))

    def line_begin(self, at: int) -> int:
        """Where the line of a place begins."""
        return self.text.rfind("\n", 0, at) + 1

    def line_end(self, at: int) -> int:
        """Where the line of a place ends, before its newline."""
        end = self.text.find("\n", at)
        return len(self.text) if end < 0 else end

    def indentation(self, at: int) -> str:
        """White space that the line of a place begins with."""
        begin = self.line_begin(at)
        line = self.text[begin : self.line_end(at)]
        return line[: len(line) - len(line.lstrip())]

    def lines_after(self, at: int) -> Iterator[int]:
        """Where the lines behind that of a place begin."""
        begin = self.line_end(at) + 1
        while begin < len(self.text):
            yield begin
            begin = self.line_end(begin) + 1


def edited(text: str, edits: Iterable[Edit]) -> str:
    """Return a text with edits that do not overlap."""
    for edit in sorted(edits, reverse=True):
        text = text[: edit.begin] + edit.text + text[edit.end :]
    return text


def difference(before: str, after: str, name: str) -> str:
    """Return a unified diff that ``patch -p1`` and ``git apply`` take."""
    lines = difflib.unified_diff(
        before.splitlines(keepends=True), after.splitlines(keepends=True), f"a/{name}", f"b/{name}"
    )
    text = ""
    for line in lines:
        text += line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"
    return text
