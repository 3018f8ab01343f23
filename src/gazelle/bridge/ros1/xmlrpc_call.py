"""Calls to XMLRPC servers of ROS 1: the master and the nodes' slave servers."""

from __future__ import annotations

import http.client
import xmlrpc.client
from typing import Any
from urllib.parse import urlsplit

from gazelle.errors import GraphError

__all__ = [
    "MAX_BODY_BYTES",
    "RemoteError",
    "RemoteRefusedError",
    "call",
    "decoded",
    "read_answer",
]

MAX_BODY_BYTES = 1 << 26
_TIMEOUT_S = 5.0
_SUCCESS = 1


class RemoteError(GraphError):
    """A server of ROS 1 did not answer, or not in XMLRPC."""


class RemoteRefusedError(RemoteError):
    """A server of ROS 1 answered with a failure; the text is its own."""


def call(uri: str, method: str, *arguments: Any, timeout_s: float = _TIMEOUT_S) -> Any:
    """Call a method of ROS 1's APIs and return the value of its answer.

    Args:
        uri: of the server, ``http://host:port/``.
        method: such as ``getPid``.
        arguments: the caller's name first.
        timeout_s: longest wait for each part of the answer.

    Raises:
        RemoteError: nobody answers there, or it is not a server of ROS 1.
        RemoteRefusedError: it answered that it could not.
    """
    body = xmlrpc.client.dumps(arguments, method, allow_none=True).encode()
    try:
        answer = _post(uri, body, timeout_s)
    except (OSError, http.client.HTTPException, ValueError) as error:
        raise RemoteError(f"{uri} did not answer {method}: {error}") from error
    return read_answer(answer, uri, method)


def read_answer(body: bytes, uri: str, method: str) -> Any:
    """Return the value in a server's answer.

    Args:
        body: what came.
        uri: of the server, for errors.
        method: what was called.

    Raises:
        RemoteError: it is not an answer of ROS 1.
        RemoteRefusedError: it says that the server could not.
    """
    try:
        values = decoded(body)[0]
    except (ValueError, xmlrpc.client.Error) as error:
        raise RemoteError(f"{uri} did not answer {method}: {error}") from error
    answer = values[0] if len(values) == 1 else None
    if not isinstance(answer, list | tuple) or len(answer) != 3:
        raise RemoteError(f"{uri} answered {method} with something that is not ROS 1's")
    code, text, value = answer
    if code != _SUCCESS:
        raise RemoteRefusedError(str(text))
    return value


def decoded(body: bytes) -> tuple[Any, str | None]:
    """Return parameters and method of an XMLRPC text.

    Raises:
        ValueError: it declares entities, or is not XMLRPC.
        xmlrpc.client.Fault: it is the report of a failure.
    """
    if b"<!" in body.replace(b"<![CDATA[", b"").replace(b"<!--", b""):
        raise ValueError("XMLRPC has no use for declarations such as <!ENTITY or <!DOCTYPE")
    try:
        return xmlrpc.client.loads(body, use_builtin_types=True)
    except xmlrpc.client.Fault:
        raise
    except Exception as error:
        # The standard library lets errors of its XML reader and of int() through alike.
        raise ValueError(f"this is not XMLRPC: {error}") from error


def _post(uri: str, body: bytes, timeout_s: float) -> bytes:
    parts = urlsplit(uri)
    if parts.scheme != "http" or not parts.hostname or not parts.port:
        raise ValueError(f"'{uri}' is not http://host:port/")
    connection = http.client.HTTPConnection(parts.hostname, parts.port, timeout=timeout_s)
    try:
        connection.request("POST", parts.path or "/", body, {"Content-Type": "text/xml"})
        answer = connection.getresponse()
        data = answer.read(MAX_BODY_BYTES + 1)
    finally:
        connection.close()
    if len(data) > MAX_BODY_BYTES:
        raise ValueError(f"more than {MAX_BODY_BYTES} bytes")
    if answer.status != http.client.OK:
        raise ValueError(f"HTTP {answer.status} {answer.reason}")
    return data
