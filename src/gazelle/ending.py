"""The end of a process that has been on a graph."""

from __future__ import annotations

import atexit
import os
import signal
import socket
import sys
import threading
from collections.abc import Callable
from typing import NoReturn

__all__ = ["at_stop_signal", "end_with"]

_SIGNALS = (signal.SIGINT, signal.SIGTERM)


def end_with(main: Callable[[], int]) -> NoReturn:
    """Run a program's main function and end the process with what it returns.

    Everything Python does at its end is done but the last: it does not take itself apart. A
    thread of the transport that called in at that very moment would be ended by force, its frames
    cannot be, and the process would abort with the work long done.
    """
    code = _code_of(main)
    # Also tells the pools of concurrent.futures to end, whose threads wait for ever otherwise.
    threading._shutdown()  # type: ignore[attr-defined]
    atexit._run_exitfuncs()
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except (OSError, ValueError):
            # Its reader has gone, or the program closed it.
            continue
    os._exit(code)


def at_stop_signal(stop: Callable[[], object]) -> None:
    """Call something on SIGINT and SIGTERM, at once whatever the main thread is doing.

    Python's own handlers run in the main thread when it next wakes: one that begins to wait just
    as the signal comes, or whose signal the kernel gave to another thread, sleeps on. So a thread
    is woken by the signal's number and calls it too; it must not mind being called twice.
    """
    near, far = socket.socketpair()
    far.setblocking(False)
    for number in _SIGNALS:
        signal.signal(number, lambda *_: stop())
    signal.set_wakeup_fd(far.fileno(), warn_on_full_buffer=False)
    # It must live as long as the process: so the thread holds both ends.
    threading.Thread(target=_listen, args=(near, far, stop), daemon=True).start()


def _listen(near: socket.socket, _far: socket.socket, stop: Callable[[], object]) -> None:
    while numbers := near.recv(16):
        if any(number in numbers for number in _SIGNALS):
            stop()


def _code_of(main: Callable[[], int]) -> int:
    try:
        return main()
    except SystemExit as stop:
        if isinstance(stop.code, str):
            sys.stderr.write(f"{stop.code}\n")
        return stop.code if isinstance(stop.code, int) else int(stop.code is not None)
    except KeyboardInterrupt:
        return 130
    except BaseException:  # noqa: BLE001 - told as Python tells it
        sys.excepthook(*sys.exc_info())
        return 1
