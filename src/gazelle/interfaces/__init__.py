"""Messages, services and actions of ROS 1 and ROS 2: classes, definitions and bytes.

`message_type` gives classes in the form of ROS 2, `ros1_message_type` in the form of ROS 1; both
write the same CDR bytes. Definitions are read, classes made and codecs compiled on first use.
"""

from __future__ import annotations

from gazelle.interfaces.codec import convert, from_cdr, from_ros1, to_cdr, to_ros1
from gazelle.interfaces.definition import Constant, Definition, Field, FieldType, Generation
from gazelle.interfaces.library import add_package, add_search_path
from gazelle.interfaces.lookup import definition, known_types
from gazelle.interfaces.message import Message, message_type
from gazelle.interfaces.naming import ros1_type_of, wire_type
from gazelle.interfaces.ros1_digest import (
    md5sum,
    ros1_definition,
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
    "from_cdr",
    "from_ros1",
    "known_types",
    "md5sum",
    "message_type",
    "ros1_definition",
    "ros1_message_type",
    "ros1_service_type",
    "ros1_type_of",
    "service_md5sum",
    "service_type",
    "show_message",
    "show_service",
    "to_cdr",
    "to_ros1",
    "wire_type",
]
