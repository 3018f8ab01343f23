"""What the two halves of the bridge say to each other over two pipes.

A frame is a head (size, kind, channel, number) and that many bytes. A channel is one topic or
service of one node, numbered by the side that asks for it; a number tells calls of a service
apart, or names the publisher of a message. Commands and reports are JSON.
"""

from __future__ import annotations

import enum
import json
import os
import struct
import threading
from typing import IO, Any, NamedTuple

__all__ = ["Frame", "FrameKind", "Pipes"]

_HEAD = struct.Struct("<IBII")
_LARGE = 1 << 16
_MAX_LENGTH = 1 << 31


class FrameKind(enum.IntEnum):
    """What a frame's bytes are."""

    CONTROL = 0
    MESSAGE = 1
    REQUEST = 2
    RESPONSE = 3
    FAILURE = 4


class Frame(NamedTuple):
    """One frame.

    Attributes:
        kind: what the bytes are.
        channel: topic or service it is about.
        number: the call, or the publisher.
        data: JSON, CDR, or for a failure the reason.
    """

    kind: int
    channel: int
    number: int
    data: bytes

    def control(self) -> dict[str, Any]:
        """Return the command or report that the frame is."""
        found: dict[str, Any] = json.loads(self.data)
        return found


class Pipes:
    """Both directions; `send` is safe to use from many threads, `receive` from one."""

    def __init__(self, reader: IO[bytes], writer: IO[bytes]) -> None:
        """Wrap two open files.

        Args:
            reader: buffered.
            writer: only its descriptor is used.
        """
        self._reader = reader
        self._writer = writer
        self._lock = threading.Lock()

    def send(self, kind: int, channel: int, number: int, data: bytes) -> None:
        """Send a frame; waits while the other side does not read.

        Raises:
            OSError: the other side has gone.
        """
        head = _HEAD.pack(len(data), kind, channel, number)
        with self._lock:
            if len(data) < _LARGE:
                self._write(head + data)
            else:
                self._write(head)
                self._write(data)

    def send_control(self, **fields: Any) -> None:
        """Send a command or a report.

        Raises:
            OSError: the other side has gone.
        """
        self.send(FrameKind.CONTROL, 0, 0, json.dumps(fields).encode())

    def receive(self) -> Frame:
        """Wait for the next frame.

        Raises:
            EOFError: the other side has gone.
        """
        size, kind, channel, number = _HEAD.unpack(self._read(_HEAD.size))
        if size > _MAX_LENGTH:
            raise EOFError("the other side does not speak in frames")
        return Frame(kind, channel, number, self._read(size))

    def close(self) -> None:
        """Tell the other side that nothing more comes."""
        self._writer.close()

    def _write(self, data: bytes) -> None:
        number = self._writer.fileno()
        rest = memoryview(data)
        while rest:
            rest = rest[os.write(number, rest) :]

    def _read(self, size: int) -> bytes:
        data = self._reader.read(size)
        if len(data) < size:
            raise EOFError("the other side of the bridge has gone")
        return data
