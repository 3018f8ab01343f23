"""Messages and services that stay CDR bytes on their way through Python.

Classes of these look to the graph like message classes: they have a name, and a codec that hands
the bytes on. So a node of C++ publishes and listens like any other, and nothing is decoded here.
"""

from __future__ import annotations

import re
from typing import Any, ClassVar

from gazelle.interfaces import RosVersion, TypeStore, default_types

__all__ = ["RawMessageBase", "know_type", "raw_message_type", "raw_service_type"]

_RULE = re.compile(r"^=+[ \t]*\n", re.MULTILINE)
_HEAD = re.compile(r"MSG: (\S+)\n")
_messages: dict[str, type[RawMessageBase]] = {}
_services: dict[str, type[Any]] = {}


class RawMessageBase:
    """A message of one type as its CDR bytes.

    Attributes:
        data: the bytes with their header.
        TYPE_NAME: ``pkg/msg/Name``.
    """

    __slots__ = ("__weakref__", "data")
    TYPE_NAME: ClassVar[str] = ""
    _types: ClassVar[TypeStore] = default_types()
    _cdr_writer: ClassVar[Any]
    _cdr_reader: ClassVar[Any]
    _big_reader: ClassVar[Any]

    def __init__(self, data: bytes) -> None:
        """Keep the bytes."""
        self.data = data


def raw_message_type(name: str) -> type[RawMessageBase]:
    """Return the class of messages of a type, by ``pkg/msg/Name``; the type need not be known."""
    found = _messages.get(name)
    if found is None:
        found = type(f"Raw[{name}]", (RawMessageBase,), {"__slots__": (), "TYPE_NAME": name})
        found._cdr_writer = staticmethod(_bytes_of)
        found._cdr_reader = found._big_reader = found
        _messages[name] = found
    return found


def raw_service_type(name: str) -> type[Any]:
    """Return the class of a service, by ``pkg/srv/Name``, of which both halves stay bytes."""
    found = _services.get(name)
    if found is None:
        halves = {part: raw_message_type(f"{name}_{part}") for part in ("Request", "Response")}
        found = _services[name] = type(f"Raw[{name}]", (), {"TYPE_NAME": name, **halves})
    return found


def know_type(name: str, definition: str, *, is_ros1: bool) -> None:
    """Let this process know a type that only the program's own header knows.

    Args:
        name: ``pkg/msg/Name``.
        definition: its text, with those of all that it contains behind rules.
        is_ros1: by whose rules it is written.
    """
    types = default_types()
    if not definition or types.exists(name):
        return
    version = RosVersion.ROS1 if is_ros1 else RosVersion.ROS2
    first, *others = _RULE.split(definition)
    types.add_text(name, version, first)
    for text in others:
        head = _HEAD.match(text)
        if head is not None and not types.exists(head[1]):
            types.add_text(head[1], version, text[head.end() :])


def _bytes_of(message: RawMessageBase) -> bytes:
    return message.data
