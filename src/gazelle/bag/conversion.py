"""Bags into bags: other formats, other compression, fewer messages."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from gazelle.bag.rosbag2.metadata import offered_qos
from gazelle.bag.storage import BagMessage, BagReader, BagWriter, Connection, Encoding
from gazelle.bag.types import (
    bag_types,
    cdr_connection,
    converter,
    ros1_connection,
    ros1_name_of,
    wire_name_of,
)
from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.errors import GazelleError
from gazelle.interfaces import TypeStore

__all__ = ["Copied", "connection_for", "copy_bag"]

_Convert = Callable[[bytes], bytes]


class Copied(NamedTuple):
    """How many messages were written, and how many were not."""

    written: int
    left_out: int


def copy_bag(
    source: BagReader,
    target: BagWriter,
    *,
    diagnostics: Diagnostics,
    wanted: Callable[[BagMessage], bool] | None = None,
    progress: Callable[[BagMessage], None] | None = None,
) -> Copied:
    """Write the messages of one bag into another; the target is not closed.

    Args:
        source: where they come from.
        target: where they go; its encoding decides whether they are converted.
        diagnostics: told of topics that cannot be converted.
        wanted: which messages go; all by default.
        progress: called with every message of the source.
    """
    routes: dict[int, tuple[Connection, _Convert] | None] = {}
    types = None
    if any(one.encoding is not target.encoding for one in source.connections):
        types = bag_types(source.connections).store
    written = left_out = 0
    for message in source.messages():
        if progress is not None:
            progress(message)
        one = message.connection
        if wanted is not None and not wanted(message):
            left_out += 1
            continue
        if one.id not in routes:
            routes[one.id] = _route(source.path, one, target, types, diagnostics)
        route = routes[one.id]
        if route is None:
            left_out += 1
            continue
        target.write(route[0], message.stamp_ns, route[1](message.data))
        written += 1
    return Copied(written, left_out)


def connection_for(
    one: Connection, encoding: Encoding, types: TypeStore | None = None
) -> Connection:
    """Return a connection as a bag of an encoding has it.

    Args:
        one: the connection.
        encoding: of the bag.
        types: knows the type; the process's own by default.

    Raises:
        NotFoundError: nothing defines the type.
    """
    if one.encoding is encoding:
        return one
    if encoding is Encoding.ROS1:
        latching = one.latching or "durability: 1" in one.qos or "transient_local" in one.qos
        name = ros1_name_of(one)
        return ros1_connection(
            one.topic, name, callerid=one.callerid, latching=latching, types=types
        )
    qos = offered_qos(latched=one.latching)
    made = cdr_connection(one.topic, wire_name_of(one), qos=qos, types=types)
    return replace(made, callerid=one.callerid)


def _route(
    source: Path,
    one: Connection,
    target: BagWriter,
    types: TypeStore | None,
    diagnostics: Diagnostics,
) -> tuple[Connection, _Convert] | None:
    try:
        convert = converter(one, target.encoding, types)
        return target.add(connection_for(one, target.encoding, types)), convert
    except GazelleError as error:
        text = f"topic {one.topic} ({one.type_name}) is left out: {error}"
        diagnostics.report("bag.not-converted", text, SourceSpan(str(source)))
        return None
