"""CMake's language: commands and their words, as ``CMakeLists.txt`` writes them."""

from __future__ import annotations

import re
from typing import NamedTuple

__all__ = ["Argument", "Command", "SyntaxProblem", "read_commands"]

_TOKEN = re.compile(
    r"""(?P<space>[ \t\r\n]+)
      | \#\[(?P<cequal>=*)\[(?P<comment>.*?)\](?P=cequal)\]
      | (?P<line>\#[^\n]*)
      | \[(?P<bequal>=*)\[\n?(?P<bracket>.*?)\](?P=bequal)\]
      | "(?P<quoted>(?:[^"\\]|\\.)*)"
      | (?P<open>\() | (?P<close>\))
      | (?P<word>(?:[^\s()#"\\]|\\.)(?:[^\s()"\\#]|\\.|"(?:[^"\\]|\\.)*"|\#)*)
      | (?P<other>.)""",
    re.VERBOSE | re.DOTALL,
)
_ESCAPE = re.compile(r"\\(\n|.)", re.DOTALL)
_ESCAPES = {"n": "\n", "t": "\t", "r": "\r", "\n": ""}


class Argument(NamedTuple):
    """One argument of a command, its variables not replaced.

    Attributes:
        quoted: between quotes or brackets, so that it is one word whatever it holds.
        line: from 1.
        column: from 1.
    """

    text: str
    quoted: bool
    line: int
    column: int


class Command(NamedTuple):
    """A call such as ``install(…)``; its name in lower case, as CMake does not tell them apart."""

    name: str
    arguments: tuple[Argument, ...]
    line: int
    column: int


class SyntaxProblem(NamedTuple):
    """Where CMake would stop reading, and why."""

    text: str
    line: int
    column: int


def read_commands(text: str) -> tuple[tuple[Command, ...], SyntaxProblem | None]:
    """Return the commands of a file, and what is wrong with its syntax.

    Comments are left out; parentheses inside a command are words of their own.
    """
    reader = _Reader(text)
    for found in _TOKEN.finditer(text):
        reader.take(found)
        if reader.problem is not None:
            break
    return tuple(reader.commands), reader.finished()


class _Reader:
    def __init__(self, text: str) -> None:
        self.commands: list[Command] = []
        self.problem: SyntaxProblem | None = None
        self._breaks = [found.start() for found in re.finditer("\n", text)]
        self._name: Argument | None = None
        self._arguments: list[Argument] = []
        self._depth = 0

    def take(self, found: re.Match[str]) -> None:
        kind, position = found.lastgroup, self._place(found.start())
        match kind:
            case "open":
                self._open(position)
            case "close":
                self._close(position)
            case "quoted":
                self._add(Argument(_ESCAPE.sub(_unescaped, found["quoted"]), True, *position))
            case "bracket":
                self._add(Argument(found["bracket"], True, *position))
            case "word":
                self._add(Argument(found["word"], False, *position))
            case "other":
                self.problem = SyntaxProblem(f"unexpected '{found.group()}'", *position)

    def finished(self) -> SyntaxProblem | None:
        if self.problem is None and self._depth and self._name is not None:
            text = f"{self._name.text}( is never closed: a ')' is missing"
            self.problem = SyntaxProblem(text, self._name.line, self._name.column)
        return self.problem

    def _place(self, start: int) -> tuple[int, int]:
        from bisect import bisect_left

        line = bisect_left(self._breaks, start)
        begin = self._breaks[line - 1] + 1 if line else 0
        return line + 1, start - begin + 1

    def _open(self, position: tuple[int, int]) -> None:
        if self._name is None:
            self.problem = SyntaxProblem("'(' without a command's name before it", *position)
            return
        if self._depth:
            self._arguments.append(Argument("(", False, *position))
        self._depth += 1

    def _close(self, position: tuple[int, int]) -> None:
        if not self._depth:
            self.problem = SyntaxProblem("')' without a '('", *position)
            return
        self._depth -= 1
        if self._depth:
            self._arguments.append(Argument(")", False, *position))
        elif self._name is not None:
            name = self._name
            self.commands.append(
                Command(name.text.lower(), tuple(self._arguments), name.line, name.column)
            )
            self._name, self._arguments = None, []

    def _add(self, argument: Argument) -> None:
        if self._depth:
            self._arguments.append(argument)
        elif self._name is None:
            self._name = argument
        else:
            text = f"'{self._name.text}' is followed by no '('"
            self.problem = SyntaxProblem(text, self._name.line, self._name.column)


def _unescaped(found: re.Match[str]) -> str:
    return _ESCAPES.get(found[1], found[1])
