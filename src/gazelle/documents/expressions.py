"""Python expressions of a user's file, compiled so that a `Budget` watches what they do.

One operation can take for ever or fill the memory (``9**9**9``, ``'a' * 10**10``), where no
signal and no trace function is heard. So operations that can grow are calls of the budget, which
computes the very same unless the result would be absurd.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from types import CodeType

from gazelle.documents.budget import HUGE_NUMBER
from gazelle.documents.scale import LimitError

__all__ = ["compile_limited", "names_in_code"]

_OPERATIONS: dict[type[ast.operator], str] = {
    ast.Add: "_limited_sum",
    ast.LShift: "_limited_shift",
    ast.Mod: "_limited_modulo",
    ast.Mult: "_limited_product",
    ast.Pow: "_limited_power",
}


def compile_limited(text: str, name: str = "<expression>") -> CodeType:
    """Compile an expression whose names include `Budget.names`.

    Args:
        text: a Python expression.
        name: the file name in tracebacks.

    Raises:
        SyntaxError: it is none.
        LimitError: it is nested absurdly deep.
    """
    try:
        tree = _Limiting().visit(ast.parse(text, name, "eval"))
        return compile(ast.fix_missing_locations(tree), name, "eval")
    except (RecursionError, MemoryError) as error:
        raise LimitError("an expression is nested too deep to be understood") from error


def names_in_code(code: CodeType) -> Iterator[str]:
    """Yield the names an expression uses, those inside its comprehensions and lambdas too."""
    yield from code.co_names
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            yield from names_in_code(constant)


class _Limiting(ast.NodeTransformer):
    def visit_BinOp(self, node: ast.BinOp) -> ast.expr:
        self.generic_visit(node)
        function = _OPERATIONS.get(type(node.op))
        # What is computed with a decimal number is one itself, or an error.
        if function is None or _is_float(node.left) or _is_float(node.right):
            return node
        return _call(function, [node.left, node.right], node)

    def visit_Call(self, node: ast.Call) -> ast.expr:
        self.generic_visit(node)
        # Without arguments nothing grows, and vars() looks at the frame that calls it.
        if not node.args and not node.keywords:
            return node
        new = _call("_limited_call", [node.func, *node.args], node)
        new.keywords = node.keywords
        return new

    def visit_Starred(self, node: ast.Starred) -> ast.Starred:
        self.generic_visit(node)
        if isinstance(node.ctx, ast.Load):
            node.value = _call("_limited_iterable", [node.value], node.value)
        return node

    def visit_comprehension(self, node: ast.comprehension) -> ast.comprehension:
        self.generic_visit(node)
        node.iter = _call("_limited_iterable", [node.iter], node.iter)
        return node

    def visit_FormattedValue(self, node: ast.FormattedValue) -> ast.FormattedValue:
        self.generic_visit(node)
        if isinstance(node.format_spec, ast.JoinedStr):
            for part in node.format_spec.values:
                text = part.value if isinstance(part, ast.Constant) else ""
                if isinstance(text, str) and re.search(HUGE_NUMBER, text):
                    raise LimitError(f"a text of {text} characters is too long")
        node.value = _call("_limited_value", [node.value], node.value)
        return node


def _is_float(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, float)


def _call(function: str, arguments: list[ast.expr], place: ast.expr) -> ast.Call:
    new = ast.Call(ast.Name(function, ast.Load()), arguments, [])
    return ast.copy_location(new, place)
