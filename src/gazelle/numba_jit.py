"""How kernels are made: numba's ``njit``, and one process at a time compiles a kernel.

Of the processes of a launch several want the same kernel at the same moment. Where nothing is in
the cache (`gazelle.kernel_cache`) yet each would compile it, for seconds; here the others wait for
the first one and load what it has kept. Who compiles says so before, and who waits says so, once.

Importing this module imports numba.
"""

from __future__ import annotations

import contextlib
import os
import sys
import time
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numba
from numba import types
from numba.core import config, errors, sigutils
from numba.core.compiler_lock import global_compiler_lock

from gazelle import kernel_links
from gazelle.announcements import announce
from gazelle.kernel_cache import KernelCache

__all__ = ["AREAS", "Area", "area_of", "kernels", "njit"]

_MAX_WAIT_S = 60.0
"""Whoever compiles for longer was stopped in the middle: nobody waits for that."""

_LOOK_EVERY_S = 0.02
_PATIENCE_S = 1.0


def _as_it_is(_scheme: object, msg: str, *_colour: object) -> str:
    return msg


# Where colorama is installed, numba puts other streams for `sys.stdout` and `sys.stderr` at each
# word of each complaint, of which compiling makes thousands and drops them, and puts back what it
# found: a thread that compiles would take what another one has set meanwhile.
if config.COLOR_SCHEME == "no_color" and hasattr(errors, "HighlightColorScheme"):
    errors.HighlightColorScheme._markup = _as_it_is

_held: set[Path] = set()
_kernels: list[Any] = []


class Area(NamedTuple):
    """Kernels that are wanted together.

    Attributes:
        package: part of Gazelle that they belong to.
        what: they are for, in words.
        compile_s: processor time of compiling all of them, about; `benchmarks/bench_kernels.py`.
    """

    package: str
    what: str
    compile_s: int


AREAS = (
    Area("sensors", "cameras", 6),
    Area("mapping", "SLAM", 12),
    Area("motion", "arm planning", 23),
    Area("navigation", "navigation", 21),
)
"""All that is compiled."""


def area_of(module: str) -> Area | None:
    """Return what a module's kernels are for, None for those that others call."""
    package = module.partition(".")[2].partition(".")[0]
    return next((area for area in AREAS if area.package == package), None)


def kernels() -> tuple[Any, ...]:
    """Return numba's dispatchers of all kernels that were imported so far."""
    return tuple(_kernels)


def njit(
    *, cache: bool = False, is_called_by_address: bool = False, **options: Any
) -> Callable[[Callable[..., Any]], Any]:
    """Return numba's decorator with these options; its kernels are compiled in turn.

    Dividing by zero gives infinity or NaN, as in NumPy: without the exception there is a quarter
    less to compile. A function whose name begins with an underscore can be called by kernels only.

    Args:
        cache: what is compiled is kept for other processes.
        is_called_by_address: other kernels do not hold a copy of it, which each of them would
            compile anew; for large ones, whose calls cost nothing beside what they do.
        options: of numba.
    """

    def decorate(function: Callable[..., Any]) -> Any:
        kernel = numba.njit(
            error_model="numpy",
            # Nobody calls kernels from C.
            no_cfunc_wrapper=True,
            no_cpython_wrapper=function.__name__.startswith("_"),
            **options,
        )(function)
        # With NUMBA_DISABLE_JIT it is the function itself.
        if not hasattr(kernel, "compile"):
            return kernel
        _see_no_literals(kernel)
        if cache:
            kernel._cache = KernelCache(function, kernel, lambda: _tell(function.__module__))
        _compile_in_turn(kernel)
        if is_called_by_address:
            kernel_links.call_by_address(kernel)
        _kernels.append(kernel)
        return kernel

    return decorate


def _tell(module: str) -> None:
    """Say what is compiled before it is."""
    area = area_of(module)
    if area is not None:
        announce(
            f"compiling the kernels of {area.what} for this machine: up to {area.compile_s} s of "
            "computing, once ('gazelle warm' does it ahead)",
            key=area.package,
        )


def _see_no_literals(kernel: Any) -> None:
    """Let a kernel be compiled for integers, not for each number that other kernels give it."""
    call_template = kernel.get_call_template

    def plain(given: Iterable[Any], named: dict[str, Any]) -> Any:
        named = {name: types.unliteral(one) for name, one in named.items()}
        found = call_template(tuple(map(types.unliteral, given)), named)
        kernel_links.note_call(kernel, tuple(found[2]))
        return found

    kernel.get_call_template = plain


def _compile_in_turn(kernel: Any) -> None:
    compile_alone = kernel.compile
    function = kernel.py_func
    name = f"{function.__module__}.{function.__qualname__}.lock"

    def compile_(signature: Any) -> Any:
        given, _ = sigutils.normalize_signature(signature)
        if (compiled := kernel.overloads.get(tuple(given))) is not None:
            return compiled.entry_point
        folder = kernel.stats.cache_path
        # Numba's own lock first: who waits for it must not keep other processes waiting.
        with (
            global_compiler_lock,
            _turn(Path(folder) / name) if folder else _NOBODY,
            kernel_links.collecting(kernel, tuple(given)),
        ):
            return compile_alone(signature)

    kernel.compile = compile_


_NOBODY = contextlib.nullcontext()


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
            if _locked(descriptor, path):
                stack.callback(_unlock, descriptor)
        _held.add(path)
        stack.callback(_held.discard, path)
        yield


def _locked(descriptor: int, path: Path) -> bool:
    """Wait for a file's lock; tells whether it is ours."""
    began = time.monotonic()
    while not _lock(descriptor):
        waited_s = time.monotonic() - began
        if waited_s > _MAX_WAIT_S:
            return False
        if waited_s > _PATIENCE_S:
            _tell_of_waiting(path)
        time.sleep(_LOOK_EVERY_S)
    return True


def _tell_of_waiting(path: Path) -> None:
    area = area_of(path.name)
    what = f" of {area.what}" if area else ""
    announce(
        f"waiting for another process, which is compiling the kernels{what} for this machine, once"
    )


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
