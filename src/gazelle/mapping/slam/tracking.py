"""Where the next scan is: odometry says roughly, the last kept scans say precisely."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.matching.field import Field
from gazelle.mapping.matching.match import Match, Prior, match, refined
from gazelle.mapping.poses import Poses, between, compose
from gazelle.mapping.slam.keyframes import Keyframe, Keyframes
from gazelle.mapping.slam.parameters import SlamParameters
from gazelle.mapping.slam.weighing import surroundings, weighed

__all__ = ["FEWEST_POINTS", "Tracker", "is_jump", "motion_information"]

FEWEST_POINTS = 20
"""Scans that meet less say nothing of where they are."""

_STILL_M = 0.05
_STILL_RAD = 0.03
_GOOD_SCORE = 0.6
_SUSPICIOUS = 0.8
_SUDDEN, _SUDDEN_SPREADS = 0.3, 6.0
_FORGET = 0.05
_BELIEVED = 0.85
_WIDE_M = 1.0
_WIDE_RAD = 1.2
_LOST_M = 2.0
_LOST_M_PER_SCAN = 1.0
_LOST_MOST_M = 6.0
# Odometry errs by less while a scan or two fit nowhere. That a robot was carried away must be
# proved by so many points, of several scans in a row where they are few: in the open there are
# always some that a few bushes fit.
_JUMP_M, _JUMP_RAD = 1.0, 0.6
_PROVING_POINTS = 500
_SAME_M, _SAME_RAD = 0.5, 0.3
# A field reaches 2 m farther than beams do.
_LEFT_M = 1.5


def motion_information(motion: Poses, parameters: SlamParameters) -> NDArray[np.float64]:
    """Return the inverse covariance, (3, 3), of a motion by odometry; x and y err alike."""
    way, turn = math.hypot(motion[0], motion[1]), abs(motion[2])
    sigma_m = _STILL_M + parameters.odometry_m_per_m * way + 0.02 * turn
    sigma_rad = (
        _STILL_RAD + parameters.odometry_rad_per_rad * turn + parameters.odometry_rad_per_m * way
    )
    return np.diag([sigma_m**-2, sigma_m**-2, sigma_rad**-2])


def is_jump(expected: Poses, found: Poses) -> bool:
    """Tell whether a pose is farther off than odometry errs while a few scans fit nowhere."""
    return _is_apart(expected, found, _JUMP_M, _JUMP_RAD)


class _Jump(NamedTuple):
    """Where a robot seems to have been carried, and how many points say so."""

    pose: Poses
    points: int


@dataclass(frozen=True, slots=True, eq=False)
class _Submap:
    field: Field
    coarse: Field
    center: Poses


class Tracker:
    """Matches scans with the last kept ones.

    Attributes:
        lost: how many scans in a row fitted nowhere.
        uses_nearest: scans are matched with the nearest kept ones in place of the last ones, in a
            map that was there before.
    """

    def __init__(self, keyframes: Keyframes, parameters: SlamParameters) -> None:
        """Follow the robot among keyframes."""
        self._keyframes = keyframes
        self._parameters = parameters
        self._submap: _Submap | None = None
        self._usual_score = 0.8
        self._usual_spread = 0.1
        self._jump: _Jump | None = None
        self.lost = 0
        self.uses_nearest = False

    def forget(self) -> None:
        """Keyframes were added or moved."""
        self._submap = None

    def locate(self, frame: Keyframe, expected: Poses, motion: Poses) -> Match | None:
        """Return where a scan is, None when it fits nowhere near.

        Args:
            frame: the scan.
            expected: pose by odometry.
            motion: how far odometry went since the last scan.
        """
        if len(frame.points_m) < FEWEST_POINTS:
            return None
        found = self._found_again(frame, expected, motion) if self.lost else None
        if found is None and self._jump is None:
            found = self._followed(frame, expected, motion)
        if found is None:
            self.lost += 1
            return None
        change = found.score - self._usual_score
        self._usual_score += _FORGET * change
        self._usual_spread += _FORGET * (abs(change) - self._usual_spread)
        self.lost = 0
        return found

    def _found_again(self, frame: Keyframe, expected: Poses, motion: Poses) -> Match | None:
        """Return where a lost robot is; a jump that is not proved yet is remembered instead."""
        before, self._jump = self._jump, None
        found = self.relocate(frame, expected)
        if found is None or not is_jump(expected, found.pose):
            return found
        points = len(frame.points_m)
        if before is not None:
            if _is_apart(compose(before.pose, motion), found.pose, _SAME_M, _SAME_RAD):
                return None
            points += before.points
        if points >= _PROVING_POINTS:
            return found
        self._jump = _Jump(found.pose, points)
        return None

    def _followed(self, frame: Keyframe, expected: Poses, motion: Poses) -> Match | None:
        submap = self._current(expected, frame.reach_m)
        prior = Prior(expected, motion_information(motion, self._parameters))
        if math.hypot(motion[0], motion[1]) < _STILL_M and abs(motion[2]) < _STILL_RAD:
            near = refined(submap.field, frame.points_m, expected, prior)
            if near.score > max(_GOOD_SCORE, _SUSPICIOUS * self._usual_score):
                return near
        told = self._parameters
        sigma_m, sigma_rad = (float(prior.information[i, i]) ** -0.5 for i in (0, 2))
        reach_m, reach_rad = max(told.window_m, 3 * sigma_m), max(told.window_rad, 3 * sigma_rad)
        found = match(
            submap.field, frame.points_m, prior,
            reach_m=reach_m, reach_rad=reach_rad, coarse=submap.coarse,
        )  # fmt: skip
        if found.score < _SUSPICIOUS * self._usual_score:
            # Wheels slip, clocks differ, and what is new to the last scans may be known of old.
            wide = max(_WIDE_M, reach_m), max(_WIDE_RAD, 2 * reach_rad)
            return self._doubted(self._weighed(frame, expected, found.pose, wide))
        return found if found.score > told.least_match else None

    def _doubted(self, found: Match | None) -> Match | None:
        """Doubt what all at once fits badly: a robot may have been carried away."""
        sudden = max(_SUDDEN, _SUDDEN_SPREADS * self._usual_spread)
        if found is None or found.score >= self._usual_score - sudden:
            return found
        return replace(found, is_doubtful=True)

    def _weighed(
        self, frame: Keyframe, expected: Poses, guess: Poses, reach: tuple[float, float]
    ) -> Match | None:
        """Return the likeliest pose of a wide window among all that was seen around it."""
        reach_m = frame.reach_m + reach[0]
        around = surroundings(self._keyframes, expected, reach_m)
        found = weighed(around, frame, expected, [guess], reach)
        if found is not None and not found.is_doubtful:
            return found
        # What was seen long ago may not lie where it should yet.
        around = surroundings(self._keyframes, expected, reach_m, self._parameters.submap_scans)
        again = weighed(around, frame, expected, [guess], reach)
        return found if again is None or (found and again.is_doubtful) else again

    def relocate(self, frame: Keyframe, expected: Poses) -> Match | None:
        """Return where a lost robot is, among all that was seen around where it may be."""
        reach = min(_LOST_MOST_M, _LOST_M + self.lost * _LOST_M_PER_SCAN), math.pi
        around = surroundings(self._keyframes, expected, frame.reach_m + reach[0])
        found = weighed(around, frame, expected, [], reach, is_lost=True)
        if found is None or found.is_doubtful:
            return None
        return found if found.score > _BELIEVED * self._usual_score else None

    def _current(self, expected: Poses, reach_m: float) -> _Submap:
        known = self._submap
        if known is None or math.dist(known.center[:2], expected[:2]) > _LEFT_M:
            reach = min(self._parameters.max_range_m, reach_m + 2.0)
            field = self._keyframes.field(self._chosen(expected), expected, reach)
            known = self._submap = _Submap(field, field.pooled(), expected.copy())
        return known

    def _chosen(self, expected: Poses) -> list[int]:
        count, wanted = len(self._keyframes), self._parameters.submap_scans
        if not self.uses_nearest:
            return list(range(max(0, count - wanted), count))
        far = np.hypot(*(self._keyframes.poses[:, :2] - expected[:2]).T)
        return [int(k) for k in np.argsort(far)[:wanted]]


def _is_apart(one: Poses, other: Poses, most_m: float, most_rad: float) -> bool:
    away = between(one, other)
    return bool(math.hypot(away[0], away[1]) > most_m or abs(away[2]) > most_rad)
