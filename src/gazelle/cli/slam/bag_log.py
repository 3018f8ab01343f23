"""Scans of a bag, placed by its transforms and odometry."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from gazelle.bag import Connection, bag_types, converter, open_bag, wire_name_of
from gazelle.bag.storage import BagReader, Encoding
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean
from gazelle.graph.tf import TransformBuffer
from gazelle.interfaces import from_cdr
from gazelle.interfaces.poses import pose_of, pose_of_transform
from gazelle.interfaces.stamps import ns_of
from gazelle.mapping.logs import LogRecord
from gazelle.nodes.slam.scan_messages import ScanQueue

__all__ = ["read_bag_log"]

_SCAN = "sensor_msgs/msg/LaserScan"
_ODOMETRY = "nav_msgs/msg/Odometry"
_TF = "tf2_msgs/msg/TFMessage"
_OLD_TF = "tf/msg/tfMessage"
_BASES = ("base_footprint", "base_link", "base")
_PEEK = 3000
# The transforms behind the last scans of a recording often did not come any more.
_LAST_SCANS = 2


def read_bag_log(
    path: Path, diagnostics: Diagnostics, *, topic: str = "", odom: str = "odom", base: str = ""
) -> Iterator[LogRecord]:
    """Yield the scans of a bag with their odometry.

    Args:
        path: of the bag.
        diagnostics: told what is missing.
        topic: of the scans; the only one when empty.
        odom: odometry's frame.
        base: the robot's frame; the first of base_footprint, base_link and base that the bag
            knows when empty.

    Raises:
        BagError: the file is no bag.
    """
    bag = open_bag(path)
    scans = _scan_topic(bag, topic, path, diagnostics)
    if not scans:
        return
    buffer = TransformBuffer(cache_ns=1 << 62)
    odom, base = odom.removeprefix("/"), base.removeprefix("/") or _base_of(bag)
    problems: list[str] = []
    queue = ScanQueue(buffer, (odom, base), problems.append, size=200)
    readers = _Readers(bag)
    for message in bag.messages(lambda one: _is_wanted(one, scans)):
        record = readers.read(message.connection, message.data)
        if message.connection.topic == scans:
            placed = queue.add(record)
        else:
            _learn(buffer, message.connection, record, (odom, base))
            placed = queue.ready()
        yield from (LogRecord(*one) for one in placed)
    queue.give_up()
    if queue.dropped > _LAST_SCANS:
        diagnostics.report(
            "mapping.scan-without-pose",
            f"{queue.dropped} scans of {scans} are left out: {problems[0]}",
            SourceSpan(str(path)),
        )


class _Readers:
    """Functions that read messages, one per connection."""

    def __init__(self, bag: BagReader) -> None:
        self._types = bag_types(bag.connections).store
        self._known: dict[int, tuple[Any, Any]] = {}

    def read(self, connection: Connection, data: bytes) -> Any:
        if connection.id not in self._known:
            name = wire_name_of(connection).replace(_OLD_TF, _TF)
            self._known[connection.id] = (
                converter(connection, Encoding.CDR, self._types),
                self._types.message_type(name),
            )  # fmt: skip
        as_cdr, kind = self._known[connection.id]
        return from_cdr(kind, as_cdr(data))


def _is_wanted(one: Connection, scans: str) -> bool:
    return one.topic == scans or wire_name_of(one) in (_ODOMETRY, _TF, _OLD_TF)


def _scan_topic(bag: BagReader, topic: str, path: Path, diagnostics: Diagnostics) -> str:
    topics = sorted({one.topic for one in bag.connections if wire_name_of(one) == _SCAN})
    wanted = f"/{topic.removeprefix('/')}" if topic else ""
    if wanted in topics:
        return wanted
    if not wanted and len(topics) == 1:
        return topics[0]
    if not topics:
        text = f"no topic of the bag has {_SCAN}; it holds " + ", ".join(
            sorted({f"{one.topic} ({one.type_name})" for one in bag.connections})
        )
    elif wanted:
        text = f"the bag has no scans on {wanted}. {did_you_mean(wanted, topics)}".rstrip()
    else:
        text = f"the bag has scans on {', '.join(topics)}"
    fix = f"name the topic: --scan {topics[0]}" if topics else ""
    diagnostics.report("mapping.no-scans", text, SourceSpan(str(path)), fix=fix)
    return ""


def _base_of(bag: BagReader) -> str:
    """Return the robot's frame by the first transforms and odometry of the bag."""
    readers, seen = _Readers(bag), set[str]()
    kinds = (_ODOMETRY, _TF, _OLD_TF)
    for count, message in enumerate(bag.messages(lambda one: wire_name_of(one) in kinds)):
        record = readers.read(message.connection, message.data)
        for one in getattr(record, "transforms", [record]):
            seen |= {str(one.child_frame_id).removeprefix("/")}
        if count > _PEEK:
            break
    return next((name for name in _BASES if name in seen), _BASES[1])


def _learn(
    buffer: TransformBuffer, connection: Connection, record: Any, frames: tuple[str, str]
) -> None:
    """Put transforms into the buffer; odometry too, where no transform says it."""
    if wire_name_of(connection) != _ODOMETRY:
        static = connection.topic.endswith("tf_static")
        for one in record.transforms:
            buffer.set_transform(
                one.header.frame_id, one.child_frame_id, ns_of(one.header.stamp),
                pose_of_transform(one.transform), authority="tf", is_static=static,
            )  # fmt: skip
        return
    known = {frame.name: frame for frame in buffer.frames()}
    child = str(record.child_frame_id).removeprefix("/") or frames[1]
    if child in known and known[child].authority == "tf":
        return
    parent, stamp_ns = record.header.frame_id or frames[0], ns_of(record.header.stamp)
    buffer.set_transform(parent, child, stamp_ns, pose_of(record.pose.pose), authority="odometry")
