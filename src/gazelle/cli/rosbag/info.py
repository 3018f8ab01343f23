"""``rosbag info``: what is in bags, as text in columns or as YAML."""

from __future__ import annotations

import re
import sys
import time
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from statistics import median

from gazelle.bag import BagError, BagReader, Summary, open_bag, ros1_name_of
from gazelle.bag.open_bag import warn_of_unindexed
from gazelle.cli.ros_tool import add_flag, option_parser
from gazelle.interfaces import md5sum

__all__ = [
    "human_size",
    "run",
]


@dataclass(frozen=True, slots=True)
class _TopicReport:
    """One topic: its type, messages, publishers, and the median rate where it was asked for."""

    name: str
    type_name: str
    messages: int
    connections: int
    rate_hz: float | None


@dataclass(frozen=True, slots=True)
class _BagReport:
    """What is told of a bag.

    Attributes:
        path: as it was given.
        version: of ROS 1's format, the storage's name for others.
        summary: what is in it.
        types: name and MD5 sum, sorted.
        topics: by name.
    """

    path: str
    version: str
    summary: Summary
    types: tuple[tuple[str, str], ...]
    topics: tuple[_TopicReport, ...]


def _report_of(bag: BagReader, path: str, *, rates: bool = False) -> _BagReport:
    """Gather what is told of a bag; for `rates` all stamps are read."""
    summary = bag.summary
    found = _rates(bag) if rates else {}
    topics: dict[str, _TopicReport] = {}
    types: dict[str, str] = {}
    for one in bag.connections:
        name = ros1_name_of(one)
        types.setdefault(name, one.md5sum or _known_sum(name))
        before = topics.get(one.topic)
        topics[one.topic] = _TopicReport(
            one.topic,
            before.type_name if before else name,
            (before.messages if before else 0) + summary.counts.get(one.id, 0),
            (before.connections if before else 0) + 1,
            found.get(one.topic),
        )
    version = getattr(bag, "version", str(bag.storage))
    ordered = tuple(topics[name] for name in sorted(topics))
    return _BagReport(path, version, summary, tuple(sorted(types.items())), ordered)


def _report_text(report: _BagReport) -> str:
    """Return the columns that ``rosbag info`` prints."""
    rows = [("path", report.path), ("version", report.version)]
    if report.topics:
        rows += [*_times(report.summary), *_contents(report.summary)]
        rows += _named("types", _type_cells(report))
        rows += _named("topics", _topic_cells(report))
    else:
        rows.append(("size", human_size(report.summary.size)))
    width = max(len(name) for name, _ in rows) + 1
    lines = (f"{f'{name}:' if name else '':<{width}} {value}" for name, value in rows)
    return "\n".join(lines).rstrip()


def _report_yaml(report: _BagReport) -> str:
    """Return the YAML that ``rosbag info -y`` prints."""
    lines = [f"{name}: {value}" for name, value in _yaml_values(report).items()]
    if not report.topics:
        return "\n".join(lines)
    lines.append("types:")
    for name, digest in report.types:
        lines += [f"    - type: {name}", f"      md5: {digest}"]
    lines.append("topics:")
    for topic in report.topics:
        lines += [f"    - topic: {topic.name}", f"      type: {topic.type_name}"]
        lines.append(f"      messages: {topic.messages}")
        if topic.connections > 1:
            lines.append(f"      connections: {topic.connections}")
        if topic.rate_hz is not None:
            lines.append(f"      frequency: {topic.rate_hz:.4f}")
    return "\n".join(lines) + "\n"


def _yaml_value(report: _BagReport, key: str) -> str | None:
    """Return the text of one key of the YAML, None when there is no such key."""
    if key in ("types", "topics"):
        text = _report_yaml(report)
        start = text.index(f"\n{key}:\n") + len(key) + 3
        end = text.index("\ntopics:\n") if key == "types" else len(text)
        return re.sub(r"(?m)^    ", "", text[start:end])
    return _yaml_values(report).get(key)


