"""``ros2 bag info``."""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

from gazelle.bag import BagReader, Summary, open_bag, wire_name_of
from gazelle.bag.open_bag import warn_of_unindexed

__all__ = ["main"]


def main(argv: list[str]) -> int:
    """Print what is in a bag."""
    about = "Print information about a bag to the screen"
    parser = argparse.ArgumentParser(prog="ros2 bag info", description=about)
    parser.add_argument("bag_path", help="Bag to open")
    parser.add_argument("-s", "--storage", help="accepted: the file itself tells its format")
    parser.add_argument("-t", "--topic-name", action="store_true", help="Only display topic names")
    options = parser.parse_args(argv)
    bag = open_bag(options.bag_path)
    if options.topic_name:
        print("\n".join(one.topic for one in bag.connections))
        return 0
    print(_text(bag))
    sys.stdout.flush()
    warn_of_unindexed(bag)
    return 0


def _text(bag: BagReader) -> str:
    summary = bag.summary
    files = getattr(bag, "files", (bag.path,))
    rows = [("Files", "\n".join(_shown(bag.path, file) for file in files))]
    rows += [("Bag size", _size(summary.size)), ("Storage id", str(bag.storage))]
    if distribution := getattr(bag, "ros_distro", ""):
        rows.append(("ROS Distro", distribution))
    rows += [
        ("Duration", f"{_decimal(summary.duration_ns)}s"),
        ("Start", _date(summary.start_ns)),
        ("End", _date(summary.end_ns)),
        ("Messages", str(summary.messages)),
        ("Topic information", "\n".join(_topics(bag, summary))),
    ]
    margin = " " * 19
    return "\n" + "\n".join(
        f"{name + ':':<19}{text.replace(chr(10), chr(10) + margin)}" for name, text in rows
    )


def _topics(bag: BagReader, summary: Summary) -> list[str]:
    counts: dict[tuple[str, str, str], int] = {}
    for one in bag.connections:
        key = (one.topic, wire_name_of(one), str(one.encoding))
        counts[key] = counts.get(key, 0) + summary.counts.get(one.id, 0)
    return [
        f"Topic: {topic} | Type: {kind} | Count: {count} | Serialization Format: {encoding}"
        for (topic, kind, encoding), count in counts.items()
    ]


def _shown(bag: Path, file: Path) -> str:
    return file.name if bag.is_dir() else str(file)


def _size(size: float) -> str:
    if size < 1024:
        return f"{size:.0f} B"
    for unit in ("KiB", "MiB", "GiB", "TiB"):
        size /= 1024
        if size < 1024 or unit == "TiB":
            break
    return f"{size:.1f} {unit}"


def _date(stamp_ns: int) -> str:
    seconds, rest = divmod(stamp_ns, 1_000_000_000)
    date = time.strftime("%b %e %Y %H:%M:%S", time.localtime(seconds))
    return f"{date}.{rest:09d} ({_decimal(stamp_ns)})"


def _decimal(value_ns: int) -> str:
    seconds, rest = divmod(value_ns, 1_000_000_000)
    return f"{seconds}.{rest:09d}"
