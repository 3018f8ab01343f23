"""Log lines on the console, in the format and colours of ROS 1's rosconsole."""

from __future__ import annotations

import enum
import os
import re
import sys
import threading
import time
from collections.abc import Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, TextIO

from gazelle.errors import GraphError
from gazelle.log_files import GAPS
from gazelle.user_folders import ros_log_folder

if TYPE_CHECKING:
    from gazelle.graph.node import Node

__all__ = [
    "Level",
    "LogRecord",
    "aside_path",
    "format_record",
    "level_of",
    "offer_loggers",
    "print_record",
    "write_aside",
]


_DEFAULT_FORMAT = "[${severity}] [${time}]: ${message}"

_FIELD = re.compile(r"\$\{([^}:]+)(?::([^}]*))?\}")

_RESET = "\033[0m"


class Level(enum.IntEnum):
    """Severities with the numbers of ``rosgraph_msgs/Log``."""

    DEBUG = 1
    INFO = 2
    WARN = 4
    ERROR = 8
    FATAL = 16


_COLOURS = {
    Level.DEBUG: "\033[32m",
    Level.INFO: "",
    Level.WARN: "\033[33m",
    Level.ERROR: "\033[31m",
    Level.FATAL: "\033[31m",
}

_WORDS = {"warning": Level.WARN, "critical": Level.FATAL}


@dataclass(frozen=True, slots=True)
class LogRecord:
    """One thing a node said.

    Attributes:
        level: how bad it is.
        text: the message.
        node: global name of the node.
        wall_ns: wall time, nanoseconds since 1970.
        sim_ns: simulated time in nanoseconds, None when the node uses wall time.
        logger: the logger's name, empty for the node's own.
        file: source file.
        function: function in it.
        line: line in it.
    """

    level: Level
    text: str
    node: str
    wall_ns: int
    sim_ns: int | None = None
    logger: str = ""
    file: str = ""
    function: str = ""
    line: int = 0


def level_of(level: Level | int | str) -> Level:
    """Return the level of a word (``warn``, ``warning``) or of a number."""
    if isinstance(level, str):
        word = level.lower()
        return _WORDS.get(word) or Level[word.upper()]
    return Level(level)


def format_record(
    record: LogRecord, *, padded: bool = True, environ: Mapping[str, str] | None = None
) -> str:
    """Return the line, by ``ROSCONSOLE_FORMAT`` where it is set.

    Args:
        record: what to write.
        padded: write ``[ INFO]`` as roscpp does, not ``[INFO]`` as rospy does.
        environ: the environment, that of the process by default.
    """
    pattern = (os.environ if environ is None else environ).get("ROSCONSOLE_FORMAT", "")
    digits = 9 if padded else 6
    stamp = _seconds(record.wall_ns, digits)
    if record.sim_ns is not None:
        stamp += f", {_seconds(record.sim_ns, digits)}"
    values = {
        "severity": record.level.name.rjust(5) if padded else record.level.name,
        "message": record.text,
        "node": record.node,
        "logger": record.logger or record.node.strip("/"),
        "file": record.file,
        "line": str(record.line),
        "function": record.function,
        "thread": threading.current_thread().name,
    }

    def fill(match: re.Match[str]) -> str:
        name, style = match[1], match[2]
        if name in ("time", "walltime"):
            if style:
                return time.strftime(style, time.localtime(record.wall_ns / 1e9))
            return stamp if name == "time" else _seconds(record.wall_ns, digits)
        return values.get(name, match[0])

    return _FIELD.sub(fill, pattern or _DEFAULT_FORMAT)


def print_record(record: LogRecord, *, padded: bool = True) -> None:
    """Write the line: warnings and worse to stderr, the rest to stdout; coloured on a terminal."""
    stream = sys.stderr if record.level >= Level.WARN else sys.stdout
    line = format_record(record, padded=padded)
    colour = _COLOURS[record.level]
    if colour and stream is not None and stream.isatty():
        line = f"{colour}{line}{_RESET}"
    # One that is closed is nobody's any more: a thread may outlive what the main one had for it.
    with suppress(ValueError):
        if stream is not None:
            _write(stream, f"{line}\n")


def _write(stream: TextIO, text: str) -> None:
    try:
        stream.write(text)
        stream.flush()
    except BrokenPipeError:
        raise
    except OSError as error:
        # It goes to a file on a full disk, which is no reason to end.
        GAPS.tell("standard output" if stream is sys.stdout else "standard error", error)


def _seconds(stamp_ns: int, digits: int) -> str:
    text = f"{stamp_ns // 1_000_000_000}.{stamp_ns % 1_000_000_000:09d}"
    return text[: len(text) - 9 + digits]


def offer_loggers(node: Node, logger: str = "ros") -> None:
    """Let others read and change how much a node says.

    A node of ours has one level for all of its loggers, so any name sets it.

    Args:
        node: the node.
        logger: name of its logger: ``ros`` as roscpp's, ``rosout`` as rospy's.
    """
    from gazelle.interfaces import ros1_message_type, ros1_service_type

    entry: Any = ros1_message_type("roscpp/Logger")
    get: Any = ros1_service_type("roscpp/GetLoggers")
    put: Any = ros1_service_type("roscpp/SetLoggerLevel")

    def loggers(_request: Any) -> Any:
        level = Level(node.log_level).name.lower()
        return get._response_class([entry(name=logger, level=level)])

    def set_level(request: Any) -> Any:
        try:
            node.log_level = level_of(request.level)
        except KeyError:
            levels = ", ".join(level.name.lower() for level in Level)
            raise GraphError(f"'{request.level}' is no level; there are {levels}") from None
        return put._response_class()

    with node.announced_together():
        node.create_service("~get_loggers", get, loggers)
        node.create_service("~set_logger_level", put, set_level)


class _Logging(Protocol):
    name: str
    log_path: str


def aside_path(node: _Logging) -> Path:
    """Return a node's log file: the launch's, else ``NAME-PID.log`` where ROS keeps its logs."""
    if node.log_path:
        return Path(node.log_path)
    return (
        ros_log_folder(os.environ) / f"{node.name.strip('/').replace('/', '-')}-{os.getpid()}.log"
    )


def write_aside(node: _Logging, lines: Iterable[str]) -> str:
    """Add lines to the node's log file.

    Returns:
        the file, empty when it cannot be written.
    """
    path = aside_path(node)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("a", encoding="utf-8", errors="replace") as stream:
            stream.writelines(f"{line}\n" for line in lines)
    except OSError:
        return ""
    return str(path)
