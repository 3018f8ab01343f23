"""The server itself: a thread with an event loop that answers HTTP and WebSockets."""

from __future__ import annotations

import asyncio
import logging
import threading
from functools import partial
from http import HTTPStatus
from typing import Self
from urllib.parse import urlsplit

from websockets.asyncio.server import Server as WebSocketServer
from websockets.asyncio.server import ServerConnection, serve
from websockets.http11 import Request, Response

from gazelle.errors import GazelleError
from gazelle.graph.glibc_malloc import keep_freed_memory
from gazelle.studio.connection import Connection
from gazelle.studio.http_answers import answer_to, response
from gazelle.studio.protocol import ROUTES
from gazelle.studio.security import guard_for
from gazelle.studio.studio import Studio
from gazelle.studio.workers import in_thread

__all__ = ["DEFAULT_PORT", "Server"]

DEFAULT_PORT = 8090
_PORTS_TRIED = 20
_MAX_MESSAGE_BYTES = 32 << 20
_WRITE_LIMIT_BYTES = 1 << 20
_STARTING_S = 10.0
# A busy machine may take long to read a mesh; a browser's spare connections wait as long.
_ANSWER_S = 120.0


class Server:
    """Serves the page of a Studio from a thread of its own.

    Attributes:
        studio: what it serves.
        url: what to open in a browser.
    """

    def __init__(
        self,
        studio: Studio,
        *,
        host: str = "127.0.0.1",
        port: int | None = None,
        first_port: int = DEFAULT_PORT,
    ) -> None:
        """Listen.

        Args:
            studio: it is closed together with the server.
            host: address.
            port: TCP port, 0 for any free one; None takes the first free one from another on.
            first_port: that one; 0 for any free one.

        Raises:
            GazelleError: the address or port cannot be listened on, or the user's secret cannot
                be read.
        """
        self.studio = studio
        self._routes = {name: partial(route, studio) for name, route in ROUTES.items()}
        self._host = host
        self._ports = _ports_tried(port, first_port)
        self._loop = asyncio.new_event_loop()
        self._started = threading.Event()
        self._stop = asyncio.Event()
        self._error: OSError | None = None
        # Its port comes later; a secret that cannot be read is told here.
        self._guard = guard_for(host, 0)
        studio.demos.may_start = self._guard.is_local
        keep_freed_memory()
        self._thread = threading.Thread(target=self._run, name="studio server", daemon=True)
        self._thread.start()
        self._started.wait(_STARTING_S)
        self._check_listening()
        self.url = self._url()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exc_info: object) -> None:
        self.close()

    @property
    def port(self) -> int:
        """The port listened on."""
        return self._guard.port

    @property
    def is_local(self) -> bool:
        """Whether only this machine can reach it."""
        return self._guard.is_local

    @property
    def token(self) -> str:
        """What the URL must carry."""
        return self._guard.token

    def close(self) -> None:
        """Close all pages' connections, stop listening and leave the graph."""
        if self._thread.is_alive():
            self._loop.call_soon_threadsafe(self._stop.set)
            self._thread.join()
        self.studio.close()

    def _check_listening(self) -> None:
        if self._error is not None:
            self._thread.join()
            raise GazelleError(_cannot_listen(self._host, self._ports, self._error))

    def _run(self) -> None:
        asyncio.set_event_loop(self._loop)
        try:
            self._loop.run_until_complete(self._serve())
        finally:
            self._started.set()
            self._loop.close()

    async def _serve(self) -> None:
        server = await self._listening()
        if server is None:
            return
        async with server:
            self._started.set()
            await self._stop.wait()

    async def _listening(self) -> WebSocketServer | None:
        for port in self._ports:
            try:
                server = await serve(
                    self._talk,
                    self._host,
                    port,
                    process_request=self._answer,
                    compression=None,
                    max_size=_MAX_MESSAGE_BYTES,
                    write_limit=_WRITE_LIMIT_BYTES,
                    server_header=None,
                    open_timeout=_ANSWER_S,
                    close_timeout=1,
                    logger=_quiet_logger(),
                )
            except OSError as error:
                self._error = error
                continue
            self._error = None
            bound = next(iter(server.sockets)).getsockname()[1]
            self._guard = self._guard._replace(port=bound)
            return server
        return None

    async def _talk(self, socket: ServerConnection) -> None:
        await Connection(self.studio, socket).run()

    async def _answer(self, _socket: ServerConnection, request: Request) -> Response | None:
        """Refuse strangers, serve files; None lets a WebSocket through."""
        reason = self._guard.refusal(request.path, request.headers)
        if reason:
            return response(HTTPStatus.FORBIDDEN, f"403: {reason}\n".encode())
        if urlsplit(request.path).path == "/ws":
            if request.headers.get("Upgrade", "").lower() == "websocket":
                return None
            return response(HTTPStatus.UPGRADE_REQUIRED, b"this path is a WebSocket\n")
        return await in_thread(answer_to, self._routes, request, self._guard)

    def _url(self) -> str:
        host = f"[{self._host}]" if ":" in self._host else self._host
        return f"http://{host}:{self.port}/?token={self.token}"


def _ports_tried(port: int | None, first_port: int) -> range:
    if port is not None or first_port == 0:
        return range(port or 0, (port or 0) + 1)
    return range(first_port, first_port + _PORTS_TRIED)


def _cannot_listen(host: str, ports: range, error: OSError) -> str:
    which = f"port {ports[0]}" if len(ports) == 1 else f"ports {ports[0]} to {ports[-1]}"
    reason = error.strerror or str(error)
    return f"cannot listen on {host}, {which}: {reason}\n  fix: choose another one with --port"


def _quiet_logger() -> logging.Logger:
    """The library logs every port scanner's broken handshake with a stack."""
    logger = logging.getLogger("gazelle.studio.websockets")
    logger.setLevel(logging.CRITICAL)
    logger.propagate = False
    return logger
