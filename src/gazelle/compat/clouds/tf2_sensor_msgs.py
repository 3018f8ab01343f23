"""tf2_sensor_msgs: point clouds into other frames."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np

from gazelle.compat.clouds.point_fields import cloud_points, packed
from gazelle.compat.tf.buffer_interface import TransformRegistration
from gazelle.interfaces import message_type, ros1_message_type
from gazelle.interfaces.poses import pose_of_transform

__all__ = ["do_transform_cloud", "register"]


def do_transform_cloud(cloud: Any, transform: Any) -> Any:
    """Return a ``PointCloud2`` with x, y and z in the transform's frame; other fields stay.

    Raises:
        ValueError: the cloud has no x, y and z.
    """
    points = packed(cloud_points(cloud))
    if not {"x", "y", "z"} <= set(points.dtype.names or ()):
        raise ValueError(
            f"the cloud has no x, y and z; it has {', '.join(points.dtype.names or ())}"
        )
    old = np.stack([points[name].astype(float) for name in "xyz"], axis=-1)
    new = pose_of_transform(transform.transform).transform(old)
    for index, name in enumerate("xyz"):
        points[name] = new[..., index]
    found = copy.copy(cloud)
    found.header = copy.deepcopy(transform.header)
    found.row_step = int(cloud.width) * int(cloud.point_step)
    found.data = points.tobytes()
    return found


def register() -> None:
    """Let buffers transform clouds."""
    for make in (ros1_message_type, message_type):
        TransformRegistration().add(make("sensor_msgs/PointCloud2"), do_transform_cloud)
