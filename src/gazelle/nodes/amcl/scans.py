"""A ``sensor_msgs/LaserScan`` as a record."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.geometry import Pose
from gazelle.interfaces.stamps import ns_of
from gazelle.mapping.laser_scan import Scan

__all__ = ["scan_of_message"]


def scan_of_message(message: Any, T_base_laser: Pose) -> Scan:
    """Return a scan whose lidar stands, or hangs, at a place on the robot."""
    _x, _y, z_axis = T_base_laser.transform(np.array([[0.0, 0.0, 1.0]]))[0] - np.array(
        T_base_laser.position_m
    )
    return Scan(
        ns_of(message.header.stamp),
        float(message.angle_min),
        float(message.angle_increment),
        np.asarray(message.ranges, np.float32),
        float(message.range_min),
        float(message.range_max),
        T_base_laser.xy_yaw,
        upside_down=bool(z_axis < 0),
    )
