"""Signals of the process as calls in an event loop."""

from __future__ import annotations

import asyncio
import signal
import socket
import warnings
from collections.abc import Callable
from typing import Any

__all__ = [
    "AsyncSafeSignalManager",
    "create_future",
    "install_signal_handlers",
    "on_sigint",
    "on_sigquit",
    "on_sigterm",
]

_Handler = Callable[[int], Any]


class AsyncSafeSignalManager:
    """Calls handlers of signals in an event loop, as long as it is entered.

    Python writes the number of every signal to a file descriptor; the loop reads it. So nothing
    runs inside of whatever the signal interrupted. Managers nest: an inner one passes on what it
    gets.
    """

    def __init__(self, loop: asyncio.AbstractEventLoop) -> None:
        self._loop = loop
        self._handlers: dict[signal.Signals, _Handler] = {}
        self._previous: dict[signal.Signals, Any] = {}
        self._pair: tuple[socket.socket, socket.socket] | None = None
        self._outer_fd = -1

    def __enter__(self) -> AsyncSafeSignalManager:
        near, far = socket.socketpair()
        near.setblocking(False)
        far.setblocking(False)
        self._pair = near, far
        self._loop.add_reader(near.fileno(), self._read)
        self._outer_fd = signal.set_wakeup_fd(far.fileno(), warn_on_full_buffer=False)
        return self

    def __exit__(self, *_exception: object) -> None:
        assert self._pair is not None
        for number in list(self._handlers):
            self.handle(number, None)
        signal.set_wakeup_fd(self._outer_fd)
        self._loop.remove_reader(self._pair[0].fileno())
        for end in self._pair:
            end.close()
        self._pair = None

    def handle(self, signum: int, handler: _Handler | None) -> _Handler | None:
        """Set what a signal calls, None for nothing more; return what it called before.

        Raises:
            ValueError: the handler cannot be called.
        """
        number = signal.Signals(signum)
        old = self._handlers.pop(number, None)
        if handler is None:
            if number in self._previous:
                signal.signal(number, self._previous.pop(number))
            return old
        if not callable(handler):
            raise ValueError("signal handler must be a callable")
        self._handlers[number] = handler
        if number not in self._previous:
            # Without a handler of Python's own the signal would end the process.
            self._previous[number] = signal.signal(number, lambda *_: None)
        return old

    def _read(self) -> None:
        assert self._pair is not None
        try:
            numbers = self._pair[0].recv(4096)
        except BlockingIOError:
            return
        for number in numbers:
            handler = self._handlers.get(signal.Signals(number))
            if handler is not None:
                handler(number)


def create_future(loop: asyncio.AbstractEventLoop) -> asyncio.Future[Any]:
    """Return a future of a loop (Foxy to Iron have this)."""
    return loop.create_future()


def install_signal_handlers() -> None:
    """Do nothing but warn: Foxy's way of handling signals, which it had deprecated itself."""
    _warn("install_signal_handlers")


def on_sigint(handler: Callable[..., Any] | None) -> None:
    """Set a handler of SIGINT (Foxy has this, and calls it deprecated)."""
    _warn("on_sigint")
    _set(signal.SIGINT, handler)


def on_sigterm(handler: Callable[..., Any] | None) -> None:
    """Set a handler of SIGTERM (Foxy has this, and calls it deprecated)."""
    _warn("on_sigterm")
    _set(signal.SIGTERM, handler)


def on_sigquit(handler: Callable[..., Any] | None) -> None:
    """Set a handler of SIGQUIT (Foxy has this, and calls it deprecated)."""
    _warn("on_sigquit")
    _set(signal.SIGQUIT, handler)


def _set(number: signal.Signals, handler: Callable[..., Any] | None) -> None:
    signal.signal(number, signal.SIG_DFL if handler is None else handler)


def _warn(name: str) -> None:
    warnings.warn(f"{name}() is deprecated, use AsyncSafeSignalManager", stacklevel=3)
