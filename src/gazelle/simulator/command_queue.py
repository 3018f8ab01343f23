"""Commands from topics and services wait here and are applied between steps."""

from __future__ import annotations

import threading
import traceback
from collections import deque
from collections.abc import Callable
from typing import Any, TypeVar

from gazelle.errors import GazelleError

__all__ = ["CommandQueue", "error_text", "telling"]

_Result = TypeVar("_Result")
_LOOK_S = 0.005


class _Call:
    """A command whose caller waits for the result."""

    __slots__ = ("_claim", "command", "done", "error", "result")

    def __init__(self, command: Callable[[], Any]) -> None:
        self.command = command
        self.done = threading.Event()
        self._claim = threading.Lock()
        self.result: Any = None
        self.error: BaseException | None = None

    def __call__(self) -> None:
        if not self._claim.acquire(blocking=False):
            return
        try:
            self.result = self.command()
        except Exception as error:  # noqa: BLE001 - it is raised again in the caller's thread
            self.error = error
        self.done.set()

    def give_up(self) -> bool:
        """Have it never begin, as its caller waits no more; False when it has begun."""
        return self._claim.acquire(blocking=False)


def error_text(error: Exception) -> str:
    """Return an error's words, with the traceback of one that nobody foresaw."""
    known = isinstance(error, GazelleError)
    return str(error) if known else "".join(traceback.format_exception(error)).rstrip()


def telling(log: Callable[[Any, str], None]) -> Callable[[Exception], None]:
    """Return what tells a log of an error."""
    return lambda error: log("ERROR", error_text(error))


class CommandQueue:
    """Hands work from transport threads to the one thread that owns the world.

    While a loop runs, `post` and `call` only queue; otherwise, and in the loop's own thread,
    they act at once (under a lock, so that one thread at a time touches the world). `post` never
    waits: threads of the transport post, and what another command asks of the graph would reach
    nobody while they wait for its end.
    """

    def __init__(self, failed: Callable[[Exception], None]) -> None:
        """Start empty.

        Args:
            failed: told what a command raised for whose result nobody waits.
        """
        self._failed = failed
        self._queue: deque[Callable[[], Any]] = deque()
        self._arrived = threading.Event()
        self._owner: int | None = None
        self._acting: int | None = None
        self._lock = threading.RLock()

    def post(self, command: Callable[[], Any]) -> None:
        """Have a command applied between steps; does not wait, not even for other commands."""
        if threading.get_ident() in (self._owner, self._acting):
            self._run(command)
        else:
            self._enqueue(command)

    def call(self, command: Callable[[], _Result], *, timeout_s: float = 60.0) -> _Result:
        """Have a command applied between steps, wait for it and return its result.

        Raises:
            GazelleError: the world server was closed or did not answer in time. A command that
                has not begun by then never does.
            Exception: whatever `command` raised.
        """
        if self._take_world():
            try:
                return self._act(command)
            finally:
                self._lock.release()
                self._apply_left()
        waiting = _Call(command)
        self._enqueue(waiting)
        if not waiting.done.wait(timeout_s):
            done = "take" if waiting.give_up() else "end"
            raise GazelleError(f"the simulation did not {done} a command within {timeout_s:g} s")
        if waiting.error is not None:
            raise waiting.error
        result: _Result = waiting.result
        return result

    def apply(self) -> None:
        """Run everything queued; the owner of the world calls this between steps."""
        if not self._queue:
            return
        self._arrived.clear()
        while self._queue:
            self._run(self._queue.popleft())

    def wait(self, timeout_s: float | None) -> bool:
        """Sleep until a command arrives or the time is over; True when one arrived."""
        return self._arrived.wait(timeout_s)

    def wake(self) -> None:
        """End a `wait` early."""
        self._arrived.set()

    def clear_wake(self) -> None:
        """Forget a wake-up that had no command."""
        if not self._queue:
            self._arrived.clear()

    def own(self) -> None:
        """The calling thread runs the loop from now on."""
        self._lock.acquire()
        self._owner = threading.get_ident()

    def disown(self) -> None:
        """The loop has ended; what is still queued is applied."""
        self.apply()
        self._owner = None
        self._lock.release()
        self._apply_left()

    def _run(self, command: Callable[[], Any]) -> None:
        try:
            command()
        except Exception as error:  # noqa: BLE001 - one command does not end the world
            self._failed(error)

    def _enqueue(self, command: Callable[[], Any]) -> None:
        self._queue.append(command)
        self._arrived.set()
        self._apply_left()

    def _apply_left(self) -> None:
        """Run what is queued while no loop does; whoever acts at the moment comes here next."""
        me = threading.get_ident()
        while self._queue and self._owner is None and self._acting != me:
            if not self._lock.acquire(blocking=False):
                return
            try:
                if self._owner is None:
                    self._act(self.apply)
            finally:
                self._lock.release()

    def _act(self, command: Callable[[], _Result]) -> _Result:
        """Run a command; what it posts itself runs within it."""
        outer, self._acting = self._acting, threading.get_ident()
        try:
            return command()
        finally:
            self._acting = outer

    def _take_world(self) -> bool:
        """Take the lock if this thread may act at once; the caller releases it.

        A loop that begins while another thread's command acts takes the lock next and keeps it,
        so whoever waits here asks again.
        """
        while self._acts_now():
            if self._lock.acquire(timeout=_LOOK_S):
                if self._acts_now():
                    return True
                self._lock.release()
        return False

    def _acts_now(self) -> bool:
        return self._owner is None or self._owner == threading.get_ident()
