"""Long sets of cases: a part in every run of the tests, the whole in ``benchmarks/soak``.

``benchmarks/soak/whole_sets.py`` runs the tests that ask here with all that they have.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TypeVar

__all__ = ["few", "part"]

_IS_WHOLE = os.environ.get("GAZELLE_WHOLE_SETS") == "1"
T = TypeVar("T")


def few(usually: T, whole: T) -> T:
    """Return what runs usually, or the whole: how often something is repeated, or which cases."""
    return whole if _IS_WHOLE else usually


def part(cases: Sequence[T], count: int) -> Sequence[T]:
    """Return so many cases, spread over all of them; all of them in ``benchmarks/soak``."""
    if _IS_WHOLE or count >= len(cases):
        return cases
    return [cases[k * len(cases) // count] for k in range(count)]
