"""States of a motion at given times."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.motion.space import FloatArray
from gazelle.motion.timing.profile import Span

__all__ = ["States", "states_at", "times_of"]


@dataclass(frozen=True, eq=False)
class States:
    """Positions, velocities and accelerations of joints, shape (m, n) each."""

    positions: FloatArray
    velocities: FloatArray
    accelerations: FloatArray


def times_of(stops_s: FloatArray, period_s: float) -> FloatArray:
    """Return the times of samples: a period apart as MoveIt takes them, and one at every stop.

    A sample of the period that lies less than a thousandth of it from a stop is left out.

    Args:
        stops_s: (m,), increasing; the last one is the end.
        period_s: above zero.
    """
    regular = np.arange(math.ceil(float(stops_s[-1]) / period_s)) * period_s
    nearest = np.abs(regular[:, None] - stops_s).min(axis=1)
    return np.sort(np.concatenate([regular[nearest > 1e-3 * period_s], stops_s]))


def states_at(spans: Sequence[Span], times_s: FloatArray) -> States:
    """Return the states (k, n) along spans at times (k,); times beyond its end give its end."""
    ends = np.cumsum([span.duration_s for span in spans])
    chosen = np.minimum(np.searchsorted(ends, times_s, side="right"), len(spans) - 1)
    size = len(spans[0].segment.states(np.zeros(1))[0][0])
    found = States(*(np.empty((len(times_s), size)) for _ in range(3)))
    for index in np.unique(chosen):
        span, rows = spans[index], np.flatnonzero(chosen == index)
        since = np.clip(times_s[rows] - (ends[index] - span.duration_s), 0.0, span.duration_s)
        speed = np.maximum(0.0, span.speed + span.acceleration * since)
        gone = (span.speed + 0.5 * span.acceleration * since) * since
        q, first, second = span.segment.states(span.start + gone)
        found.positions[rows] = q
        found.velocities[rows] = first * speed[:, None]
        found.accelerations[rows] = first * span.acceleration + second * speed[:, None] ** 2
    return found
