"""Running a configuration: its assignments, expressions and functions."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from gazelle.diagnostics import SourceSpan, did_you_mean
from gazelle.nodes.slam.cartographer.lua_parser import (
    Assign,
    Binary,
    Block,
    Call,
    Constant,
    Do,
    Expression,
    Function,
    If,
    Index,
    Local,
    Name,
    Return,
    Statement,
    TableOf,
    Unary,
    failure,
)

__all__ = ["Builtin", "LuaTable", "Machine", "text_of"]

_MAX_STEPS = 200_000
_MAX_CALL_DEPTH = 40
_NUMBERS: dict[str, Callable[[float, float], float]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "/": lambda a, b: a / b if b else math.copysign(math.inf, a) if a else math.nan,
    "%": lambda a, b: a - math.floor(a / b) * b if b else math.nan,
    "^": lambda a, b: float(a**b),
}
_ORDERS: dict[str, Callable[[Any, Any], bool]] = {
    "<": lambda a, b: a < b,
    ">": lambda a, b: a > b,
    "<=": lambda a, b: a <= b,
    ">=": lambda a, b: a >= b,
}


@dataclass(slots=True, eq=False)
class LuaTable:
    """A table.

    Attributes:
        values: by key.
        name: what it is called where cartographer's own files would have filled it. Such a table
            has tables for all names, as those files give them, and their numbers are not known.
    """

    values: dict[Any, Any] = field(default_factory=dict)
    name: str = ""

    def get(self, key: Any) -> Any:
        """Return a value, None when there is none."""
        if key not in self.values and self.name and isinstance(key, str):
            self.values[key] = LuaTable(name=f"{self.name}.{key}")
        return self.values.get(key)

    @property
    def is_unknown(self) -> bool:
        """It stands for something of cartographer's own files that was only looked at."""
        return bool(self.name) and all(
            isinstance(one, LuaTable) and one.is_unknown for one in self.values.values()
        )


class Builtin(NamedTuple):
    """A function of ours; takes the arguments and the place of the call."""

    name: str
    call: Callable[[list[Any], SourceSpan], Any]


class _Closure(NamedTuple):
    function: Function
    scope: _Scope


@dataclass(slots=True)
class _Scope:
    values: dict[str, Any]
    outer: _Scope | None

    def owner(self, name: str) -> _Scope | None:
        scope: _Scope | None = self
        while scope is not None and name not in scope.values:
            scope = scope.outer
        return scope


class _Returned(Exception):  # noqa: N818 - it is no error
    def __init__(self, values: list[Any]) -> None:
        self.values = values


