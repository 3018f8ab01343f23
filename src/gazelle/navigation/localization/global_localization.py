"""Where in a whole map a robot may be that sees a scan."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.localization.beam_refinement import Refiner
from gazelle.navigation.localization.laser_model import LikelihoodMap

__all__ = ["chances_of", "places_like"]

_POSES_PER_M2 = 6000
_MAX_POSES = 300_000
_BEAMS = 30
_CELL = np.array([0.3, 0.3, math.radians(20)])
_MAX_PLACES = 300
_WIDE = np.diag([0.1**2, 0.1**2, 0.1**2])
_JITTER = np.array([0.03, 0.03, 0.02])
# Maps are some centimetres wrong, so that a scan alone decides nothing for good.
_CAUTION = 3.0


def chances_of(fits: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return how likely each of n poses is, (n,), from `Refiner.log_fits`; their sum is 1."""
    chances = np.exp((fits - fits.max()) / _CAUTION)
    return np.asarray(chances / chances.sum())


def places_like(
    ends: NDArray[np.float64],
    place: LikelihoodMap,
    refiner: Refiner,
    count: int,
    random: np.random.Generator,
) -> NDArray[np.float64]:
    """Return poses where a scan fits, as often as it fits well there, (count, 3).

    Many poses all over the map are looked at with some of the beams; the best ones of every
    neighbourhood are moved to where the scan fits best, so that chance does not decide between
    places that look alike.

    Args:
        ends: of beams that met something, in the robot's frame, (n, 2).
        place: the map; it has a free cell.
        refiner: of that map.
        count: how many poses.
        random: where chance comes from.
    """
    area_m2 = len(place.free) * place.resolution_m**2
    tried = int(min(max(area_m2 * _POSES_PER_M2, count), _MAX_POSES))
    poses = place.random_poses(tried, random)
    if not len(ends):
        return poses[:count]
    order = np.argsort(-refiner.log_fits(poses, ends[:: max(len(ends) // _BEAMS, 1)]))
    poses = poses[order]
    _cells, first = np.unique(np.floor(poses / _CELL), axis=0, return_index=True)
    chosen = poses[np.sort(first)[:_MAX_PLACES]]
    best = np.array([refiner.refine(pose, _WIDE, ends) for pose in chosen])
    drawn = random.choice(len(best), count, p=chances_of(refiner.log_fits(best, ends)))
    return np.asarray(best[drawn] + random.standard_normal((count, 3)) * _JITTER)
