"""The server itself: a thread with an event loop that answers HTTP and WebSockets."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import threading
from functools import partial
from http import HTTPStatus
from typing import NamedTuple, Self
from urllib.parse import urlsplit

from websockets.asyncio.server import Server as WebSocketServer
from websockets.asyncio.server import ServerConnection, serve
from websockets.http11 import Request, Response

from gazelle.errors import GazelleError
from gazelle.graph.glibc_malloc import keep_freed_memory
from gazelle.studio.connection import Connection
from gazelle.studio.frame_passes import FRAME, FramePasses
from gazelle.studio.http_answers import answer_to, response
from gazelle.studio.protocol import ROUTES
from gazelle.studio.security import guard_for
from gazelle.studio.studio import Studio
from gazelle.studio.workers import in_thread

__all__ = ["DEFAULT_PORT", "Frame", "Server"]

DEFAULT_PORT = 8090
_PORTS_TRIED = 20
_MAX_MESSAGE_BYTES = 32 << 20
_WRITE_LIMIT_BYTES = 1 << 20
_STARTING_S = 10.0
# A busy machine may take long to read a mesh; a browser's spare connections wait as long.
_ANSWER_S = 120.0


class Frame(NamedTuple):
    """A page that another one may show in a frame.

    Attributes:
        token: of its pass.
        port: of its server, on 127.0.0.1.
    """

    token: str
    port: int

    def __repr__(self) -> str:
        """Without the token: logs and tracebacks show values."""
        return f"Frame(token='***', port={self.port})"

    @property
    def path(self) -> str:
        """Where the page is on the server."""
        return f"/{FRAME}/{self.token}/"


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
        self._passes = FramePasses()
        self._framed: dict[str, set[ServerConnection]] = {}
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

    def open_frame(self, origin: str | None = None) -> Frame:
        """Let one other page show this one in a frame.

        Args:
            origin: of that page; the first one on this machine that does when None.
        """
        return Frame(self._passes.issue(origin), self.port)

    def close_frame(self, frame: Frame) -> None:
        """End what `open_frame` has begun, with the connections that were made by it."""
        self._passes.withdraw(frame.token)
        with contextlib.suppress(RuntimeError):
            self._loop.call_soon_threadsafe(self._end_connections, frame.token)

    def is_reached(self, frame: Frame) -> bool:
        """Return whether a browser has ever asked for a page of `open_frame`."""
        return self._passes.is_reached(frame.token)

    def _end_connections(self, token: str) -> None:
        for socket in self._framed.pop(token, ()):
            socket.transport.abort()

    async def _talk(self, socket: ServerConnection) -> None:
        assert socket.request is not None
        framed = self._passes.look(socket.request.path, socket.request.headers)
        if framed is None:
            await Connection(self.studio, socket).run()
            return
        sockets = self._framed.setdefault(framed.token, set())
        sockets.add(socket)
        try:
            if self._passes.holds(framed.token):
                await Connection(self.studio, socket).run()
        finally:
            sockets.discard(socket)

    async def _answer(self, _socket: ServerConnection, request: Request) -> Response | None:
        """Refuse strangers, serve files; None lets a WebSocket through."""
        framed = self._passes.look(request.path, request.headers)
        if framed is None:
            reason = self._guard.refusal(request.path, request.headers)
            return await self._served(request, reason)
        reason = self._guard.strangeness(request.headers) or framed.refusal
        answer = await self._served(Request(framed.path, request.headers), reason)
        return None if answer is None else framed.admit(answer)

    async def _served(self, request: Request, reason: str) -> Response | None:
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
