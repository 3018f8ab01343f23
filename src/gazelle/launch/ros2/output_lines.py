"""What a process writes, line by line, into a log."""

from __future__ import annotations

import codecs
import logging
from collections.abc import Callable

__all__ = ["OutputLines"]


class OutputLines:
    """Cuts the output of a process into lines and logs each as soon as it ends."""

    def __init__(
        self, logger: logging.Logger, format_line: Callable[[str], str], *, is_cached: bool
    ) -> None:
        self._logger = logger
        self._format_line = format_line
        self._is_cached = is_cached
        self._decoder = codecs.getincrementaldecoder("utf-8")("replace")
        self._part = ""
        self._all: list[str] = []

    def add(self, data: bytes) -> None:
        """Take more of the output."""
        text = self._decoder.decode(data)
        if self._is_cached:
            self._all.append(text)
        *lines, self._part = (self._part + text).split("\n")
        for line in lines:
            self._logger.info(self._format_line(line.removesuffix("\r")))

    def end(self) -> None:
        """Log what has no line end behind it."""
        if self._part:
            self._logger.info(self._format_line(self._part))
        self._part = ""

    def text(self) -> str:
        """Return all of it so far; empty unless it is cached."""
        return "".join(self._all)
