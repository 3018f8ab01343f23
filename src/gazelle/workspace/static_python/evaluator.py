"""A small interpreter of the plain part of Python; everything else comes to `UNKNOWN`.

Nothing of the file is executed: names, strings, lists, dictionaries, loops over known lists and
calls of the file's own functions are followed; of the file system only names are looked at.
"""

from __future__ import annotations

import ast
import operator
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path, PurePath
from typing import Any

from gazelle.workspace.static_python.values import (
    UNKNOWN,
    Call,
    Function,
    Name,
    Unknown,
    is_known,
    library,
    method,
)

__all__ = ["Evaluator", "parse_python"]

_STEPS = 200_000
_MAX_CALL_DEPTH = 12
_MAX_LENGTH = 100_000
_MAX_SIZE = 2**63
_BUILTINS = frozenset(
    {"bool", "dict", "enumerate", "float", "int", "len", "list", "range", "set", "sorted", "str",
     "tuple", "zip", "print", "open", "isinstance", "getattr", "map", "filter", "any", "all"}
)  # fmt: skip
_ARITHMETIC: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
}
_COMPARISONS: dict[type[ast.cmpop], Callable[[Any, Any], bool]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.In: lambda left, right: left in right,
    ast.NotIn: lambda left, right: left not in right,
}


class _ReturnError(Exception):
    def __init__(self, value: Any) -> None:
        super().__init__()
        self.value = value


