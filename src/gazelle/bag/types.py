"""Types as bags carry them: definitions in, definitions out, and the bytes of the other ROS."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

from gazelle.bag.rosbag2.metadata import offered_qos
from gazelle.bag.storage import BagError, Connection, Encoding
from gazelle.errors import GazelleError
from gazelle.interfaces import (
    RosVersion,
    TypeStore,
    default_types,
    from_cdr,
    from_ros1,
    ros1_type_of,
    split_name,
    to_cdr,
    to_ros1,
    wire_type,
)
from gazelle.interfaces.type_names import canonical_name

__all__ = [
    "BagTypes",
    "bag_types",
    "cdr_connection",
    "converter",
    "learn_definitions",
    "message_class",
    "ros1_connection",
    "ros1_name_of",
    "split_texts",
    "wire_name_of",
]

_PART = re.compile(r"^=+\s*\nMSG:\s*(\S+)[^\n]*\n", re.MULTILINE)


def ros1_name_of(connection: Connection) -> str:
    """Return ``pkg/Name``."""
    if connection.encoding is Encoding.ROS1:
        return connection.type_name
    return ros1_type_of(connection.type_name)


def wire_name_of(connection: Connection) -> str:
    """Return the name, ``pkg/msg/Name``, under which the messages travel."""
    if connection.encoding is Encoding.CDR:
        return connection.type_name
    return wire_type(connection.type_name)


def ros1_connection(
    topic: str,
    type_name: str,
    *,
    callerid: str = "",
    latching: bool = False,
    types: TypeStore | None = None,
) -> Connection:
    """Return a connection for a ROS 1 bag.

    Args:
        topic: global name.
        type_name: ``pkg/Name``.
        callerid: global name of the node that publishes.
        latching: late subscriptions get the last message.
        types: knows the type; the process's own by default.

    Raises:
        NotFoundError: nothing defines the type.
    """
    known = types or default_types()
    text, digest = known.ros1_definition(type_name), known.md5sum(type_name)
    return Connection(0, topic, type_name, Encoding.ROS1, text, digest, callerid, latching)


def cdr_connection(
    topic: str, type_name: str, *, qos: str = "", types: TypeStore | None = None
) -> Connection:
    """Return a connection for a bag of rosbag2; without definition where it is not known.

    Args:
        topic: global name.
        type_name: ``pkg/msg/Name``.
        qos: ``offered_qos_profiles``, YAML; reliable and volatile by default.
        types: may know the type; the process's own by default.
    """
    known = types or default_types()
    try:
        text, digest = known.ros2_definition(type_name), known.type_hash(type_name)
    except GazelleError:
        text, digest = "", ""
    qos = qos or offered_qos()
    return Connection(0, topic, type_name, Encoding.CDR, text, qos=qos, type_hash=digest)


def message_class(connection: Connection, types: TypeStore | None = None) -> Any:
    """Return the class in which messages of a connection are read, in its generation's form.

    Args:
        connection: of a bag.
        types: knows the type (see `bag_types`); the process's own by default.

    Raises:
        NotFoundError: nothing defines the type, not even the bag.
    """
    known = types or default_types()
    if connection.encoding is Encoding.ROS1:
        return known.ros1_message_type(connection.type_name)
    return known.message_type(connection.type_name)


def converter(
    connection: Connection, encoding: Encoding, types: TypeStore | None = None
) -> Callable[[bytes], bytes]:
    """Return the function that turns a connection's bytes into those of an encoding.

    Args:
        connection: of a bag.
        encoding: of what comes out.
        types: knows the type (see `bag_types`); the process's own by default.

    Raises:
        NotFoundError: the bytes must be read for that, and nothing defines the type.
    """
    if connection.encoding is encoding:
        return bytes
    # ROS 1's view of a type reads and writes both encodings.
    view = (types or default_types()).ros1_message_type(ros1_name_of(connection))
    if encoding is Encoding.CDR:
        return lambda data: to_cdr(from_ros1(view, data))
    return lambda data: to_ros1(from_cdr(view, data))


class BagTypes(NamedTuple):
    """What the types of a bag are.

    Attributes:
        store: knows those that the bag defines where nothing else does, or differently; all
            others are the process's own.
        differing: names of the types that are known here with another definition.
    """

    store: TypeStore
    differing: tuple[str, ...]


def bag_types(connections: Iterable[Connection]) -> BagTypes:
    """Return the types of a bag; the rest of the process learns nothing of them.

    Raises:
        BagError: a type's name is no name of a message.
    """
    store = TypeStore(below=default_types())
    return BagTypes(store, learn_definitions(connections, store))


def learn_definitions(
    connections: Iterable[Connection], types: TypeStore | None = None
) -> tuple[str, ...]:
    """Let a bag define its types where nothing else does, or where it does it differently.

    Args:
        connections: of the bag.
        types: learns; it reads those types as the bag has them from then on, and writes their
            texts so. The process's own by default, for those whose users ask the process.

    Returns:
        Names of the types that are known here with another definition.

    Raises:
        BagError: a type's name is no name of a message.
    """
    types = types or default_types()
    differing = []
    for one in {(item.type_name, item.md5sum): item for item in connections}.values():
        known = _known_sum(one, types)
        if not one.definition:
            continue
        if known != one.md5sum and not (known and not one.md5sum):
            if known:
                differing.append(one.type_name)
            _teach(one, types)
        types.keep_text(one.type_name, _GENERATIONS[one.encoding], one.definition)
    return tuple(differing)


_GENERATIONS = {Encoding.ROS1: RosVersion.ROS1, Encoding.CDR: RosVersion.ROS2}


def split_texts(one: Connection) -> list[tuple[str, str]]:
    """Return the names and texts of the type and of all that it contains, as the bag has them."""
    first, *rest = _PART.split(one.definition)
    return [(one.type_name, first), *zip(rest[::2], rest[1::2], strict=True)]


def _known_sum(one: Connection, types: TypeStore) -> str:
    try:
        if one.encoding is Encoding.ROS1:
            return types.md5sum(one.type_name)
        types.definition(one.type_name, RosVersion.ROS2)
    except GazelleError:
        return ""
    return "known"


def _teach(one: Connection, types: TypeStore) -> None:
    """Define a type; what it contains only where that is not known, or differs too."""
    ros_version = _GENERATIONS[one.encoding]
    (_, first), *parts = split_texts(one)
    _define(one.type_name, first, ros_version, types)
    for name, text in parts:
        if not types.exists(canonical_name(name)):
            _define(name, text, ros_version, types)
    if _known_sum(one, types) in ("known", one.md5sum):
        return
    for name, text in parts:
        _define(name, text, ros_version, types)


def _define(name: str, text: str, ros_version: RosVersion, types: TypeStore) -> None:
    package, part, bare = split_name(name)
    if not package.isidentifier() or not bare.isidentifier() or part != "msg":
        raise BagError(f"the bag names a type '{name}', which is no name of a message")
    types.add_text(name, ros_version, text)
