"""Bytes of TCPROS: connection headers and length-prefixed frames over a socket.

Source: http://wiki.ros.org/ROS/TCPROS and http://wiki.ros.org/ROS/Connection%20Header.
"""

from __future__ import annotations

import socket
import struct
from collections.abc import Iterable, Mapping

from gazelle.errors import GraphError

__all__ = [
    "MAX_FRAME_BYTES",
    "FrameError",
    "read_exactly",
    "read_frame",
    "read_header",
    "send_all",
    "write_header",
]

MAX_FRAME_BYTES = 1 << 29
_MAX_HEADER_BYTES = 1 << 20
_FIRST_BYTES = 16 << 20
_LENGTH = struct.Struct("<I")


class FrameError(GraphError):
    """The other side sent what is not TCPROS, or more than is accepted."""


def write_header(fields: Mapping[str, str]) -> bytes:
    """Return a connection header, its own length in front."""
    lines = [f"{key}={value}".encode() for key, value in fields.items()]
    body = b"".join(_LENGTH.pack(len(line)) + line for line in lines)
    return _LENGTH.pack(len(body)) + body


def read_header(stream: socket.socket) -> dict[str, str]:
    """Return the fields of the connection header that comes next.

    Raises:
        FrameError: it is not one, or longer than a mebibyte.
        ConnectionError: the stream ended.
    """
    body = bytes(read_frame(stream, _MAX_HEADER_BYTES))
    fields: dict[str, str] = {}
    offset = 0
    while offset < len(body):
        end = offset + 4
        size = _LENGTH.unpack_from(body, offset)[0] if end <= len(body) else len(body)
        line = body[end : end + size]
        if end + size > len(body) or b"=" not in line:
            raise FrameError("this is not a connection header of TCPROS")
        key, _, value = line.decode("utf-8", "replace").partition("=")
        fields[key] = value
        offset = end + size
    return fields


def read_frame(stream: socket.socket, most: int = MAX_FRAME_BYTES) -> bytearray:
    """Return the next frame without its length.

    Raises:
        FrameError: it is longer than `most` bytes.
        ConnectionError: the stream ended.
    """
    size = _LENGTH.unpack(read_exactly(stream, 4))[0]
    if size > most:
        raise FrameError(f"a frame of {size} bytes, more than the {most} that are accepted")
    return read_exactly(stream, size)


def read_exactly(stream: socket.socket, size: int) -> bytearray:
    """Return so many bytes.

    Raises:
        ConnectionError: the stream ended before.
    """
    # Whoever says that much will come must send it before there is room for more.
    data = bytearray(min(size, _FIRST_BYTES))
    offset = 0
    while offset < size:
        if offset == len(data):
            data.extend(bytes(min(size - offset, offset)))
        with memoryview(data) as view, view[offset:] as rest:
            got = stream.recv_into(rest)
        if not got:
            raise ConnectionError("the connection was closed")
        offset += got
    return data


def send_all(stream: socket.socket, parts: Iterable[bytes | memoryview]) -> None:
    """Send several pieces one behind the other, without joining them first."""
    views = [memoryview(part) for part in parts if len(part)]
    while views:
        sent = stream.sendmsg(views)
        while views and sent >= views[0].nbytes:
            sent -= views.pop(0).nbytes
        if sent:
            views[0] = views[0][sent:]
