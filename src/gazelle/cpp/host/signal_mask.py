"""Signals for programs that are started while C++ waits for Python.

While Python works for C++, the thread has signals blocked: they are for the native handlers. A
program that is started then would have them blocked as well, and CMake would wait for ever for
those that tell the end of its own.
"""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager

__all__ = ["signals_for_children"]


@contextmanager
def signals_for_children() -> Iterator[None]:
    """Let what this thread and those that it makes start have no signal blocked."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    blocked = signal.pthread_sigmask(signal.SIG_SETMASK, set())
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, blocked)
