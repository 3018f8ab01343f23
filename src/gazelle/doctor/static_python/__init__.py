"""Python files read as text: what their expressions come to, without running them."""

from __future__ import annotations

from gazelle.doctor.static_python.evaluating import Evaluator
from gazelle.doctor.static_python.parsing import parse_python
from gazelle.doctor.static_python.values import UNKNOWN, Call, Unknown, is_known

__all__ = ["UNKNOWN", "Call", "Evaluator", "Unknown", "is_known", "parse_python"]
