"""Expressions over time in publishers, such as ``sin(t/2)``: numbers and nothing else.

A text is parsed and walked; only numbers, arithmetic, comparisons, ``a if c else b`` and the
functions of `math` are in it, so no name of Python's own can be reached.
"""

from __future__ import annotations

import ast
import math
import operator
import random
from collections.abc import Callable, Mapping
from types import BuiltinFunctionType
from typing import Any

from gazelle.diagnostics import nearest_names
from gazelle.studio.errors import StudioError

__all__ = ["Expression", "expression"]

Expression = Callable[[Mapping[str, float]], float]

_MAX_LENGTH = 500
_MAX_DEPTH = 50
_MAX_BITS = 1024
_CONSTANTS = {"pi": math.pi, "e": math.e, "tau": math.tau, "inf": math.inf, "nan": math.nan}
# They make whole numbers without limit, or take lists.
_LEFT_OUT = ("comb", "dist", "factorial", "fsum", "perm", "prod", "sumprod")
_FUNCTIONS: dict[str, Callable[..., Any]] = {
    name: function
    for name, function in vars(math).items()
    if isinstance(function, BuiltinFunctionType) and name not in _LEFT_OUT
}
_FUNCTIONS |= {"abs": abs, "max": max, "min": min, "round": round, "int": int, "float": float}
_FUNCTIONS |= {"random": random.random, "uniform": random.uniform}
_BINARY: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
}
_UNARY: dict[type[ast.unaryop], Callable[[Any], Any]] = {
    ast.UAdd: operator.pos,
    ast.USub: operator.neg,
    ast.Not: operator.not_,
}
_COMPARED: dict[type[ast.cmpop], Callable[[Any, Any], bool]] = {
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
}


def expression(text: str, names: tuple[str, ...] = ("t", "i")) -> Expression:
    """Return the function of an expression; it raises `StudioError` where the value is none.

    Args:
        text: Python's notation; ``^`` is not a power, ``**`` is.
        names: the variables that may be in it.

    Raises:
        StudioError: it is no expression of numbers.
    """
    if len(text) > _MAX_LENGTH:
        raise StudioError(f"the expression is longer than {_MAX_LENGTH} characters")
    try:
        tree = ast.parse(text.strip(), mode="eval").body
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        reason = getattr(error, "msg", None) or str(error)
        raise StudioError(f"'{text}' is not an expression: {reason}") from None
    _check(tree, text, names, 0)

    def value(variables: Mapping[str, float]) -> float:
        try:
            return float(_value(tree, variables))
        except (ArithmeticError, ValueError, TypeError) as error:
            raise StudioError(f"'{text}': {error}") from None

    return value


def _check(node: ast.AST, text: str, names: tuple[str, ...], depth: int) -> None:
    """Refuse whatever is not listed here."""
    if depth > _MAX_DEPTH:
        raise StudioError(f"'{text}' is nested too deep")
    if isinstance(node, ast.Constant) and type(node.value) in (int, float, bool):
        if isinstance(node.value, int) and node.value.bit_length() > _MAX_BITS:
            raise StudioError(f"'{text}': the number is too large")
        return
    if isinstance(node, ast.Name):
        known = (*names, *_CONSTANTS)
        if node.id not in known:
            near = nearest_names(node.id, (*known, *_FUNCTIONS))
            raise StudioError(f"'{text}': '{node.id}' is not known here", known=near or known)
        return
    for part in _parts(node, text):
        _check(part, text, names, depth + 1)


def _parts(node: ast.AST, text: str) -> list[ast.expr]:
    match node:
        case ast.BinOp() if type(node.op) in _BINARY or _is_power(node.op):
            return [node.left, node.right]
        case ast.UnaryOp() if type(node.op) in _UNARY:
            return [node.operand]
        case ast.BoolOp():
            return node.values
        case ast.IfExp():
            return [node.test, node.body, node.orelse]
        case ast.Compare() if all(type(op) in _COMPARED for op in node.ops):
            return [node.left, *node.comparators]
        case ast.Call():
            return _arguments(node, text)
    shown = ast.unparse(node) if isinstance(node, ast.expr) else type(node).__name__
    raise StudioError(f"'{text}': '{shown}' cannot be part of an expression of numbers")


def _arguments(node: ast.Call, text: str) -> list[ast.expr]:
    name = node.func.id if isinstance(node.func, ast.Name) else ast.unparse(node.func)
    if name not in _FUNCTIONS:
        near = nearest_names(name, _FUNCTIONS)
        raise StudioError(f"'{text}': there is no function '{name}'", known=near)
    if node.keywords:
        raise StudioError(f"'{text}': {name}() takes numbers without names")
    return node.args


def _is_power(op: ast.operator) -> bool:
    return isinstance(op, ast.Pow)


def _value(node: ast.expr, variables: Mapping[str, float]) -> Any:
    if isinstance(node, ast.Constant):
        return node.value
    if isinstance(node, ast.Name):
        return variables[node.id] if node.id in variables else _CONSTANTS[node.id]
    if isinstance(node, ast.BinOp):
        left, right = _value(node.left, variables), _value(node.right, variables)
        # Whole numbers would grow without limit.
        return math.pow(left, right) if _is_power(node.op) else _BINARY[type(node.op)](left, right)
    if isinstance(node, ast.UnaryOp):
        return _UNARY[type(node.op)](_value(node.operand, variables))
    if isinstance(node, ast.BoolOp):
        return _both(node, variables)
    if isinstance(node, ast.IfExp):
        chosen = node.body if _value(node.test, variables) else node.orelse
        return _value(chosen, variables)
    if isinstance(node, ast.Compare):
        return _compared(node, variables)
    assert isinstance(node, ast.Call)
    assert isinstance(node.func, ast.Name)
    return _FUNCTIONS[node.func.id](*(_value(one, variables) for one in node.args))


def _both(node: ast.BoolOp, variables: Mapping[str, float]) -> Any:
    is_and = isinstance(node.op, ast.And)
    value: Any = is_and
    for part in node.values:
        value = _value(part, variables)
        if bool(value) != is_and:
            break
    return value


def _compared(node: ast.Compare, variables: Mapping[str, float]) -> bool:
    left = _value(node.left, variables)
    for op, part in zip(node.ops, node.comparators, strict=True):
        right = _value(part, variables)
        if not _COMPARED[type(op)](left, right):
            return False
        left = right
    return True
