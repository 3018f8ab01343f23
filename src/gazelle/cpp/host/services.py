"""Servers and clients of C++, as the graph has them."""

from __future__ import annotations

import itertools
import queue
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.cpp.host.raw_messages import raw_service_type
from gazelle.errors import GazelleError
from gazelle.graph.errors import (
    ServiceRefusedError,
    ServiceTimeoutError,
    ServiceUnavailableError,
)
from gazelle.graph.type_support import decode, encode, request_type, response_type
from gazelle.process_lifetime import start_deaf_thread

if TYPE_CHECKING:
    from gazelle.cpp.host.table import Core

__all__ = ["Calls", "HostClient", "HostServer"]

_OK, _FAILED, _UNAVAILABLE, _TIMEOUT = 0, 1, 2, 3
_LEFT = "the program left the graph before it answered"


class _Answer:
    """What C++ answers to one request."""

    def __init__(self) -> None:
        self.done = threading.Event()
        self.data = b""
        self.error: str | None = None


class HostServer:
    """A service that C++ answers.

    Attributes:
        name: global name.
    """

    _answers: dict[int, _Answer] = {}  # noqa: RUF012 - of the whole process, as its numbers are
    _numbers = itertools.count(1)

    def __init__(self, core: Core, node: Any, request: dict[str, Any]) -> None:
        """Offer it; `request` is that of the verb ``service/offer``."""
        self._core = core
        self._number: int = request["core"]
        self._open: set[int] = set()
        self._service_class = _service_class(node, request["type"])
        self._is_raw = getattr(node, "graph", None) is not None
        if self._is_raw:
            self._service = node.create_service(
                request["name"], self._service_class, self._handle, with_caller=True
            )
        else:
            self._service = node.create_service(request["name"], self._service_class, self._handle)
        self.name: str = self._service.name

    @classmethod
    def answer(cls, number: int, data: bytes, *, is_error: bool) -> None:
        """Take the answer to a request, by the number that C++ was given."""
        one = cls._answers.get(number)
        if one is not None:
            if is_error:
                one.error = data.decode("utf-8", "replace")
            one.data = data
            one.done.set()

    def close(self) -> None:
        """Take it off the graph; who still waits for an answer is told."""
        self._service.unregister()
        for number in tuple(self._open):
            self.answer(number, _LEFT.encode(), is_error=True)

    def _handle(self, request: Any, caller: str = "") -> Any:
        number = next(self._numbers)
        one = self._answers[number] = _Answer()
        self._open.add(number)
        try:
            info = (bytes(16), number, 0, caller.encode())
            self._core.on_request(self._number, number, encode(request), info)
            one.done.wait()
        finally:
            self._open.discard(number)
            self._answers.pop(number, None)
        if one.error is not None:
            raise ServiceRefusedError(one.error)
        return decode(response_type(self._service_class), one.data)


class HostClient:
    """A client of C++.

    Attributes:
        name: global name.
    """

    def __init__(self, node: Any, request: dict[str, Any]) -> None:
        """Prepare it; `request` is that of the verb ``service/client``."""
        self._service_class = _service_class(node, request["type"])
        self._client = node.create_client(request["name"], self._service_class)
        self.name: str = self._client.name

    @property
    def is_ready(self) -> bool:
        """Whether somebody offers the service; the graph is not asked for what it has told."""
        client = self._client
        return bool(client.known_to_be_available or client.available)

    def wait(self, timeout_s: float) -> bool:
        """Wait until somebody offers the service."""
        return bool(self._client.wait_for_service(timeout_s))

    def ask(self, data: bytes, timeout_s: float | None) -> Callable[[], bytes]:
        """Send a request and return what waits for the response's bytes."""
        wanted = request_type(self._service_class)
        answer = self._client.send(decode(wanted, data), timeout_s)
        return lambda: encode(answer())

    def close(self) -> None:
        """Give it up, with the calls under way."""
        self._client.unregister()


class Calls:
    """Waits for responses in threads of its own, as many as there are calls at a time."""

    def __init__(self, core: Core) -> None:
        self._core = core
        self._idle = 0
        self._jobs: queue.SimpleQueue[Callable[[], None] | None] = queue.SimpleQueue()
        self._lock = threading.Lock()
        self._closed = False

    def ask(
        self,
        client: HostClient,
        call: int,
        data: bytes,
        timeout_s: float | None,
        *,
        is_waiting: bool,
    ) -> None:
        """Send a request now; C++ gets the response from another thread, or before this returns."""
        try:
            answer = client.ask(data, timeout_s)
        except GazelleError as error:
            self._fail(call, error)
            return
        if is_waiting:
            self._finish(call, answer)
            return
        with self._lock:
            self._idle -= 1
            is_short = self._idle < 0
        self._jobs.put(lambda: self._finish(call, answer))
        if is_short:
            start_deaf_thread(self._work)

    def close(self) -> None:
        """Tell C++ of no more responses."""
        self._closed = True

    def _work(self) -> None:
        while (job := self._jobs.get()) is not None:
            job()
            with self._lock:
                self._idle += 1

    def _finish(self, call: int, answer: Callable[[], bytes]) -> None:
        try:
            data = answer()
        except GazelleError as error:
            self._fail(call, error)
            return
        if not self._closed:
            self._core.on_response(call, _OK, data)

    def _fail(self, call: int, error: GazelleError) -> None:
        status = _FAILED
        if isinstance(error, ServiceUnavailableError):
            status = _UNAVAILABLE
        elif isinstance(error, ServiceTimeoutError):
            status = _TIMEOUT
        if not self._closed:
            self._core.on_response(call, status, str(error).encode())


def _service_class(node: Any, type_name: str) -> Any:
    if getattr(node, "graph", None) is not None:
        return raw_service_type(type_name)
    from gazelle.interfaces import service_type

    return service_type(type_name)
