"""Types as bags carry them: definitions in, definitions out, and the bytes of the other ROS."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from gazelle.bag.qos import offered_qos
from gazelle.bag.records import BagError, Connection, Encoding
from gazelle.errors import GazelleError
from gazelle.interfaces import (
    Generation,
    add_package,
    definition,
    exists,
    from_cdr,
    from_ros1,
    keep_text,
    md5sum,
    message_type,
    ros1_definition,
    ros1_message_type,
    ros1_type_of,
    ros2_definition,
    split_name,
    to_cdr,
    to_ros1,
    type_hash,
    wire_type,
)

__all__ = [
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
    topic: str, type_name: str, *, callerid: str = "", latching: bool = False
) -> Connection:
    """Return a connection for a ROS 1 bag.

    Args:
        topic: global name.
        type_name: ``pkg/Name``.
        callerid: global name of the node that publishes.
        latching: late subscriptions get the last message.

    Raises:
        NotFoundError: nothing defines the type.
    """
    text, digest = ros1_definition(type_name), md5sum(type_name)
    return Connection(0, topic, type_name, Encoding.ROS1, text, digest, callerid, latching)


def cdr_connection(topic: str, type_name: str, *, qos: str = "") -> Connection:
    """Return a connection for a bag of rosbag2; without definition where it is not known.

    Args:
        topic: global name.
        type_name: ``pkg/msg/Name``.
        qos: ``offered_qos_profiles``, YAML; reliable and volatile by default.
    """
    try:
        text, digest = ros2_definition(type_name), type_hash(type_name)
    except GazelleError:
        text, digest = "", ""
    qos = qos or offered_qos()
    return Connection(0, topic, type_name, Encoding.CDR, text, qos=qos, type_hash=digest)


def message_class(connection: Connection) -> Any:
    """Return the class in which messages of a connection are read, in its generation's form.

    Raises:
        NotFoundError: nothing defines the type, not even the bag (see `learn_definitions`).
    """
    if connection.encoding is Encoding.ROS1:
        return ros1_message_type(connection.type_name)
    return message_type(connection.type_name)


def converter(connection: Connection, encoding: Encoding) -> Callable[[bytes], bytes]:
    """Return the function that turns a connection's bytes into those of an encoding.

    Raises:
        NotFoundError: the bytes must be read for that, and nothing defines the type.
    """
    if connection.encoding is encoding:
        return bytes
    # ROS 1's view of a type reads and writes both encodings.
    view = ros1_message_type(ros1_name_of(connection))
    if encoding is Encoding.CDR:
        return lambda data: to_cdr(from_ros1(view, data))
    return lambda data: to_ros1(from_cdr(view, data))


def learn_definitions(connections: Iterable[Connection]) -> tuple[str, ...]:
    """Let a bag define its types where nothing else does, or where it does it differently.

    From then on this process reads those types as the bag has them, and writes their texts so.

    Returns:
        Names of the types that are known here with another definition.
    """
    differing = []
    for one in {(item.type_name, item.md5sum): item for item in connections}.values():
        known = _known_sum(one)
        if not one.definition:
            continue
        if known != one.md5sum and not (known and not one.md5sum):
            if known:
                differing.append(one.type_name)
            _teach(one)
        keep_text(one.type_name, _GENERATIONS[one.encoding], one.definition)
    return tuple(differing)


_GENERATIONS = {Encoding.ROS1: Generation.ROS1, Encoding.CDR: Generation.ROS2}


def split_texts(one: Connection) -> list[tuple[str, str]]:
    """Return the names and texts of the type and of all that it contains, as the bag has them."""
    first, *rest = _PART.split(one.definition)
    return [(one.type_name, first), *zip(rest[::2], rest[1::2], strict=True)]


def _known_sum(one: Connection) -> str:
    try:
        if one.encoding is Encoding.ROS1:
            return md5sum(one.type_name)
        definition(one.type_name, Generation.ROS2)
    except GazelleError:
        return ""
    return "known"


def _teach(one: Connection) -> None:
    """Define a type; what it contains only where that is not known, or differs too."""
    generation = _GENERATIONS[one.encoding]
    (_, first), *parts = split_texts(one)
    _define(one.type_name, first, generation)
    for name, text in parts:
        if not exists("/".join(split_name(name))):
            _define(name, text, generation)
    if _known_sum(one) in ("known", one.md5sum):
        return
    for name, text in parts:
        _define(name, text, generation)


def _define(name: str, text: str, generation: Generation) -> None:
    package, part, bare = split_name(name)
    if not package.isidentifier() or not bare.isidentifier() or part != "msg":
        raise BagError(f"the bag names a type '{name}', which is no name of a message")
    folder = _learned() / package
    (folder / "msg").mkdir(parents=True, exist_ok=True)
    (folder / "msg" / f"{bare}.msg").write_text(text, encoding="utf-8")
    add_package(package, folder, generation)


_folders: list[tempfile.TemporaryDirectory[str]] = []


def _learned() -> Path:
    if not _folders:
        _folders.append(tempfile.TemporaryDirectory(prefix="gazelle_bag_types_"))
    return Path(_folders[0].name)
