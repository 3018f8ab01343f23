"""Kernels that are wanted together, and what compiling them costs."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["AREAS", "COMPILING", "Area", "area_of"]

COMPILING = "compiling the kernels of "
"""How the line begins that says that somebody compiles."""


class Area(NamedTuple):
    """Kernels that are wanted together.

    Attributes:
        package: part of Gazelle that they belong to.
        what: they are for, in words.
        compile_s: processor time of compiling all of them, about; `benchmarks/bench_kernels.py`.
    """

    package: str
    what: str
    compile_s: int


AREAS = (
    Area("sensors", "cameras", 1),
    Area("mapping", "SLAM", 2),
    Area("motion", "arm planning", 3),
    Area("navigation", "navigation", 3),
)
"""All that is compiled."""


def area_of(module: str) -> Area | None:
    """Return what a module's kernels are for, None for those that others call."""
    package = module.partition(".")[2].partition(".")[0]
    return next((area for area in AREAS if area.package == package), None)
