"""What a scan says of surfaces: points evenly spread, and the lines between neighbouring beams."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.scan_matching.settings import SurfaceSettings

__all__ = ["dense_surface", "even_points"]


def even_points(points_m: NDArray[np.float64], cell_m: float, most: int) -> NDArray[np.float64]:
    """Return at most one point per cell, and at most so many in all, shape (m, 2).

    Near walls meet most beams; without this they would outvote what is far.
    """
    if not len(points_m):
        return points_m
    keys = np.floor(points_m / cell_m).astype(np.int64)
    _, first = np.unique(keys[:, 0] * 1_000_003 + keys[:, 1], return_index=True)
    kept = points_m[np.sort(first)]
    if len(kept) > most:
        kept = kept[np.linspace(0, len(kept) - 1, most).astype(int)]
    return np.ascontiguousarray(kept)


def dense_surface(
    points_m: NDArray[np.float64],
    beams: NDArray[np.int64],
    spacing_m: float,
    settings: SurfaceSettings,
) -> NDArray[np.float64]:
    """Return what the beams met and the surfaces between neighbouring beams, shape (m, 2).

    Beams that graze a wall meet it at points far from each other, at the same places in every
    scan from along the wall: matching would stick to them.

    Args:
        points_m: what was met, (n, 2).
        beams: which beam met each, ascending.
        spacing_m: of points on surfaces.
        settings: which beams met one surface.
    """
    if len(points_m) < 3:
        return points_m
    neighbours = np.diff(beams) == 1
    steps = np.diff(points_m, axis=0)
    gaps = np.hypot(steps[:, 0], steps[:, 1])
    straight = _straight(steps, gaps, neighbours, settings.straight_m)
    joined = neighbours & ((gaps < settings.same_m) | ((gaps < settings.straight_gap_m) & straight))
    counts = np.where(joined, np.floor(gaps / spacing_m).astype(int), 0)
    segment = np.repeat(np.arange(len(steps)), counts)
    place = np.arange(len(segment)) - np.repeat(np.cumsum(counts) - counts, counts) + 1
    between = points_m[segment] + steps[segment] * (place / (counts[segment] + 1))[:, None]
    return np.concatenate([points_m, between])


def _straight(
    steps: NDArray[np.float64],
    gaps: NDArray[np.float64],
    neighbours: NDArray[np.bool_],
    most_m: float,
) -> NDArray[np.bool_]:
    """Which gaps continue the line of the gap before or after them."""
    cross = np.abs(steps[:-1, 0] * steps[1:, 1] - steps[:-1, 1] * steps[1:, 0])
    forward = (steps[:-1] * steps[1:]).sum(axis=1) > 0
    longer = np.maximum(np.maximum(gaps[:-1], gaps[1:]), 1e-9)
    # Distance of the middle point's neighbours from the line of the longer step.
    bent = cross / longer
    pair = forward & (bent < most_m) & neighbours[:-1] & neighbours[1:]
    out = np.zeros(len(gaps), dtype=bool)
    out[:-1] |= pair
    out[1:] |= pair
    return out
