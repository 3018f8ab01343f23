"""Names of Python programs that nothing defines: found by reading, before the line runs."""

from __future__ import annotations

import ast
import builtins
from collections.abc import Iterator
from functools import cache

from gazelle.diagnostics import Diagnostics, SourceSpan, nearest_names
from gazelle.doctor.packages.dependency_checks import is_slip
from gazelle.interfaces import known_types

__all__ = ["check_names"]

# What Python 2 had; such programs are translated before they run.
_PYTHON_2 = frozenset(
    {
        "apply", "basestring", "buffer", "cmp", "coerce", "execfile", "file", "intern", "long",
        "raw_input", "reduce", "reload", "unichr", "unicode", "xrange",
    }
)  # fmt: skip
# Where a message of this name is looked for first.
_USUAL = ("std_msgs", "geometry_msgs", "sensor_msgs", "nav_msgs")
# Classes whose attributes are known here, or that have none of their own.
_KNOWN_BASES = frozenset({"Node", "object", "rclpy.node.Node"})


def check_names(
    tree: ast.Module, file: str, diagnostics: Diagnostics, *, code: str = "package.python-name"
) -> None:
    """Report names that nothing defines, and attributes of ``self`` that are slips for others.

    Args:
        tree: a whole program.
        file: name for the places.
        diagnostics: receives the findings.
        code: of names that nothing defines.
    """
    for name, span in _undefined(tree, file):
        text = f"name '{name}' is not defined (NameError)"
        diagnostics.report(code, text, span, fix=_remedy(name, tree))
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef):
            _check_attributes(node, file, diagnostics)


def _undefined(tree: ast.Module, file: str) -> Iterator[tuple[str, SourceSpan]]:
    # Most examinations meet no Python.
    from pyflakes.checker import Checker
    from pyflakes.messages import UndefinedName

    seen = set()
    for message in Checker(tree, filename=file).messages:
        name = str(message.message_args[0]) if message.message_args else ""
        if isinstance(message, UndefinedName) and name not in _PYTHON_2 and name not in seen:
            seen.add(name)
            yield name, SourceSpan(file, message.lineno, message.col + 1, len(name))


def _remedy(name: str, tree: ast.Module) -> str:
    package = _package_of(name)
    if package:
        return f"write above: from {package}.msg import {name}"
    near = nearest_names(name, sorted({*_names_in(tree), *dir(builtins)} - {name}), count=1)
    if near:
        return f"did you mean '{near[0]}'?"
    return "import it, or define it above its use"


def _names_in(tree: ast.Module) -> Iterator[str]:
    for node in ast.walk(tree):
        if isinstance(node, ast.alias):
            yield (node.asname or node.name).partition(".")[0]
        elif isinstance(node, ast.FunctionDef | ast.ClassDef):
            yield node.name
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id
        elif isinstance(node, ast.arg):
            yield node.arg


@cache
def _package_of(name: str) -> str:
    """Return the package of messages that has one of this name, empty when none has."""
    if not name[:1].isupper():
        return ""
    for package in _USUAL:
        if f"{package}/msg/{name}" in known_types("msg", package):
            return package
    return ""


def _check_attributes(node: ast.ClassDef, file: str, diagnostics: Diagnostics) -> None:
    if any(ast.unparse(base) not in _KNOWN_BASES for base in node.bases) or node.keywords:
        return
    stored = {item.name for item in ast.walk(node) if isinstance(item, ast.FunctionDef)}
    read: dict[str, ast.Attribute] = {}
    for item in ast.walk(node):
        if isinstance(item, ast.Name) and isinstance(item.ctx, ast.Store):
            stored.add(item.id)
        if isinstance(item, ast.Call) and ast.unparse(item.func) in {"setattr", "vars"}:
            return
        if not isinstance(item, ast.Attribute) or ast.unparse(item.value) != "self":
            continue
        if isinstance(item.ctx, ast.Load):
            read.setdefault(item.attr, item)
        else:
            stored.add(item.attr)
    for name, place in read.items():
        slip = next((one for one in sorted(stored) if _is_slip(name, one)), "")
        if name in stored or not slip or (node.bases and name in _attributes_of_nodes()):
            continue
        text = f"class {node.name} has no attribute '{name}' (AttributeError: '{node.name}' object "
        text += f"has no attribute '{name}')"
        end = place.end_col_offset or 0
        span = SourceSpan(file, place.end_lineno or 0, end - len(name) + 1, len(name))
        fix = f"did you mean '{slip}'?"
        diagnostics.report("package.python-attribute", text, span, fix=fix)


def _is_slip(name: str, other: str) -> bool:
    """Tell a slip; names that differ in a number are different things."""
    bare = [text.translate(_NO_DIGITS) for text in (name, other)]
    return bare[0] != bare[1] and len(name) > 3 and is_slip(name, other)


@cache
def _attributes_of_nodes() -> frozenset[str]:
    # It brings the graph along.
    from gazelle.compat.rclpy.node import Node

    return frozenset(dir(Node))


_NO_DIGITS = str.maketrans("", "", "0123456789")
