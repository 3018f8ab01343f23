"""Which message becomes which array (ros_numpy.registry)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from gazelle.compat.ros_numpy import geometry, image, occupancy_grid, point_cloud2
from gazelle.diagnostics import did_you_mean

__all__ = ["msgify", "numpify"]

Convert = Callable[..., Any]

_TO_NUMPY: dict[str, Convert] = {
    "geometry_msgs/msg/Point": geometry.point_to_numpy,
    "geometry_msgs/msg/Pose": geometry.pose_to_numpy,
    "geometry_msgs/msg/Quaternion": geometry.quat_to_numpy,
    "geometry_msgs/msg/Transform": geometry.transform_to_numpy,
    "geometry_msgs/msg/Vector3": geometry.vector3_to_numpy,
    "nav_msgs/msg/OccupancyGrid": occupancy_grid.occupancygrid_to_numpy,
    "sensor_msgs/msg/Image": image.image_to_numpy,
    "sensor_msgs/msg/PointCloud2": point_cloud2.pointcloud2_to_array,
}
_FROM_NUMPY: dict[str, Convert] = {
    "geometry_msgs/msg/Point": geometry.numpy_to_vector,
    "geometry_msgs/msg/Pose": geometry.numpy_to_pose,
    "geometry_msgs/msg/Quaternion": geometry.numpy_to_quat,
    "geometry_msgs/msg/Transform": geometry.numpy_to_transform,
    "geometry_msgs/msg/Vector3": geometry.numpy_to_vector,
    "nav_msgs/msg/OccupancyGrid": occupancy_grid.numpy_to_occupancy_grid,
    "sensor_msgs/msg/Image": image.numpy_to_image,
    "sensor_msgs/msg/PointCloud2": point_cloud2.array_to_pointcloud2,
}
_POINT_FIELD = "sensor_msgs/msg/PointField"


def numpify(msg: Any, *args: Any, **kwargs: Any) -> Any:
    """Return a message as an array; None for None.

    Args:
        msg: ``Image``, ``PointCloud2``, ``OccupancyGrid``, ``Point``, ``Vector3``, ``Quaternion``,
            ``Pose`` or ``Transform``, or a list of ``PointField``.
        *args: as the function of that type takes them.
        **kwargs: likewise, such as ``hom`` of a vector.

    Raises:
        ValueError: no array stands for the type.
    """
    if msg is None:
        return None
    if isinstance(msg, Sequence) and not isinstance(msg, str):
        if not msg:
            raise ValueError("Cannot determine the type of an empty Collection")
        if _type_name(msg[0]) == _POINT_FIELD:
            return point_cloud2.fields_to_dtype(msg, *args, **kwargs)
        raise ValueError(
            _unsupported_text("convert", _type_name(msg[0]) + "[]", [f"{_POINT_FIELD}[]"])
        )
    convert = _TO_NUMPY.get(_type_name(msg))
    if convert is None:
        raise ValueError(_unsupported_text("convert", _type_name(msg), _TO_NUMPY))
    return convert(msg, *args, **kwargs)


def msgify(msg_type: Any, numpy_obj: Any, *args: Any, plural: bool = False, **kwargs: Any) -> Any:
    """Return an array as a message.

    Args:
        msg_type: the message's class.
        numpy_obj: the array.
        plural: make a list of ``PointField`` of a structured type.
        *args: as the function of that type takes them.
        **kwargs: likewise, such as an image's ``encoding``.

    Raises:
        ValueError: no array stands for the type, or this one has not its shape.
    """
    name = _type_name(msg_type)
    if plural and name == _POINT_FIELD:
        return point_cloud2.dtype_to_fields(numpy_obj, msg_type)
    convert = _FROM_NUMPY.get(name)
    if convert is None or plural:
        raise ValueError(_unsupported_text("build", name, _FROM_NUMPY))
    return convert(numpy_obj, *args, msg_type=msg_type, **kwargs)


def _type_name(one: Any) -> str:
    return str(getattr(one, "TYPE_NAME", "") or getattr(one, "__name__", type(one).__name__))


def _unsupported_text(what: str, name: str, known: Any) -> str:
    names = ", ".join(sorted(known))
    text = f"Unable to {what} message {name} - only supports {names}"
    return f"{text}; {did_you_mean(name, known)}".rstrip("; ")
