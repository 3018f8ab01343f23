"""What is wrong with a YAML text, as records."""

from __future__ import annotations

import re
from dataclasses import dataclass
from enum import Enum, auto

import yaml

from gazelle.diagnostics import SourceSpan
from gazelle.documents.yaml.loader import YamlDepthError, YamlLengthError, YamlLimitError

__all__ = ["ProblemKind", "PyYamlError", "YamlError", "YamlProblem", "problem_of"]

PyYamlError = yaml.YAMLError
"""What PyYAML raises; users' own programs use it as well."""


class ProblemKind(Enum):
    """What a problem is about."""

    UNREADABLE = auto()
    NOT_UTF8 = auto()
    TAB_INDENT = auto()
    TAB = auto()
    MAPPING_VALUE = auto()
    NO_COLON = auto()
    NO_SPACE = auto()
    SYNTAX = auto()
    TOO_LONG = auto()
    TOO_DEEP = auto()
    TOO_MUCH = auto()
    VALUE = auto()


_FIXES = {
    ProblemKind.TAB_INDENT: "indent with spaces",
    ProblemKind.TAB: "indent with spaces",
    ProblemKind.NO_COLON: "write a colon behind the name",
    ProblemKind.NO_SPACE: "write a space behind the colon",
    ProblemKind.MAPPING_VALUE: "put the value in quotes, or correct the indentation",
}


# The narrower ones first.
_KINDS: tuple[tuple[type[Exception], ProblemKind], ...] = (
    (YamlLengthError, ProblemKind.TOO_LONG),
    (YamlDepthError, ProblemKind.TOO_DEEP),
    (YamlLimitError, ProblemKind.TOO_MUCH),
    (yaml.constructor.ConstructorError, ProblemKind.VALUE),
)


_BARE_NAME = re.compile(r"\s*(?:- )?([\w/~]+)\s*(?:#.*)?$")
_NO_SPACE = re.compile(r"\s*(?:- )?([\w/~]+:)[^\s:/]")
_LEFT_OPEN = (
    "while parsing a flow", "while scanning a simple key", "while scanning a quoted scalar",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class YamlProblem:
    """Something that is wrong with a text.

    Attributes:
        kind: what it is about.
        what: in one line.
        span: the place; without a line where only the file is known.
        context: what was being read, such as ``while parsing a flow sequence``; may be empty.
        context_span: where that begins or, of brackets, quotes and keys, is noticed, when it is
            another place.
        text: all of that as PyYAML prints it, in several lines.
    """

    kind: ProblemKind
    what: str
    span: SourceSpan
    context: str = ""
    context_span: SourceSpan | None = None
    text: str = ""

    @property
    def fix(self) -> str:
        """What to do about it; empty when nobody knows."""
        return _FIXES.get(self.kind, "")

    @property
    def is_limit(self) -> bool:
        """Whether the text may be YAML, and asks for too much."""
        return self.kind in {ProblemKind.TOO_LONG, ProblemKind.TOO_DEEP, ProblemKind.TOO_MUCH}

    @property
    def has_place(self) -> bool:
        """Whether more is known than the file."""
        return self.span.line > 0


class YamlError(yaml.YAMLError):
    """A text has no YAML value, or one above a limit; its text is PyYAML's.

    Attributes:
        problem: what is wrong.
    """

    def __init__(self, problem: YamlProblem) -> None:
        self.problem = problem
        super().__init__(problem.text)


def problem_of(error: Exception, file: str) -> YamlProblem:
    """Return what an error says.

    Args:
        error: of PyYAML, of the operating system, of decoding, or a `YamlError`.
        file: the file's name for the place.
    """
    if isinstance(error, YamlError):
        return error.problem
    if isinstance(error, OSError):
        what = error.strerror or str(error)
        return YamlProblem(ProblemKind.UNREADABLE, what, SourceSpan(file), text=str(error))
    if isinstance(error, UnicodeDecodeError):
        what = f"{error.reason} at byte {error.start}"
        return YamlProblem(ProblemKind.NOT_UTF8, what, SourceSpan(file), text=str(error))
    if not isinstance(error, yaml.MarkedYAMLError):
        return YamlProblem(ProblemKind.SYNTAX, str(error), SourceSpan(file), text=str(error))
    mark, begin = error.problem_mark, error.context_mark
    if begin is not None and (error.context or "").startswith(_LEFT_OPEN):
        # What was left open is the mistake; it shows lines behind.
        mark, begin = begin, mark
    kind = _kind(error)
    above = _line_above(mark) if kind is ProblemKind.MAPPING_VALUE else None
    if above is not None:
        kind, line, column = above
        span = SourceSpan(file, line, column)
        return YamlProblem(kind, error.problem or "", span, error.context or "", text=str(error))
    return YamlProblem(
        kind,
        error.problem or str(error),
        _span(mark, file) if mark else SourceSpan(file),
        error.context or "",
        _span(begin, file) if begin and begin is not mark else None,
        str(error),
    )


def _kind(error: yaml.MarkedYAMLError) -> ProblemKind:
    problem = error.problem or ""
    for kind, number in _KINDS:
        if isinstance(error, kind):
            return number
    if "\t" in _indentation(error.problem_mark):
        return ProblemKind.TAB_INDENT
    if "'\\t'" in problem:
        return ProblemKind.TAB
    if "mapping values are not allowed" in problem:
        return ProblemKind.MAPPING_VALUE
    return ProblemKind.SYNTAX


def _line_above(mark: yaml.Mark | None) -> tuple[ProblemKind, int, int] | None:
    """Return what the line above lacks that makes a mapping a surprise, and where that is."""
    text = getattr(mark, "buffer", None)
    if mark is None or text is None:
        return None
    lines = str(text[: mark.pointer]).split("\n")[:-1]
    while lines and not lines[-1].strip():
        lines.pop()
    if not lines:
        return None
    bare = _BARE_NAME.match(lines[-1])
    if bare:
        return ProblemKind.NO_COLON, len(lines), bare.end(1)
    tight = _NO_SPACE.match(lines[-1])
    return None if tight is None else (ProblemKind.NO_SPACE, len(lines), tight.end(1))


def _indentation(mark: yaml.Mark | None) -> str:
    """Return the white space that a line begins with; empty when the text is not at hand."""
    text = getattr(mark, "buffer", None)
    if mark is None or text is None:
        return ""
    begin = mark.pointer - mark.column
    end = begin
    while text[end : end + 1] in {" ", "\t"}:
        end += 1
    return str(text[begin:end])


def _span(mark: yaml.Mark, file: str) -> SourceSpan:
    return SourceSpan(file, mark.line + 1, mark.column + 1)
