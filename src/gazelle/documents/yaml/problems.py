"""What is wrong with a YAML text, as records."""

from __future__ import annotations

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
    SYNTAX = auto()
    TOO_LONG = auto()
    TOO_DEEP = auto()
    TOO_MUCH = auto()
    VALUE = auto()


_FIXES = {
    ProblemKind.TAB_INDENT: "indent with spaces",
    ProblemKind.TAB: "indent with spaces",
    ProblemKind.MAPPING_VALUE: "put the value in quotes, or correct the indentation",
}


# The narrower ones first.
_KINDS: tuple[tuple[type[Exception], ProblemKind], ...] = (
    (YamlLengthError, ProblemKind.TOO_LONG),
    (YamlDepthError, ProblemKind.TOO_DEEP),
    (YamlLimitError, ProblemKind.TOO_MUCH),
    (yaml.constructor.ConstructorError, ProblemKind.VALUE),
)


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
    return YamlProblem(
        _kind(error),
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
