"""Log files on a disk that may be full, which is no reason for whoever writes them to end."""

from __future__ import annotations

import os
import sys
import threading
from contextlib import suppress
from pathlib import Path

__all__ = ["GAPS", "Gaps", "LogStream"]


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
        # A closed descriptor's number may be another file's at once. A signal's handler may log
        # while its own thread does.
        self._lock = threading.RLock()

    def write(self, text: str) -> None:
        """Add some text, usually a line; nothing after `close`."""
        with self._lock:
            if self._descriptor >= 0:
                self._add(text)

    def close(self) -> None:
        """Write nothing more."""
        with self._lock:
            descriptor, self._descriptor = self._descriptor, -1
        if descriptor >= 0:
            with suppress(OSError):
                os.close(descriptor)

    def _add(self, text: str) -> None:
        if self._missing:
            gap = f"… {self._missing} lines are missing here: they could not be written\n"
            text = f"{gap}{text}"
        try:
            _write_all(self._descriptor, text.encode("utf-8", "replace"))
        except OSError as error:
            self._missing += 1
            GAPS.tell(str(self.path), error)
        else:
            self._missing = 0


def _write_all(descriptor: int, data: bytes) -> None:
    while data:
        data = data[os.write(descriptor, data) :]


class Gaps:
    """Where something is missing that could not be written, said once of each place."""

    def __init__(self) -> None:
        """Begin with nothing said."""
        self._told: set[str] = set()

    def tell(self, place: str, error: OSError) -> None:
        """Say on standard error that something is missing at a place; several may write there."""
        if place in self._told:
            return
        self._told.add(place)
        if sys.stderr is not None:
            with suppress(OSError, ValueError):
                text = f"{place}: {error.strerror}; what cannot be written is missing there"
                sys.stderr.write(f"warning: {text}\n")

    def reset(self) -> None:
        """Forget what was said."""
        self._told.clear()


GAPS = Gaps()
"""Those of this process."""
