"""Python files read as text: what their expressions come to, without running them."""

from __future__ import annotations

from gazelle.workspace.static_python.evaluator import Evaluator, parse_python
from gazelle.workspace.static_python.syntax_problem import SyntaxProblem, syntax_problem
from gazelle.workspace.static_python.values import UNKNOWN, Call, Unknown, is_known

__all__ = [
    "UNKNOWN",
    "Call",
    "Evaluator",
    "SyntaxProblem",
    "Unknown",
    "is_known",
    "parse_python",
    "syntax_problem",
]