class Machine:
    """Runs files over one set of globals.

    Attributes:
        globals: by name.
    """

    def __init__(self, names: dict[str, Any]) -> None:
        """Begin with these globals."""
        self.globals = names
        self._steps = 0
        self._calls = 0

    def run(self, block: Block) -> Any:
        """Run a file; return what it returns, None when it returns nothing."""
        try:
            self._block(block, _Scope({}, _Scope(self.globals, None)))
        except _Returned as returned:
            return returned.values[0] if returned.values else None
        return None

    def _block(self, block: Block, scope: _Scope) -> None:
        for statement in block:
            self._statement(statement, scope)

    def _statement(self, statement: Statement, scope: _Scope) -> None:
        match statement:
            case Assign():
                values = self._values(statement.values, scope, len(statement.targets))
                for target, value in zip(statement.targets, values, strict=True):
                    self._assign(target, value, scope)
            case Local():
                self._declare(statement, scope)
            case If():
                for condition, block in statement.branches:
                    if condition is None or _is_true(self._value(condition, scope)):
                        self._block(block, _Scope({}, scope))
                        break
            case Do():
                self._block(statement.body, _Scope({}, scope))
            case Return():
                raise _Returned([self._value(value, scope) for value in statement.values])
            case _:
                self._value(statement, scope)

    def _declare(self, statement: Local, scope: _Scope) -> None:
        if statement.knows_itself:
            scope.values[statement.names[0]] = None
        values = self._values(statement.values, scope, len(statement.names))
        scope.values.update(zip(statement.names, values, strict=True))

    def _values(self, expressions: Sequence[Expression], scope: _Scope, count: int) -> list[Any]:
        values = [self._value(one, scope) for one in expressions]
        return (values + [None] * count)[:count]

    def _assign(self, target: Name | Index, value: Any, scope: _Scope) -> None:
        if isinstance(target, Name):
            owner = scope.owner(target.name)
            (owner.values if owner else self.globals)[target.name] = value
            return
        table = self._table(target, scope)
        key = self._value(target.key, scope)
        if key is None:
            raise failure("table index is nil", target.span, "write a name or a number")
        if value is None:
            table.values.pop(key, None)
        else:
            table.values[key] = value

    def _table(self, target: Index, scope: _Scope) -> LuaTable:
        owner = self._value(target.owner, scope)
        if isinstance(owner, LuaTable):
            return owner
        what, name = _described(target.owner), _kind(owner)
        fix = f"assign a table to {what} first"
        if owner is None and isinstance(target.owner, Name):
            known = [key for key, one in self.globals.items() if isinstance(one, LuaTable)]
            fix = did_you_mean(target.owner.name, known) or (
                'include "map_builder.lua" and "trajectory_builder.lua" above'
            )
        raise failure(f"attempt to index {what} (a {name} value)", target.span, fix)

    def _value(self, one: Expression, scope: _Scope) -> Any:
        self._steps += 1
        if self._steps > _MAX_STEPS:
            raise failure(
                "the configuration takes too long", one.span, "write its values as they are"
            )
        match one:
            case Constant():
                return one.value
            case Name():
                owner = scope.owner(one.name)
                return owner.values[one.name] if owner else None
            case Index():
                return self._table(one, scope).get(self._value(one.key, scope))
            case Call():
                return self._call(one, scope)
            case Unary():
                return self._unary(one, self._value(one.value, scope))
            case Binary():
                return self._binary(one, scope)
            case TableOf():
                return self._new_table(one, scope)
            case Function():
                return _Closure(one, scope)

    def _new_table(self, one: TableOf, scope: _Scope) -> LuaTable:
        table, number = LuaTable(), 0
        for item in one.fields:
            value = self._value(item.value, scope)
            if item.key is None:
                number += 1
                table.values[float(number)] = value
            elif value is not None:
                table.values[self._value(item.key, scope)] = value
        return table

    def _call(self, one: Call, scope: _Scope) -> Any:
        if one.method:
            raise failure(f"method '{one.method}' is not understood in a configuration", one.span,
                 "write the value as it is")  # fmt: skip
        function = self._value(one.function, scope)
        given = [self._value(argument, scope) for argument in one.arguments]
        if isinstance(function, Builtin):
            return function.call(given, one.span)
        if not isinstance(function, _Closure):
            what = _described(one.function)
            known = [key for key, value in self.globals.items() if isinstance(value, Builtin)]
            raise failure(f"attempt to call {what} (a {_kind(function)} value)", one.span,
                 did_you_mean(what, known) or "write the value as it is")  # fmt: skip
        names = function.function.parameters
        inner = _Scope(dict(zip(names, [*given, *([None] * len(names))], strict=False)),
                       function.scope)  # fmt: skip
        self._calls += 1
        if self._calls > _MAX_CALL_DEPTH:
            raise failure("stack overflow", one.span, "a function calls itself without end")
        try:
            self._block(function.function.body, inner)
        except _Returned as returned:
            return returned.values[0] if returned.values else None
        finally:
            self._calls -= 1
        return None

    def _unary(self, one: Unary, value: Any) -> Any:
        if one.operator == "not":
            return not _is_true(value)
        if one.operator == "-":
            return -_number(value, one.value, one.span)
        if isinstance(value, str):
            return float(len(value.encode()))
        if isinstance(value, LuaTable):
            count = 0
            while float(count + 1) in value.values:
                count += 1
            return float(count)
        raise failure(f"attempt to get length of {_described(one.value)} (a {_kind(value)} value)",
             one.span, "take a table or a string")  # fmt: skip

    def _binary(self, one: Binary, scope: _Scope) -> Any:
        left = self._value(one.left, scope)
        if one.operator in ("and", "or"):
            decides = _is_true(left) is (one.operator == "or")
            return left if decides else self._value(one.right, scope)
        right = self._value(one.right, scope)
        if one.operator in ("==", "~="):
            same = type(left) is type(right) and left == right
            return same is (one.operator == "==")
        if one.operator == "..":
            return _piece(left, one.left, one.span) + _piece(right, one.right, one.span)
        if one.operator in _ORDERS:
            if isinstance(left, str) is isinstance(right, str) and isinstance(left, str | float):
                return _ORDERS[one.operator](left, right)
            raise failure(f"attempt to compare {_kind(left)} with {_kind(right)}", one.span,
                 "compare two numbers or two strings")  # fmt: skip
        a, b = _number(left, one.left, one.span), _number(right, one.right, one.span)
        try:
            return _NUMBERS[one.operator](a, b)
        except (ArithmeticError, TypeError, ValueError):
            return math.nan


def _is_true(value: Any) -> bool:
    return value is not None and value is not False


def _number(value: Any, source: Expression, span: SourceSpan) -> float:
    if isinstance(value, float):
        return value
    if isinstance(value, str):
        try:
            return float(value)
        except ValueError:
            pass
    if isinstance(value, LuaTable) and value.is_unknown:
        text = f"the default of {value.name} stands in cartographer's own files"
        raise failure(f"{text}, which are not here", span, "write the number")
    what = _described(source)
    raise failure(f"attempt to perform arithmetic on {what} (a {_kind(value)} value)", span,
         "write a number")  # fmt: skip


def _piece(value: Any, source: Expression, span: SourceSpan) -> str:
    if isinstance(value, str | float) and not isinstance(value, bool):
        return text_of(value)
    what = _described(source)
    raise failure(f"attempt to concatenate {what} (a {_kind(value)} value)", span, "write a string")


def text_of(value: Any) -> str:
    """Return a value as ``tostring`` does."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return f"{value:.14g}"
    return "nil" if value is None else value if isinstance(value, str) else _kind(value)


def _kind(value: Any) -> str:
    if value is None:
        return "nil"
    if isinstance(value, bool):
        return "boolean"
    names = {float: "number", str: "string", LuaTable: "table"}
    return names.get(type(value), "function")


def _described(one: Expression) -> str:
    if isinstance(one, Name):
        return f"'{one.name}'"
    if isinstance(one, Index) and isinstance(one.key, Constant):
        return f"field '{one.key.value}'"
    return "a value"
