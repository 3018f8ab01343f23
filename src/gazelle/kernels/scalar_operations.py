"""Arithmetic with numbers, as NumPy and Python do it.

Integers are computed with in 64 bits, with a sign unless both have none. Dividing by zero gives
infinity or NaN, of integers 0. ``//`` and ``%`` round down, as in Python.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any

from gazelle.kernels.function_text import FunctionText
from gazelle.kernels.kernel_types import (
    BOOL,
    FLOAT32,
    FLOAT64,
    INT64,
    UINT64,
    Scalar,
    joined_floats,
)
from gazelle.kernels.kernel_values import Number, constant

__all__ = ["absolute", "arithmetic", "compared", "converted", "least_or_most", "negated", "truth"]

_FLOATS = {"Add": "fadd", "Sub": "fsub", "Mult": "fmul", "Div": "fdiv"}
_INTEGERS = {"Add": "add", "Sub": "sub", "Mult": "mul", "BitAnd": "and", "BitOr": "or",
             "BitXor": "xor", "LShift": "shl"}  # fmt: skip
_FOLDED: dict[str, Callable[[Any, Any], Any]] = {
    "Add": operator.add, "Sub": operator.sub, "Mult": operator.mul, "BitAnd": operator.and_,
    "BitOr": operator.or_, "BitXor": operator.xor, "LShift": operator.lshift,
    "RShift": operator.rshift,
}  # fmt: skip
_STAY_NATURAL = ("Add", "Mult", "FloorDiv", "RShift", "LShift", "BitOr", "BitXor")
_RELATIONS = {
    "Lt": ("slt", "ult", "olt"), "LtE": ("sle", "ule", "ole"), "Gt": ("sgt", "ugt", "ogt"),
    "GtE": ("sge", "uge", "oge"), "Eq": ("eq", "eq", "oeq"), "NotEq": ("ne", "ne", "une"),
}  # fmt: skip
_MAX_POWER = 64


def converted(text: FunctionText, number: Number, scalar: Scalar) -> Number:
    """Return a number as another type; floats lose their fraction, large integers their front."""
    have = number.scalar
    if have == scalar:
        return number
    if number.known is not None and (scalar.kind == "f" or scalar in (INT64, UINT64)):
        return constant(number.known if scalar.kind == "f" else int(number.known), scalar)
    if scalar.kind == "b":
        return truth(text, number)
    operand = number.operand
    if have.kind == "f" and scalar.kind == "f":
        word = "fpext" if scalar.bits > have.bits else "fptrunc"
    elif have.kind == "f":
        word = "fptoui" if scalar.kind == "u" else "fptosi"
    elif scalar.kind == "f":
        word = "sitofp" if have.kind == "i" else "uitofp"
    elif have.kind == "b":
        word = "zext"
    elif have.bits == scalar.bits:
        return Number(scalar, operand, scalar.kind == "u" or number.is_natural)
    elif have.bits > scalar.bits:
        word = "trunc"
    else:
        word = "sext" if have.kind == "i" else "zext"
    is_natural = scalar.kind == "u" or (
        have.kind != "f" and number.is_natural and scalar.bits >= have.bits
    )
    return Number(scalar, text.let(f"{word} {have.ir} {operand} to {scalar.ir}"), is_natural)


def truth(text: FunctionText, number: Number) -> Number:
    """Return whether a number is not zero."""
    kind = number.scalar
    if kind.kind == "b":
        return number
    if number.known is not None:
        return constant(bool(number.known))
    if kind.kind == "f":
        zero = constant(0.0, kind).operand
        return Number(BOOL, text.let(f"fcmp une {kind.ir} {number.operand}, {zero}"), True)
    return Number(BOOL, text.let(f"icmp ne {kind.ir} {number.operand}, 0"), True)


def arithmetic(text: FunctionText, word: str, one: Number, other: Number) -> Number:
    """Return the result of an operator, named as in `ast`.

    Raises:
        TypeError: there is no such operation for these types.
    """
    if word == "Pow":
        return _power(text, one, other)
    if "f" in (one.scalar.kind, other.scalar.kind) or word == "Div":
        return _of_floats(text, word, one, other)
    return _of_integers(text, word, one, other)


def _of_floats(text: FunctionText, word: str, one: Number, other: Number) -> Number:
    kind = joined_floats(one.scalar, other.scalar)
    if one.scalar.is_integer and other.scalar.is_integer:
        kind = FLOAT64
    a, b = converted(text, one, kind).operand, converted(text, other, kind).operand
    ir, flags = kind.ir, text.flags
    if word in _FLOATS:
        return Number(kind, text.let(f"{_FLOATS[word]} {flags}{ir} {a}, {b}"))
    if word not in ("Mod", "FloorDiv"):
        raise TypeError(f"no operator {word} for floats")
    zero = constant(0.0, kind).operand
    rest = text.let(f"frem {flags}{ir} {a}, {b}")
    is_exact = text.let(f"fcmp oeq {ir} {rest}, {zero}")
    is_below, b_below = (text.let(f"fcmp olt {ir} {x}, {zero}") for x in (rest, b))
    differs = text.let(f"xor i1 {is_below}, {b_below}")
    if word == "Mod":
        moved = text.let(f"fadd {flags}{ir} {rest}, {b}")
        kept = text.let(f"select i1 {differs}, {ir} {moved}, {ir} {rest}")
        signed = text.let(f"call {ir} @llvm.copysign.f{kind.bits}({ir} {zero}, {ir} {b})")
        return Number(kind, text.let(f"select i1 {is_exact}, {ir} {signed}, {ir} {kept}"))
    off = text.let(f"fsub {flags}{ir} {a}, {rest}")
    ratio = text.let(f"fdiv {flags}{ir} {off}, {b}")
    less = text.let(f"fsub {flags}{ir} {ratio}, {constant(1.0, kind).operand}")
    is_less = text.let(f"select i1 {is_exact}, i1 false, i1 {differs}")
    ratio = text.let(f"select i1 {is_less}, {ir} {less}, {ir} {ratio}")
    # What was divided without a rest is a whole number but for rounding.
    whole = text.let(f"call {ir} @llvm.rint.f{kind.bits}({ir} {ratio})")
    is_none = text.let(f"fcmp oeq {ir} {whole}, {zero}")
    real = text.let(f"fdiv {flags}{ir} {a}, {b}")
    none = text.let(f"call {ir} @llvm.copysign.f{kind.bits}({ir} {zero}, {ir} {real})")
    return Number(kind, text.let(f"select i1 {is_none}, {ir} {none}, {ir} {whole}"))


def _of_integers(text: FunctionText, word: str, one: Number, other: Number) -> Number:
    if one.scalar.kind == other.scalar.kind == "b" and word in ("BitAnd", "BitOr", "BitXor"):
        found = text.let(f"{_INTEGERS[word]} i1 {one.operand}, {other.operand}")
        return Number(BOOL, found, True)
    kind = _common(one, other)
    one, other = converted(text, one, kind), converted(text, other, kind)
    if one.known is not None and other.known is not None and word in _FOLDED:
        return constant(_FOLDED[word](one.known, other.known), kind)
    is_natural = kind == UINT64 or (one.is_natural and other.is_natural and word in _STAY_NATURAL)
    a, b = one.operand, other.operand
    if word in _INTEGERS:
        found = text.let(f"{_INTEGERS[word]} i64 {a}, {b}")
        natural_and = word == "BitAnd" and (one.is_natural or other.is_natural)
        return Number(kind, found, is_natural or natural_and)
    if word == "RShift":
        name = "lshr" if kind == UINT64 else "ashr"
        return Number(kind, text.let(f"{name} i64 {a}, {b}"), kind == UINT64 or one.is_natural)
    if word in ("FloorDiv", "Mod"):
        return _rounded_down(text, word, one, other)
    raise TypeError(f"no operator {word} for integers")


def _common(*numbers: Number) -> Scalar:
    """Return the type that integers are computed in."""
    if all(number.scalar.kind == "u" for number in numbers):
        return UINT64
    if any(number.scalar == UINT64 for number in numbers):
        for number in numbers:
            is_known = number.known is not None and number.is_natural
            if number.scalar.kind == "i" and not is_known:
                raise TypeError("a uint64 and an integer with a sign have no type in common")
        return UINT64
    return INT64


def _rounded_down(text: FunctionText, word: str, one: Number, other: Number) -> Number:
    kind, a, b = one.scalar, one.operand, other.operand
    is_plain = kind == UINT64 or (one.is_natural and other.is_natural)
    is_never_zero = bool(other.known)
    # The least integer has no quotient by -1, and processors stop there.
    is_never_minus = is_plain or other.is_natural or other.known not in (None, -1)
    if not is_never_zero:
        is_zero = text.let(f"icmp eq i64 {b}, 0")
        b = text.let(f"select i1 {is_zero}, i64 1, i64 {b}")
    if not is_never_minus:
        is_minus = text.let(f"icmp eq i64 {b}, -1")
        b = text.let(f"select i1 {is_minus}, i64 1, i64 {b}")
    sign = "u" if is_plain else "s"
    rest = text.let(f"{sign}rem i64 {a}, {b}")
    found = rest if word == "Mod" else text.let(f"{sign}div i64 {a}, {b}")
    if not is_plain:
        mixed = text.let(f"icmp slt i64 {text.let(f'xor i64 {rest}, {b}')}, 0")
        is_inexact = text.let(f"icmp ne i64 {rest}, 0")
        is_off = text.let(f"and i1 {mixed}, {is_inexact}")
        if word == "Mod":
            other_rest = text.let(f"add i64 {rest}, {b}")
            found = text.let(f"select i1 {is_off}, i64 {other_rest}, i64 {rest}")
        else:
            found = text.let(f"sub i64 {found}, {text.let(f'zext i1 {is_off} to i64')}")
    if not is_never_minus and word == "FloorDiv":
        turned = text.let(f"sub i64 0, {a}")
        found = text.let(f"select i1 {is_minus}, i64 {turned}, i64 {found}")
    if not is_never_zero:
        found = text.let(f"select i1 {is_zero}, i64 0, i64 {found}")
    return Number(kind, found, is_plain or (word == "Mod" and other.is_natural))


def _power(text: FunctionText, one: Number, other: Number) -> Number:
    exponent = other.known
    if one.scalar.kind == "b":
        one = converted(text, one, INT64)
    if isinstance(exponent, int) and 0 <= exponent <= _MAX_POWER:
        result: Number | None = None
        square = one
        while exponent:
            if exponent & 1:
                result = square if result is None else arithmetic(text, "Mult", result, square)
            exponent >>= 1
            if exponent:
                square = arithmetic(text, "Mult", square, square)
        return constant(1, one.scalar) if result is None else result
    kind = joined_floats(one.scalar, other.scalar)
    if kind == FLOAT32 and "f" not in (one.scalar.kind, other.scalar.kind):
        kind = FLOAT64
    a, b = converted(text, one, kind).operand, converted(text, other, kind).operand
    call = f"call {text.flags}{kind.ir} @llvm.pow.f{kind.bits}({kind.ir} {a}, {kind.ir} {b})"
    return Number(kind, text.let(call))


def compared(text: FunctionText, word: str, one: Number, other: Number) -> Number:
    """Return whether a relation, named as in `ast`, holds.

    Raises:
        TypeError: there is no such relation of numbers.
    """
    if word not in _RELATIONS:
        raise TypeError(f"no relation {word} of numbers")
    signed, unsigned, ordered = _RELATIONS[word]
    if "f" in (one.scalar.kind, other.scalar.kind):
        kind = joined_floats(one.scalar, other.scalar)
        a, b = converted(text, one, kind).operand, converted(text, other, kind).operand
        return Number(BOOL, text.let(f"fcmp {text.flags}{ordered} {kind.ir} {a}, {b}"), True)
    kind = _common(one, other)
    a, b = converted(text, one, kind).operand, converted(text, other, kind).operand
    name = unsigned if kind == UINT64 else signed
    return Number(BOOL, text.let(f"icmp {name} i64 {a}, {b}"), True)


def least_or_most(text: FunctionText, word: str, numbers: list[Number]) -> Number:
    """Return the least (``Lt``) or the greatest (``Gt``) as Python's ``min`` and ``max`` do."""
    kind = numbers[0].scalar
    if any(number.scalar.kind == "f" for number in numbers):
        for number in numbers[1:]:
            kind = joined_floats(kind, number.scalar)
    elif any(number.scalar != kind for number in numbers):
        kind = _common(*numbers)
    found = converted(text, numbers[0], kind)
    for number in numbers[1:]:
        other = converted(text, number, kind)
        is_better = compared(text, word, other, found).operand
        ir = kind.ir
        chosen = text.let(f"select i1 {is_better}, {ir} {other.operand}, {ir} {found.operand}")
        both, either = found.is_natural and other.is_natural, found.is_natural or other.is_natural
        found = Number(kind, chosen, either if word == "Gt" else both)
    return found


def negated(text: FunctionText, number: Number) -> Number:
    """Return a number with the other sign."""
    if number.known is not None:
        kind = number.scalar if number.scalar.kind == "f" else INT64
        return constant(-number.known, kind)
    if number.scalar.kind == "f":
        kind = number.scalar
        return Number(kind, text.let(f"fneg {text.flags}{kind.ir} {number.operand}"))
    whole = converted(text, number, INT64)
    return Number(INT64, text.let(f"sub i64 0, {whole.operand}"))


def absolute(text: FunctionText, number: Number) -> Number:
    """Return how far a number is from zero."""
    kind = number.scalar
    if kind.kind == "f":
        call = f"call {text.flags}{kind.ir} @llvm.fabs.f{kind.bits}({kind.ir} {number.operand})"
        return Number(kind, text.let(call))
    whole = converted(text, number, INT64)
    return Number(INT64, text.let(f"call i64 @llvm.abs.i64(i64 {whole.operand}, i1 false)"), True)
