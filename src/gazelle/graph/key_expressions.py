"""Key expressions, liveliness tokens and attachments, as ROS 2's ``rmw_zenoh`` writes them.

Source of the formats: ros2/rmw_zenoh, ``docs/design.md``. Names are written there with ``%``
for ``/``; a type is spelled ``sensor_msgs::msg::dds_::LaserScan_``.
"""

from __future__ import annotations

import enum
import struct
from dataclasses import dataclass
from hashlib import blake2b
from typing import NamedTuple

__all__ = [
    "ANY_TYPE",
    "DEFAULT_QOS",
    "NO_HASH",
    "Attachment",
    "Entity",
    "Kind",
    "Qos",
    "clock_key",
    "control_key",
    "dds_type",
    "entity_gid",
    "parameter_key",
    "ros_type",
    "service_key",
    "service_selector",
    "token",
    "token_selector",
    "topic_key",
    "topic_selector",
    "type_in_key",
]

ANY_TYPE = "*"
NO_HASH = "TypeHashNotSupported"
_ANY_ON_WIRE = "any"
_SPACE = "@ros2_lv"
_OWN_SPACE = "@gazelle"
_ATTACHMENT = struct.Struct("<qqB16s")
_DEFAULT_DEPTH = 42
_KEEP_ALL = "2"
_MANUAL = "3"
_S_TO_NS = 1_000_000_000
_INFINITE_NS = 2**63 - 1
_MAX_DIGITS = 20


class Kind(enum.StrEnum):
    """What a liveliness token stands for."""

    NODE = "NN"
    PUBLISHER = "MP"
    SUBSCRIPTION = "MS"
    SERVICE = "SS"
    CLIENT = "SC"


class Qos(NamedTuple):
    """A ROS 2 quality of service; the graph acts on the first three, the rest is told.

    Attributes:
        reliable: slow subscriptions are waited for.
        latched: late subscriptions get the last message (transient local).
        depth: most messages kept, 0 for all of them (keep all).
        deadline_ns: longest time between two messages, 0 for no limit.
        lifespan_ns: how long a message counts, 0 for ever.
        manual: the publisher itself says that it lives.
        lease_ns: how often it has to say so, 0 for never.
    """

    reliable: bool = True
    latched: bool = False
    depth: int = _DEFAULT_DEPTH
    deadline_ns: int = 0
    lifespan_ns: int = 0
    manual: bool = False
    lease_ns: int = 0

    def to_key(self) -> str:
        """Write as in a token: only what differs from the default (reliable, volatile)."""
        depth = "" if self.depth in (0, _DEFAULT_DEPTH) else str(self.depth)
        parts = (
            "" if self.reliable else "2",
            "1" if self.latched else "",
            f"{'' if self.depth else _KEEP_ALL},{depth}",
            _duration_key(self.deadline_ns),
            _duration_key(self.lifespan_ns),
            f"{_MANUAL if self.manual else ''},{_duration_key(self.lease_ns)}",
        )
        return ":".join(parts)

    @classmethod
    def from_key(cls, text: str) -> Qos:
        """Read what `to_key` or ``rmw_zenoh`` wrote; unknown parts count as default."""
        parts = [*text.split(":"), "", "", "", "", ""]
        history, _, depth = parts[2].partition(",")
        liveliness, _, lease = parts[5].partition(",")
        kept = _number(depth)
        return cls(
            parts[0] != "2",
            parts[1] == "1",
            0 if history == _KEEP_ALL else _DEFAULT_DEPTH if kept is None else kept,
            _duration_ns(parts[3]),
            _duration_ns(parts[4]),
            liveliness == _MANUAL,
            _duration_ns(lease),
        )


def _duration_key(duration_ns: int) -> str:
    if not duration_ns:
        return ","
    seconds, nanoseconds = divmod(duration_ns, _S_TO_NS)
    return f"{seconds},{nanoseconds}"


def _duration_ns(text: str) -> int:
    seconds, _, nanoseconds = text.partition(",")
    found = (_number(seconds) or 0) * _S_TO_NS + (_number(nanoseconds) or 0)
    return 0 if found >= _INFINITE_NS else found


def _number(text: str) -> int | None:
    """Read a whole number of at most 64 bits; what else Python calls digits is none."""
    is_one = text.isascii() and text.isdigit() and len(text) <= _MAX_DIGITS
    return int(text) if is_one else None


DEFAULT_QOS = Qos()


