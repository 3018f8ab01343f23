"""How the fields of a ``sensor_msgs/PointCloud2`` lie in its bytes."""

from __future__ import annotations

import sys
from collections import namedtuple
from collections.abc import Callable, Iterable, Sequence
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "cloud_points",
    "dtype_from_fields",
    "make_cloud",
    "packed",
    "point_class",
    "xyz32_fields",
]

_FORMATS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}


def dtype_from_fields(
    fields: Iterable[Any], point_step: int | None = None, *, is_bigendian: bool | None = None
) -> np.dtype[Any]:
    """Return the structured type of one point; a field of several values becomes ``name_0`` ….

    Args:
        fields: ``sensor_msgs/PointField``.
        point_step: bytes from point to point; those of the fields when None.
        is_bigendian: byte order, this machine's when None.

    Raises:
        ValueError: a field's ``datatype`` is none of PointField's.
    """
    big = sys.byteorder == "big" if is_bigendian is None else is_bigendian
    names: list[str] = []
    formats: list[str] = []
    offsets: list[int] = []
    for index, field in enumerate(fields):
        name = field.name or f"unnamed_field_{index}"
        if field.datatype not in _FORMATS:
            raise ValueError(f"field '{name}' has datatype {field.datatype}; known are 1 to 8")
        one = np.dtype((">" if big else "<") + _FORMATS[field.datatype])
        count = max(int(field.count), 1)
        for number in range(count):
            names.append(name if count == 1 else f"{name}_{number}")
            formats.append(one.str)
            offsets.append(int(field.offset) + number * one.itemsize)
    layout: dict[str, Any] = {"names": names, "formats": formats, "offsets": offsets}
    if point_step is not None:
        layout["itemsize"] = int(point_step)
    found: np.dtype[Any] = np.dtype(cast(Any, layout))
    return found


def cloud_points(cloud: Any) -> NDArray[Any]:
    """Return all points of a cloud, structured, of shape (height, width).

    Raises:
        ValueError: the cloud has fewer bytes than its size says.
    """
    kind = dtype_from_fields(cloud.fields, cloud.point_step, is_bigendian=bool(cloud.is_bigendian))
    data = np.frombuffer(bytes(cloud.data), np.uint8)
    width, height, step = int(cloud.width), int(cloud.height), int(cloud.row_step)
    step = step or width * kind.itemsize
    wanted = step * (height - 1) + width * kind.itemsize if height else 0
    if len(data) < wanted:
        size = f"{width}×{height} points of {kind.itemsize} bytes"
        raise ValueError(f"the cloud's data have {len(data)} bytes, {size} need {wanted}")
    strides = (step, kind.itemsize)
    found: NDArray[Any] = np.ndarray((height, width), kind, data, strides=strides)
    return found


def make_cloud(
    cloud: Any, header: Any, fields: Sequence[Any], points: NDArray[Any], point_step: int
) -> Any:
    """Fill an empty ``PointCloud2`` with structured points.

    Args:
        cloud: is filled and returned.
        header: its header.
        fields: ``sensor_msgs/PointField``.
        points: of shape (points,) or, columns first, (width, height).
        point_step: bytes from point to point.
    """
    cloud.header = header
    cloud.width = points.shape[0] if points.ndim else 0
    cloud.height = points.shape[1] if points.ndim == 2 else 1
    cloud.fields = list(fields)
    cloud.is_dense = False
    cloud.is_bigendian = False
    cloud.point_step = point_step
    cloud.row_step = point_step * cloud.width
    cloud.data = packed(points).tobytes()
    return cloud


def point_class(names: Sequence[str]) -> Callable[..., Any]:
    """Return a named tuple with the fields of a cloud."""
    make: Callable[..., Callable[..., Any]] = namedtuple
    return make("Point", names)


def packed(points: NDArray[Any]) -> NDArray[Any]:
    """Return a copy whose gaps between fields are zeros; numpy leaves them as they come.

    Args:
        points: structured, of any shape; the copy is of the same shape and type.
    """
    found = np.zeros(points.shape, points.dtype)
    for name in points.dtype.names or ():
        found[name] = points[name]
    return found


def xyz32_fields(kind: Any) -> list[Any]:
    """Return fields x, y and z of 32 bits each."""
    return [
        kind(name=name, offset=4 * index, datatype=7, count=1) for index, name in enumerate("xyz")
    ]
