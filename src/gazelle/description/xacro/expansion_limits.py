"""What one run of xacro may use up: the largest public robots take a tenth of it."""

from __future__ import annotations

import builtins
import io
import re
import time
from collections.abc import Callable
from typing import Any

from gazelle.documents import Budget, LimitError, compile_limited, read_text_limited, scaled
from gazelle.documents.yaml import ProblemKind, YamlError, read_yaml

__all__ = ["ExpansionBudget", "ExpansionLimitError"]

_MAX_SECONDS = 10
_LONG_YAML = 1 << 20
_DEEP_YAML = 32
_BRACKETS = re.compile(r"[][{}]")
# Indented far, or many lists begun in it.
_DEEP_LINE = re.compile(r"^(?: {32}|[ ]*(?:[-?] +){16})", re.MULTILINE)
# Until its release 6.0.4, PyYAML follows merges of merges one by one.
_MERGE = "<<"
_SLOW = {ProblemKind.TOO_LONG, ProblemKind.TOO_DEEP, ProblemKind.TOO_MUCH}
_MAX_CALLS = 5_000
_MAX_COPIES = 20_000
_MAX_TEXTS = 200_000
_MAX_CHARACTERS = 64 << 20


class ExpansionLimitError(LimitError):
    """A file expands to too much."""


class ExpansionBudget:
    """Counts what a run does, and ends it with a `LimitError` where that is absurd.

    Attributes:
        expressions: watches over what expressions compute.
    """

    def __init__(self) -> None:
        self.expressions = Budget()
        self._calls = self._texts = self._characters = self._copies = 0
        self._most_copies = scaled(_MAX_COPIES)
        self._end_s = time.thread_time() + scaled(_MAX_SECONDS)
        self._most_texts = scaled(_MAX_TEXTS)
        self._most_characters = scaled(_MAX_CHARACTERS)

    def counted(self, function: Callable[..., Any]) -> Callable[..., Any]:
        """Count the calls of the library's function for macro calls or for includes."""

        def call(element: Any, *rest: Any) -> Any:
            self._calls += 1
            if self._calls > scaled(_MAX_CALLS):
                limit = scaled(_MAX_CALLS)
                raise ExpansionLimitError(f"more than {limit} macro calls and includes")
            if time.thread_time() > self._end_s:
                limit = scaled(_MAX_SECONDS)
                raise ExpansionLimitError(f"more than {limit} s of computing")
            return function(element, *rest)

        return call

    def copied(self) -> None:
        """Count an element that is copied from a macro's body or from a block."""
        self._copies += 1
        if self._copies > self._most_copies:
            raise ExpansionLimitError(f"more than {self._most_copies} copies of elements")

    def texts(self, eval_text: Callable[[str, Any], Any]) -> Callable[[str, Any], Any]:
        """Count the texts that are evaluated, and pass those without a dollar sign through.

        The library's lexer would do the same with them, only later.
        """

        def evaluate(text: str, symbols: Any) -> Any:
            result = text if text and "$" not in text else eval_text(text, symbols)
            self._texts += 1
            if type(result) is str:
                self._characters += len(result)
            if self._texts > self._most_texts or self._characters > self._most_characters:
                raise self._too_much_text()
            return result

        return evaluate

    def _too_much_text(self) -> ExpansionLimitError:
        if self._texts > self._most_texts:
            return ExpansionLimitError(f"more than {self._most_texts} attributes and texts")
        most = self._most_characters
        return ExpansionLimitError(f"attributes and texts of more than {most} characters")

    def open(self, name: str) -> io.StringIO:
        """Open a YAML file that an expression loads; see `gazelle.documents.read_text_limited`.

        Raises:
            OSError: it cannot be read.
            YamlError: it is so long or so deep, or merges so much, that PyYAML would take for ever.
        """
        text = read_text_limited(name)
        # The library reads it again: that is not done twice where it cannot be slow.
        problem = read_yaml(text, name).problem if _may_be_slow(text) else None
        if problem is not None and problem.kind in _SLOW:
            raise YamlError(problem)
        return io.StringIO(text)

    def eval(self, text: str, names: dict[str, Any], locals_: Any) -> Any:
        """Evaluate what stands in ``$(eval …)``, in place of Python's own function."""
        code = compile_limited(text, "<string>")
        allowed = {**vars(builtins), **self.expressions.names}
        # As the library does: the file's own expression.
        value = eval(code, {**names, "__builtins__": allowed}, locals_)  # noqa: S307
        return self.expressions.checked(value)


def _may_be_slow(text: str) -> bool:
    """Tell whether a YAML text may be slow to read; what stands in quotes counts as well."""
    if len(text) > _LONG_YAML or _MERGE in text or _DEEP_LINE.search(text):
        return True
    depth = 0
    for bracket in _BRACKETS.findall(text):
        depth += 1 if bracket in "[{" else -1
        if depth > _DEEP_YAML:
            return True
    return False
