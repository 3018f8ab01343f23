"""Handlers of Python's logging on a disk that may be full."""

from __future__ import annotations

import logging
import sys
from contextlib import suppress
from logging.handlers import RotatingFileHandler, WatchedFileHandler

from gazelle.log_files import GAPS

__all__ = ["RotatingLog", "WatchedLog"]


class _TellsOnce(logging.FileHandler):
    """A handler that says once when the disk does not take a record, in place of tracebacks."""

    def handleError(self, record: logging.LogRecord) -> None:
        """Say what is wrong with the disk; leave other mistakes to logging."""
        error = sys.exc_info()[1]
        if isinstance(error, OSError):
            GAPS.tell(self.baseFilename, error)
        else:
            super().handleError(record)

    def close(self) -> None:
        """Close the file, also when it cannot take its last bytes."""
        with suppress(OSError):
            super().close()


class RotatingLog(_TellsOnce, RotatingFileHandler):
    """The handler of this name, on a disk that may be full."""


class WatchedLog(_TellsOnce, WatchedFileHandler):
    """The handler of this name, on a disk that may be full."""
