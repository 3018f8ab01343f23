"""How sessions of the transport end."""

from __future__ import annotations

import contextlib
import ctypes
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

__all__ = ["CallsInFlight", "close_session"]


class CallsInFlight:
    """Counts threads that wait inside the transport.

    A thread that is still there when Python ends is ended by force, and the transport's frames
    cannot be: the process would abort.
    """

    def __init__(self) -> None:
        self._count = 0
        self._changed = threading.Condition()

    @contextmanager
    def waiting(self) -> Iterator[None]:
        """Mark the calling thread as one that waits."""
        with self._changed:
            self._count += 1
        try:
            yield
        finally:
            with self._changed:
                self._count -= 1
                self._changed.notify_all()

    def wait_until_none(self, timeout_s: float) -> bool:
        """Wait until no thread waits any more; False when time is up first."""
        with self._changed:
            return self._changed.wait_for(lambda: self._count == 0, timeout_s)


_CLOSE_S = 2.0


def close_session(session: Any, then: Callable[[], None] | None = None) -> None:
    """Leave; what the session declared disappears for all others.

    The transport waits up to ten seconds for its threads, which may be in the middle of a link
    that just broke. They get two here; the process' end takes the rest.

    The object stays for good (20 kB). Its destructor waits for the transport's threads, too, but
    does not let other threads of Python run meanwhile, and a callback of another session that one
    of these is in would wait for just that: everything in the process stood still for ten seconds,
    and all its links were lost.

    Args:
        session: the one to close.
        then: called when it is closed, however long that takes.
    """
    ctypes.pythonapi.Py_IncRef(ctypes.py_object(session))
    words = (session, then or _do_nothing)
    closing = threading.Thread(target=_close, args=words, name="gazelle-close", daemon=True)
    try:
        closing.start()
    except RuntimeError:
        # Python 3.12 and later start no thread at the process' very end.
        _close(*words)
    else:
        closing.join(_CLOSE_S)


def _close(session: Any, then: Callable[[], None]) -> None:
    import zenoh

    with contextlib.suppress(zenoh.ZError):
        session.close()
    then()


def _do_nothing() -> None:
    pass
