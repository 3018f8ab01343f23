"""Messages, services and actions of ROS 1 and ROS 2: classes, definitions and bytes.

`message_type` gives classes in the form of ROS 2, `ros1_message_type` in the form of ROS 1; both
write the same CDR bytes. Definitions are read, classes made and codecs compiled on first use.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.interfaces.codec import convert, from_cdr, from_ros1, to_cdr, to_ros1
from gazelle.interfaces.definition import Constant, Definition, Field, FieldType, RosVersion
from gazelle.interfaces.message import Message
from gazelle.interfaces.ros1_message import AnyMsg, Ros1Message
from gazelle.interfaces.ros1_time import Duration, Time, TVal
from gazelle.interfaces.services import ActionType, Ros1Service, ServiceType
from gazelle.interfaces.type_names import ros1_name, ros1_type_of, split_name, wire_type
from gazelle.interfaces.type_store import TypeStore, default_types, types_of

if TYPE_CHECKING:
    from gazelle.interfaces.echo_text import strify
    from gazelle.interfaces.message_dict import fill, to_plain

__all__ = [
    "ActionType",
    "AnyMsg",
    "Constant",
    "Definition",
    "Duration",
    "Field",
    "FieldType",
    "Message",
    "Ros1Message",
    "Ros1Service",
    "RosVersion",
    "ServiceType",
    "TVal",
    "Time",
    "TypeStore",
    "action_type",
    "add_package",
    "add_search_path",
    "convert",
    "default_types",
    "definition",
    "exists",
    "fill",
    "find_source",
    "from_cdr",
    "from_ros1",
    "keep_text",
    "kept_text",
    "known_types",
    "md5sum",
    "message_type",
    "ros1_definition",
    "ros1_message_type",
    "ros1_name",
    "ros1_service_type",
    "ros1_type_of",
    "ros2_definition",
    "service_md5sum",
    "service_type",
    "show_message",
    "show_service",
    "split_name",
    "strify",
    "time_keys",
    "to_cdr",
    "to_plain",
    "to_ros1",
    "type_description",
    "type_hash",
    "types_of",
    "wire_type",
]

_TYPES = default_types()
action_type = _TYPES.action_type
add_package = _TYPES.add_package
add_search_path = _TYPES.add_search_path
definition = _TYPES.definition
exists = _TYPES.exists
find_source = _TYPES.find_source
keep_text = _TYPES.keep_text
kept_text = _TYPES.kept_text
known_types = _TYPES.known_types
md5sum = _TYPES.md5sum
message_type = _TYPES.message_type
ros1_definition = _TYPES.ros1_definition
ros1_message_type = _TYPES.ros1_message_type
ros1_service_type = _TYPES.ros1_service_type
ros2_definition = _TYPES.ros2_definition
service_md5sum = _TYPES.service_md5sum
service_type = _TYPES.service_type
show_message = _TYPES.show_message
show_service = _TYPES.show_service
time_keys = _TYPES.time_keys
type_description = _TYPES.type_description
type_hash = _TYPES.type_hash

_LATER = {
    "fill": "message_dict",
    "strify": "echo_text",
    "to_plain": "message_dict",
}


def __getattr__(name: str) -> Any:
    """Import what programs seldom need when it is asked for."""
    if name in _LATER:
        from importlib import import_module

        found = getattr(import_module(f"{__name__}.{_LATER[name]}"), name)
        globals()[name] = found
        return found
    if name == "Generation":
        from gazelle.deprecation import warn_renamed

        warn_renamed(f"{__name__}.Generation", "RosVersion", gone_in="0.3.0")
        return RosVersion
    raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
