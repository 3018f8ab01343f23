"""sensor_msgs.point_cloud2 of ROS 1: points as tuples."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from gazelle.compat.clouds.point_fields import (
    cloud_points,
    dtype_from_fields,
    make_cloud,
    point_class,
    xyz32_fields,
)
from gazelle.diagnostics import did_you_mean
from gazelle.interfaces import ros1_message_type

__all__ = ["create_cloud", "create_cloud_xyz32", "read_points", "read_points_list"]


def read_points(
    cloud: Any,
    field_names: Sequence[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[tuple[int, int]] = (),
) -> Iterator[tuple[Any, ...]]:
    """Give points as tuples of Python numbers.

    Args:
        cloud: ``sensor_msgs/PointCloud2``.
        field_names: which fields, in this order; all when None.
        skip_nans: leave points out that have a NaN among these fields.
        uvs: column and row of single points; all when empty.

    Raises:
        ValueError: a field does not exist, or data are missing.
    """
    points = cloud_points(cloud)
    if field_names is not None:
        points = points[_columns(points.dtype.names or (), cloud, field_names)]
    pixels = list(uvs)
    chosen = np.array([points[v, u] for u, v in pixels], points.dtype) if pixels else points
    for row in chosen.ravel().tolist():
        # NaN alone differs from itself.
        if not skip_nans or all(value == value for value in row):  # noqa: PLR0124
            yield row


def read_points_list(
    cloud: Any,
    field_names: Sequence[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[tuple[int, int]] = (),
) -> list[Any]:
    """Return points as named tuples; see `read_points`."""
    names = [field.name for field in cloud.fields] if field_names is None else list(field_names)
    make = point_class(names)
    return [make(*row) for row in read_points(cloud, field_names, skip_nans, uvs)]


def create_cloud(header: Any, fields: Sequence[Any], points: Iterable[Iterable[Any]]) -> Any:
    """Return a ``sensor_msgs/PointCloud2`` of one row.

    Args:
        header: its header.
        fields: ``sensor_msgs/PointField``.
        points: values of each point, in the order of the fields' offsets.
    """
    kind = dtype_from_fields(sorted(fields, key=lambda field: int(field.offset)))
    rows = np.array([tuple(point) for point in points], kind)
    cloud: Any = ros1_message_type("sensor_msgs/PointCloud2")()
    return make_cloud(cloud, header, fields, rows, kind.itemsize)


def create_cloud_xyz32(header: Any, points: Iterable[Iterable[float]]) -> Any:
    """Return a ``sensor_msgs/PointCloud2`` of x, y and z with 32 bits each."""
    return create_cloud(header, xyz32_fields(ros1_message_type("sensor_msgs/PointField")), points)


def _columns(known: Sequence[str], cloud: Any, wanted: Iterable[str]) -> list[str]:
    columns: list[str] = []
    for name in wanted:
        if not any(field.name == name for field in cloud.fields):
            hint = did_you_mean(name, [field.name for field in cloud.fields])
            raise ValueError(f"the cloud has no field '{name}'; {hint}".rstrip("; "))
        columns += [one for one in known if one == name or one.rpartition("_")[0] == name]
    return columns
