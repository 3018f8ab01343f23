"""Handlers of Python's logging that format each logger's records in its own way."""

from __future__ import annotations

import logging
import logging.handlers
import sys
from typing import Any, TextIO

from gazelle.log_handlers import RotatingLog, WatchedLog
from gazelle.process_lifetime import drop_output

__all__ = ["ScreenHandler", "with_per_logger_formatting"]

_OWN: dict[str, type[logging.Handler]] = {
    "RotatingFileHandler": RotatingLog,
    "WatchedFileHandler": WatchedLog,
}
_made: dict[str, type[logging.Handler]] = {}


def with_per_logger_formatting(cls: type[logging.Handler]) -> type[Any]:
    """Return a subclass of a handler with a formatter per logger."""

    def initialize(self: Any, *args: Any, **kwargs: Any) -> None:
        cls.__init__(self, *args, **kwargs)
        self._formatters = {}

    def set_formatter_for(self: Any, logger: logging.Logger | str, formatter: Any) -> None:
        self._formatters[logger if isinstance(logger, str) else logger.name] = formatter

    def unset_formatter_for(self: Any, logger: logging.Logger | str) -> None:
        self._formatters.pop(logger if isinstance(logger, str) else logger.name, None)

    def format_record(self: Any, record: logging.LogRecord) -> str:
        formatter = self._formatters.get(record.name)
        return formatter.format(record) if formatter is not None else cls.format(self, record)

    members = {
        "__init__": initialize,
        "setFormatterFor": set_formatter_for,
        "unsetFormatterFor": unset_formatter_for,
        "format": format_record,
        "__doc__": cls.__doc__,
    }
    return type(cls.__name__, (cls,), members)


def __getattr__(name: str) -> Any:
    """Return any handler of `logging` and `logging.handlers` with a formatter per logger."""
    found = _OWN.get(name) or getattr(logging, name, None) or getattr(logging.handlers, name, None)
    if not (isinstance(found, type) and issubclass(found, logging.Handler)):
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    if name not in _made:
        _made[name] = with_per_logger_formatting(found)
    return _made[name]


class _Screen(logging.StreamHandler[TextIO]):
    """Writes to what standard output is at the time; what it cannot encode becomes ``?``."""

    def __init__(self) -> None:
        logging.Handler.__init__(self)

    @property
    def stream(self) -> TextIO:
        return sys.stdout

    @stream.setter
    def stream(self, _stream: TextIO) -> None:
        """It is not kept."""

    def format(self, record: logging.LogRecord) -> str:
        encoding = getattr(sys.stdout, "encoding", None) or "utf-8"
        return super().format(record).encode(encoding, "replace").decode(encoding, "replace")

    def handleError(self, record: logging.LogRecord) -> None:
        if isinstance(sys.exception(), BrokenPipeError):
            # The reader of the launch's output has gone, which ends the launch.
            drop_output(sys.stdout)
        else:
            super().handleError(record)


ScreenHandler = with_per_logger_formatting(_Screen)
