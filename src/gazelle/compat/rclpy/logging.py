"""Loggers (rclpy.logging): ROS 2's layout on the console, ``/rosout``, and their levels.

Others get and set the levels by services, as rclpy.logging_service offers them.
"""

from __future__ import annotations

import enum
import sys
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.compat.warn_once import is_first_time
from gazelle.interfaces import message_type, service_type

if TYPE_CHECKING:
    from gazelle.compat.rclpy.node import Node

__all__ = [
    "LoggingSeverity",
    "RcutilsLogger",
    "get_logger",
    "get_logger_effective_level",
    "get_logger_level",
    "get_logging_severity_from_string",
    "offer_logger_levels",
    "set_default_level",
    "set_logger_level",
]


class LoggingSeverity(enum.IntEnum):
    """How serious a message is."""

    UNSET = 0
    DEBUG = 10
    INFO = 20
    WARN = 30
    ERROR = 40
    FATAL = 50


_levels: dict[str, LoggingSeverity] = {}
_default = [LoggingSeverity.INFO]
_nodes: dict[str, Any] = {}
_skipped: set[tuple[str, int]] = set()
_throttled: dict[tuple[str, int], int] = {}
_COLOURS = {LoggingSeverity.DEBUG: "32", LoggingSeverity.WARN: "33"}


class RcutilsLogger:
    """Says things under a name; made by `get_logger` or a node."""

    def __init__(self, name: str = "") -> None:
        self.name = name

    def get_child(self, name: str) -> RcutilsLogger:
        """Return the logger of a part."""
        return RcutilsLogger(f"{self.name}.{name}" if self.name else name)

    def set_level(self, level: LoggingSeverity | int) -> None:
        """Say nothing below a level."""
        set_logger_level(self.name, level)

    def get_effective_level(self) -> LoggingSeverity:
        """Return the level that counts."""
        return get_logger_effective_level(self.name)

    def is_enabled_for(self, severity: LoggingSeverity | int) -> bool:
        """Tell whether something of a level would be said."""
        return severity >= self.get_effective_level()

    def log(self, message: Any, severity: LoggingSeverity | int, **kwargs: Any) -> bool:
        """Say something; False when it was filtered.

        Args:
            message: what to say.
            severity: its level.
            kwargs: ``once``, ``skip_first``, ``throttle_duration_sec`` and
                ``throttle_time_source_type`` (a clock), as in rclpy.
        """
        level = LoggingSeverity(severity)
        frame = sys._getframe(1)
        while frame.f_code.co_filename == __file__ and frame.f_back is not None:
            frame = frame.f_back
        if not self.is_enabled_for(level):
            return False
        if kwargs and not _passes((frame.f_code.co_filename, frame.f_lineno), kwargs):
            return False
        _write(level, self.name, str(message))
        node = _nodes.get(self.name) or _nodes.get(self.name.partition(".")[0])
        if node is not None:
            node.log(level.name, str(message), console=False, depth=3)
        return True

    def debug(self, message: Any, **kwargs: Any) -> bool:
        """Say something at debug level."""
        return self.log(message, LoggingSeverity.DEBUG, **kwargs)

    def info(self, message: Any, **kwargs: Any) -> bool:
        """Say something at info level."""
        return self.log(message, LoggingSeverity.INFO, **kwargs)

    def warning(self, message: Any, **kwargs: Any) -> bool:
        """Say something at warn level."""
        return self.log(message, LoggingSeverity.WARN, **kwargs)

    warn = warning

    def error(self, message: Any, **kwargs: Any) -> bool:
        """Say something at error level."""
        return self.log(message, LoggingSeverity.ERROR, **kwargs)

    def fatal(self, message: Any, **kwargs: Any) -> bool:
        """Say something at fatal level."""
        return self.log(message, LoggingSeverity.FATAL, **kwargs)


def get_logger(name: str) -> RcutilsLogger:
    """Return the logger of a name."""
    if not name:
        raise ValueError("Logger name must not be empty.")
    return RcutilsLogger(name)


def set_logger_level(name: str, level: LoggingSeverity | int, detailed_error: bool = False) -> None:
    """Say nothing below a level under this name; UNSET takes that back.

    Args:
        name: of the logger.
        level: the least that is said.
        detailed_error: without effect: setting a level does not fail here.
    """
    _levels[name] = LoggingSeverity(level)


def set_default_level(level: LoggingSeverity | int) -> None:
    """Set the level of loggers that have none of their own."""
    _default[0] = LoggingSeverity(level)


def get_logger_effective_level(name: str) -> LoggingSeverity:
    """Return the level of a logger: its own, or that of the nearest above it."""
    while name:
        level = _levels.get(name, LoggingSeverity.UNSET)
        if level is not LoggingSeverity.UNSET:
            return level
        name = name.rpartition(".")[0]
    return _default[0]


def get_logger_level(name: str) -> LoggingSeverity:
    """Return a logger's own level, UNSET when it has none."""
    return _levels.get(name, LoggingSeverity.UNSET)


def get_logging_severity_from_string(log_severity: str) -> LoggingSeverity:
    """Return a level by its word."""
    return LoggingSeverity[log_severity.upper()]


def attach_node(name: str, node: Any) -> None:
    """Let what is said under a name go out on a node's ``/rosout`` too."""
    _nodes[name] = node


def detach_node(name: str) -> None:
    """Undo `attach_node`."""
    _nodes.pop(name, None)


def _passes(call_site: tuple[str, int], rules: dict[str, Any]) -> bool:
    if rules.get("skip_first") and call_site not in _skipped:
        _skipped.add(call_site)
        return False
    if rules.get("once") and not is_first_time(call_site):
        return False
    period_s = rules.get("throttle_duration_sec")
    if period_s is not None:
        clock = rules.get("throttle_time_source_type")
        now_ns: Callable[[], int] = getattr(clock, "now_ns", time.monotonic_ns)
        last_ns = _throttled.get(call_site)
        if last_ns is not None and now_ns() - last_ns < period_s * 1e9:
            return False
        _throttled[call_site] = now_ns()
    return True


def _write(level: LoggingSeverity, name: str, text: str) -> None:
    stamp = f"{time.time_ns() / 1e9:.9f}"
    line = f"[{level.name}] [{stamp}] [{name}]: {text}"
    if sys.stderr.isatty() and level is not LoggingSeverity.INFO:
        line = f"\033[{_COLOURS.get(level, '31')}m{line}\033[0m"
    sys.stderr.write(f"{line}\n")
    sys.stderr.flush()


def offer_logger_levels(node: Node) -> None:
    """Let others get and set the levels of this process's loggers."""
    for name, handler in (
        ("get_logger_levels", _answer_levels),
        ("set_logger_levels", _take_levels),
    ):
        service = "".join(part.capitalize() for part in name.split("_"))
        kind = service_type(f"rcl_interfaces/srv/{service}")
        node.create_service(kind, f"{node.get_name()}/{name}", handler)


def _answer_levels(request: Any, response: Any) -> Any:
    make = message_type("rcl_interfaces/msg/LoggerLevel")
    response.levels = [make(name=name, level=int(get_logger_level(name))) for name in request.names]
    return response


def _take_levels(request: Any, response: Any) -> Any:
    make = message_type("rcl_interfaces/msg/SetLoggerLevelsResult")
    for one in request.levels:
        try:
            set_logger_level(one.name, one.level)
        except ValueError:
            reason = "Failed reason: Invalid logger level."
            response.results.append(make(successful=False, reason=reason))
        else:
            response.results.append(make(successful=True))
    return response
