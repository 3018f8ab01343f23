"""Log files that a full disk does not turn into the end of whoever writes them."""

from __future__ import annotations

import logging
import os
import sys
from contextlib import suppress
from logging.handlers import RotatingFileHandler, WatchedFileHandler
from pathlib import Path

__all__ = ["LogStream", "RotatingLog", "WatchedLog"]

_told: set[Path] = set()


class LogStream:
    """A text file that lines are added to; what cannot be written is left out, told once.

    Attributes:
        path: of the file.
    """

    def __init__(self, path: Path) -> None:
        """Open it.

        Raises:
            OSError: it cannot be opened.
        """
        self.path = path
        self._descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o666)
        self._missing = 0

    def write(self, text: str) -> None:
        """Add some text, usually a line; nothing after `close`."""
        if self._descriptor < 0:
            return
        if self._missing:
            gap = f"… {self._missing} lines are missing here: they could not be written\n"
            text = f"{gap}{text}"
        try:
            _write_all(self._descriptor, text.encode("utf-8", "replace"))
        except OSError as error:
            self._missing += 1
            _tell_once(self.path, error)
        else:
            self._missing = 0

    def close(self) -> None:
        """Write nothing more."""
        descriptor, self._descriptor = self._descriptor, -1
        if descriptor >= 0:
            with suppress(OSError):
                os.close(descriptor)


class _TellsOnce(logging.FileHandler):
    """A handler that says once when the disk does not take a record, in place of tracebacks."""

    def handleError(self, record: logging.LogRecord) -> None:
        """Say what is wrong with the disk; leave other mistakes to logging."""
        error = sys.exc_info()[1]
        if isinstance(error, OSError):
            _tell_once(Path(self.baseFilename), error)
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


def _write_all(descriptor: int, data: bytes) -> None:
    while data:
        data = data[os.write(descriptor, data) :]


def _tell_once(path: Path, error: OSError) -> None:
    """Say of a file that it lacks something; several may write to it."""
    if path in _told:
        return
    _told.add(path)
    text = f"{path}: {error.strerror}; what cannot be written is missing there"
    if sys.stderr is not None:
        with suppress(OSError, ValueError):
            sys.stderr.write(f"warning: {text}\n")