@dataclass(frozen=True, slots=True)
class Entity:
    """One node, publisher, subscription, service or client somewhere on the graph.

    Attributes:
        zid: the session it lives in, hexadecimal; one session is one process.
        node_id: number of its node in the session.
        entity_id: number of its own in the session.
        kind: what it is.
        node: global name of its node.
        name: global name of topic or service, empty for a node.
        type_name: ``pkg/msg/Name``, `ANY_TYPE` when it takes any, empty for a node.
        type_hash: RIHS01 hash of the type.
        qos: quality of service.
    """

    zid: str
    node_id: int
    entity_id: int
    kind: Kind
    node: str
    name: str = ""
    type_name: str = ""
    type_hash: str = NO_HASH
    qos: Qos = DEFAULT_QOS

    @classmethod
    def from_token(cls, key: str) -> Entity | None:
        """Read a token; None when it is not one, whatever it is: anybody can announce anything."""
        parts = key.split("/")
        if len(parts) not in (9, 13) or parts[0] != _SPACE or parts[5] not in set(Kind):
            return None
        node_id, entity_id = _number(parts[3]), _number(parts[4])
        if node_id is None or entity_id is None or not key.isprintable():
            return None
        namespace = parts[7].replace("%", "/").rstrip("/")
        start = (parts[2], node_id, entity_id, Kind(parts[5]))
        node = f"{namespace}/{parts[8].replace('%', '/')}"
        if len(parts) == 9:
            return cls(*start, node)
        name = parts[9].replace("%", "/")
        return cls(*start, node, name, ros_type(parts[10]), parts[11], Qos.from_key(parts[12]))


class Attachment(NamedTuple):
    """What travels beside each message.

    Attributes:
        sequence: counts the publisher's messages from 1.
        stamp_ns: wall time of publishing, nanoseconds since 1970.
        gid: 16 bytes that name the publisher, see `entity_gid`.
    """

    sequence: int
    stamp_ns: int
    gid: bytes

    def to_bytes(self) -> bytes:
        """Return the 33 bytes of ``rmw_zenoh`` 0.2.4 and later."""
        return _ATTACHMENT.pack(self.sequence, self.stamp_ns, 16, self.gid)

    @classmethod
    def from_bytes(cls, data: bytes) -> Attachment:
        """Read an attachment; one of another length gives zeros."""
        if len(data) != _ATTACHMENT.size:
            return cls(0, 0, bytes(16))
        sequence, stamp_ns, _, gid = _ATTACHMENT.unpack(data)
        return cls(sequence, stamp_ns, gid)


def dds_type(type_name: str) -> str:
    """Spell ``pkg/msg/Name`` as ``pkg::msg::dds_::Name_``."""
    if type_name == ANY_TYPE:
        return _ANY_ON_WIRE
    *folders, name = type_name.split("/")
    return "::".join([*folders, "dds_", f"{name}_"])


def ros_type(text: str) -> str:
    """Undo `dds_type`."""
    if text == _ANY_ON_WIRE:
        return ANY_TYPE
    *folders, name = text.split("::")
    return "/".join([*(one for one in folders if one != "dds_"), name.removesuffix("_")])


def topic_key(domain: int, topic: str, type_name: str, type_hash: str) -> str:
    """Return the key that a topic's messages travel under."""
    return f"{domain}/{topic.strip('/')}/{dds_type(type_name)}/{type_hash}"


def topic_selector(domain: int, topic: str) -> str:
    """Return the expression that matches a topic whatever its type, so mismatches can be told."""
    return f"{domain}/{topic.strip('/')}/*/*"


def service_key(domain: int, service: str, type_name: str, type_hash: str) -> str:
    """Return the key a service answers at; hash ``*`` asks whatever the hash."""
    return f"{domain}/{service.strip('/')}/{dds_type(type_name)}/{type_hash}"


def type_in_key(key: str) -> tuple[str, str]:
    """Return type name and hash of a topic's or service's key."""
    type_text, type_hash = key.rsplit("/", 2)[1:]
    return ros_type(type_text), type_hash


def token(domain: int, entity: Entity) -> str:
    """Return the liveliness token of an entity."""
    namespace, _, name = entity.node.rpartition("/")
    text = (
        f"{_SPACE}/{domain}/{entity.zid}/{entity.node_id}/{entity.entity_id}/{entity.kind}"
        f"/%/{namespace.replace('/', '%') or '%'}/{name}"
    )
    if entity.kind is Kind.NODE:
        return text
    topic = entity.name.replace("/", "%")
    type_text = dds_type(entity.type_name)
    return f"{text}/{topic}/{type_text}/{entity.type_hash}/{entity.qos.to_key()}"


def token_selector(domain: int) -> str:
    """Return the expression that matches every token of a domain."""
    return f"{_SPACE}/{domain}/**"


def service_selector(domain: int, name: str, type_name: str) -> str:
    """Return the expression that matches the tokens of all servers of a service."""
    topic = name.replace("/", "%")
    return f"{_SPACE}/{domain}/*/*/*/{Kind.SERVICE}/%/*/*/{topic}/{dds_type(type_name)}/**"


def entity_gid(token_text: str) -> bytes:
    """Return 16 bytes that name the entity with this token, the same in every process."""
    return blake2b(token_text.encode(), digest_size=16).digest()


def control_key(domain: int, zid: str) -> str:
    """Return the key at which a process answers about itself (pid, shutting down a node)."""
    return f"{_OWN_SPACE}/{domain}/control/{zid}"


def clock_key(domain: int, zid: str) -> str:
    """Return the key at which a process tells of the clock that it shows."""
    return f"{_OWN_SPACE}/{domain}/clock/{zid}"


def parameter_key(what: str) -> str:
    """Return the key of the hub's parameter store: ``store`` to ask, ``update`` for changes."""
    return f"{_OWN_SPACE}/parameters/{what}"
