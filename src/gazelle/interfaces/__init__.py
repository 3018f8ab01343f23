"""Messages, services and actions of ROS 1 and ROS 2: classes, definitions and bytes.

`message_type` gives classes in the form of ROS 2, `ros1_message_type` in the form of ROS 1; both
write the same CDR bytes. Definitions are read, classes made and codecs compiled on first use.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.interfaces.codec import convert, from_cdr, from_ros1, to_cdr, to_ros1
from gazelle.interfaces.definition import Constant, Definition, Field, FieldType, Generation
from gazelle.interfaces.library import add_package, add_search_path
from gazelle.interfaces.lookup import definition, known_types
from gazelle.interfaces.message import Message, message_type
from gazelle.interfaces.naming import ros1_type_of, wire_type
from gazelle.interfaces.ros1_digest import (
    md5sum,
    service_md5sum,
    show_message,
    show_service,
)
from gazelle.interfaces.ros1_message import AnyMsg, Ros1Message, ros1_message_type
from gazelle.interfaces.ros1_time import Duration, Time, TVal
from gazelle.interfaces.services import (
    ActionType,
    Ros1Service,
    ServiceType,
    action_type,
    ros1_service_type,
    service_type,
)

if TYPE_CHECKING:
    from gazelle.interfaces.echo_text import strify
    from gazelle.interfaces.full_text import keep_text, kept_text, ros1_definition, ros2_definition
    from gazelle.interfaces.plain import fill, time_keys, to_plain
    from gazelle.interfaces.rihs01 import type_hash

__all__ = [
    "ActionType",
    "AnyMsg",
    "Constant",
    "Definition",
    "Duration",
    "Field",
    "FieldType",
    "Generation",
    "Message",
    "Ros1Message",
    "Ros1Service",
    "ServiceType",
    "TVal",
    "Time",
    "action_type",
    "add_package",
    "add_search_path",
    "convert",
    "definition",
    "fill",
    "from_cdr",
    "from_ros1",
    "keep_text",
    "kept_text",
    "known_types",
    "md5sum",
    "message_type",
    "ros1_definition",
    "ros1_message_type",
    "ros1_service_type",
    "ros1_type_of",
    "ros2_definition",
    "service_md5sum",
    "service_type",
    "show_message",
    "show_service",
    "strify",
    "time_keys",
    "to_cdr",
    "to_plain",
    "to_ros1",
    "type_hash",
    "wire_type",
]

_LATER = {
    "fill": "plain",
    "keep_text": "full_text",
    "kept_text": "full_text",
    "ros1_definition": "full_text",
    "ros2_definition": "full_text",
    "strify": "echo_text",
    "time_keys": "plain",
    "to_plain": "plain",
    "type_hash": "rihs01",
}


def __getattr__(name: str) -> Any:
    """Import what programs seldom need when it is asked for."""
    if name in _LATER:
        from importlib import import_module

        found = getattr(import_module(f"{__name__}.{_LATER[name]}"), name)
        globals()[name] = found
        return found
    raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
