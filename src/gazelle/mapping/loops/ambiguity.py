"""How far a place could be shifted and would still look about the same."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.loops.settings import AmbiguitySettings
from gazelle.mapping.matching.field import Field
from gazelle.mapping.matching.match import Match
from gazelle.mapping.pose_graph.information import bounded

__all__ = ["ambiguous"]


def ambiguous(
    field: Field,
    points_m: NDArray[np.float64],
    found: Match,
    reach_m: float,
    settings: AmbiguitySettings,
) -> NDArray[np.float64]:
    """Return the inverse covariance of a match, (3, 3), other matches nearby being possible too.

    The shape of the best peak does not know of others beside it: along a corridor every door fits
    every door. Shifts along the direction that is known least count by how well they fit (Olson,
    "Real-time correlative scan matching", 2009).
    """
    information = bounded(found.information)
    _, axes = np.linalg.eigh(information[:2, :2])
    along = axes[:, 0]
    shifts = np.arange(-reach_m, reach_m + settings.step_m / 2, settings.step_m)
    scores = np.array(
        [field.mean(points_m, found.pose + np.array([*(along * shift), 0.0])) for shift in shifts]
    )
    weights = np.exp(np.minimum(0.0, scores - found.score) / settings.score_sigma)
    variance = float((weights * shifts**2).sum() / max(1.0, weights.sum()))
    # Sherman and Morrison (1950): the covariance grows by this variance along the axis.
    axis = np.array([*along, 0.0])
    pushed = information @ axis
    return np.asarray(
        information - np.outer(pushed, pushed) * variance / (1 + variance * float(axis @ pushed))
    )
