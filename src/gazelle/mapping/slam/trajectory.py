"""Where every scan was, kept ones and others, relative to kept ones."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gazelle.mapping.poses import Poses, between, compose
from gazelle.mapping.slam.keyframes import Keyframe, Keyframes
from gazelle.mapping.slam.tracking import Tracker

__all__ = ["Track"]


class _Lost(NamedTuple):
    place: int
    frame: Keyframe
    odometry: Poses


class Track:
    """The poses of all scans; they move when keyframes are moved.

    Attributes:
        stamps_ns: of all scans.
    """

    def __init__(self, keyframes: Keyframes) -> None:
        """Start empty."""
        self.stamps_ns: list[int] = []
        self._keyframes = keyframes
        self._anchors: list[int] = []
        self._offsets: list[Poses] = []
        self._lost: list[_Lost] = []

    def add(self, stamp_ns: int, pose: Poses) -> None:
        """Note the pose, (3,) in the map, m and rad, of one more scan, beside the last keyframe."""
        self.stamps_ns.append(stamp_ns)
        self._anchors.append(0)
        self._offsets.append(pose)
        self._place(len(self.stamps_ns) - 1, pose)

    def poses(self) -> Poses:
        """Return the poses of all scans in the map's frame, (n, 3)."""
        if not self._anchors:
            return np.empty((0, 3))
        return compose(self._keyframes.poses[self._anchors], np.array(self._offsets))

    def note_lost(self, frame: Keyframe, odometry: Poses) -> None:
        """Note that the last scan fitted nowhere, with the pose (3,) that odometry told then."""
        self._lost.append(_Lost(len(self.stamps_ns) - 1, frame, odometry))

    def find_lost(self, tracker: Tracker, pose: Poses, odometry: Poses) -> None:
        """Place lost scans from where the robot is found again, back in time.

        Args:
            tracker: that found it.
            pose: where it is now in the map, (3,): x, y (m) and yaw (rad).
            odometry: what odometry says now, likewise (3,) in its own frame.
        """
        for lost in reversed(self._lost):
            expected = compose(pose, between(odometry, lost.odometry))
            found = tracker.relocate(lost.frame, expected)
            pose, odometry = expected if found is None else found.pose, lost.odometry
            self._place(lost.place, pose)
        self._lost.clear()

    def _place(self, index: int, pose: Poses) -> None:
        last = len(self._keyframes) - 1
        self._anchors[index] = last
        self._offsets[index] = between(self._keyframes.poses[last], pose)
