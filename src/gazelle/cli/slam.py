"""``gazelle slam FILE``: a map and a trajectory of a log.

Scans of a bag are placed by its transforms and odometry.
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.progress import Progress

from gazelle.bag import BagError, Connection, bag_types, converter, open_bag, wire_name_of
from gazelle.bag.storage import BagReader, Encoding
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean, render
from gazelle.graph.tf import TransformBuffer
from gazelle.interfaces import from_cdr
from gazelle.interfaces.poses import pose_of, pose_of_transform
from gazelle.interfaces.stamps import ns_of
from gazelle.mapping.grids import write_map
from gazelle.mapping.logs import (
    LogRecord,
    duration_s,
    read_log,
    stamp_problem,
    write_carmen,
    write_tum,
)
from gazelle.mapping.logs.log_formats import is_carmen
from gazelle.mapping.relative_pose_error import align, read_relations, relation_errors
from gazelle.mapping.slam import Slam, SlamResult
from gazelle.nodes.slam.scan_messages import ScanQueue

__all__ = [
    "main",
]

_SCAN = "sensor_msgs/msg/LaserScan"
_ODOMETRY = "nav_msgs/msg/Odometry"
_TF = "tf2_msgs/msg/TFMessage"
_OLD_TF = "tf/msg/tfMessage"
_BASES = ("base_footprint", "base_link", "base")
_PEEK = 3000
# The transforms behind the last scans of a recording often did not come any more.
_LAST_SCANS = 2


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


def main(argv: list[str]) -> int:
    """Map a log.

    Returns:
        0 when a map was written, 1 when the log holds nothing to map.
    """
    options = _parser().parse_args(argv)
    console = Console(stderr=True)
    diagnostics = Diagnostics()
    try:
        records = list(_records(options, diagnostics))
    except (BagError, OSError) as error:
        message = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        span = SourceSpan(options.file)
        fix = "look whether the file is there, whole and yours to read; copy it again"
        text = f"it cannot be read: {message}"
        diagnostics.report("mapping.log-unreadable", text, span, fix=fix)
        records = []
    if not records and not diagnostics.errors:
        diagnostics.report(
            "mapping.no-scans", "no scan could be placed by odometry", SourceSpan(options.file)
        )
    if diagnostics.errors:
        render(diagnostics)
        return 1
    if problem := stamp_problem([record.scan.stamp_ns for record in records]):
        diagnostics.report("mapping.stamps", problem, SourceSpan(options.file))
    engine, took_s = _mapped(records, console)
    result = engine.result(options.resolution)
    _write(options, records, result)
    _tell(records, result, took_s)
    if options.relations:
        _judge(Path(options.relations), result, diagnostics)
    render(diagnostics)
    return 0


def _read_bag_log(
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


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="gazelle slam",
        description="Make a map and a trajectory of a log: a bag, a CARMEN log, a numpy archive.",
    )
    parser.add_argument("file", help="the log")
    parser.add_argument("-o", "--output", default="map", help="stem of what is written (map)")
    parser.add_argument("--resolution", type=_positive, default=0.05, help="side of a cell, m")
    parser.add_argument("--relations", default="", help="known relations, to measure the error")
    parser.add_argument("--scan", default="", help="topic of the scans of a bag")
    parser.add_argument("--odom-frame", default="odom", help="odometry's frame in a bag (odom)")
    parser.add_argument("--base-frame", default="", help="the robot's frame in a bag")
    parser.add_argument(
        "--carmen", action="store_true", help="write the log anew with the mapped poses, too"
    )
    return parser


def _positive(word: str) -> float:
    value = float(word)
    if not 0 < value < 10:
        raise argparse.ArgumentTypeError(f"{word} is no side of a cell, metres")
    return value


def _records(options: argparse.Namespace, diagnostics: Diagnostics) -> Iterator[LogRecord]:
    path = Path(options.file)
    if path.is_dir() or not (path.suffix == ".npz" or is_carmen(path)):
        return _read_bag_log(
            path, diagnostics,
            topic=options.scan, odom=options.odom_frame, base=options.base_frame,
        )  # fmt: skip
    return read_log(path, diagnostics)


def _mapped(records: list[LogRecord], console: Console) -> tuple[Slam, float]:
    engine, start_s = Slam(), time.perf_counter()
    with Progress(console=console, transient=True) as progress:
        task = progress.add_task("mapping", total=len(records))
        for record in records:
            engine.add(*record)
            progress.advance(task)
        progress.update(task, description="matching all scans once more")
        engine.finish()
    return engine, time.perf_counter() - start_s


def _write(options: argparse.Namespace, records: list[LogRecord], result: SlamResult) -> None:
    written = [str(path) for path in write_map(result.grid, options.output)]
    path = Path(f"{options.output}.tum")
    write_tum(path, result.stamps_ns, result.trajectory)
    written.append(str(path))
    if options.carmen:
        path = Path(f"{options.output}.log")
        write_carmen(path, records, result.trajectory)
        written.append(str(path))
    print(f"wrote {', '.join(written)}")


def _tell(records: list[LogRecord], result: SlamResult, took_s: float) -> None:
    stamps = result.stamps_ns
    lasted_s = duration_s(stamps.tolist())
    steps = np.diff(result.trajectory[:, :2], axis=0)
    way_m = float(np.hypot(steps[:, 0], steps[:, 1]).sum())
    speed = f", {lasted_s / took_s:.0f} times real time" if lasted_s > 0 else ""
    print(
        f"{len(records)} scans, {way_m:.0f} m driven, {result.loops} loop closures; map of "
        f"{result.grid.width} × {result.grid.height} cells of {result.grid.resolution_m:g} m; "
        f"{took_s:.1f} s, {1e3 * took_s / len(records):.1f} ms a scan{speed}"
    )


def _judge(path: Path, result: SlamResult, diagnostics: Diagnostics) -> None:
    """Print the errors against known relations."""
    try:
        relations = read_relations(path, diagnostics)
    except OSError as error:
        span = SourceSpan(str(path))
        text = f"relations cannot be read: {error.strerror}"
        diagnostics.report("mapping.log-unreadable", text, span)
        return
    first, second, relative = align(relations, result.stamps_ns / 1e9)
    if not len(first):
        print(f"none of {len(relations.first_s)} relations has the times of two scans of this log")
        return
    errors = relation_errors(result.trajectory, first, second, relative)
    left = len(relations.first_s) - len(first)
    print(f"{errors}" + (f" ({left} relations have no scans at their times)" if left else ""))
