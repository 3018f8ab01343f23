"""What a Lua file says, as a tree.

All of Lua that configurations use: assignments, tables, expressions, calls, ``if``, ``do`` and
functions. Loops are refused: a configuration that needs them can be written without.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from gazelle.nodes.slam.cartographer.lua_tokens import Place

__all__ = [
    "Assign",
    "Binary",
    "Block",
    "Call",
    "Constant",
    "Do",
    "Expression",
    "Field",
    "Function",
    "If",
    "Index",
    "Local",
    "Name",
    "Return",
    "Statement",
    "TableOf",
    "Unary",
]


@dataclass(frozen=True, slots=True)
class Constant:
    """``nil``, ``true``, ``false``, a number or a string."""

    value: bool | float | str | None
    place: Place


@dataclass(frozen=True, slots=True)
class Name:
    """A variable."""

    name: str
    place: Place


@dataclass(frozen=True, slots=True)
class Index:
    """``owner.key`` or ``owner[key]``."""

    owner: Expression
    key: Expression
    place: Place


@dataclass(frozen=True, slots=True)
class Call:
    """``function(arguments)``; with `method`, ``owner:method(arguments)``."""

    function: Expression
    arguments: tuple[Expression, ...]
    method: str
    place: Place


@dataclass(frozen=True, slots=True)
class Unary:
    """``-x``, ``not x``, ``#x``."""

    operator: str
    value: Expression
    place: Place


@dataclass(frozen=True, slots=True)
class Binary:
    """``a operator b``."""

    operator: str
    left: Expression
    right: Expression
    place: Place


@dataclass(frozen=True, slots=True)
class Field:
    """A field of a table; without a key the next number."""

    key: Expression | None
    value: Expression


@dataclass(frozen=True, slots=True)
class TableOf:
    """``{…}``."""

    fields: tuple[Field, ...]
    place: Place


@dataclass(frozen=True, slots=True)
class Function:
    """``function (parameters) … end``."""

    parameters: tuple[str, ...]
    body: Block
    place: Place


Expression: TypeAlias = Constant | Name | Index | Call | Unary | Binary | TableOf | Function


@dataclass(frozen=True, slots=True)
class Assign:
    """``targets = values``."""

    targets: tuple[Name | Index, ...]
    values: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Local:
    """``local names = values``; a local function knows its own name."""

    names: tuple[str, ...]
    values: tuple[Expression, ...]
    knows_itself: bool = False


@dataclass(frozen=True, slots=True)
class If:
    """Conditions with their blocks, the last without a condition for ``else``."""

    branches: tuple[tuple[Expression | None, Block], ...]


@dataclass(frozen=True, slots=True)
class Do:
    """``do … end``."""

    body: Block


@dataclass(frozen=True, slots=True)
class Return:
    """``return values``."""

    values: tuple[Expression, ...]


Statement: TypeAlias = Assign | Local | If | Do | Return | Call
Block: TypeAlias = tuple[Statement, ...]
