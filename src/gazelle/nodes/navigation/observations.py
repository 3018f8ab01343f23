"""What sensor messages show, in a costmap's frame."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry import Pose
from gazelle.interfaces.stamps import ns_of
from gazelle.navigation.costmap import Observation

__all__ = ["MESSAGE_TYPES", "cloud_points", "observation_of"]

MESSAGE_TYPES = {
    "LaserScan": "sensor_msgs/msg/LaserScan",
    "PointCloud": "sensor_msgs/msg/PointCloud",
    "PointCloud2": "sensor_msgs/msg/PointCloud2",
}
"""Types of messages by the parameter ``data_type``."""

_NUMBERS = {7: "f4", 8: "f8"}


def observation_of(
    message: Any, T_global_sensor: Pose, *, origin: Pose | None = None, inf_is_valid: bool = False
) -> Observation:
    """Return what a message shows.

    Args:
        message: a ``LaserScan``, ``PointCloud`` or ``PointCloud2``.
        T_global_sensor: the message's frame in the costmap's, at the message's time.
        origin: the sensor itself, where that is another frame (``sensor_frame``).
        inf_is_valid: beams of infinite range clear up to just below the largest range.

    Raises:
        ValueError: a cloud has no x, y, z of floats.
    """
    ends: NDArray[np.float64] | None = None
    if hasattr(message, "ranges"):
        points, ends = _beams(message, inf_is_valid)
        ends = T_global_sensor.transform(ends)
    elif hasattr(message, "fields"):
        points = cloud_points(message)
    else:
        points = np.array([(p.x, p.y, p.z) for p in message.points], float).reshape(-1, 3)
    place = (origin or T_global_sensor).position_m
    return Observation(ns_of(message.header.stamp), place, T_global_sensor.transform(points), ends)


def cloud_points(cloud: Any) -> NDArray[np.float64]:
    """Return the points of a ``PointCloud2`` that have numbers, (n, 3).

    Raises:
        ValueError: it has no x, y, z of floats, or fewer bytes than it says.
    """
    by_name = {field.name: field for field in cloud.fields}
    if not {"x", "y", "z"} <= set(by_name):
        raise ValueError(f"the cloud has fields {', '.join(by_name) or 'none'}, not x, y and z")
    order = ">" if cloud.is_bigendian else "<"
    formats = []
    for name in "xyz":
        kind = _NUMBERS.get(int(by_name[name].datatype))
        if kind is None:
            raise ValueError(
                f"field {name} of the cloud is no float (type {by_name[name].datatype})"
            )
        formats.append(order + kind)
    count = int(cloud.width) * int(cloud.height)
    if len(cloud.data) < count * int(cloud.point_step):
        raise ValueError(f"the cloud says {count} points and has {len(cloud.data)} bytes")
    layout = np.dtype(
        {
            "names": list("xyz"),
            "formats": formats,
            "offsets": [int(by_name[name].offset) for name in "xyz"],
            "itemsize": int(cloud.point_step),
        }
    )
    rows = np.frombuffer(bytes(cloud.data), layout, count)
    points = np.column_stack([rows[name].astype(float) for name in "xyz"])
    return np.asarray(points[np.isfinite(points).all(axis=1)])


def _beams(scan: Any, inf_is_valid: bool) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return what beams met and the ends of those that met nothing, in the lidar's frame."""
    ranges = np.asarray(scan.ranges, dtype=float)
    angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges))
    # laser_geometry leaves out what is not below the largest range.
    met = (ranges >= max(scan.range_min, sys.float_info.min)) & (ranges < scan.range_max)
    nothing = np.isposinf(ranges) & inf_is_valid
    # 0.1 mm inside of the largest range, as the original has it.
    ranges = np.where(nothing, scan.range_max - 1e-4, np.where(met, ranges, 0.0))
    flat = np.column_stack(
        [ranges * np.cos(angles), ranges * np.sin(angles), np.zeros(len(ranges))]
    )
    return flat[met], flat[nothing]
