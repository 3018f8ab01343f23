"""Kernels: functions that are compiled for this machine when they are first called.

A kernel is written in Python, of the part of it that `lowering` knows, and is compiled anew for
each kind of arguments it is given. What was compiled is kept (`kept_code`).
"""

from __future__ import annotations

import contextlib
import functools
import hashlib
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any, NamedTuple, overload

import numpy as np

from gazelle.announcements import announce
from gazelle.kernels.areas import COMPILING, area_of
from gazelle.kernels.kept_code import KeptCode, file_of, keep, kept
from gazelle.kernels.kernel_types import (
    Array,
    KernelType,
    Scalar,
    Tuple,
    described,
    has_arrays,
    type_of,
)
from gazelle.kernels.source import KernelSource, digest_of
from gazelle.kernels.turns import turn

__all__ = ["Kernel", "compiling", "kernel", "kernels", "tell"]

_lock = threading.RLock()
_all: list[Kernel] = []
_watchers: list[Callable[[KernelSource, float], None]] = []


class _Entry(NamedTuple):
    """What runs a kernel for arguments of some types, and makes its result of what comes back."""

    run: Callable[..., Any]
    finish: Callable[[Any], Any] | None


class Kernel:
    """A function that is compiled when it is called.

    Attributes:
        source: what is compiled.
        signatures: the types of arguments it was loaded or compiled for so far.
    """

    def __init__(self, source: KernelSource) -> None:
        """Keep a function; nothing is compiled yet."""
        functools.update_wrapper(self, source.function)
        self.source = source
        self.signatures: list[tuple[KernelType, ...]] = []
        self._entries: tuple[_Entry, ...] = ()

    def __repr__(self) -> str:
        """Tell it from others."""
        return f"<kernel {self.source.name}>"

    def __call__(self, *arguments: Any) -> Any:
        """Run it.

        Raises:
            TypeError: an argument is of a kind that kernels do not take, or the source holds what
                is not for kernels, with its place.
        """
        for entry in self._entries:
            result = entry.run(*arguments)
            if result is not NotImplemented:
                return result if entry.finish is None else entry.finish(result)
        return self._first_call(arguments)

    def _first_call(self, arguments: tuple[Any, ...]) -> Any:
        types = tuple(map(type_of, arguments))
        with _lock:
            if types not in self.signatures:
                self._entries = (*self._entries, self._entry(types))
                self.signatures.append(types)
        entry = self._entries[self.signatures.index(types)]
        result = entry.run(*arguments)
        if result is NotImplemented:
            words = ", ".join(map(described, types))
            raise TypeError(f"{self.source.name}() cannot be given ({words}) as they are")
        return result if entry.finish is None else entry.finish(result)

    def _entry(self, types: tuple[KernelType, ...]) -> _Entry:
        # Who imports kernels and calls none waits for nothing.
        from gazelle.kernels import machine_code
        from gazelle.kernels.python_entry import classes_of

        file = file_of(self.source, types, machine_code.machine())
        with contextlib.ExitStack() as stack:
            code = kept(file, self.source) if file is not None else None
            if code is None and file is not None:
                stack.enter_context(turn(file.with_suffix(".lock"), self.source))
                # Another process may have been faster.
                code = kept(file, self.source)
            if code is None:
                code = _compiled(self.source, types)
                if file is not None:
                    keep(file, code)
        machine_code.load(code.content, classes_of(types))
        return _Entry(machine_code.callable_of(code.name), _finish(code.result))


def _compiled(source: KernelSource, types: tuple[KernelType, ...]) -> KeptCode:
    from gazelle.kernels import machine_code
    from gazelle.kernels.program import Program
    from gazelle.kernels.python_entry import entry

    tell(source)
    began = time.thread_time()
    program = Program()
    compiled = program.function(source, types)
    digest = hashlib.sha256(repr((source.name, types)).encode()).hexdigest()[:16]
    name = f"gazelle_{source.function.__name__}_{digest}"
    content = machine_code.object_code(program.text() + entry(name, types, compiled))
    for watcher in _watchers:
        watcher(source, time.thread_time() - began)
    uses = tuple(program.uses.values())
    return KeptCode(digest_of(source), uses, compiled.result, name, content)


def tell(source: KernelSource) -> None:
    """Say that a kernel is compiled, of each area once in a process."""
    area = area_of(source.function.__module__)
    if area is not None:
        announce(
            f"{COMPILING}{area.what} for this machine: up to {area.compile_s} s of computing, "
            "once ('gazelle warm' does it ahead)",
            key=area.package,
        )


def _finish(kind: KernelType) -> Callable[[Any], Any] | None:
    """Return what makes a result of what the entry gives back, None where that is it."""
    match kind:
        case Array(element=Scalar() as scalar):
            dtype = np.dtype(scalar.name)
            return lambda given: np.frombuffer(given[0], dtype).reshape(given[1])
        case Tuple():
            steps = [_finish(element) for element in kind.elements]
            maker = kind.maker
            if maker is None and not has_arrays(kind) and steps == [None] * len(steps):
                return None

            def finish(given: tuple[Any, ...]) -> Any:
                items = [
                    one if step is None else step(one)
                    for one, step in zip(given, steps, strict=True)
                ]
                return tuple(items) if maker is None else maker(*items)

            return finish
    return None


def kernels() -> tuple[Kernel, ...]:
    """Return all kernels that were imported so far."""
    return tuple(_all)


@contextlib.contextmanager
def compiling(watcher: Callable[[KernelSource, float], None]) -> Iterator[None]:
    """Let a function know each kernel that is compiled meanwhile, and the seconds it took."""
    _watchers.append(watcher)
    try:
        yield
    finally:
        _watchers.remove(watcher)


@overload
def kernel(function: Callable[..., Any], /) -> Kernel: ...
@overload
def kernel(*, flags: str) -> Callable[[Callable[..., Any]], Kernel]: ...
def kernel(function: Callable[..., Any] | None = None, /, *, flags: str = "") -> Any:
    """Let a function be compiled when it is called; a decorator, also with flags.

    Args:
        function: written of what kernels know.
        flags: what may be done with arithmetic of floats, LLVM's words: ``nsz reassoc``; ``fast``
            is all of them.
    """

    def decorate(function: Callable[..., Any]) -> Kernel:
        made = Kernel(KernelSource(function, flags))
        _all.append(made)
        return made

    return decorate if function is None else decorate(function)