class Evaluator:
    """Follows a module's statements in order.

    Attributes:
        calls: every call whose outcome is not computed, in the order met.
        computed: calls of `functions` and of the library that were computed, with their outcomes.
        names: the module's names and their values.

    Args:
        file: the file; ``__file__``.
        folder: what relative paths are relative to.
        functions: more functions that are computed, by dotted name or by last name.
        methods: methods of calls that are computed from the call, by name.
        environ: environment variables; the process's own when None.
    """

    def __init__(
        self,
        file: Path,
        folder: Path,
        *,
        functions: Mapping[str, Callable[..., Any]] | None = None,
        methods: Mapping[str, Callable[[Call], Any]] | None = None,
        environ: Mapping[str, str] | None = None,
    ) -> None:
        self.calls: list[Call] = []
        self.computed: list[tuple[Call, Any]] = []
        self.names: dict[str, Any] = {"__file__": str(file), "__name__": "launch"}
        self._functions = library(folder, file, os.environ if environ is None else environ)
        self._functions.update(functions or {})
        self._methods = dict(methods or {})
        self._environ = os.environ if environ is None else environ
        self._steps = 0
        self._depth = 0

    def run(self, tree: ast.Module) -> None:
        """Follow a module from top to bottom."""
        try:
            self._body(tree.body, self.names)
        except _ReturnError:
            return

    def call_function(self, name: str, *arguments: Any) -> Any:
        """Follow a function of the module; `UNKNOWN` when there is none of this name."""
        found = self.names.get(name)
        return self.follow(found, arguments, {}) if isinstance(found, Function) else UNKNOWN

    def follow(self, function: Function, arguments: Sequence[Any], keywords: dict[str, Any]) -> Any:
        """Follow a function of the file with these arguments."""
        if self._depth >= _MAX_CALL_DEPTH:
            return UNKNOWN
        scope = {**self.names, **self._bound(function.node.args, arguments, keywords)}
        self._depth += 1
        try:
            if isinstance(function.node, ast.Lambda):
                return self.value(function.node.body, scope)
            self._body(function.node.body, scope)
        except _ReturnError as found:
            return found.value
        finally:
            self._depth -= 1
        return None

    def value(self, node: ast.expr | None, scope: dict[str, Any]) -> Any:
        """Return what an expression comes to."""
        self._steps += 1
        if node is None or self._steps > _STEPS:
            return UNKNOWN
        handler = getattr(self, f"_{type(node).__name__.lower()}", None)
        if handler is None:
            for child in ast.iter_child_nodes(node):
                if isinstance(child, ast.expr):
                    self.value(child, scope)
            return UNKNOWN
        try:
            found = handler(node, scope)
            return UNKNOWN if _is_huge(found) else found
        # Functions of the library refuse values of the wrong type: then nothing is known.
        except (ArithmeticError, AttributeError, LookupError, OSError, TypeError, ValueError):
            return UNKNOWN
        # Sums of hundreds of terms are nested as deep.
        except RecursionError:
            return UNKNOWN

    def _bound(
        self, wanted: ast.arguments, arguments: Sequence[Any], keywords: dict[str, Any]
    ) -> dict[str, Any]:
        names = [item.arg for item in (*wanted.posonlyargs, *wanted.args)]
        bound: dict[str, Any] = dict.fromkeys(names, UNKNOWN)
        for name, default in zip(reversed(names), reversed(wanted.defaults), strict=False):
            bound[name] = self.value(default, self.names)
        for item, given in zip(wanted.kwonlyargs, wanted.kw_defaults, strict=True):
            bound[item.arg] = self.value(given, self.names)
        bound.update(zip(names, arguments, strict=False))
        bound.update(keywords)
        for rest in (wanted.vararg, wanted.kwarg):
            if rest is not None:
                bound[rest.arg] = UNKNOWN
        return bound

    # -- statements ------------------------------------------------------------------------

    def _body(self, body: Iterable[ast.stmt], scope: dict[str, Any]) -> None:
        for statement in body:
            self._steps += 1
            if self._steps > _STEPS:
                return
            self._statement(statement, scope)

    def _statement(self, node: ast.stmt, scope: dict[str, Any]) -> None:
        match node:
            case ast.Import() | ast.ImportFrom():
                self._import(node, scope)
            case ast.FunctionDef():
                scope[node.name] = Function(node)
            case ast.Assign():
                value = self.value(node.value, scope)
                for target in node.targets:
                    self._assign(target, value, scope)
            case ast.AnnAssign() if node.value is not None:
                self._assign(node.target, self.value(node.value, scope), scope)
            case ast.AugAssign():
                self._add_to(node, scope)
            case ast.Expr():
                self.value(node.value, scope)
            case ast.Return():
                raise _ReturnError(self.value(node.value, scope) if node.value else None)
            case _:
                self._block(node, scope)

    def _block(self, node: ast.stmt, scope: dict[str, Any]) -> None:
        match node:
            case ast.If():
                self._if(node, scope)
            case ast.For():
                self._for(node, scope)
            case ast.With():
                for item in node.items:
                    self._assign_maybe(item.optional_vars, UNKNOWN, scope)
                self._body(node.body, scope)
            case ast.Try():
                self._body([*node.body, *node.orelse, *node.finalbody], scope)
            case ast.While():
                self._forget(node.body, scope)

    def _import(self, node: ast.Import | ast.ImportFrom, scope: dict[str, Any]) -> None:
        for alias in node.names:
            if isinstance(node, ast.ImportFrom):
                scope[alias.asname or alias.name] = Name(f"{node.module}.{alias.name}")
            elif alias.asname:
                scope[alias.asname] = Name(alias.name)
            else:
                first = alias.name.partition(".")[0]
                scope[first] = Name(first)

    def _assign_maybe(self, target: ast.expr | None, value: Any, scope: dict[str, Any]) -> None:
        if target is not None:
            self._assign(target, value, scope)

    def _assign(self, target: ast.expr, value: Any, scope: dict[str, Any]) -> None:
        match target:
            case ast.Name():
                scope[target.id] = value
            case ast.Tuple() | ast.List():
                same = isinstance(value, list | tuple) and len(value) == len(target.elts)
                values = value if same else [UNKNOWN] * len(target.elts)
                for part, item in zip(target.elts, values, strict=True):
                    self._assign(part, item, scope)
            case ast.Subscript():
                owner, key = self.value(target.value, scope), self.value(target.slice, scope)
                if isinstance(owner, dict) and isinstance(key, str):
                    owner[key] = value

    def _add_to(self, node: ast.AugAssign, scope: dict[str, Any]) -> None:
        if not isinstance(node.target, ast.Name):
            return
        old, new = scope.get(node.target.id, UNKNOWN), self.value(node.value, scope)
        if isinstance(old, list) and isinstance(new, list | tuple):
            old.extend(new)
        elif isinstance(old, list):
            old.append(UNKNOWN)
        else:
            same = isinstance(old, str) and isinstance(new, str)
            scope[node.target.id] = old + new if same else UNKNOWN

    def _if(self, node: ast.If, scope: dict[str, Any]) -> None:
        test = self.value(node.test, scope)
        if isinstance(test, bool):
            self._body(node.body if test else node.orelse, scope)
            return
        for body in (node.body, node.orelse):
            try:
                self._body(body, scope)
            except _ReturnError:
                if body is node.orelse:
                    raise

    def _for(self, node: ast.For, scope: dict[str, Any]) -> None:
        items = self.value(node.iter, scope)
        if not isinstance(items, list | tuple | dict) or _has_unknown(items):
            self._assign(node.target, UNKNOWN, scope)
            self._body(node.body, scope)
            self._forget(node.body, scope)
            return
        for item in items:
            if self._steps > _STEPS:
                self._forget(node.body, scope)
                return
            self._assign(node.target, item, scope)
            self._body(node.body, scope)

    def _forget(self, body: Iterable[ast.stmt], scope: dict[str, Any]) -> None:
        """Give up what statements that were not followed might have changed."""
        for node in (item for statement in body for item in ast.walk(statement)):
            if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
                scope[node.id] = UNKNOWN
            elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
                changed = scope.get(node.value.id)
                if isinstance(changed, list):
                    changed.append(UNKNOWN)

    # -- expressions -----------------------------------------------------------------------

    def _constant(self, node: ast.Constant, scope: dict[str, Any]) -> Any:
        return node.value

    def _name(self, node: ast.Name, scope: dict[str, Any]) -> Any:
        if node.id in scope:
            return scope[node.id]
        return Name(node.id) if node.id in _BUILTINS else UNKNOWN

    def _list(self, node: ast.List, scope: dict[str, Any]) -> Any:
        return self._items(node.elts, scope)

    def _tuple(self, node: ast.Tuple, scope: dict[str, Any]) -> Any:
        return tuple(self._items(node.elts, scope))

    def _items(self, nodes: Iterable[ast.expr], scope: dict[str, Any]) -> list[Any]:
        found: list[Any] = []
        for node in nodes:
            value = self.value(node.value if isinstance(node, ast.Starred) else node, scope)
            if isinstance(node, ast.Starred) and isinstance(value, list | tuple):
                found.extend(value)
            else:
                found.append(value)
        return found

    def _dict(self, node: ast.Dict, scope: dict[str, Any]) -> Any:
        found: dict[Any, Any] = {}
        for key, value in zip(node.keys, node.values, strict=True):
            inner = self.value(value, scope)
            if key is None:
                found.update(inner if isinstance(inner, dict) else {UNKNOWN: UNKNOWN})
            else:
                word = self.value(key, scope)
                found[word if isinstance(word, str | int | float) else UNKNOWN] = inner
        return found

    def _joinedstr(self, node: ast.JoinedStr, scope: dict[str, Any]) -> Any:
        parts = [self.value(item, scope) for item in node.values]
        return "".join(parts) if all(isinstance(part, str) for part in parts) else UNKNOWN

    def _formattedvalue(self, node: ast.FormattedValue, scope: dict[str, Any]) -> Any:
        value = self.value(node.value, scope)
        return str(value) if is_known(value) and node.format_spec is None else UNKNOWN

    def _binop(self, node: ast.BinOp, scope: dict[str, Any]) -> Any:
        left, right = self.value(node.left, scope), self.value(node.right, scope)
        if isinstance(left, list) and isinstance(node.op, ast.Add):
            return [*left, *(right if isinstance(right, list | tuple) else [UNKNOWN])]
        if isinstance(node.op, ast.Div) and isinstance(left, PurePath) and is_known(right):
            return left / right
        work = _ARITHMETIC.get(type(node.op))
        known = is_known(left) and is_known(right) and not isinstance(left, PurePath)
        if isinstance(node.op, ast.Mod) and isinstance(left, str):
            return method(left, "%", (right,), {}) if known else UNKNOWN
        plain = isinstance(node.op, ast.Add) or (_is_number(left) and _is_number(right))
        return work(left, right) if work is not None and known and plain else UNKNOWN

    def _boolop(self, node: ast.BoolOp, scope: dict[str, Any]) -> Any:
        values = [self.value(item, scope) for item in node.values]
        if not is_known(values):
            return UNKNOWN
        stops = isinstance(node.op, ast.Or)
        return next((item for item in values if bool(item) is stops), values[-1])

    def _unaryop(self, node: ast.UnaryOp, scope: dict[str, Any]) -> Any:
        value = self.value(node.operand, scope)
        if isinstance(node.op, ast.Not):
            return not value if is_known(value) else UNKNOWN
        return -value if isinstance(node.op, ast.USub) and _is_number(value) else UNKNOWN

    def _compare(self, node: ast.Compare, scope: dict[str, Any]) -> Any:
        left, right = self.value(node.left, scope), self.value(node.comparators[0], scope)
        work = _COMPARISONS.get(type(node.ops[0]))
        if len(node.ops) > 1 or work is None or not is_known(left) or not is_known(right):
            return UNKNOWN
        return work(left, right)

    def _ifexp(self, node: ast.IfExp, scope: dict[str, Any]) -> Any:
        test = self.value(node.test, scope)
        both = [self.value(node.body, scope), self.value(node.orelse, scope)]
        return both[0 if test else 1] if is_known(test) else UNKNOWN

    def _subscript(self, node: ast.Subscript, scope: dict[str, Any]) -> Any:
        owner = self.value(node.value, scope)
        if isinstance(node.slice, ast.Slice):
            return UNKNOWN
        key = self.value(node.slice, scope)
        if isinstance(owner, Name) and owner.dotted == "os.environ":
            return self._environ.get(key, UNKNOWN) if isinstance(key, str) else UNKNOWN
        if isinstance(owner, dict | list | tuple | str) and is_known(key):
            return owner[key]
        return UNKNOWN

    def _attribute(self, node: ast.Attribute, scope: dict[str, Any]) -> Any:
        owner = self.value(node.value, scope)
        if isinstance(owner, Name):
            return Name(f"{owner.dotted}.{node.attr}")
        if isinstance(owner, PurePath) and node.attr in {"parent", "name", "stem", "suffix"}:
            return getattr(owner, node.attr)
        return UNKNOWN

    def _listcomp(self, node: ast.ListComp | ast.GeneratorExp, scope: dict[str, Any]) -> Any:
        loop = node.generators[0]
        items = self.value(loop.iter, scope)
        if len(node.generators) > 1 or not isinstance(items, list | tuple) or _has_unknown(items):
            return UNKNOWN
        found = []
        for item in items:
            inner = dict(scope)
            self._assign(loop.target, item, inner)
            tests = [self.value(test, inner) for test in loop.ifs]
            if not is_known(tests):
                return UNKNOWN
            if all(tests):
                found.append(self.value(node.elt, inner))
        return found

    _generatorexp = _listcomp

    def _call(self, node: ast.Call, scope: dict[str, Any]) -> Any:
        owner, function = self._callee(node, scope)
        arguments = tuple(self._items(node.args, scope))
        keywords: dict[str, Any] = {}
        for item in node.keywords:
            value = self.value(item.value, scope)
            if item.arg is not None:
                keywords[item.arg] = value
            elif isinstance(value, dict):
                keywords.update({key: v for key, v in value.items() if isinstance(key, str)})
        if isinstance(function, Function):
            return self.follow(function, arguments, keywords)
        if isinstance(function, Name):
            return self._named(node, function.dotted, arguments, keywords)
        if isinstance(node.func, ast.Attribute):
            return self._method(node, owner, arguments, keywords)
        return UNKNOWN

    def _callee(self, node: ast.Call, scope: dict[str, Any]) -> tuple[Any, Any]:
        if not isinstance(node.func, ast.Attribute):
            return None, self.value(node.func, scope)
        owner = self.value(node.func.value, scope)
        if isinstance(owner, Name):
            return None, Name(f"{owner.dotted}.{node.func.attr}")
        return owner, None

    def _named(
        self, node: ast.Call, name: str, arguments: tuple[Any, ...], keywords: dict[str, Any]
    ) -> Any:
        work = self._functions.get(name) or self._functions.get(name.rpartition(".")[2])
        if work is not None:
            plain = is_known(arguments) and is_known(keywords)
            outcome = work(*arguments, **keywords) if plain else UNKNOWN
            self.computed.append((Call(name, arguments, keywords, node), outcome))
            return outcome
        made = Call(name, arguments, keywords, node)
        self.calls.append(made)
        inner = keywords.get("function", arguments[0] if arguments else None)
        if name.endswith("OpaqueFunction") and isinstance(inner, Function):
            given = keywords.get("args")
            self.follow(inner, (UNKNOWN, *(given if isinstance(given, list | tuple) else ())), {})
        return made

    def _method(
        self, node: ast.Call, owner: Any, arguments: tuple[Any, ...], keywords: dict[str, Any]
    ) -> Any:
        assert isinstance(node.func, ast.Attribute)
        name = node.func.attr
        if isinstance(owner, list) and name in {"append", "extend", "insert"}:
            _grow(owner, name, arguments)
            return None
        if isinstance(owner, dict) and name == "update":
            owner.update(arguments[0] if arguments and isinstance(arguments[0], dict) else {})
            return None
        of_folder = self._functions.get(f"pathlib.Path.{name}")
        if isinstance(owner, PurePath) and of_folder is not None and is_known(arguments):
            return of_folder(owner, *arguments)
        work = self._methods.get(name) if isinstance(owner, Call) else None
        if work is not None:
            return work(owner)
        if isinstance(owner, Call):
            made = Call(f"{owner.function}.{name}", arguments, keywords, node, owner)
            self.calls.append(made)
            return made
        return method(owner, name, arguments, keywords)


def parse_python(text: str) -> ast.Module:
    """Return a text's syntax tree.

    Raises:
        SyntaxError: it is no Python 3, or nested deeper than Python reads.
    """
    try:
        return ast.parse(text)
    except (MemoryError, RecursionError) as error:
        raise SyntaxError("too many nested parentheses") from error
    except ValueError as error:
        raise SyntaxError(str(error)) from error


def _grow(items: list[Any], name: str, arguments: tuple[Any, ...]) -> None:
    value = arguments[-1] if arguments else UNKNOWN
    if len(items) > _MAX_LENGTH:
        return
    if name != "extend":
        items.append(value)
    elif isinstance(value, list | tuple):
        items.extend(value)
    else:
        items.append(UNKNOWN)


def _is_huge(value: Any) -> bool:
    """Tell what a file could only have made to fill the memory."""
    if isinstance(value, str | list | tuple | dict):
        return len(value) > _MAX_LENGTH
    return isinstance(value, int) and abs(value) > _MAX_SIZE


def _has_unknown(items: Any) -> bool:
    return any(isinstance(item, Unknown) for item in items)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
