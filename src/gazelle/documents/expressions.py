"""Python expressions of a user's file, compiled so that a `Budget` watches what they do.

One operation can take for ever or fill the memory (``9**9**9``, ``'a' * 10**10``), where no
signal and no trace function is heard. So operations that can grow are calls of the budget, which
computes the very same unless the result would be absurd.
"""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Callable, Iterable, Iterator, Sized
from types import CodeType
from typing import Any

from gazelle.documents.files import LimitError, scaled

__all__ = ["HUGE_NUMBER", "Budget", "compile_limited", "names_in_code"]

HUGE_NUMBER = r"\d{7,}"
_MAX_STEPS = 2_000_000
_MAX_ITEMS = 2_000_000
_MAX_CHARACTERS = 10_000_000
_MAX_BITS = 100_000
_MAX_FACTORS = 10_000
_COUNTING = (math.factorial, math.comb, math.perm)
_PADDING = frozenset({"center", "expandtabs", "ljust", "rjust", "to_bytes", "zfill"})
_CONTAINERS = (list, tuple, set, frozenset, dict)
_OPERATIONS: dict[type[ast.operator], str] = {
    ast.Add: "_limited_sum",
    ast.LShift: "_limited_shift",
    ast.Mod: "_limited_modulo",
    ast.Mult: "_limited_product",
    ast.Pow: "_limited_power",
}


class Budget:
    """Does the operations of expressions, and refuses those whose result would be absurd.

    Attributes:
        names: the names that expressions of `compile_limited` need, for their builtins.
    """

    def __init__(self) -> None:
        self._steps = 0
        self._most_steps = scaled(_MAX_STEPS)
        self._measured: dict[int, Any] = {}
        self.names: dict[str, Callable[..., Any]] = {
            "_limited_call": self._call,
            "_limited_iterable": self._iterable,
            "_limited_modulo": self._modulo,
            "_limited_power": self._power,
            "_limited_product": self._product,
            "_limited_shift": self._shift,
            "_limited_sum": self._sum,
            "_limited_value": self.checked,
        }

    def checked(self, value: Any) -> Any:
        """Return a value that is about to be stored or printed.

        Raises:
            LimitError: it is too large, or holds so often the same that its text would be.
        """
        if isinstance(value, str):
            _check_size(len(value), _MAX_CHARACTERS, "a text of {} characters")
        elif isinstance(value, _CONTAINERS) and value:
            known = self._measured.get(id(value))
            if known is None or known[0] is not value or known[1] != len(value):
                _check_size(_expanded_size(value, {}), _MAX_ITEMS, "a list of {} items")
                # Kept, so that no other value gets its id.
                self._measured[id(value)] = (value, len(value))
        elif isinstance(value, int):
            _check_bits(value.bit_length())
        return value

    def _spend(self, steps: int) -> None:
        self._steps += steps
        if self._steps > self._most_steps:
            raise LimitError(
                f"the expressions of this file take more than {self._most_steps} steps"
            )

    def _iterable(self, value: Iterable[Any]) -> Iterator[Any]:
        return self._counted(iter(value))

    def _counted(self, items: Iterator[Any]) -> Iterator[Any]:
        for item in items:
            self._spend(1)
            yield item

    def _sum(self, left: Any, right: Any) -> Any:
        if isinstance(left, Sized) and isinstance(right, Sized):
            _check_length(left, len(left) + len(right))
        return left + right

    def _product(self, left: Any, right: Any) -> Any:
        if isinstance(left, int):
            if isinstance(right, int):
                _check_bits(left.bit_length() + right.bit_length())
            elif isinstance(right, Sized):
                _check_length(right, len(right) * left)
        elif isinstance(right, int) and isinstance(left, Sized):
            _check_length(left, len(left) * right)
        return left * right

    def _power(self, left: Any, right: Any) -> Any:
        if isinstance(left, int) and isinstance(right, int):
            _check_bits(max(abs(left).bit_length() - 1, 0) * max(right, 0))
        return left**right

    def _shift(self, left: Any, right: Any) -> Any:
        if isinstance(left, int) and isinstance(right, int):
            _check_bits(left.bit_length() + right)
        return left << right

    def _modulo(self, left: Any, right: Any) -> Any:
        if isinstance(left, str):
            numbers = right if isinstance(right, tuple) else (right,)
            _check_template(left, numbers if "*" in left else ())
            for number in numbers:
                self.checked(number)
        return left % right

    def _call(self, function: Any, *arguments: Any, **named: Any) -> Any:
        self._spend(1)
        for value in arguments:
            if isinstance(value, range):
                _check_size(len(value), _MAX_ITEMS, "a range of {} numbers")
                self._spend(len(value))
        owner = getattr(function, "__self__", None)
        if isinstance(owner, str | bytes | int) and not isinstance(owner, bool):
            self._check_method(owner, function.__name__, arguments, named)
        elif isinstance(owner, list) and arguments and isinstance(arguments[0], Sized):
            _check_length(owner, len(owner) + len(arguments[0]))
        elif function is pow:
            self._power(*arguments[:2])
        elif function in (str, repr):
            self.checked(arguments[0]) if arguments else None
        elif function is round and len(arguments) > 1 and isinstance(arguments[1], int):
            _check_bits(4 * abs(arguments[1]))
        elif function in _COUNTING:
            numbers = [abs(value) for value in arguments if isinstance(value, int)]
            _check_size(max(numbers, default=0), _MAX_FACTORS, "a product of {} factors")
        return function(*arguments, **named)

    def _check_method(
        self, owner: Any, name: str, arguments: tuple[Any, ...], named: dict[str, Any]
    ) -> None:
        if name in _PADDING:
            for value in (*arguments, *named.values()):
                if isinstance(value, int):
                    _check_size(value, _MAX_CHARACTERS, "a text of {} characters")
        elif name in {"format", "format_map"}:
            values = (*arguments, *named.values())
            _check_template(str(owner), values if ":{" in str(owner) else ())
            for value in values:
                self.checked(value)
        elif name == "replace" and len(arguments) > 1:
            old, new = arguments[:2]
            size = len(owner) + owner.count(old) * len(new)
            _check_size(size, _MAX_CHARACTERS, "a text of {} characters")
        elif name == "join" and isinstance(arguments[0], list | tuple):
            size = sum(len(item) + len(owner) for item in arguments[0] if isinstance(item, Sized))
            _check_size(size, _MAX_CHARACTERS, "a text of {} characters")


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


