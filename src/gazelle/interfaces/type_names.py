"""ROS 1 names ↔ the names that travel, and the few places where the definitions differ.

ROS 2 definitions are canonical on the wire. Fields are matched by name; ``D`` is ``d`` and
``hiStop`` is ``hi_stop``. What else differs stands in the tables here.
"""

from __future__ import annotations

from gazelle.errors import NotFoundError
from gazelle.interfaces.definition import Definition, Field, RosVersion
from gazelle.interfaces.message_base import Types
from gazelle.interfaces.ros1_conversion import as_ros_version

__all__ = [
    "canonical_name",
    "ros1_name",
    "ros1_type_of",
    "split_name",
    "wire_definition",
    "wire_field",
    "wire_type",
]


def split_name(name: str, part: str = "msg") -> tuple[str, str, str]:
    """Return package, part and bare name of ``pkg/Name`` or ``pkg/part/Name``.

    Raises:
        NotFoundError: the text is not written as a type's name.
    """
    parts = name.strip("/").split("/")
    if len(parts) == 2 and all(parts):
        return parts[0], part, parts[1]
    if len(parts) == 3 and all(parts) and parts[1] in ("msg", "srv", "action"):
        return parts[0], parts[1], parts[2]
    raise NotFoundError(
        "type", name, hint="a type is written package/Name or package/msg/Name (srv, action)"
    )


def canonical_name(name: str, part: str = "msg") -> str:
    """Return ``pkg/msg/Name`` for that or for ``pkg/Name``.

    Raises:
        NotFoundError: the text is not written as a type's name.
    """
    return "/".join(split_name(name, part))


def ros1_name(full: str) -> str:
    """Return ``pkg/Name`` of a full name; ``pkg/srv/Name_Request`` is ``pkg/NameRequest``."""
    package, part, name = split_name(full)
    if part == "srv":
        for suffix in ("_Request", "_Response"):
            if name.endswith(suffix):
                name = name.removesuffix(suffix) + suffix[1:]
    return f"{package}/{name}"


_RENAMED_TYPES = {
    "tf/msg/tfMessage": "tf2_msgs/msg/TFMessage",
    "rosgraph_msgs/msg/Log": "rcl_interfaces/msg/Log",
    "roslib/msg/Header": "std_msgs/msg/Header",
    "roslib/msg/Log": "rcl_interfaces/msg/Log",
}

_ROS1_OF_WIRE = {"rcl_interfaces/msg/Log": "rosgraph_msgs/Log"}

_RENAMED_FIELDS = {
    "control_msgs/msg/JointTrajectoryControllerState": {
        "reference": "desired",
        "feedback": "actual",
    },
}

_OWN_LAYOUT = frozenset({"controller_manager_msgs"})

"""Packages whose ROS 1 and ROS 2 services share names only."""


def wire_type(ros1_type: str, part: str = "msg") -> str:
    """Return the canonical name under which values of a ROS 1 type travel.

    Args:
        ros1_type: ``sensor_msgs/LaserScan``; the full form is taken too.
        part: ``msg``, or ``srv`` for a service's name.

    Raises:
        NotFoundError: the text is not a type's name.
    """
    full = canonical_name(ros1_type, part)
    return _RENAMED_TYPES.get(full, full)


def ros1_type_of(wire: str) -> str:
    """Return the ROS 1 name of what travels under a canonical name.

    ``rcl_interfaces/msg/Log`` is ``rosgraph_msgs/Log``, the type of ``/rosout`` in ROS 1.
    """
    return _ROS1_OF_WIRE.get(wire) or ros1_name(wire)


def wire_definition(types: Types, name: str) -> Definition:
    """Return the definition that lays out a ROS 1 type's CDR, by ROS 2's rules."""
    if name.split("/", 1)[0] in _OWN_LAYOUT:
        return as_ros_version(types.definition(name, RosVersion.ROS1), RosVersion.ROS2)
    return types.definition(name, RosVersion.ROS2)


def wire_field(wire: Definition, item: Field, own: dict[str, Field]) -> Field | None:
    """Return the field of a ROS 1 or ROS 2 class that fills a field of the wire.

    Args:
        wire: the definition that lays out the bytes.
        item: one of its fields.
        own: the class's fields by name.

    Returns:
        None when the class has none; the default is written and nothing is read.
    """
    renamed = _RENAMED_FIELDS.get(wire.name, {})
    back = {ros1: ros2 for ros2, ros1 in renamed.items()}
    for name in (renamed.get(item.name), back.get(item.name), item.name):
        if name is not None and name in own:
            return own[name]
    plain = _plain(item.name)
    return next((field for name, field in own.items() if _plain(name) == plain), None)


def _plain(name: str) -> str:
    return name.replace("_", "").casefold()
