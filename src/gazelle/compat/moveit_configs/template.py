"""Expressions in double braces, which ``launch_param_builder`` lets parameter files have."""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any

from gazelle.errors import LaunchError

__all__ = ["rendered"]

_EXPRESSION = re.compile(r"\{\{(.*?)\}\}", re.DOTALL)
_OPERATORS: dict[type[ast.AST], Callable[..., Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
}
_ERRORS: tuple[type[Exception], ...]
_ERRORS = (ValueError, KeyError, TypeError, SyntaxError, ArithmeticError)
_ERRORS += (RecursionError, MemoryError)
_FUNCTIONS: dict[str, Callable[[float], float]] = {
    "radians": math.radians,
    "degrees": math.degrees,
}


def rendered(text: str, mappings: Mapping[str, Any], file: str) -> str:
    """Return a text with its expressions worked out.

    Jinja2 does the work where it is installed. Without it, names, numbers, arithmetic and
    ``radians()`` and ``degrees()`` are understood, which is what parameter files have.

    Args:
        text: the template.
        mappings: values of names.
        file: for messages.

    Raises:
        LaunchError: an expression needs Jinja2, or cannot be worked out.
    """
    if not any(mark in text for mark in ("{{", "{%", "{#")):
        return text
    try:
        template: Any = import_module("jinja2").Template(text)
    except ImportError:
        return _simple(text, mappings, file)
    template.globals.update(_FUNCTIONS)
    return str(template.render(mappings))


def _simple(text: str, mappings: Mapping[str, Any], file: str) -> str:
    def value(match: re.Match[str]) -> str:
        try:
            return str(_worked_out(ast.parse(match[1].strip(), mode="eval").body, mappings))
        except _ERRORS as error:
            line = text.count("\n", 0, match.start()) + 1
            reason = f"'{match[0]}' cannot be worked out ({error!r})"
            raise LaunchError(f"{file}:{line}: {reason}; pip install jinja2 may help") from error

    if "{%" in text or "{#" in text:
        raise LaunchError(f"{file}: it has statements of Jinja2: pip install jinja2")
    # Behind the last end there is none to be looked for, again and again.
    end = text.rfind("}}") + len("}}") if "}}" in text else 0
    return _EXPRESSION.sub(value, text[:end]) + text[end:]


def _worked_out(node: ast.expr, mappings: Mapping[str, Any]) -> Any:
    match node:
        case ast.Constant(value=value):
            return value
        case ast.Name(id=name):
            return mappings[name]
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _OPERATORS:
            return _OPERATORS[type(op)](_worked_out(left, mappings), _worked_out(right, mappings))
        case ast.UnaryOp(op=op, operand=operand) if type(op) in _OPERATORS:
            return _OPERATORS[type(op)](_worked_out(operand, mappings))
        case ast.Call(func=ast.Name(id=name), args=[argument]) if name in _FUNCTIONS:
            return _FUNCTIONS[name](_worked_out(argument, mappings))
        case ast.Subscript(value=inner, slice=key):
            return _worked_out(inner, mappings)[_worked_out(key, mappings)]
        case ast.Attribute(value=inner, attr=key):
            return _worked_out(inner, mappings)[key]
    raise ValueError(f"'{ast.unparse(node)}' is not understood")
