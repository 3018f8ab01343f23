"""Types and fields of Gazebo's messages in those of ROS, as ``ros_gz_bridge`` pairs them.

Source of the pairs: the table in the README of ``ros_gz_bridge``.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from gazelle.cli.gz.options import GzError
from gazelle.diagnostics import did_you_mean
from gazelle.errors import GazelleError
from gazelle.interfaces import fill, message_type
from gazelle.interfaces.definition import Array

__all__ = ["gz_type_of", "message_of", "ros_types_of", "text_fields"]

_SPACES = ("gz.msgs.", "ignition.msgs.")
_GEOMETRY = "geometry_msgs/msg/"
_STD = "std_msgs/msg/"
# The first one is taken where nobody uses the topic yet.
_TYPES: Mapping[str, tuple[str, ...]] = {
    "Boolean": (f"{_STD}Bool",),
    "Clock": ("rosgraph_msgs/msg/Clock",),
    "Color": (f"{_STD}ColorRGBA",),
    "Double": (f"{_STD}Float64",),
    "Empty": (f"{_STD}Empty",),
    "Entity": ("ros_gz_interfaces/msg/Entity",),
    "EntityWrench": ("ros_gz_interfaces/msg/EntityWrench",),
    "Float": (f"{_STD}Float32",),
    "Header": (f"{_STD}Header",),
    "Int32": (f"{_STD}Int32",),
    "JointTrajectory": ("trajectory_msgs/msg/JointTrajectory",),
    "Pose": tuple(f"{_GEOMETRY}{name}" for name in ("Pose", "PoseStamped")),
    "Pose_V": ("tf2_msgs/msg/TFMessage",),
    "Quaternion": (f"{_GEOMETRY}Quaternion",),
    "StringMsg": (f"{_STD}String",),
    "Twist": tuple(f"{_GEOMETRY}{name}" for name in ("Twist", "TwistStamped")),
    "UInt32": (f"{_STD}UInt32",),
    "Vector3d": tuple(f"{_GEOMETRY}{name}" for name in ("Vector3", "Point")),
    "WorldStatistics": ("gazelle_msgs/msg/WorldStatistics",),
    "Wrench": tuple(f"{_GEOMETRY}{name}" for name in ("Wrench", "WrenchStamped")),
}
_BACK = {ros: f"gz.msgs.{gz}" for gz, names in _TYPES.items() for ros in names}
_RENAMED = {"nsec": "nanosec", "sim": "clock"}
_HEADER = "header"


def ros_types_of(gz_type: str) -> tuple[str, ...]:
    """Return the types of ROS that a type of Gazebo is paired with.

    Raises:
        GzError: none here; the text names what is spelled alike.
    """
    bare = gz_type
    for space in _SPACES:
        bare = bare.removeprefix(space)
    if bare not in _TYPES:
        hint = did_you_mean(bare, _TYPES) or f"there are {', '.join(sorted(_TYPES))}"
        raise GzError(
            f"message type '{gz_type}' has no pair of ROS here; {hint}; "
            "other types go with ros2 topic pub"
        )
    return _TYPES[bare]


def gz_type_of(ros_type: str) -> str:
    """Return the type of Gazebo that a type of ROS is paired with, itself where there is none."""
    return _BACK.get(ros_type, ros_type)


def message_of(ros_type: str, fields: Mapping[str, Any]) -> Any:
    """Return a message of ROS with fields of Gazebo's message.

    Args:
        ros_type: ``pkg/msg/Name``.
        fields: as `protobuf_reading` gives them.

    Raises:
        GzError: a field does not fit.
    """
    message = message_type(ros_type)()
    try:
        fill(message, _fields(type(message), fields))
    except GazelleError as error:
        raise GzError(f"this is no {gz_type_of(ros_type)} ({ros_type}): {error}") from None
    return message


def text_fields(value: Any) -> Any:
    """Return a message's plain values with Gazebo's names of times, for `protobuf_text`."""
    if isinstance(value, Mapping):
        return {
            "nsec" if name == "nanosec" else name: text_fields(one) for name, one in value.items()
        }
    return [text_fields(one) for one in value] if isinstance(value, list) else value


def _fields(message_class: Any, fields: Mapping[str, Any]) -> dict[str, Any]:
    known = {one.name: one for one in message_class.FIELDS}
    inner = [name for name in known if name != _HEADER]
    is_wrapped = _HEADER in known and len(inner) == 1 and not fields.keys() & set(inner)
    if is_wrapped:
        outer = {name: value for name, value in fields.items() if name == _HEADER}
        fields = {**outer, inner[0]: {k: v for k, v in fields.items() if k != _HEADER}}
    found: dict[str, Any] = {}
    for name, value in fields.items():
        own = name if name in known else _RENAMED.get(name, name)
        field = known.get(own)
        if own == _HEADER:
            found[own] = _header(value)
        elif field is None:
            found[own] = value
        else:
            found[own] = _value(message_class, field, value)
    return found


def _value(message_class: Any, field: Any, value: Any) -> Any:
    if field.type.array is not Array.ONE:
        many = value if isinstance(value, list) else [value]
        return [_one(message_class, field, one) for one in many]
    return _one(message_class, field, value)


def _one(message_class: Any, field: Any, value: Any) -> Any:
    if isinstance(value, Mapping):
        return _fields(message_type(field.type.base), value)
    # Words of enumerations are constants of the message in ROS.
    if isinstance(value, str) and "string" not in field.type.base:
        return getattr(message_class, value, value)
    return value


def _header(fields: Any) -> dict[str, Any]:
    """Gazebo keeps the frame among pairs of key and value."""
    if not isinstance(fields, Mapping):
        raise GzError("header is a message: header: {stamp: {sec: 1}}")
    stamp = fields.get("stamp", {})
    found: dict[str, Any] = {
        "stamp": {_RENAMED.get(name, name): value for name, value in stamp.items()}
    }
    for pair in _many(fields.get("data", ())):
        if pair.get("key") == "frame_id":
            found["frame_id"] = " ".join(_many(pair.get("value", "")))
    return found


def _many(value: Any) -> Iterable[Any]:
    return value if isinstance(value, (list, tuple)) else (value,)
