"""How well scans fit beam by beam, and the pose where one fits best."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.localization.laser_model import LikelihoodMap

__all__ = ["Refiner"]

_SIGMA_M = 0.1
_OUTLIERS = 0.1
# Neighbouring beams err alike, so more of them say no more.
_INDEPENDENT = 30.0
_MIN_SPREAD = np.array([0.03, 0.03, 0.02])
_FIRST_STEP = np.array([0.04, 0.04, 0.03])
_HALVINGS = 4
_MAX_STEPS = 40
_AROUND = np.array(list(itertools.product((0.0, -1.0, 1.0), repeat=3)))


class Refiner:
    """Climbs from the particles' mean to where the scan fits best.

    amcl's likelihoods are broad on purpose, so that few particles are enough; its mean pose is
    some centimetres off even where a scan tells the place to one. The particles' spread is the
    prior: along a corridor, where a scan says nothing, the mean stays.
    """

    def __init__(self, place: LikelihoodMap) -> None:
        """Prepare a map."""
        self._map = place
        squares = place.distances_m.astype(np.float64) ** 2
        values = _value(squares)
        self._field = np.ascontiguousarray(values.astype(np.float32))
        self._outside = np.float32(_value(np.array(place.reach_m**2)))

    def refine(
        self,
        mean: NDArray[np.float64],
        covariance: NDArray[np.float64],
        ends: NDArray[np.float64],
    ) -> NDArray[np.float64]:
        """Return a pose near the mean.

        Args:
            mean: of a group of particles, (3,).
            covariance: of them, (3, 3).
            ends: of beams that met something, in the robot's frame, (n, 2).
        """
        if not len(ends):
            return mean
        inverse = np.asarray(np.linalg.inv(covariance + np.diag(_MIN_SPREAD**2)), np.float64)
        best, step = mean.copy(), _FIRST_STEP.copy()
        halvings = 0
        for _ in range(_MAX_STEPS):
            around = best + _AROUND * step
            chosen = int(np.argmax(self._scores(around, mean, inverse, ends)))
            if chosen:
                best = around[chosen]
                continue
            if halvings == _HALVINGS:
                break
            halvings += 1
            step /= 2
        return best

    def log_fits(
        self, poses: NDArray[np.float64], ends: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Return, by pose, the logarithm of how likely it is to see this there, (n,)."""
        from gazelle.navigation.localization.amcl_kernels import log_sums

        out = np.zeros(len(poses))
        if not len(ends):
            return out
        used = np.ones(len(ends), bool)
        # One layout, whatever they are a part of: another one would be compiled for anew.
        ends = np.ascontiguousarray(ends)
        log_sums(poses, ends, used, self._field, self._outside, self._map.frame, out)
        return np.asarray(out * min(1.0, _INDEPENDENT / len(ends)))

    def _scores(
        self,
        poses: NDArray[np.float64],
        mean: NDArray[np.float64],
        inverse: NDArray[np.float64],
        ends: NDArray[np.float64],
    ) -> NDArray[np.float64]:
        off = poses - mean
        away = np.einsum("ni,ij,nj->n", off, inverse, off)
        return np.asarray(self.log_fits(poses, ends) - 0.5 * away)


def _value(squares: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.asarray(np.log((1 - _OUTLIERS) * np.exp(-squares / (2 * _SIGMA_M**2)) + _OUTLIERS))
