"""Why a run failed, in words: one module for each kind of cause."""

from __future__ import annotations

from collections.abc import Callable

from gazelle.description.xacro.error_explanations.calls import explain_call
from gazelle.description.xacro.error_explanations.elements import (
    explain_element,
    explain_substitution,
)
from gazelle.description.xacro.error_explanations.expressions import (
    explain_expression,
    explain_name,
)
from gazelle.description.xacro.error_explanations.files import (
    explain_document,
    explain_file,
    explain_limit,
)
from gazelle.description.xacro.failure import Explanation, Failure, one_line

__all__ = ["Explanation", "explain"]

_EXPLAINERS: tuple[Callable[[Failure], Explanation | None], ...] = (
    explain_limit,
    explain_document,
    explain_file,
    explain_substitution,
    explain_name,
    explain_call,
    explain_expression,
    explain_element,
)


def explain(failure: Failure) -> Explanation:
    """Return what is wrong, where and what to do about it."""
    for explainer in _EXPLAINERS:
        found = explainer(failure)
        if found is not None:
            return found
    text = one_line(str(failure.error) or repr(failure.error))
    return Explanation("xacro.failed", text, failure.span)
