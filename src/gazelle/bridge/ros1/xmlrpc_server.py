"""Serving XMLRPC over a connection that was accepted elsewhere."""

from __future__ import annotations

import http.server
import socket
import traceback
import xmlrpc.client
from collections.abc import Callable, Mapping
from inspect import signature
from typing import Any, NamedTuple

from gazelle.bridge.ros1.xmlrpc_call import MAX_BODY_BYTES, decoded

__all__ = ["Methods", "Notice", "serve_calls"]

Methods = Mapping[str, Callable[..., Any]]
Notice = Callable[[str], None]

_IDLE_S = 60.0
_MAX_REASON = 200
_ERROR = -1
_MAX_DIGITS = 20
_TEXT = ("str", str)
_MULTICALL = "system.multicall"


def serve_calls(
    stream: socket.socket, methods: Methods, hosts: frozenset[str], notice: Notice
) -> None:
    """Answer the calls that come over a connection until it ends.

    Args:
        stream: the connection, closed by the caller.
        methods: by name; each returns ROS 1's (code, text, value).
        hosts: names this server may be called by; a page of a browser knows others.
        notice: told of failures in a method.
    """
    stream.settimeout(_IDLE_S)
    _Calls(stream, _Terms(methods, hosts, notice))


class _Terms(NamedTuple):
    methods: Methods
    hosts: frozenset[str]
    notice: Notice


class _Calls(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    wbufsize = -1
    disable_nagle_algorithm = True

    def __init__(self, stream: socket.socket, terms: _Terms) -> None:
        """Serve the connection until it ends."""
        self._terms = terms
        # The library's own server is not behind it: connections are accepted elsewhere.
        super().__init__(stream, ("", 0), None)  # type: ignore[arg-type]

    def do_POST(self) -> None:
        size = self.headers.get("Content-Length", "")
        host = self.headers.get("Host", "").rpartition(":")[0].lower()
        if host not in self._terms.hosts or "Origin" in self.headers:
            self._refuse(403, f"'{host}' is not a name of this server")
        elif not (size.isascii() and size.isdigit() and len(size) < _MAX_DIGITS):
            self._refuse(411, "Content-Length is needed")
        elif int(size) > MAX_BODY_BYTES:
            self._refuse(413, f"more than {MAX_BODY_BYTES} bytes")
        else:
            self._answer(self.rfile.read(int(size)))

    def log_message(self, format: str, *args: Any) -> None:
        """Keep quiet; a master is asked many times a second."""

    def _refuse(self, status: int, text: str) -> None:
        self.close_connection = True
        # A status line is of plain letters; what was sent may hold any, and ends of lines.
        plain = "".join(one if one.isascii() and one.isprintable() else "?" for one in text)
        self.send_error(status, plain[:_MAX_REASON])

    def _answer(self, body: bytes) -> None:
        try:
            arguments, method = decoded(body)
        except (ValueError, xmlrpc.client.Error) as error:
            self._refuse(400, str(error))
            return
        data = _written(self._result(method or "", arguments))
        self.send_response(200)
        self.send_header("Content-Type", "text/xml")
        self.send_header("Content-Length", str(len(data)))
        self.end_headers()
        self.wfile.write(data)

    def _result(self, method: str, arguments: tuple[Any, ...]) -> Any:
        if method == _MULTICALL:
            return self._results(arguments)
        found = self._terms.methods.get(method)
        if found is None:
            return xmlrpc.client.Fault(1, f'method "{method}" is not supported')
        taken = signature(found)
        try:
            bound = taken.bind(*arguments)
        except TypeError as error:
            return [_ERROR, f"wrong arguments of {method}: {error}", 0]
        for name, value in bound.arguments.items():
            if taken.parameters[name].annotation in _TEXT and not isinstance(value, str):
                return [_ERROR, f"ERROR: parameter [{name.lstrip('_')}] must be a string", 0]
        try:
            return found(*arguments)
        except Exception as error:  # noqa: BLE001 - the caller is told, and the other calls go on
            self._terms.notice(f"{method} failed: {error}\n{traceback.format_exc().rstrip()}")
            return [_ERROR, str(error), 0]

    def _results(self, arguments: tuple[Any, ...]) -> Any:
        calls = arguments[0] if len(arguments) == 1 and isinstance(arguments[0], list) else []
        return [self._one_result(one) for one in calls]

    def _one_result(self, one: Any) -> Any:
        name = one.get("methodName") if isinstance(one, dict) else None
        params = one.get("params") if isinstance(one, dict) else None
        if not isinstance(name, str) or not isinstance(params, list) or name == _MULTICALL:
            return {"faultCode": 1, "faultString": "a call has methodName and params"}
        result = self._result(name, tuple(params))
        if isinstance(result, xmlrpc.client.Fault):
            return {"faultCode": result.faultCode, "faultString": result.faultString}
        return [result]


def _written(result: Any) -> bytes:
    value = result if isinstance(result, xmlrpc.client.Fault) else (result,)
    return xmlrpc.client.dumps(value, methodresponse=True, allow_none=True).encode()
