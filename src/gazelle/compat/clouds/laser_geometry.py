"""laser_geometry: scans as point clouds."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np

from gazelle.compat.clouds.point_fields import dtype_from_fields, make_cloud
from gazelle.compat.clouds.tf2_sensor_msgs import do_transform_cloud
from gazelle.interfaces import Ros1Message, message_type, ros1_message_type

__all__ = ["LaserProjection"]

_FIELDS = {"intensity": 7, "index": 5, "distance": 7, "stamps": 7}


class LaserProjection:
    """Projects ``sensor_msgs/LaserScan`` to ``sensor_msgs/PointCloud2``."""

    class ChannelOption:
        """Which channels a cloud gets besides x, y and z."""

        NONE = 0x00
        INTENSITY = 0x01
        INDEX = 0x02
        DISTANCE = 0x04
        TIMESTAMP = 0x08
        VIEWPOINT = 0x10
        DEFAULT = INTENSITY | INDEX

    def projectLaser(
        self, scan_in: Any, range_cutoff: float = -1.0, channel_options: int = ChannelOption.DEFAULT
    ) -> Any:
        """Return the points of a scan in its own frame.

        Args:
            scan_in: ``sensor_msgs/LaserScan`` of either generation.
            range_cutoff: metres; ranges from here on are left out, those from ``range_max`` on
                in any case.
            channel_options: sum of `ChannelOption`.
        """
        ranges = np.asarray(scan_in.ranges, float)
        limit = scan_in.range_max if range_cutoff < 0 else min(range_cutoff, scan_in.range_max)
        # A comparison with NaN is false, so those are left out too.
        taken = np.flatnonzero((ranges >= scan_in.range_min) & (ranges < limit))
        angles = scan_in.angle_min + taken * scan_in.angle_increment
        kept = ranges[taken]
        columns: dict[str, Any] = {
            "x": kept * np.cos(angles),
            "y": kept * np.sin(angles),
            "z": np.zeros(len(taken)),
        }
        columns |= _channels(scan_in, taken, kept, channel_options)
        return _cloud(scan_in, columns)

    def transformLaserScanToPointCloud(
        self,
        target_frame: str,
        scan_in: Any,
        buffer: Any,
        range_cutoff: float = -1.0,
        channel_options: int = ChannelOption.DEFAULT,
    ) -> Any:
        """Return the points of a scan in another frame at the time of the scan.

        Raises:
            TransformException: the buffer does not know the transform.
        """
        cloud = self.projectLaser(scan_in, range_cutoff, channel_options)
        header = scan_in.header
        found = buffer.lookup_transform(target_frame, header.frame_id, header.stamp)
        return do_transform_cloud(cloud, found)


def _channels(scan: Any, taken: Any, kept: Any, options: int) -> dict[str, Any]:
    wanted = LaserProjection.ChannelOption
    columns: dict[str, Any] = {}
    if options & wanted.INTENSITY and len(scan.intensities) == len(scan.ranges):
        columns["intensity"] = np.asarray(scan.intensities, float)[taken]
    if options & wanted.INDEX:
        columns["index"] = taken
    if options & wanted.DISTANCE:
        columns["distance"] = kept
    if options & wanted.TIMESTAMP:
        columns["stamps"] = taken * scan.time_increment
    if options & wanted.VIEWPOINT:
        columns |= {f"vp_{axis}": np.zeros(len(taken)) for axis in "xyz"}
    return columns


def _cloud(scan: Any, columns: dict[str, Any]) -> Any:
    make = ros1_message_type if isinstance(scan, Ros1Message) else message_type
    field = make("sensor_msgs/PointField")
    fields = [
        field(name=name, offset=4 * index, datatype=_FIELDS.get(name, 7), count=1)
        for index, name in enumerate(columns)
    ]
    kind = dtype_from_fields(fields)
    points = np.zeros(len(columns["x"]), kind)
    for name, values in columns.items():
        points[name] = values
    header = copy.deepcopy(scan.header)
    return make_cloud(make("sensor_msgs/PointCloud2")(), header, fields, points, kind.itemsize)
