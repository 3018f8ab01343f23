"""A listening port that takes XMLRPC calls and TCPROS connections alike.

Each node has one such port, so a caller's choice of port tells which node it means.
"""

from __future__ import annotations

import contextlib
import socket
import threading
from collections.abc import Callable

from gazelle.bridge.ros1.addresses import Address
from gazelle.bridge.ros1.xmlrpc_server import Methods, Notice, serve_calls
from gazelle.errors import GazelleError

__all__ = ["ServerSocket", "StreamHandler"]

_FIRST_BYTES = 4
_HTTP = (b"POST", b"GET ", b"HEAD", b"PUT ", b"OPTI")
_PATIENCE_S = 10.0
_BREATH_S = 0.05

StreamHandler = Callable[[socket.socket], None]
"""Serves a TCPROS connection until it ends; the stream is closed when it returns."""


class ServerSocket:
    """Accepts connections, each served in a thread of its own.

    Attributes:
        host: the name others reach it by.
        port: its port.
    """

    def __init__(
        self,
        address: Address,
        methods: Methods,
        streams: StreamHandler | None,
        notice: Notice,
        *,
        port: int = 0,
    ) -> None:
        """Listen.

        Args:
            address: where to bind and what to be called.
            methods: answered over XMLRPC.
            streams: takes TCPROS connections, None where there are none.
            notice: told of failures.
            port: 0 for any.

        Raises:
            OSError: the port is taken.
        """
        self.host = address.host
        self._hosts = address.names
        self._methods = methods
        self._streams = streams
        self._notice = notice
        self._closed = threading.Event()
        self._open: set[socket.socket] = set()
        self._lock = threading.Lock()
        self._listener = socket.create_server((address.bind, port), backlog=128)
        self.port: int = self._listener.getsockname()[1]
        name = f"ros1 {self.port}"
        self._thread = threading.Thread(target=self._accept, name=name, daemon=True)
        self._thread.start()

    @property
    def uri(self) -> str:
        """Address for XMLRPC."""
        return f"http://{self.host}:{self.port}/"

    @property
    def service_uri(self) -> str:
        """Address for calls of services."""
        return f"rosrpc://{self.host}:{self.port}"

    def close(self) -> None:
        """Take nothing more and end what is open."""
        with self._lock:
            self._closed.set()
            streams = list(self._open)
        for one in (self._listener, *streams):
            with contextlib.suppress(OSError):
                one.shutdown(socket.SHUT_RDWR)
        self._listener.close()

    def _accept(self) -> None:
        while True:
            try:
                stream, _ = self._listener.accept()
            except OSError:
                # Closed; or a caller that went before it was served, or too many at once.
                if self._closed.wait(_BREATH_S):
                    return
                continue
            with self._lock:
                if self._closed.is_set():
                    stream.close()
                    return
                self._open.add(stream)
            threading.Thread(
                target=self._serve, args=(stream,), name=f"ros1 {self.port}", daemon=True
            ).start()

    def _serve(self, stream: socket.socket) -> None:
        try:
            stream.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            stream.settimeout(_PATIENCE_S)
            first = stream.recv(_FIRST_BYTES, socket.MSG_PEEK | socket.MSG_WAITALL)
            if self._closed.is_set() or len(first) < _FIRST_BYTES:
                return
            if first in _HTTP:
                serve_calls(stream, self._methods, self._hosts, self._notice)
            elif self._streams is not None:
                self._streams(stream)
        except OSError:
            # The other side went; it is noticed where its data are missed.
            return
        except GazelleError as error:
            self._notice(str(error))
        finally:
            with self._lock:
                self._open.discard(stream)
            stream.close()
