"""SLAM: scans and odometry in, a trajectory and a map out."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from gazelle.mapping.grids import OccupancyGrid
from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.pose_graph.constraints import (
    DOUBTFUL,
    UNKNOWN,
    Edges,
    bounded,
    no_edges,
    seen_from,
)
from gazelle.mapping.pose_graph.optimizer import optimise
from gazelle.mapping.scan_matching.scan_matcher import Match
from gazelle.mapping.se2 import Poses, between, compose
from gazelle.mapping.slam.global_refinement import refined_globally
from gazelle.mapping.slam.keyframes import Keyframe, Keyframes, keyframe_of
from gazelle.mapping.slam.loop_closure import LoopCloser, Track
from gazelle.mapping.slam.occupancy_counts import draw
from gazelle.mapping.slam.slam_parameters import SlamParameters
from gazelle.mapping.slam.tracking import Tracker, is_jump, motion_information
from gazelle.rich_display import shown_by

__all__ = ["Slam", "SlamResult", "Update", "slam"]


class Update(NamedTuple):
    """What a scan changed.

    Attributes:
        pose: of the robot in the map's frame, (3,): x, y (m) and yaw (rad).
        is_keyframe: the scan was kept.
        is_matched: it fits the map; otherwise the pose is odometry's.
        has_closed: the map was moved because a place was recognised.
    """

    pose: Poses
    is_keyframe: bool
    is_matched: bool
    has_closed: bool


@shown_by("maps:slam_bundle")
class SlamResult(NamedTuple):
    """A map and how the robot moved in it.

    Attributes:
        stamps_ns: of all scans, int64 (n,).
        trajectory: poses of the robot at these times, (n, 3), in the map's frame.
        grid: the map; the robot began at its origin.
        loops: how many loop closures hold.
    """

    stamps_ns: np.ndarray[tuple[int], np.dtype[np.int64]]
    trajectory: Poses
    grid: OccupancyGrid
    loops: int


def slam(
    records: Iterable[tuple[Scan, ArrayLike]],
    parameters: SlamParameters | None = None,
    *,
    resolution_m: float = 0.05,
) -> SlamResult:
    """Map a log.

    Args:
        records: scans in the order of time, each with the pose that odometry gave at that time,
            (x_m, y_m, yaw_rad) in odometry's frame.
        parameters: of SLAM.
        resolution_m: side of the map's cells.
    """
    engine = Slam(parameters)
    for scan, odometry in records:
        engine.add(scan, odometry)
    engine.finish()
    return engine.result(resolution_m)


class Slam:
    """Builds a map from scans with odometry, scan by scan.

    Every scan is matched with the last kept ones; kept scans are the nodes of a graph of poses;
    places that are recognised tie it together. No randomness: the same records give the same map.

    Attributes:
        parameters: as given.
        keyframes: the kept scans.
        edges: what is known of their poses.
        is_mapping: scans are kept; otherwise the robot is only located in the map as it is.
    """

    def __init__(self, parameters: SlamParameters | None = None) -> None:
        """Start with no map; the first scan will be at the map's origin; see `begin`."""
        self.parameters = parameters or SlamParameters()
        self.keyframes = Keyframes(self.parameters)
        self.edges: Edges = no_edges()
        self.is_mapping = True
        self._tracker = Tracker(self.keyframes, self.parameters)
        self._closer = LoopCloser(self.keyframes, self.parameters)
        self._track = Track(self.keyframes)
        self._odometry: Poses | None = None
        self._pose = np.zeros(3)
        self._way_m = 0.0
        self._is_doubtful = False

    @property
    def pose(self) -> Poses:
        """Where the robot is, in the map's frame, (3,): x, y (m) and yaw (rad)."""
        return self._pose.copy()

    def begin(self, pose: ArrayLike) -> None:
        """Let the first scan be at a pose of the map's frame."""
        self._pose = np.array(pose, dtype=float)

    def resume(self, pose: ArrayLike) -> None:
        """Go on from a pose in the map; the next scan is looked for around it."""
        self._pose = np.array(pose, dtype=float)
        self._odometry = None
        self._way_m = float(self.keyframes[-1].way_m) if len(self.keyframes) else 0.0
        self._tracker.forget()
        self._tracker.lost = 1
        self._tracker.uses_nearest = True

    @property
    def loops(self) -> int:
        """How many loop closures hold."""
        return self._closer.closed

    def add(self, scan: Scan, odometry: ArrayLike) -> Update:
        """Take one scan.

        Args:
            scan: not older than the last one.
            odometry: the robot's pose by odometry at that time, in odometry's frame.

        Raises:
            ValueError: the pose is not finite.
        """
        odometry = np.asarray(odometry, dtype=float)
        if not np.isfinite(odometry).all():
            raise ValueError(f"odometry is {odometry.tolist()}, not three finite numbers")
        motion = np.zeros(3) if self._odometry is None else between(self._odometry, odometry)
        self._odometry = odometry
        self._way_m += math.hypot(motion[0], motion[1])
        frame = keyframe_of(scan, self.parameters, self._way_m)
        if not len(self.keyframes):
            return self._first(frame)
        was_lost, is_back = self._tracker.lost > 0, False
        expected = compose(self._pose, motion)
        found = self._tracker.locate(frame, expected, motion)
        if found is not None and was_lost and self._comes_back(expected, found.pose):
            # The way drifted, and the robot was not carried: closing the loop bends the way.
            found, self._is_doubtful, is_back = None, False, True
        self._pose = expected if found is None else found.pose
        settings = self.parameters.settings
        sees = len(frame.points_m) >= settings.tracking.fewest_points
        if not is_back:
            self._is_doubtful |= sees and (found is None or found.is_doubtful)
        waits = 0 < self._tracker.lost < settings.engine.give_up
        is_kept = self.is_mapping and self._is_new() and not waits
        has_closed = is_kept and self._keep(frame, found)
        self._track.add(scan.stamp_ns, self._pose)
        if found is None and sees:
            self._track.note_lost(frame, odometry)
        elif was_lost and found is not None:
            self._track.find_lost(self._tracker, self._pose, odometry)
        return Update(self.pose, is_kept, found is not None, has_closed)

    def finish(self) -> None:
        """Use all that is known: call it once, when no more scans come."""
        keyframes, settings = self.keyframes, self.parameters.settings
        told = settings.engine
        keyframes.poses = optimise(
            keyframes.poses, self.edges, iterations=told.last_iterations, settings=settings.graph
        )
        for _ in range(told.global_refinements if self.parameters.global_refinement else 0):
            keyframes.poses = refined_globally(keyframes, self.edges, self.parameters)

    def trajectory(self) -> Poses:
        """Return the poses of all scans in the map's frame, (n, 3), as they are known now."""
        return self._track.poses()

    def grid(self, resolution_m: float = 0.05) -> OccupancyGrid:
        """Draw the map as it is known now."""
        return draw(self.keyframes, resolution_m)

    def result(self, resolution_m: float = 0.05) -> SlamResult:
        """Return map and trajectory as they are known now."""
        stamps = np.array(self._track.stamps_ns, dtype=np.int64)
        return SlamResult(stamps, self.trajectory(), self.grid(resolution_m), self.loops)

    def _first(self, frame: Keyframe) -> Update:
        self.keyframes.append(frame, self.pose)
        self._track.add(frame.scan.stamp_ns, self.pose)
        return Update(self.pose, True, True, False)

    def _is_new(self) -> bool:
        away = between(self.keyframes.poses[-1], self._pose)
        is_far = math.hypot(away[0], away[1]) >= self.parameters.keyframe_m
        return is_far or bool(abs(away[2]) >= self.parameters.keyframe_rad)

    def _comes_back(self, expected: Poses, found: Poses) -> bool:
        """Tell whether a lost robot is seen to be off where it was a long way ago."""
        closes = self.is_mapping and self.parameters.loop_closing
        if not closes or not is_jump(expected, found, self.parameters.settings.jump):
            return False
        return self._closer.has_drifted(found, math.dist(expected[:2], found[:2]))

    def _keep(self, frame: Keyframe, found: Match | None) -> bool:
        """Keep a scan; return whether a place was recognised, which moves the map."""
        tail = len(self.keyframes) - 1
        before = self.keyframes.poses[tail].copy()
        relative = between(before, self._pose)
        information = motion_information(relative, self.parameters)
        if self._is_doubtful:
            information = UNKNOWN if self._tracker.lost else DOUBTFUL
            self.keyframes.tears.add(tail + 1)
        elif found is not None:
            information = bounded(seen_from(before, found.information) + information)
        self._is_doubtful = False
        head = self.keyframes.append(frame, self._pose)
        self.edges = self.edges.with_edge(tail, head, relative, information, is_loop=False)
        self._tracker.forget()
        tied = self._closer.close(self.edges) if self.parameters.loop_closing else None
        if tied is None:
            return False
        self.edges, self._pose = tied, self.keyframes.poses[head].copy()
        return True
