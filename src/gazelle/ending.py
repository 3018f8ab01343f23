"""The end of a process that has been on a graph."""

from __future__ import annotations

import atexit
import os
import sys
import threading
from collections.abc import Callable
from typing import NoReturn

__all__ = ["end_with"]


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
