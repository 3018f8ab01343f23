"""What a node says on the terminal, in the layout of ROS 2 (rcutils' default)."""

from __future__ import annotations

import sys

from gazelle.graph import Level, LogRecord

__all__ = ["print_ros2"]

_COLOURS = {Level.DEBUG: "32", Level.WARN: "33", Level.ERROR: "31", Level.FATAL: "31"}


def print_ros2(record: LogRecord, *, padded: bool = True) -> None:
    """Write ``[INFO] [stamp] [logger]: text`` on standard error, coloured on a terminal."""
    seconds, nanoseconds = divmod(record.wall_ns, 1_000_000_000)
    logger = record.logger or record.node.strip("/").replace("/", ".")
    line = f"[{record.level.name}] [{seconds}.{nanoseconds:09d}] [{logger}]: {record.text}"
    if sys.stderr.isatty() and record.level in _COLOURS:
        line = f"\033[{_COLOURS[record.level]}m{line}\033[0m"
    sys.stderr.write(f"{line}\n")
    sys.stderr.flush()