def human_size(size: float) -> str:
    """Return a number of bytes as rosbag writes it: in KB of 1024, with one decimal."""
    for unit in ("KB", "MB", "GB", "TB", "PB"):
        size /= 1024
        if size < 1024 or unit == "PB":
            break
    return f"{size:.1f} {unit}"


def run(argv: list[str]) -> int:
    """Print what is in bags, as text or YAML."""
    parser = option_parser("rosbag", "info [options] BAGFILE1 [BAGFILE2 BAGFILE3 ...]")
    add_flag(parser, "-y", "--yaml", dest="yaml", text="print information in YAML format")
    parser.add_option("-k", "--key", metavar="KEY", help="print information on the given key")
    add_flag(parser, "--freq", dest="freq", text="display topic message frequency statistics")
    options, args = parser.parse_args(argv)
    if not args:
        parser.error("You must specify at least 1 bag file.")
    if options.key and not options.yaml:
        parser.error("You can only specify key when printing in YAML format.")
    is_readable = True
    for index, path in enumerate(args):
        try:
            is_readable &= _show(path, options.key, yaml=options.yaml, rates=options.freq)
        except BagError as error:
            print(f"ERROR reading {path}: {error}", file=sys.stderr)
            return 1
        if index < len(args) - 1:
            print("---")
    return 0 if is_readable else 1


def _times(summary: Summary) -> list[tuple[str, str]]:
    seconds = _seconds(summary.end_ns) - _seconds(summary.start_ns)
    minutes, hours = int(seconds / 60), int(seconds / 3600)
    if hours:
        text = f"{hours}hr {minutes % 60}:{int(seconds % 60):02d}s ({int(seconds)}s)"
    elif minutes:
        text = f"{minutes}:{int(seconds % 60):02d}s ({int(seconds)}s)"
    else:
        text = f"{seconds:.1f}s"
    return [
        ("duration", text),
        ("start", _date(summary.start_ns)),
        ("end", _date(summary.end_ns)),
    ]


def _date(stamp_ns: int) -> str:
    seconds = stamp_ns / 1e9
    date = time.strftime("%b %d %Y %H:%M:%S", time.localtime(seconds))
    return f"{date}{f'{seconds - int(seconds):.2f}'[1:]} ({seconds:.2f})"


def _contents(summary: Summary) -> list[tuple[str, str]]:
    rows = [("size", human_size(summary.size)), ("messages", str(summary.messages))]
    total = sum(pack.pieces for pack in summary.packs.values())
    texts = []
    for name, pack in sorted(
        summary.packs.items(), key=lambda item: (item[1].pieces, item[0]), reverse=True
    ):
        share = f"; {100 * pack.compressed / pack.uncompressed:.2f}%" if _packed(name) else ""
        texts.append(f"{name or 'none'} [{pack.pieces}/{total} chunks{share}]")
    rows.append(("compression", ", ".join(texts) or "none"))
    if any(map(_packed, summary.packs)):
        rows += _compressed(summary)
    return rows


def _compressed(summary: Summary) -> list[tuple[str, str]]:
    sizes = [sum(pack[index] for pack in summary.packs.values()) for index in (1, 2)]
    texts = [human_size(size) for size in sizes]
    width = max(map(len, texts))
    seconds = summary.duration_ns / 1e9
    cells = [word.rjust(width) for word in texts]
    if seconds > 0:
        rates = [human_size(size / seconds) for size in sizes]
        rate_width = max(map(len, rates))
        pairs = zip(cells, rates, strict=True)
        cells = [f"{cell} @ {rate.rjust(rate_width)}/s" for cell, rate in pairs]
        cells[1] += f" ({100 * sizes[1] / sizes[0]:.2f}%)"
    return [("uncompressed", cells[0]), ("compressed", cells[1])]


