"""What is wrong with the stamps of a log."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

__all__ = ["duration_s", "stamp_problem"]

_MAX_PAUSE_NS = 86_400 * 1_000_000_000


def stamp_problem(stamps_ns: Sequence[int]) -> str:
    """Return what is wrong with the stamps of scans in their order, empty when nothing is."""
    if len(stamps_ns) < 2:
        return ""
    stamps = np.array([float(stamp) for stamp in stamps_ns])
    steps = np.diff(stamps)
    if not steps.any():
        return f"all {len(stamps)} scans have the same stamp, {stamps[0] * 1e-9:.9g} s"
    odd = np.flatnonzero((steps < 0) | (steps > _MAX_PAUSE_NS))
    if not len(odd):
        return ""
    first = int(odd[0])
    return (
        f"stamps of scans go back, or leap by more than a day, {len(odd)} times, first from "
        f"{stamps[first] * 1e-9:.9g} s to {stamps[first + 1] * 1e-9:.9g} s (scan {first + 1})"
    )


def duration_s(stamps_ns: Sequence[int]) -> float:
    """Return how long a log lasted, 0 when its stamps do not tell; see `stamp_problem`."""
    if len(stamps_ns) < 2 or stamp_problem(stamps_ns):
        return 0.0
    return (int(stamps_ns[-1]) - int(stamps_ns[0])) * 1e-9
