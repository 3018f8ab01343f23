"""Where a node's log goes: its file, and the terminal in the layout of its ROS."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from gazelle.graph import Level, LogRecord
from gazelle.graph.console import format_record, print_record
from gazelle.log_files import LogStream

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["LogFile", "keep_log", "print_ros2"]


_COLOURS = {Level.DEBUG: "32", Level.WARN: "33", Level.ERROR: "31", Level.FATAL: "31"}


class LogFile:
    """Writes every record to a file, and to the terminal those of a level.

    Args:
        path: the file; its folder is made.
        terminal: least level that is printed too.
        show: prints a record.
    """

    def __init__(
        self,
        path: Path,
        *,
        terminal: Level = Level.DEBUG,
        show: Callable[..., None] = print_record,
    ) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        self._stream = LogStream(path)
        self._terminal = terminal
        self._show = show

    def __call__(self, record: LogRecord, *, padded: bool = True) -> None:
        """Write one record."""
        self._stream.write(f"{format_record(record, padded=padded)}\n")
        if record.level >= self._terminal:
            self._show(record, padded=padded)

    def close(self) -> None:
        """Write nothing more to the file."""
        self._stream.close()


def print_ros2(record: LogRecord, *, padded: bool = True) -> None:
    """Write ``[INFO] [stamp] [logger]: text`` on standard error, coloured on a terminal."""
    seconds, nanoseconds = divmod(record.wall_ns, 1_000_000_000)
    logger = record.logger or record.node.strip("/").replace("/", ".")
    line = f"[{record.level.name}] [{seconds}.{nanoseconds:09d}] [{logger}]: {record.text}"
    if sys.stderr.isatty() and record.level in _COLOURS:
        line = f"\033[{_COLOURS[record.level]}m{line}\033[0m"
    sys.stderr.write(f"{line}\n")
    sys.stderr.flush()


def keep_log(node: Node, path: str, output: str = "screen") -> None:
    """Send a node's log to a file; with output ``log`` the terminal gets warnings and worse."""
    if not path:
        return
    least = Level.WARN if output == "log" else Level.DEBUG
    log = LogFile(Path(path), terminal=least, show=node.console)
    node.console, node.log_path = log, path
    node.on_shutdown(lambda _reason: log.close())
