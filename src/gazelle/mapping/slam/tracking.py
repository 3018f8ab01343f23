"""Where the next scan is: odometry says roughly, the last kept scans say precisely."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.mapping.scan_matching.likelihood_field import Field
from gazelle.mapping.scan_matching.scan_matcher import Match, Prior, match, refined
from gazelle.mapping.se2 import Poses, between, compose
from gazelle.mapping.slam.keyframes import Keyframe, Keyframes
from gazelle.mapping.slam.pose_selection import local_map, select_pose
from gazelle.mapping.slam.slam_parameters import JumpSettings, SlamParameters

__all__ = ["Tracker", "is_jump", "motion_information"]


def motion_information(motion: Poses, parameters: SlamParameters) -> NDArray[np.float64]:
    """Return the inverse covariance, (3, 3), of a motion by odometry; x and y err alike."""
    way, turn = math.hypot(motion[0], motion[1]), abs(motion[2])
    told = parameters.settings.tracking
    sigma_m = told.still_m + parameters.odometry_m_per_m * way + told.m_per_rad * turn
    sigma_rad = (
        told.still_rad
        + parameters.odometry_rad_per_rad * turn
        + parameters.odometry_rad_per_m * way
    )
    return np.diag([sigma_m**-2, sigma_m**-2, sigma_rad**-2])


def is_jump(expected: Poses, found: Poses, settings: JumpSettings) -> bool:
    """Tell whether a pose is farther off than odometry errs while a few scans fit nowhere.

    Both poses are (3,) in the map: x, y (m) and yaw (rad).
    """
    return _is_apart(expected, found, settings.away_m, settings.away_rad)


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
        self._settings = parameters.settings
        self._usual_score = self._settings.tracking.usual_score
        self._usual_spread = self._settings.tracking.usual_spread
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
            expected: pose in the map by odometry, (3,): x, y (m) and yaw (rad).
            motion: how far odometry went since the last scan, (3,) in the robot's frame then.
        """
        told = self._settings.tracking
        if len(frame.points_m) < told.fewest_points:
            return None
        found = self._found_again(frame, expected, motion) if self.lost else None
        if found is None and self._jump is None:
            found = self._followed(frame, expected, motion)
        if found is None:
            self.lost += 1
            return None
        change = found.score - self._usual_score
        self._usual_score += told.forget * change
        self._usual_spread += told.forget * (abs(change) - self._usual_spread)
        self.lost = 0
        return found

    def _found_again(self, frame: Keyframe, expected: Poses, motion: Poses) -> Match | None:
        """Return where a lost robot is; a jump that is not proved yet is remembered instead."""
        told, before, self._jump = self._settings.jump, self._jump, None
        found = self.relocate(frame, expected)
        if found is None or not is_jump(expected, found.pose, told):
            return found
        points = len(frame.points_m)
        if before is not None:
            moved = compose(before.pose, motion)
            if _is_apart(moved, found.pose, told.same_m, told.same_rad):
                return None
            points += before.points
        if points >= told.proving_points:
            return found
        self._jump = _Jump(found.pose, points)
        return None

    def _followed(self, frame: Keyframe, expected: Poses, motion: Poses) -> Match | None:
        submap = self._current(expected, frame.reach_m)
        prior = Prior(expected, motion_information(motion, self._parameters))
        told, numbers = self._parameters, self._settings.tracking
        least = numbers.suspicious * self._usual_score
        if (
            math.hypot(motion[0], motion[1]) < numbers.still_m
            and abs(motion[2]) < numbers.still_rad
        ):
            near = refined(submap.field, frame.points_m, expected, prior, self._settings.match)
            if near.score > max(numbers.good_score, least):
                return near
        sigma_m, sigma_rad = (float(prior.information[i, i]) ** -0.5 for i in (0, 2))
        reach_m, reach_rad = max(told.window_m, 3 * sigma_m), max(told.window_rad, 3 * sigma_rad)
        found = match(
            submap.field, frame.points_m, prior,
            reach_m=reach_m, reach_rad=reach_rad, coarse=submap.coarse,
            settings=self._settings.match,
        )  # fmt: skip
        if found.score < least:
            # Wheels slip, clocks differ, and what is new to the last scans may be known of old.
            wide = max(numbers.wide_m, reach_m), max(numbers.wide_rad, 2 * reach_rad)
            return self._doubted(self._weighed(frame, expected, found.pose, wide))
        return found if found.score > told.least_match else None

    def _doubted(self, found: Match | None) -> Match | None:
        """Doubt what all at once fits badly: a robot may have been carried away."""
        told = self._settings.tracking
        sudden = max(told.sudden, told.sudden_spreads * self._usual_spread)
        if found is None or found.score >= self._usual_score - sudden:
            return found
        return replace(found, is_doubtful=True)

    def _weighed(
        self, frame: Keyframe, expected: Poses, guess: Poses, reach: tuple[float, float]
    ) -> Match | None:
        """Return the likeliest pose of a wide window among all that was seen around it."""
        reach_m = frame.reach_m + reach[0]
        around = local_map(self._keyframes, expected, reach_m, self._settings)
        found = select_pose(around, frame, expected, [guess], reach)
        if found is not None and not found.is_doubtful:
            return found
        # What was seen long ago may not lie where it should yet.
        last = self._parameters.submap_scans
        around = local_map(self._keyframes, expected, reach_m, self._settings, last)
        again = select_pose(around, frame, expected, [guess], reach)
        return found if again is None or (found and again.is_doubtful) else again

    def relocate(self, frame: Keyframe, expected: Poses) -> Match | None:
        """Return where a lost robot is, among all that was seen around where it may be.

        It may be around a pose (3,) of the map: x, y (m) and yaw (rad).
        """
        told = self._settings.relocation
        reach = min(told.most_m, told.reach_m + self.lost * told.reach_m_per_scan), math.pi
        reach_m = frame.reach_m + reach[0]
        around = local_map(self._keyframes, expected, reach_m, self._settings)
        found = select_pose(around, frame, expected, [], reach, is_lost=True)
        if found is None or found.is_doubtful:
            return None
        return found if found.score > told.believed * self._usual_score else None

    def _current(self, expected: Poses, reach_m: float) -> _Submap:
        told, known = self._settings.tracking, self._submap
        if known is None or math.dist(known.center[:2], expected[:2]) > told.left_m:
            reach = min(self._parameters.max_range_m, reach_m + told.field_margin_m)
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
