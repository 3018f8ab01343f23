"""How kernels are made: numba's ``njit``, and one process at a time compiles a kernel.

Of the processes of a launch several want the same kernel at the same moment. Where nothing is in
numba's cache yet each would compile it, for seconds; here the others wait for the first one and
load what it has kept.

What numba has kept for a kernel holds the machine code of the kernels it calls, and numba asks
only whether the kernel's own file is older; here it asks for theirs, too.

Importing this module imports numba.
"""

from __future__ import annotations

import contextlib
import os
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numba
from numba.core.compiler_lock import global_compiler_lock

__all__ = ["njit"]

_LONGEST_WAIT_S = 60.0
"""Whoever compiles for longer was stopped in the middle: nobody waits for that."""

_LOOK_EVERY_S = 0.02

_held: set[Path] = set()
_stamps: dict[Any, set[Any]] = {}
"""Of each kernel: the stamps of its file and of those of all kernels it calls."""


def njit(**options: Any) -> Callable[[Callable[..., Any]], Any]:
    """Return numba's decorator with these options; its kernels are compiled in turn.

    Dividing by zero gives infinity or NaN, as in NumPy: without the exception there is a quarter
    less to compile.
    """

    def decorate(function: Callable[..., Any]) -> Any:
        kernel = numba.njit(error_model="numpy", **options)(function)
        # With NUMBA_DISABLE_JIT it is the function itself.
        if options.get("cache") and hasattr(kernel, "compile"):
            _depend_on_callees(kernel)
            _compile_in_turn(kernel)
        return kernel

    return decorate


def _depend_on_callees(kernel: Any) -> None:
    """Let a kernel's cache be stale where the file of a kernel it calls has changed."""
    function = kernel.py_func
    kept = kernel._cache._cache_file
    stamps = {kept._source_stamp}
    for name in function.__code__.co_names:
        callee = function.__globals__.get(name)
        if hasattr(callee, "py_func"):
            stamps |= _stamps.get(callee, set())
    _stamps[kernel] = stamps
    kept._source_stamp = tuple(sorted(stamps))


def _compile_in_turn(kernel: Any) -> None:
    compile_alone = kernel.compile
    function = kernel.py_func
    name = f"{function.__module__}.{function.__qualname__}.lock"

    def compile_(signature: Any) -> Any:
        # Numba's own lock first: who waits for it must not keep other processes waiting.
        with global_compiler_lock, _turn(Path(kernel.stats.cache_path) / name):
            return compile_alone(signature)

    kernel.compile = compile_


@contextlib.contextmanager
def _turn(path: Path) -> Iterator[None]:
    """Hold a file locked; without it where that cannot be, or not soon.

    The system lets go of it when a process ends, however that happens.
    """
    if path in _held:
        yield
        return
    with contextlib.ExitStack() as stack:
        with contextlib.suppress(OSError):
            path.parent.mkdir(parents=True, exist_ok=True)
            descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
            stack.callback(os.close, descriptor)
            if _locked(descriptor):
                stack.callback(_unlock, descriptor)
        _held.add(path)
        stack.callback(_held.discard, path)
        yield


def _locked(descriptor: int) -> bool:
    """Wait for a file's lock; tells whether it is ours."""
    until = time.monotonic() + _LONGEST_WAIT_S
    while not _lock(descriptor):
        if time.monotonic() > until:
            return False
        time.sleep(_LOOK_EVERY_S)
    return True


if sys.platform == "win32":
    import msvcrt

    def _lock(descriptor: int) -> bool:
        try:
            msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)
        except PermissionError:
            return False
        return True

    def _unlock(descriptor: int) -> None:
        os.lseek(descriptor, 0, os.SEEK_SET)
        msvcrt.locking(descriptor, msvcrt.LK_UNLCK, 1)
else:
    import fcntl

    def _lock(descriptor: int) -> bool:
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True

    def _unlock(descriptor: int) -> None:
        fcntl.flock(descriptor, fcntl.LOCK_UN)
