"""Scans of messages, placed by tf: waiting for transforms, saying what is missing."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from gazelle.geometry import Pose
from gazelle.graph.tf import MessageFilter, TransformBuffer, TransformError
from gazelle.interfaces.stamps import ns_of
from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.se2 import Poses

__all__ = ["PlacedScan", "ScanQueue", "scan_of"]

_TILTED = 0.1


class PlacedScan(NamedTuple):
    """A scan and where odometry saw the robot.

    Attributes:
        scan: with the lidar's mounting.
        odometry: pose of the robot in odometry's frame.
    """

    scan: Scan
    odometry: Poses


def scan_of(message: Any, T_base_laser: Pose, max_range_m: float = math.inf) -> Scan:
    """Return the record of a ``LaserScan``.

    Args:
        message: NaN and infinity in it are beams that say nothing.
        T_base_laser: the lidar on the robot.
        max_range_m: ranges from there on say nothing.

    Raises:
        ValueError: the message contradicts itself, or the lidar does not scan the ground plane.
    """
    step = float(message.angle_increment)
    if not (math.isfinite(step) and step != 0 and math.isfinite(message.angle_min)):
        raise ValueError(
            f"angle_min is {message.angle_min}, angle_increment {step}: beams have no directions"
        )
    up = T_base_laser.rotate((0.0, 0.0, 1.0))[2]
    if abs(up) < 1 - _TILTED:
        tilt = math.degrees(math.acos(min(1.0, abs(up))))
        raise ValueError(f"the lidar is tilted by {tilt:.0f}°: only flat scans can be mapped")
    limit = min(float(message.range_max), max_range_m)
    ranges = np.asarray(message.ranges, dtype=np.float32)
    ranges = np.where(ranges >= limit, np.inf, ranges).astype(np.float32)
    # Upside down, yaw seen from above turns the other way round.
    ahead = T_base_laser.rotate((1.0, 0.0, 0.0))
    mount = (*T_base_laser.position_m[:2], math.atan2(ahead[1], ahead[0]))
    return Scan(
        ns_of(message.header.stamp), float(message.angle_min), step, ranges,
        max(0.0, float(message.range_min)), limit, mount, upside_down=up < 0,
    )  # fmt: skip


class ScanQueue:
    """Holds scans until tf knows where they were taken.

    Attributes:
        dropped: how many scans were given up.
    """

    def __init__(
        self,
        buffer: TransformBuffer,
        frames: tuple[str, str],
        say: Callable[[str], None],
        *,
        size: int = 30,
        max_range_m: float = math.inf,
    ) -> None:
        """Wait for nothing yet.

        Args:
            buffer: tf.
            frames: odometry's frame and the robot's.
            say: told why scans are dropped.
            size: so many scans wait at most.
            max_range_m: ranges from there on say nothing.
        """
        self.dropped = 0
        self._buffer = buffer
        self._odom, self._base = frames
        self._say = say
        self._max_range_m = max_range_m
        self._filter = MessageFilter(self._place, self._drop, size=size)

    def add(self, message: Any) -> list[PlacedScan]:
        """Take a message; return the scans that can be placed now, in order."""
        return [scan for scan in self._filter.add(message) if scan is not None]

    def ready(self) -> list[PlacedScan]:
        """Return the scans that can be placed now, in order; others do not stop them."""
        return [scan for scan in self._filter.ready() if scan is not None]

    def give_up(self) -> None:
        """Drop what still waits."""
        self._filter.give_up()

    def clear(self) -> None:
        """Forget what waits."""
        self._filter.clear()

    def _place(self, message: Any) -> PlacedScan | None:
        """Return a scan in its place, None where there is something wrong with it."""
        frame, stamp = str(message.header.frame_id).removeprefix("/"), ns_of(message.header.stamp)
        mount = self._buffer.lookup_transform(self._base, frame, stamp).pose
        robot = self._buffer.lookup_transform(self._odom, self._base, stamp).pose
        try:
            scan = scan_of(message, mount, self._max_range_m)
            odometry = np.array(robot.xy_yaw)
            if not np.isfinite(odometry).all():
                raise ValueError(f"tf from {self._odom} to {self._base} is not finite")
        except ValueError as error:
            self.dropped += 1
            self._say(f"a scan is left out: {error}")
            return None
        return PlacedScan(scan, odometry)

    def _drop(self, message: Any, why: TransformError) -> None:
        self.dropped += 1
        frame = str(message.header.frame_id).removeprefix("/")
        self._say(
            f"a scan in frame '{frame}' is dropped, as tf does not say where it was taken: {why}\n"
            f"  fix: publish the transforms {self._odom} → {self._base} → {frame}; "
            "`rosrun tf view_frames` draws what there is"
        )
