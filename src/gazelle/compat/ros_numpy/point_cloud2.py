"""Point clouds as structured arrays (ros_numpy.point_cloud2)."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from gazelle.interfaces import ros1_message_type

__all__ = [
    "array_to_pointcloud2",
    "dtype_to_fields",
    "fields_to_dtype",
    "get_xyz_points",
    "merge_rgb_fields",
    "pointcloud2_to_array",
    "pointcloud2_to_xyz_array",
    "split_rgb_field",
]

_FORMATS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}
_NUMBERS = {np.dtype(text): number for number, text in _FORMATS.items()}
_COLOURS = {"r": 16, "g": 8, "b": 0}


def fields_to_dtype(
    fields: Iterable[Any], point_step: int, is_bigendian: bool = False
) -> np.dtype[Any]:
    """Return the structured type of one point.

    Args:
        fields: ``sensor_msgs/PointField``; one of several values becomes an array.
        point_step: bytes from point to point.
        is_bigendian: byte order of the values.

    Raises:
        ValueError: a field's ``datatype`` is none of PointField's.
    """
    layout: dict[str, Any] = {"names": [], "formats": [], "offsets": []}
    for field in fields:
        if field.datatype not in _FORMATS:
            raise ValueError(
                f"field '{field.name}' has datatype {field.datatype}; known are 1 to 8"
            )
        one = np.dtype((">" if is_bigendian else "<") + _FORMATS[field.datatype])
        layout["names"].append(field.name)
        layout["formats"].append(one if field.count in (0, 1) else (one, (int(field.count),)))
        layout["offsets"].append(int(field.offset))
    found: np.dtype[Any] = np.dtype(cast(Any, layout | {"itemsize": int(point_step)}))
    return found


def dtype_to_fields(dtype: np.dtype[Any], msg_type: Any = None) -> list[Any]:
    """Return the ``PointField`` of a structured type.

    Raises:
        ValueError: a field is of a type that PointField has not.
    """
    make = msg_type or ros1_message_type("sensor_msgs/PointField")
    found = []
    for name in dtype.names or ():
        kind, offset = dtype.fields[name][:2]  # type: ignore[index]
        base, shape = kind.subdtype or (kind, ())
        number = _NUMBERS.get(base.newbyteorder("="))
        if number is None:
            raise ValueError(f"field '{name}' is of {base}, which PointField has not")
        count = int(np.prod(shape)) if shape else 1
        found.append(make(name=name, offset=offset, datatype=number, count=count))
    return found


def pointcloud2_to_array(cloud_msg: Any, squeeze: bool = True) -> NDArray[Any]:
    """Return a cloud's points, structured, of shape (height, width), or (width,) of one row.

    Raises:
        ValueError: the cloud has fewer bytes than its size says.
    """
    kind = fields_to_dtype(cloud_msg.fields, cloud_msg.point_step, bool(cloud_msg.is_bigendian))
    height, width = int(cloud_msg.height), int(cloud_msg.width)
    step = int(cloud_msg.row_step) or width * kind.itemsize
    data = np.frombuffer(bytes(cloud_msg.data), np.uint8)
    wanted = step * (height - 1) + width * kind.itemsize if height else 0
    if len(data) < wanted:
        size = f"{width}×{height} points of {kind.itemsize} bytes"
        raise ValueError(f"the cloud's data have {len(data)} bytes, {size} need {wanted}")
    points: NDArray[Any] = np.ndarray((height, width), kind, data, strides=(step, kind.itemsize))
    return points[0] if squeeze and height == 1 else points


def array_to_pointcloud2(
    cloud_arr: NDArray[Any],
    stamp: Any = None,
    frame_id: str | None = None,
    *,
    msg_type: Any = None,
) -> Any:
    """Return the cloud of structured points.

    Args:
        cloud_arr: structured, of shape (width,) or (height, width).
        stamp: the header's time.
        frame_id: the header's frame.
        msg_type: class of the cloud.

    Raises:
        ValueError: it is not structured, or of types that PointField has not.
    """
    if cloud_arr.dtype.names is None:
        raise ValueError("a cloud's array has fields such as x, y and z; this one has none")
    rows = np.atleast_2d(cloud_arr)
    cloud = (msg_type or ros1_message_type("sensor_msgs/PointCloud2"))()
    if stamp is not None:
        cloud.header.stamp = stamp
    if frame_id is not None:
        cloud.header.frame_id = frame_id
    cloud.height, cloud.width = rows.shape
    cloud.fields = dtype_to_fields(rows.dtype, _field_type(cloud))
    cloud.is_bigendian = False
    cloud.point_step = rows.dtype.itemsize
    cloud.row_step = cloud.point_step * cloud.width
    cloud.is_dense = all(bool(np.isfinite(rows[name]).all()) for name in cloud_arr.dtype.names)
    cloud.data = rows.tobytes()
    return cloud


def get_xyz_points(
    cloud_array: NDArray[Any], remove_nans: bool = True, dtype: Any = float
) -> NDArray[Any]:
    """Return x, y and z along the last axis.

    Args:
        cloud_array: structured points of any shape, with fields x, y and z in m.
        remove_nans: leave points out that are not finite; what is left is of shape (points, 3),
            else it is of the shape of `cloud_array` and 3.
        dtype: type of the result.
    """
    points = np.stack([cloud_array[name] for name in "xyz"], axis=-1).astype(dtype)
    return points[np.isfinite(points).all(axis=-1)] if remove_nans else points


def pointcloud2_to_xyz_array(cloud_msg: Any, remove_nans: bool = True) -> NDArray[Any]:
    """Return a cloud's x, y and z in m and in its own frame, of shape (points, 3).

    With points that are not finite, it is of shape (height, width, 3), or (width, 3) of one row.
    """
    return get_xyz_points(pointcloud2_to_array(cloud_msg), remove_nans=remove_nans)


def merge_rgb_fields(cloud_arr: NDArray[Any]) -> NDArray[Any]:
    """Return points whose bytes ``r``, ``g`` and ``b`` have become PCL's float ``rgb``.

    They are structured, of any shape, which stays.
    """
    packed = np.zeros(cloud_arr.shape, np.uint32)
    for name, shift in _COLOURS.items():
        packed |= cloud_arr[name].astype(np.uint32) << shift
    kept = [name for name in cloud_arr.dtype.names or () if name not in _COLOURS]
    return _with_fields(cloud_arr, kept, {"rgb": packed.view(np.float32)})


def split_rgb_field(cloud_arr: NDArray[Any]) -> NDArray[Any]:
    """Return points whose float ``rgb`` has become the bytes ``r``, ``g`` and ``b``.

    They are structured, of any shape, which stays.
    """
    packed = np.ascontiguousarray(cloud_arr["rgb"]).view(np.uint32)
    colours = {name: (packed >> shift).astype(np.uint8) for name, shift in _COLOURS.items()}
    kept = [name for name in cloud_arr.dtype.names or () if name != "rgb"]
    return _with_fields(cloud_arr, kept, colours)


def _with_fields(
    points: NDArray[Any], kept: list[str], added: dict[str, NDArray[Any]]
) -> NDArray[Any]:
    kinds = [(name, points.dtype[name]) for name in kept]
    kinds += [(name, values.dtype) for name, values in added.items()]
    found = np.zeros(points.shape, kinds)
    for name in kept:
        found[name] = points[name]
    for name, values in added.items():
        found[name] = values
    return found


def _field_type(cloud: Any) -> Any:
    """Return ``PointField`` of the same generation as the cloud."""
    from gazelle.interfaces import Ros1Message, message_type

    is_ros1 = isinstance(cloud, Ros1Message)
    return (ros1_message_type if is_ros1 else message_type)("sensor_msgs/PointField")
