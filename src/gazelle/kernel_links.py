"""Kernels that others call by address, and do not hold a copy of.

Numba puts a copy of all that a kernel calls into its machine code and optimises it there anew: what
lies five calls deep is compiled five times. A kernel that is marked here is compiled once; it gets
a name of its own in the process, by which callers find it, as they find functions of C. Whoever
loads a caller that was kept has to see to it that what it calls has been loaded before: what that
is, is kept beside it.

All of this happens under numba's lock. Importing this imports numba.
"""

from __future__ import annotations

import copy
import hashlib
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Any, NamedTuple

from llvmlite import binding

__all__ = ["Callee", "call_by_address", "callees_so_far", "collecting", "note_call", "require"]


class Callee(NamedTuple):
    """A kernel that is called by address, for some types of arguments."""

    module: str
    name: str
    types: tuple[Any, ...]

    @property
    def symbol(self) -> str:
        """What it is called in this process."""
        said = f"{self.types} {fields_of(self.types)}"
        digest = hashlib.sha256(said.encode()).hexdigest()[:16]
        return f"{self.module}.{self.name}.{digest}"


_marked: set[Any] = set()
_known: dict[tuple[Any, tuple[Any, ...]], frozenset[Callee]] = {}
"""What each kernel calls by address, itself or by the copies that it holds."""
_collected: list[set[Callee]] = []


def fields_of(types: Iterable[Any]) -> tuple[Any, ...]:
    """Return the names of all fields of records, and of records in them."""
    found: list[Any] = []
    for one in types:
        if (members := getattr(one, "types", None)) is not None:
            found += [*getattr(one, "fields", ()), fields_of(members)]
    return tuple(found)


def call_by_address(kernel: Any) -> None:
    """Let other kernels call this one by its address."""
    _marked.add(kernel)
    add_overload = kernel.add_overload

    def add(compiled: Any) -> None:
        add_overload(compiled)
        address = compiled.library.get_pointer_to_function(compiled.fndesc.mangled_name)
        if not address:
            return
        described = copy.copy(compiled.fndesc)
        described.mangled_name = _callee(kernel, compiled.signature.args).symbol
        binding.add_symbol(described.mangled_name, address)
        # Of two of the same types numba takes the later one.
        kernel.targetctx.insert_user_function(compiled.entry_point, described, ())

    kernel.add_overload = add


@contextmanager
def collecting(kernel: Any, types: tuple[Any, ...]) -> Iterator[None]:
    """Note what a kernel calls while it is compiled or loaded."""
    _collected.append(set())
    try:
        yield
    finally:
        _known[kernel, types] = frozenset(_collected.pop())


def note_call(kernel: Any, types: tuple[Any, ...]) -> None:
    """Note that the kernel that is being compiled calls another one."""
    if not _collected:
        return
    if kernel in _marked:
        _collected[-1].add(_callee(kernel, types))
    else:
        _collected[-1] |= _known.get((kernel, types), frozenset())


def callees_so_far() -> tuple[Callee, ...]:
    """Return what the kernel that is being compiled calls by address."""
    return tuple(sorted(_collected[-1], key=lambda one: one.symbol)) if _collected else ()


def require(callees: Iterable[Callee]) -> None:
    """Compile or load what a kernel calls by address before the kernel itself is loaded.

    Raises:
        LookupError: it cannot be called by address here.
    """
    for callee in callees:
        getattr(import_module(callee.module), callee.name).compile(callee.types)
        if binding.address_of_symbol(callee.symbol) is None:
            raise LookupError(f"'{callee.name}' has no address")
        if _collected:
            _collected[-1].add(callee)


def _callee(kernel: Any, types: tuple[Any, ...]) -> Callee:
    function = kernel.py_func
    return Callee(function.__module__, function.__name__, tuple(types))
