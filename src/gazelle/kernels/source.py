"""The source of a kernel: its tree, which names stay what they are, and what it depends on."""

from __future__ import annotations

import ast
import functools
import hashlib
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

__all__ = [
    "External",
    "KernelSource",
    "Use",
    "digest_of",
    "fingerprint",
    "settled_names",
    "stored_names",
    "tree_of",
]


class KernelSource(NamedTuple):
    """A function that is to be compiled.

    Attributes:
        function: Python's.
        flags: LLVM's of its arithmetic with floats, e.g. ``nsz reassoc``.
    """

    function: Callable[..., Any]
    flags: str = ""

    @property
    def name(self) -> str:
        """With its module."""
        return f"{self.function.__module__}.{self.function.__qualname__}"


class External(NamedTuple):
    """A function of a library, by its name there, that takes addresses and returns nothing."""

    name: str
    arguments: int


def fingerprint(thing: Any) -> str:
    """Return what changes where something of a module is another thing; empty for modules."""
    source = getattr(thing, "source", None)
    if isinstance(source, KernelSource):
        return digest_of(source)
    if isinstance(thing, bool | int | float | str | tuple | np.generic | np.dtype):
        return f"{type(thing).__name__} {thing!r}"
    name = getattr(thing, "__qualname__", "")
    return f"{thing.__module__}.{name} {getattr(thing, '_fields', '')}" if name else ""


@functools.cache
def _functions_of(file: str) -> dict[tuple[str, int], ast.FunctionDef]:
    tree = ast.parse(Path(file).read_text(encoding="utf-8"), file)
    found = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef):
            # A function begins at its first decorator.
            lines = [node.lineno, *(one.lineno for one in node.decorator_list)]
            found[node.name, min(lines)] = node
    return found


def tree_of(source: KernelSource) -> ast.FunctionDef:
    """Return the tree of a kernel's function.

    Raises:
        TypeError: its file is not there, or has another function in its place by now.
    """
    code = source.function.__code__
    try:
        found = _functions_of(code.co_filename)[code.co_name, code.co_firstlineno]
    except (KeyError, OSError, SyntaxError):
        place = f"{code.co_filename}:{code.co_firstlineno}"
        raise TypeError(f"the source of the kernel {source.name} is not at {place}") from None
    return found


def digest_of(source: KernelSource) -> str:
    """Return what changes where the function does."""
    code = source.function.__code__
    words = (code.co_code, code.co_consts, code.co_names, code.co_varnames, source.flags)
    return hashlib.sha256(repr(words).encode()).hexdigest()


class Use(NamedTuple):
    """Something of a module that what was compiled depends on, and what it was then."""

    module: str
    name: str
    fingerprint: str


class _Place(NamedTuple):
    """Where a name is: the blocks of statements around it, and its place in the file."""

    blocks: tuple[int, ...]
    line: int
    column: int


def settled_names(function: ast.FunctionDef) -> frozenset[str]:
    """Return the names that are given a value once, before and around all their uses.

    They stand for their value; others have a place in memory, as their value is another one after
    a branch or in the next round of a loop.
    """
    stores: dict[str, list[_Place]] = {}
    loads: dict[str, list[_Place]] = {}
    for argument in function.args.args:
        stores.setdefault(argument.arg, []).append(_Place((), 0, 0))
    _note(function.body, (), stores, loads)
    return frozenset(
        name
        for name, found in stores.items()
        if len(found) == 1 and all(_is_behind(use, found[0]) for use in loads.get(name, ()))
    )


def stored_names(function: ast.FunctionDef) -> frozenset[str]:
    """Return all names that a function gives a value to."""
    return frozenset(
        node.id
        for node in ast.walk(function)
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
    )


def _is_behind(use: _Place, store: _Place) -> bool:
    is_around = use.blocks[: len(store.blocks)] == store.blocks
    return is_around and (use.line, use.column) > (store.line, store.column)


def _note(
    body: Iterable[ast.stmt],
    blocks: tuple[int, ...],
    stores: dict[str, list[_Place]],
    loads: dict[str, list[_Place]],
) -> None:
    for statement in body:
        inner = (*blocks, id(statement))
        match statement:
            case ast.For():
                _note_names([statement.target], inner, stores, loads)
                _note_names([statement.iter], blocks, stores, loads)
                _note(statement.body, inner, stores, loads)
            case ast.While():
                _note_names([statement.test], blocks, stores, loads)
                _note(statement.body, inner, stores, loads)
            case ast.If():
                _note_names([statement.test], blocks, stores, loads)
                _note(statement.body, inner, stores, loads)
                _note(statement.orelse, (*inner, 1), stores, loads)
            case ast.AugAssign(target=ast.Name() as name):
                _note_names([name, statement.value], blocks, stores, loads)
                loads.setdefault(name.id, []).append(_Place(blocks, name.lineno, name.col_offset))
            case _:
                _note_names([statement], blocks, stores, loads)


def _note_names(
    nodes: Sequence[ast.AST],
    blocks: tuple[int, ...],
    stores: dict[str, list[_Place]],
    loads: dict[str, list[_Place]],
) -> None:
    for root in nodes:
        for node in ast.walk(root):
            if isinstance(node, ast.Name):
                names = stores if isinstance(node.ctx, ast.Store) else loads
                use = _Place(blocks, node.lineno, node.col_offset)
                names.setdefault(node.id, []).append(use)
