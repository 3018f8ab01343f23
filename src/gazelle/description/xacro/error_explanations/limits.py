"""Runs that were ended because the file asks for too much."""

from __future__ import annotations

from gazelle.description.xacro.error_explanations.finding import Finding, one_line
from gazelle.description.xacro.expansion_limits import ExpansionLimitError
from gazelle.description.xacro.failure import Failure
from gazelle.documents import LimitError

__all__ = ["explain_limit"]

_MAX_LENGTH = 80


def explain_limit(failure: Failure) -> Finding | None:
    """Explain that a limit was reached; None for other failures."""
    error = failure.cause(LimitError)
    if error is None:
        return None
    if isinstance(error, ExpansionLimitError):
        message = f"the file expands to too much: {error}"
        return Finding("limits.expansion", message, failure.span)
    shown = one_line(failure.expression or failure.part)
    shown = shown if len(shown) <= _MAX_LENGTH else f"{shown[:_MAX_LENGTH]}…"
    message = f"{error}, when evaluating expression '{shown}'"
    return Finding("limits.expression", message, failure.span)
