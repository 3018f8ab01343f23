"""Message classes as the graph needs them: names, hashes, bytes; ROS 1 views included."""

from __future__ import annotations

from typing import Any

from gazelle.errors import GazelleError
from gazelle.graph.key_expressions import NO_HASH
from gazelle.interfaces import TypeStore, from_cdr, message_type, to_cdr, types_of, wire_type

__all__ = [
    "convert",
    "decode",
    "encode",
    "hash_of",
    "is_ros1_view",
    "request_type",
    "resolve_type",
    "response_type",
    "service_name_of",
    "type_name_of",
]


def type_name_of(message_class: Any) -> str:
    """Return the name, ``pkg/msg/Name``, under which messages of a class travel.

    A ROS 1 view has the name of what it views: ``rosgraph_msgs/Log`` is
    ``rcl_interfaces/msg/Log``.
    """
    name: str = getattr(message_class, "TYPE_NAME", "") or message_class._type
    return wire_type(name) if is_ros1_view(message_class) else name


def service_name_of(service_class: Any) -> str:
    """Return the name, ``pkg/srv/Name``, of a service class of either generation."""
    name: str = getattr(service_class, "TYPE_NAME", "") or service_class.name
    return wire_type(name, "srv")


def request_type(service_class: Any) -> Any:
    """Return the request's message class."""
    return getattr(service_class, "_request_class", None) or service_class.Request


def response_type(service_class: Any) -> Any:
    """Return the response's message class."""
    return getattr(service_class, "_response_class", None) or service_class.Response


def is_ros1_view(message_class: Any) -> bool:
    """Return whether the class has ROS 1 field names and rules."""
    return hasattr(message_class, "_slot_types")


def resolve_type(type_or_name: Any) -> Any:
    """Return the class of a type given by name; a class is returned as it is."""
    if isinstance(type_or_name, str):
        return message_type(type_or_name)
    return type_or_name


def hash_of(type_name: str, message_class: Any = None) -> str:
    """Return the RIHS01 hash of a type, a fixed word where the type is not known.

    Args:
        type_name: under which it travels.
        message_class: is asked what the type means; the process by default.
    """
    types = types_of(message_class)
    return types.remembered(("hash", type_name), lambda: _hash(types, type_name))


def _hash(types: TypeStore, type_name: str) -> str:
    try:
        return types.type_hash(type_name)
    except GazelleError:
        return NO_HASH


def encode(message: Any) -> bytes:
    """Return the CDR bytes of a message."""
    return to_cdr(message)


def decode(message_class: Any, data: bytes) -> Any:
    """Return a message read from CDR bytes."""
    return from_cdr(message_class, data)


def convert(message: Any, message_class: Any) -> Any:
    """Return the message as another class of the same type, itself when it already is one."""
    return message if type(message) is message_class else decode(message_class, encode(message))