def _expanded_size(value: Any, known: dict[int, int]) -> int:
    """Return how many items a value prints; what it holds several times counts as often."""
    if not isinstance(value, _CONTAINERS):
        return 1
    size = known.get(id(value))
    if size is None:
        # A list that holds itself prints as [...].
        known[id(value)] = 1
        items = value.values() if isinstance(value, dict) else value
        size = 1 + sum(_expanded_size(item, known) for item in items)
        known[id(value)] = size
    return size


def _check_template(template: str, numbers: Iterable[Any]) -> None:
    widths = [int(text) for text in re.findall(HUGE_NUMBER, template)]
    widths += [abs(value) for value in numbers if isinstance(value, int)]
    _check_size(max(widths, default=0), _MAX_CHARACTERS, "a text of {} characters")


def _check_length(value: Any, size: int) -> None:
    is_text = isinstance(value, str | bytes)
    what = "a text of {} characters" if is_text else "a list of {} items"
    _check_size(size, _MAX_CHARACTERS if is_text else _MAX_ITEMS, what)


def _check_bits(bits: int) -> None:
    _check_size(bits, _MAX_BITS, "a whole number of {} binary digits")


def _check_size(size: int, most: int, what: str) -> None:
    if size > most and size > (limit := scaled(most)):
        shown = str(size) if size < 10**15 else "more than 10^15"
        raise LimitError(f"{what.format(shown)} is above the limit of {limit}")


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
