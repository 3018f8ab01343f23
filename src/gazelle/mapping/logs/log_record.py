"""One scan of a log."""

from __future__ import annotations

from typing import NamedTuple

from gazelle.mapping.laser_scan import Scan
from gazelle.mapping.se2 import Poses

__all__ = ["LogRecord"]


class LogRecord(NamedTuple):
    """A scan and where odometry saw the robot.

    Attributes:
        scan: of the lidar.
        odometry: pose of the robot, (x_m, y_m, yaw_rad).
    """

    scan: Scan
    odometry: Poses
