"""sensor_msgs_py.point_cloud2 of ROS 2: points as numpy arrays.

As there, an organised cloud has the shape (width, height).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.lib.recfunctions import structured_to_unstructured, unstructured_to_structured
from numpy.typing import NDArray

from gazelle.compat.clouds.point_fields import (
    cloud_points,
    dtype_from_fields,
    make_cloud,
    point_class,
    xyz32_fields,
)
from gazelle.diagnostics import did_you_mean
from gazelle.interfaces import message_type

__all__ = [
    "create_cloud",
    "create_cloud_xyz32",
    "dtype_from_fields",
    "read_points",
    "read_points_list",
    "read_points_numpy",
]


def read_points(
    cloud: Any,
    field_names: Sequence[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[int] | None = None,
    reshape_organized_cloud: bool = False,
) -> NDArray[Any]:
    """Return points as a structured array.

    Args:
        cloud: ``sensor_msgs/msg/PointCloud2``.
        field_names: which fields; all when None.
        skip_nans: leave points out that have a NaN among these fields.
        uvs: numbers of single points; all when None.
        reshape_organized_cloud: return (width, height) for a cloud of several rows.

    Raises:
        AssertionError: a field does not exist.
        ValueError: data are missing.
    """
    points: NDArray[Any] = cloud_points(cloud).reshape(-1)
    points = points.astype(points.dtype.newbyteorder("="))
    if field_names is not None:
        points = points[_known(field_names, points.dtype.names or ())]
    if skip_nans and not cloud.is_dense:
        good = np.ones(len(points), bool)
        for name in points.dtype.names or ():
            good &= ~np.isnan(points[name])
        points = points[good]
    if uvs is not None:
        points = points[uvs if isinstance(uvs, np.ndarray) else np.fromiter(uvs, int)]
    if reshape_organized_cloud and cloud.height > 1:
        points = points.reshape(cloud.width, cloud.height)
    return points


def read_points_numpy(
    cloud: Any,
    field_names: Sequence[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[int] | None = None,
    reshape_organized_cloud: bool = False,
) -> NDArray[Any]:
    """Return points as an array of numbers, one column a field; see `read_points`.

    It is of shape (points, fields) and of the fields' own type; of (width, height, fields) where
    a cloud of several rows is reshaped.

    Raises:
        AssertionError: the fields are of several types.
    """
    points = read_points(cloud, field_names, skip_nans, uvs, reshape_organized_cloud)
    _check(bool(points.dtype.names), "the cloud has no fields")
    kinds = {points.dtype[name] for name in points.dtype.names or ()}
    text = "All fields need to have the same datatype. Use `read_points()` otherwise."
    _check(len(kinds) <= 1, text)
    return structured_to_unstructured(points)


def read_points_list(
    cloud: Any,
    field_names: Sequence[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[int] | None = None,
) -> list[Any]:
    """Return points as named tuples; see `read_points`."""
    names = [field.name for field in cloud.fields] if field_names is None else list(field_names)
    make = point_class(names)
    return [make(*row) for row in read_points(cloud, names, skip_nans, uvs).tolist()]


def create_cloud(header: Any, fields: Sequence[Any], points: Any, step: int | None = None) -> Any:
    """Return a ``sensor_msgs/msg/PointCloud2``.

    Args:
        header: its header.
        fields: ``sensor_msgs/msg/PointField``.
        points: structured array, array with a column for each field, or rows of values.
        step: bytes from point to point; those of the fields when None.

    Raises:
        AssertionError: points and fields do not fit.
    """
    kind = dtype_from_fields(fields, step)
    rows = _structured(points, fields, kind)
    text = "Points can only be organized in max. two dimensional space"
    _check(rows.ndim <= 2, f"Too many dimensions for organized cloud! {text}")
    cloud: Any = message_type("sensor_msgs/msg/PointCloud2")()
    return make_cloud(cloud, header, fields, rows, kind.itemsize)


def create_cloud_xyz32(header: Any, points: Any) -> Any:
    """Return a ``sensor_msgs/msg/PointCloud2`` of x, y and z with 32 bits each."""
    return create_cloud(header, xyz32_fields(message_type("sensor_msgs/msg/PointField")), points)


def _structured(points: Any, fields: Sequence[Any], kind: np.dtype[Any]) -> NDArray[Any]:
    if not isinstance(points, np.ndarray):
        return np.array([tuple(point) for point in points], kind)
    if points.dtype.names is None:
        same = len({field.datatype for field in fields}) == 1
        text = "Pass a structured NumPy array with multiple dtypes otherwise."
        _check(same, f"All fields need to have the same datatype. {text}")
        return unstructured_to_structured(points, dtype=kind)
    text = "PointFields and structured NumPy array dtype do not match for all fields!"
    _check(points.dtype == kind, f"{text} Check their field order, names and types.")
    return points


def _known(wanted: Iterable[str], known: Sequence[str]) -> list[str]:
    names = list(wanted)
    for name in names:
        text = "Requested field is not in the fields of the PointCloud!"
        _check(name in known, f"{text} '{name}': {did_you_mean(name, known)}")
    return names


def _check(holds: bool, text: str) -> None:
    # AssertionError is what callers of the original catch, also under python -O.
    if not holds:
        raise AssertionError(text)
