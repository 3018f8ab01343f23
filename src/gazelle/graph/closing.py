"""How sessions of the transport end."""

from __future__ import annotations

import contextlib
import ctypes
import threading
from collections.abc import Callable
from typing import Any

__all__ = ["close_session"]

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
