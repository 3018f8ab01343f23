"""The code blocks of the pages, with the marks that stand before them.

A block is fenced and says its language. Those in ``bash`` and ``python`` are run as printed, each
page from top to bottom in a folder of its own; a ``text`` block is what the block above it prints.
What else a block needs stands in comments before it, which no rendered page shows:

``<!-- not run: REASON -->``
    it is not run; why.
``<!-- before: SHELL -->``
    what a reader has by then: typed before the block, in the same folder.
``<!-- running: COMMAND => TEXT -->``
    what a reader has running by then; waited for as below.
``<!-- file: PATH -->``
    the reader saves the block under this name; it is not run by itself.
``<!-- continues -->``
    a Python block that goes on where the one above it ended.
``<!-- runs on: TEXT | TEXT -->``
    its last commands, as many as there are texts, run side by side, each in a terminal of its own,
    until the page ends; each is waited for until it has printed its text. ``-`` is anything, or
    nothing for some seconds.
``<!-- stop: COMMAND -->``
    the command, one that runs on, gets Ctrl-C before the block.
``<!-- exit: NUMBER -->``
    its last command ends with this exit code; those before it may fail.
``<!-- varies -->``
    numbers of the ``text`` block below are examples.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

__all__ = ["RUN_LANGUAGES", "SHOWN_LANGUAGES", "Block", "PageError", "blocks_of", "pages_of"]

RUN_LANGUAGES = ("bash", "python")
SHOWN_LANGUAGES = ("figure", "ini", "javascript", "json", "text", "toml", "xml", "yaml")
_MARKS = {
    "before": True,
    "continues": False,
    "exit": True,
    "file": True,
    "not run": True,
    "running": True,
    "runs on": True,
    "stop": True,
    "varies": False,
}
_MARK = re.compile(r"^\s*<!-- ([a-z ]+?)(?:: (.*?))? -->$")
_FENCE = re.compile(r"^(\s*)(`{3,})\s*(\S*)")
_LISTED = re.compile(r"\s*(?:[-*]|\d+\.) ")


class PageError(Exception):
    """A page has a block that nobody can run; the text says which one and what to write."""


@dataclass(frozen=True)
class Block:
    """A fenced block.

    Attributes:
        page: the file.
        line: of its fence, from 1.
        language: what stands behind the fence.
        text: what stands in it, without the indentation of its fence.
        marks: the comments before it, by name; those of one name are lines of one text.
    """

    page: Path
    line: int
    language: str
    text: str
    marks: dict[str, str] = field(default_factory=dict)

    @property
    def is_run(self) -> bool:
        """Whether it is a program, or typed."""
        return self.language in RUN_LANGUAGES and not {"not run", "file"} & set(self.marks)

    @property
    def is_output(self) -> bool:
        """Whether it is what the block above it prints."""
        return self.language == "text" and not {"not run", "file"} & set(self.marks)

    def __str__(self) -> str:
        return f"{self.page.name}:{self.line}"


def pages_of(root: Path) -> list[Path]:
    """Return the README and all pages of the documentation."""
    return [root / "README.md", *sorted((root / "docs").rglob("*.md"))]


def blocks_of(page: Path) -> list[Block]:
    """Read a page's blocks.

    Raises:
        PageError: a block without fence or language, or a mark that means nothing.
    """
    return list(_Reader(page).blocks())


class _Reader:
    def __init__(self, page: Path) -> None:
        self._page = page
        self._lines = page.read_text(encoding="utf-8").splitlines()
        self._marks: dict[str, str] = {}
        self._found: list[Block] = []

    def blocks(self) -> list[Block]:
        number, is_list = 0, False
        while number < len(self._lines):
            line = self._lines[number]
            if fence := _FENCE.match(line):
                number = self._fenced(number, fence)
                continue
            if line.strip().startswith("<!--"):
                self._mark(number, line)
            elif line.strip():
                self._unmarked(number)
                is_list = bool(_LISTED.match(line)) or (is_list and line.startswith(" "))
                before = self._lines[number - 1] if number else ""
                if line.startswith("    ") and not before.strip() and not is_list:
                    raise self._error(number, "a block is fenced and says its language")
            number += 1
        self._unmarked(number)
        return self._found

    def _mark(self, number: int, line: str) -> None:
        mark = _MARK.match(line)
        if mark is None or mark[1] not in _MARKS:
            raise self._error(number, f"{line.strip()} is none of {', '.join(_MARKS)}")
        if _MARKS[mark[1]] != bool(mark[2] and mark[2].strip()):
            wanted = "needs a text" if _MARKS[mark[1]] else "takes no text"
            raise self._error(number, f"the mark '{mark[1]}' {wanted}")
        texts = [self._marks[mark[1]]] if mark[1] in self._marks else []
        self._marks[mark[1]] = "\n".join([*texts, (mark[2] or "").strip()])

    def _unmarked(self, number: int) -> None:
        if self._marks:
            raise self._error(number, f"no block follows the mark '{next(iter(self._marks))}'")

    def _fenced(self, number: int, fence: re.Match[str]) -> int:
        """Read from the fence on; return the number of the line behind it."""
        indent, ticks, language = fence.groups()
        if language not in (*RUN_LANGUAGES, *SHOWN_LANGUAGES):
            known = ", ".join((*RUN_LANGUAGES, *SHOWN_LANGUAGES))
            raise self._error(number, f"the language '{language}' is none of {known}")
        body, end = [], number + 1
        while end < len(self._lines) and self._lines[end].strip() != ticks:
            body.append(self._lines[end].removeprefix(indent))
            end += 1
        if end == len(self._lines):
            raise self._error(number, "the block does not end")
        marks, self._marks = self._marks, {}
        text = "\n".join(body) + "\n"
        self._found.append(Block(self._page, number + 1, language, text, marks))
        return end + 1

    def _error(self, number: int, text: str) -> PageError:
        return PageError(f"{self._page.name}:{number + 1}: {text}")
