"""Moving the map so that places seen again coincide."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gazelle.mapping.loop_detection.hypotheses import Hypotheses, Hypothesis
from gazelle.mapping.loop_detection.loop_candidates import loop_candidates, recognise
from gazelle.mapping.pose_graph.constraints import Edges, doubtful
from gazelle.mapping.pose_graph.optimizer import optimise, residuals
from gazelle.mapping.se2 import Poses, between, compose
from gazelle.mapping.slam.keyframes import Keyframe, Keyframes
from gazelle.mapping.slam.slam_parameters import SlamParameters
from gazelle.mapping.slam.tracking import Tracker

__all__ = ["LoopCloser", "Track"]


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


class LoopCloser:
    """Recognises places and ties them together.

    Attributes:
        closed: how many loop closures hold.
        refused: how many were found that would have torn the map.
    """

    def __init__(self, keyframes: Keyframes, parameters: SlamParameters) -> None:
        """Look among keyframes."""
        self.closed = 0
        self.refused = 0
        self._keyframes = keyframes
        self._parameters = parameters
        self._settings = parameters.settings
        self._hypotheses = Hypotheses(self._settings.agreement)
        self._looked_m = 0.0

    def close(self, edges: Edges) -> Edges | None:
        """Look around the last keyframe; move the map and return new edges if it is known there."""
        way_m = self._keyframes[-1].way_m
        if way_m - self._looked_m < self._settings.loop_closure.step_m:
            return None
        self._looked_m = way_m
        believed = self._believed(edges)
        if not believed:
            return None
        tied = edges
        for one in believed:
            tied = tied.with_edge(one.tail, one.head, one.relative, one.information, is_loop=True)
        told = self._settings.loop_closure
        poses = optimise(
            self._keyframes.poses, tied, iterations=told.iterations, settings=self._settings.graph
        )
        sure = ~tied.is_loop & ~doubtful(tied.information)
        bent = residuals(poses, tied).squared[sure]
        if bent.max(initial=0.0) > told.torn:
            self.refused += len(believed)
            return None
        self.closed += len(believed)
        self._keyframes.poses = poses
        return tied

    def has_drifted(self, pose: Poses, jump_m: float) -> bool:
        """Tell whether the robot was near a pose so long ago that drift explains a jump to it.

        The pose is (3,) in the map: x, y (m) and yaw (rad).
        """
        poses, ways = self._keyframes.poses, self._keyframes.ways_m
        gap_m = max(self._parameters.loop_gap_m, jump_m / self._settings.places.drift_m_per_m)
        old = ways[-1] - ways > gap_m
        far = np.hypot(*(poses[old, :2] - pose[:2]).T)
        return bool(far.min(initial=np.inf) < self._settings.jump.near_m)

    def _believed(self, edges: Edges) -> list[Hypothesis]:
        told, poses = self._parameters, self._keyframes.poses
        believed: list[Hypothesis] = []
        places = loop_candidates(
            poses,
            edges,
            gap_m=told.loop_gap_m,
            reach_m=told.loop_reach_m,
            settings=self._settings.places,
        )
        for place in places:
            found = recognise(self._keyframes, place, told)
            if found is None:
                continue
            if found.reach_m <= self._settings.loop_closure.sure_reach_m:
                believed.append(found)
            else:
                believed += self._hypotheses.agree(found, poses, self._keyframes.ways_m)
        return believed
