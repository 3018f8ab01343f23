"""Names, sums and bytes of types in ROS 1 and on the graph."""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Any, NamedTuple

from gazelle.errors import GazelleError
from gazelle.interfaces import (
    RosVersion,
    default_types,
    definition,
    from_cdr,
    from_ros1,
    md5sum,
    message_type,
    ros1_message_type,
    ros1_type_of,
    service_md5sum,
    to_ros1,
    wire_type,
)
from gazelle.interfaces.definition import Array
from gazelle.interfaces.ros1_conversion import CONVERTED
from gazelle.interfaces.type_names import ros1_name

__all__ = ["Frame", "MessageKind", "ServiceKind", "is_ros2_only", "message_kind", "service_kind"]

_LENGTH = struct.Struct("<I")
_HEAD = struct.Struct("<II")
_HEADER = "std_msgs/msg/Header"


class Frame(NamedTuple):
    """A message as TCPROS sends it: its length and first bytes, and what comes behind."""

    head: bytes
    body: memoryview

    @property
    def size(self) -> int:
        """Bytes on the wire."""
        return len(self.head) + self.body.nbytes


class MessageKind(NamedTuple):
    """A message type in both worlds.

    Attributes:
        ros1_name: ``sensor_msgs/LaserScan``.
        wire_name: ``sensor_msgs/msg/LaserScan``, the name on the graph.
        md5: its sum in ROS 1.
        message_class: what carries it from one side to the other.
        has_header: whether ROS 1's bytes start with a sequence number.
    """

    ros1_name: str
    wire_name: str
    md5: str
    message_class: Any
    has_header: bool

    @property
    def reliable(self) -> bool:
        """True: ROS 1 has no other."""
        return True

    def to_frame(self, cdr: bytes, sequence: int) -> Frame:
        """Return a message of the graph as ROS 1 sends it; the sequence goes into its header.

        Raises:
            InterfaceError: the bytes are not of this type.
        """
        data = to_ros1(from_cdr(self.message_class, cdr))
        if self.has_header:
            head = _HEAD.pack(len(data), sequence & 0xFFFFFFFF)
            return Frame(head, memoryview(data)[4:])
        return Frame(_LENGTH.pack(len(data)), memoryview(data))

    def from_bytes(self, data: bytes | bytearray) -> Any:
        """Return the message that ROS 1's bytes hold.

        Raises:
            InterfaceError: the bytes are not of this type.
        """
        return from_ros1(self.message_class, data)


class ServiceKind(NamedTuple):
    """A service type in both worlds.

    Attributes:
        ros1_name: ``std_srvs/SetBool``.
        md5: its sum in ROS 1.
        service_class: in the form of ROS 1.
    """

    ros1_name: str
    md5: str
    service_class: Any


def message_kind(name: str) -> MessageKind:
    """Return a message type by its name in either world.

    Raises:
        GazelleError: nothing defines it.
    """
    return default_types().remembered(("kind", name), lambda: _message_kind(name))


def _message_kind(name: str) -> MessageKind:
    wire = wire_type(name)
    ros1 = name if name.count("/") == 1 else ros1_type_of(name)
    full = "/".join((ros1.split("/")[0], "msg", ros1.split("/")[1]))
    # A converted type becomes another one by rules that only its ROS 1 form knows.
    view: Callable[[str], Any] = ros1_message_type if full in CONVERTED else message_type
    fields = definition(full, RosVersion.ROS1).fields
    has_header = (
        bool(fields) and fields[0].type.base == _HEADER and fields[0].type.array is Array.ONE
    )
    message_class = view(full if full in CONVERTED else wire)
    return MessageKind(ros1, wire, md5sum(full), message_class, has_header)


def service_kind(name: str) -> ServiceKind:
    """Return a service type by its name in either world.

    Raises:
        GazelleError: nothing defines it.
    """
    return default_types().remembered(("service kind", name), lambda: _service_kind(name))


def _service_kind(name: str) -> ServiceKind:
    from gazelle.interfaces import ros1_service_type

    wire = wire_type(name, "srv")
    return ServiceKind(ros1_name(wire), service_md5sum(wire), ros1_service_type(wire))


def is_ros2_only(wire_name: str) -> bool:
    """Return whether ROS 1 has no definition of its own of a type."""
    try:
        first, part, bare = wire_name.split("/")
        names = [wire_name] if part == "msg" else [f"{first}/srv/{bare}_Request"]
        return not all(definition(name, RosVersion.ROS1).native for name in names)
    except (GazelleError, ValueError):
        return False
