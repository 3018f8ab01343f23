"""Calls of services, both ways, over TCPROS.

Source: http://wiki.ros.org/ROS/TCPROS, "Service connection headers": a response starts with one
byte, 1 for success; a failure's text follows a 0.
"""

from __future__ import annotations

import socket
import struct
from collections.abc import Callable
from typing import Any
from urllib.parse import urlsplit

from gazelle.bridge.ros1.tcpros import (
    FrameError,
    read_exactly,
    read_frame,
    read_header,
    write_header,
)
from gazelle.bridge.ros1.types import ServiceKind
from gazelle.errors import GazelleError
from gazelle.graph import ANY_TYPE
from gazelle.graph.errors import ServiceRefusedError, ServiceUnavailableError
from gazelle.interfaces import from_ros1, to_ros1

__all__ = ["call_service", "probe", "serve_requests"]

_CONNECT_S = 5.0
_RESULT = struct.Struct("<BI")
_LENGTH = struct.Struct("<I")
_NO_REASON = "service cannot process request: no reason given"


def serve_requests(
    stream: socket.socket,
    header: dict[str, str],
    kind: ServiceKind,
    caller: str,
    answer: Callable[[Any], Any],
) -> None:
    """Answer the calls of a service that come over a connection.

    Args:
        stream: the connection, its header already read.
        header: what the client sent.
        kind: the service's type.
        caller: name of the node that offers it.
        answer: request → response, in the form of ROS 1.

    Raises:
        OSError: the client went.
    """
    if header.get("md5sum", ANY_TYPE) not in (ANY_TYPE, kind.md5):
        wanted = f"md5sums do not match: [{header['md5sum']}] vs. [{kind.md5}]"
        stream.sendall(write_header({"error": wanted}))
        return
    stream.sendall(write_header(_answer_header(kind, caller)))
    if header.get("probe") == "1":
        return
    stream.settimeout(None)
    while True:
        data = read_frame(stream)
        stream.sendall(_reply(bytes(data), kind, answer))
        if header.get("persistent", "0").lower() not in ("1", "true"):
            return


def _reply(data: bytes, kind: ServiceKind, answer: Callable[[Any], Any]) -> bytes:
    try:
        response = to_ros1(answer(from_ros1(kind.service_class._request_class, data)))
    except GazelleError as error:
        text = str(error).encode()
        return _RESULT.pack(0, len(text)) + text
    return _RESULT.pack(1, len(response)) + response


def _answer_header(kind: ServiceKind, caller: str) -> dict[str, str]:
    return {
        "callerid": caller,
        "md5sum": kind.md5,
        "type": kind.ros1_name,
        "request_type": f"{kind.ros1_name}Request",
        "response_type": f"{kind.ros1_name}Response",
    }


def probe(uri: str, service: str, caller: str) -> str:
    """Return the type of a service, which only its server knows.

    Raises:
        GazelleError: the server refuses.
        OSError: it does not answer.
    """
    with _connected(uri) as stream:
        request = {"callerid": caller, "md5sum": ANY_TYPE, "probe": "1", "service": service}
        stream.sendall(write_header(request))
        header = read_header(stream)
    if "type" not in header:
        raise FrameError(f"service [{service}]: {header.get('error', 'its server tells no type')}")
    return header["type"]


def call_service(uri: str, service: str, kind: ServiceKind, caller: str, request: Any) -> Any:
    """Call a service of ROS 1 and return its response, both in the form of ROS 1.

    Each call has a connection of its own, as rospy's have, so none is ever sent twice.

    Args:
        uri: where it is answered, ``rosrpc://host:port``.
        service: its global name.
        kind: its type.
        caller: name of the calling node.
        request: the request.

    Raises:
        ServiceRefusedError: the server failed; its own words.
        ServiceUnavailableError: it does not answer.
    """
    data = to_ros1(request)
    header = {"callerid": caller, "md5sum": kind.md5, "service": service}
    try:
        with _connected(uri) as stream:
            stream.sendall(write_header(header))
            answer = read_header(stream)
            if "error" in answer:
                raise ServiceRefusedError(answer["error"])
            stream.settimeout(None)
            stream.sendall(_LENGTH.pack(len(data)) + data)
            well = read_exactly(stream, 1)[0]
            body = read_frame(stream)
    except OSError as error:
        raise ServiceUnavailableError(f"service [{service}] unavailable: {error}") from error
    if not well:
        raise ServiceRefusedError(body.decode("utf-8", "replace") or _NO_REASON)
    return from_ros1(kind.service_class._response_class, bytes(body))


def _connected(uri: str) -> socket.socket:
    parts = urlsplit(uri)
    if parts.scheme != "rosrpc" or not parts.hostname or not parts.port:
        raise FrameError(f"'{uri}' is not rosrpc://host:port")
    stream = socket.create_connection((parts.hostname, parts.port), _CONNECT_S)
    stream.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    return stream
