"""Why a run failed, in words: one module for each kind of cause."""

from __future__ import annotations

from collections.abc import Callable

from gazelle.description.xacro.explaining.calls import explain_call
from gazelle.description.xacro.explaining.documents import explain_document
from gazelle.description.xacro.explaining.elements import explain_element
from gazelle.description.xacro.explaining.expressions import explain_expression
from gazelle.description.xacro.explaining.files import explain_file
from gazelle.description.xacro.explaining.finding import Finding, one_line
from gazelle.description.xacro.explaining.limits import explain_limit
from gazelle.description.xacro.explaining.names import explain_name
from gazelle.description.xacro.explaining.substitutions import explain_substitution
from gazelle.description.xacro.failure import Failure

__all__ = ["Finding", "explain"]

_EXPLAINERS: tuple[Callable[[Failure], Finding | None], ...] = (
    explain_limit,
    explain_document,
    explain_file,
    explain_substitution,
    explain_name,
    explain_call,
    explain_expression,
    explain_element,
)


def explain(failure: Failure) -> Finding:
    """Return what is wrong, where and what to do about it."""
    for explainer in _EXPLAINERS:
        found = explainer(failure)
        if found is not None:
            return found
    text = one_line(str(failure.error) or repr(failure.error))
    return Finding("xacro.failed", text, failure.span)
