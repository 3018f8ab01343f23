"""How kernels are made: numba's ``njit``, and one process at a time compiles a kernel.

Of the processes of a launch several want the same kernel at the same moment. Where nothing is in
numba's cache yet each would compile it, for seconds; here the others wait for the first one and
load what it has kept.

What numba has kept for a kernel holds the machine code of the kernels it calls, and the places of
fields in the records it is given or makes. Numba asks only whether the kernel's own file is older,
and for the names of the records it is given; here it asks for the files of the kernels that are
called and of the records that are made, and for the names of fields, too.

Importing this module imports numba.
"""

from __future__ import annotations

import contextlib
import copy
import inspect
import os
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

import numba
from numba.core.compiler_lock import global_compiler_lock

__all__ = ["njit"]

_MAX_WAIT_S = 60.0
"""Whoever compiles for longer was stopped in the middle: nobody waits for that."""

_LOOK_EVERY_S = 0.02

_held: set[Path] = set()
_stamps: dict[Any, set[Any]] = {}
"""Of each kernel: the stamps of its file and of those of what it calls and of records it makes."""


def njit(**options: Any) -> Callable[[Callable[..., Any]], Any]:
    """Return numba's decorator with these options; its kernels are compiled in turn.

    Dividing by zero gives infinity or NaN, as in NumPy: without the exception there is a quarter
    less to compile.
    """

    def decorate(function: Callable[..., Any]) -> Any:
        kernel = numba.njit(error_model="numpy", **options)(function)
        # With NUMBA_DISABLE_JIT it is the function itself.
        if options.get("cache") and hasattr(kernel, "compile"):
            _depend_on_files(kernel)
            _depend_on_fields(kernel)
            _pass_over_lost_records(kernel)
            _compile_in_turn(kernel)
        return kernel

    return decorate


def _depend_on_files(kernel: Any) -> None:
    """Let a kernel's cache be stale where a file has changed of what it calls or makes."""
    function = kernel.py_func
    kept = kernel._cache._cache_file
    stamps = {kept._source_stamp}
    for name in function.__code__.co_names:
        used = function.__globals__.get(name)
        if hasattr(used, "py_func"):
            stamps |= _stamps.get(used, set())
        elif isinstance(used, type) and hasattr(used, "_fields"):
            made = copy.copy(kernel._cache._impl.locator)
            made._py_file = inspect.getfile(used)
            stamps.add(made.get_source_stamp())
    _stamps[kernel] = stamps
    kept._source_stamp = tuple(sorted(stamps))


def _depend_on_fields(kernel: Any) -> None:
    """Let a kernel's cache not be for records whose fields had another order."""
    cache = kernel._cache
    index_key = cache._index_key

    def with_fields(signature: Any, codegen: Any) -> tuple[Any, ...]:
        return (*index_key(signature, codegen), _fields(getattr(signature, "args", signature)))

    cache._index_key = with_fields


def _pass_over_lost_records(kernel: Any) -> None:
    """Let what is kept for records that have another name now count as nothing.

    Numba reads which records it is for before it asks whether it is stale, and fails.
    """
    kept = kernel._cache._cache_file
    load_index = kept._load_index

    def loaded() -> Any:
        try:
            return load_index()
        except (AttributeError, ImportError):
            return {}

    kept._load_index = loaded


def _fields(types: Iterable[Any]) -> tuple[Any, ...]:
    """Return the names of all fields of records, and of records in them."""
    found: list[Any] = []
    for one in types:
        if (members := getattr(one, "types", None)) is not None:
            found += [*getattr(one, "fields", ()), _fields(members)]
    return tuple(found)


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
    until = time.monotonic() + _MAX_WAIT_S
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