def _type_cells(report: _BagReport) -> list[str]:
    width = max(len(name) for name, _ in report.types)
    return [f"{name:<{width}} [{digest}]" for name, digest in report.types]


def _topic_cells(report: _BagReport) -> list[str]:
    topics = report.topics
    name_width = max(len(one.name) for one in topics)
    type_width = max(len(name) for name, _ in report.types)
    count_width = max(len(str(one.messages)) for one in topics)
    rates = {one.name: _frequency(one.rate_hz) for one in topics if one.rate_hz is not None}
    rate_width = max(map(len, rates.values()), default=0)
    cells = []
    for one in topics:
        word = "msgs" if one.messages > 1 else "msg "
        cell = f"{one.name:<{name_width}}   {one.messages:>{count_width}} {word}"
        sign = " @ " if one.name in rates else "   "
        cell += f"{sign}{rates.get(one.name, ''):>{rate_width}} : {one.type_name:<{type_width}}"
        cells.append(cell + (f" ({one.connections} connections)" if one.connections > 1 else ""))
    return cells


def _named(name: str, cells: Iterable[str]) -> list[tuple[str, str]]:
    return [(name if index == 0 else "", cell) for index, cell in enumerate(cells)]


def _yaml_values(report: _BagReport) -> dict[str, str]:
    summary = report.summary
    values = {"path": report.path, "version": report.version}
    if not report.topics:
        return values | {"size": str(summary.size), "indexed": str(summary.is_indexed)}
    main = max(summary.packs, key=lambda name: summary.packs[name].pieces, default="none")
    values |= {
        "duration": f"{_seconds(summary.end_ns) - _seconds(summary.start_ns):.6f}",
        "start": f"{summary.start_ns / 1e9:.6f}",
        "end": f"{summary.end_ns / 1e9:.6f}",
        "size": str(summary.size),
        "messages": str(summary.messages),
        "indexed": str(summary.is_indexed),
        "compression": main or "none",
    }
    if any(map(_packed, summary.packs)):
        values["uncompressed"] = str(sum(one.uncompressed for one in summary.packs.values()))
        values["compressed"] = str(sum(one.compressed for one in summary.packs.values()))
    return values


def _packed(name: str) -> bool:
    return name not in ("", "none", "loose")


def _rates(bag: BagReader) -> Mapping[str, float]:
    stamps: dict[str, list[int]] = {}
    for message in bag.messages():
        stamps.setdefault(message.connection.topic, []).append(message.stamp_ns)
    rates = {}
    for topic, own in stamps.items():
        gaps = [after - before for before, after in pairwise(own)]
        if gaps and median(gaps) > 0:
            rates[topic] = 1e9 / median(gaps)
    return rates


def _seconds(stamp_ns: int) -> float:
    """Add as rospy's `to_sec` does, to round alike."""
    return float(stamp_ns // 1_000_000_000) + float(stamp_ns % 1_000_000_000) / 1e9


def _frequency(rate_hz: float) -> str:
    for unit in ("Hz", "kHz", "MHz", "GHz"):
        if rate_hz < 1000 or unit == "GHz":
            break
        rate_hz /= 1000
    return f"{rate_hz:.1f} {unit}"


def _known_sum(name: str) -> str:
    from gazelle.errors import GazelleError

    try:
        return md5sum(name)
    except GazelleError:
        return "unknown"


def _show(path: str, key: str | None, *, yaml: bool, rates: bool) -> bool:
    """Print what is in a bag; False when it was cut off and nothing of it can be read."""
    bag = open_bag(path)
    report = _report_of(bag, path, rates=rates)
    if not yaml:
        print(_report_text(report))
    elif key:
        value = _yaml_value(report, key)
        print(f'Error getting key "{key}"' if value is None else value)
    else:
        print(_report_yaml(report))
    sys.stdout.flush()
    warn_of_unindexed(bag)
    bag.close()
    return bag.summary.is_indexed or bag.summary.messages > 0
