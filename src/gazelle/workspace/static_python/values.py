"""What an expression may come to besides Python's own plain values."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import PurePath
from typing import Any

__all__ = ["UNKNOWN", "Call", "Function", "Name", "Unknown", "is_known"]

_MAX_DEPTH = 40


class Unknown:
    """A value that only running the file would tell."""

    def __repr__(self) -> str:
        return "UNKNOWN"


UNKNOWN = Unknown()


@dataclass(frozen=True, slots=True)
class Name:
    """Something imported or built in, by its full dotted name."""

    dotted: str

    @property
    def last(self) -> str:
        """The name after the last dot."""
        return self.dotted.rpartition(".")[2]


@dataclass(frozen=True, slots=True, eq=False)
class Call:
    """A call of something whose outcome is not computed, such as ``Node(package=…)``.

    Attributes:
        function: full dotted name of what is called; a method's begins with that of its object.
        arguments: values of the arguments by position.
        keywords: values of the arguments by name.
        node: the call in the syntax tree, for its place.
        owner: the object whose method it is, None for functions.
    """

    function: str
    arguments: tuple[Any, ...]
    keywords: Mapping[str, Any]
    node: ast.Call = field(repr=False)
    owner: Any = None

    @property
    def name(self) -> str:
        """The function's name after the last dot."""
        return self.function.rpartition(".")[2]

    def get(self, name: str, position: int | None = None, default: Any = None) -> Any:
        """Return an argument by name, or by its position when it has no name."""
        if name in self.keywords:
            return self.keywords[name]
        if position is not None and position < len(self.arguments):
            return self.arguments[position]
        return default


@dataclass(frozen=True, slots=True, eq=False)
class Function:
    """A function defined in the file."""

    node: ast.FunctionDef | ast.Lambda


def is_known(value: Any, depth: int = 0) -> bool:
    """Tell whether a value has nothing in it that only running the file would tell."""
    if depth > _MAX_DEPTH:
        return False
    if isinstance(value, list | tuple | set):
        return all(is_known(item, depth + 1) for item in value)
    if isinstance(value, dict):
        return all(is_known(item, depth + 1) for item in value.values())
    return value is None or isinstance(value, str | bytes | int | float | PurePath)
