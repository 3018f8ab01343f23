"""What kernels may call of Python and its `math`: what it gives, and how it is computed."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from gazelle.kernels.function_text import FunctionText
from gazelle.kernels.kernel_types import BOOL, FLOAT32, FLOAT64, INT64, Scalar, joined_floats
from gazelle.kernels.kernel_values import ArrayValue, Number, TupleValue, Value, constant
from gazelle.kernels.scalar_operations import (
    absolute,
    arithmetic,
    converted,
    least_or_most,
    truth,
)

__all__ = ["CALLS", "DECLARATIONS", "Builtin", "Call"]

_INTRINSICS = ("sqrt", "sin", "cos", "exp", "log", "log2", "floor", "ceil", "rint", "fabs", "trunc")
_OF_TWO = ("pow", "copysign")
_LIBRARY = ("tan", "asin", "acos", "atan")
_IR = {FLOAT64: "double", FLOAT32: "float"}

DECLARATIONS = "\n".join(
    [
        *(
            f"declare {ir} @llvm.{name}.f{kind.bits}({ir})"
            for name in _INTRINSICS
            for kind, ir in _IR.items()
        ),
        *(
            f"declare {ir} @llvm.{name}.f{kind.bits}({ir}, {ir})"
            for name in _OF_TWO
            for kind, ir in _IR.items()
        ),
        *(f"declare double @{name}(double) nounwind memory(none) willreturn" for name in _LIBRARY),
        "declare double @atan2(double, double) nounwind memory(none) willreturn",
        "declare i64 @llvm.abs.i64(i64, i1)",
        "declare void @llvm.memmove.p0.p0.i64(ptr, ptr, i64, i1)",
        "declare void @llvm.memset.p0.i64(ptr, i8, i64, i1)",
    ]
)
"""What the functions of a program may use of LLVM and of the system's library of mathematics."""


class Call(NamedTuple):
    """A call that is compiled: where, and what it is given."""

    text: FunctionText
    arguments: list[Value]

    def number(self, place: int = 0) -> Number:
        """Return an argument that is a number.

        Raises:
            TypeError: it is something else.
        """
        value = self.arguments[place]
        if not isinstance(value, Number):
            raise TypeError("a number is needed here")
        return value

    def numbers(self) -> list[Number]:
        """Return all arguments, numbers."""
        return [self.number(place) for place in range(len(self.arguments))]

    def floating(self, place: int = 0) -> Number:
        """Return an argument as a float: single precision stays so."""
        number = self.number(place)
        kind = number.scalar if number.scalar.kind == "f" else FLOAT64
        return converted(self.text, number, kind)


def _intrinsic(name: str) -> Callable[[Call], Number]:
    def call(call: Call) -> Number:
        number = call.floating()
        return Number(number.scalar, _result(call, name, number))

    return call


def _result(call: Call, name: str, number: Number) -> str:
    kind = number.scalar
    words = f"{kind.ir} @llvm.{name}.f{kind.bits}({kind.ir} {number.operand})"
    return call.text.let(f"call {call.text.flags}{words}")


def _to_whole(name: str) -> Callable[[Call], Number]:
    """Return what rounds to an integer of 64 bits."""

    def call(call: Call) -> Number:
        if call.number().scalar.is_integer:
            return converted(call.text, call.number(), INT64)
        number = call.floating()
        rounded = Number(number.scalar, _result(call, name, number))
        return converted(call.text, rounded, INT64)

    return call


def _library(name: str) -> Callable[[Call], Number]:
    def call(call: Call) -> Number:
        numbers = [converted(call.text, one, FLOAT64).operand for one in call.numbers()]
        words = ", ".join(f"double {one}" for one in numbers)
        return Number(FLOAT64, call.text.let(f"call double @{name}({words})"))

    return call


def _hypot(call: Call) -> Number:
    one, other = call.floating(0), call.floating(1)
    kind = joined_floats(one.scalar, other.scalar)
    one, other = converted(call.text, one, kind), converted(call.text, other, kind)
    squares = [arithmetic(call.text, "Mult", each, each) for each in (one, other)]
    whole = arithmetic(call.text, "Add", *squares)
    return Number(kind, _result(call, "sqrt", whole))


def _copysign(call: Call) -> Number:
    one, other = call.floating(0), call.floating(1)
    kind = joined_floats(one.scalar, other.scalar)
    a, b = (converted(call.text, each, kind).operand for each in (one, other))
    words = f"{kind.ir} @llvm.copysign.f{kind.bits}({kind.ir} {a}, {kind.ir} {b})"
    return Number(kind, call.text.let(f"call {words}"))


def _is(relation: str, number: float) -> Callable[[Call], Number]:
    def call(call: Call) -> Number:
        found = call.floating()
        kind = found.scalar
        if relation == "une":
            words = f"fcmp une {kind.ir} {found.operand}, {found.operand}"
        else:
            size = absolute(call.text, found).operand
            words = f"fcmp {relation} {kind.ir} {size}, {constant(number, kind).operand}"
        return Number(BOOL, call.text.let(words), True)

    return call


def _extreme(relation: str) -> Callable[[Call], Number]:
    return lambda call: least_or_most(call.text, relation, call.numbers())


def _length(call: Call) -> Number:
    match call.arguments[0]:
        case ArrayValue() as array:
            return array.shape[0]
        case TupleValue() as whole:
            return constant(len(whole.items))
    raise TypeError("only arrays and tuples have a length")


def _as(scalar: Scalar) -> Callable[[Call], Number]:
    return lambda call: converted(call.text, call.number(), scalar)


class Builtin(NamedTuple):
    """How a function is computed, and how many arguments it takes."""

    compute: Callable[[Call], Number]
    least: int = 1
    most: int = 1


_COMPUTED: dict[Any, Callable[[Call], Number]] = {
    abs: lambda call: absolute(call.text, call.number()),
    bool: lambda call: truth(call.text, call.number()),
    float: _as(FLOAT64),
    int: _as(INT64),
    len: _length,
    max: _extreme("Gt"),
    min: _extreme("Lt"),
    round: _to_whole("rint"),
    math.acos: _library("acos"),
    math.asin: _library("asin"),
    math.atan: _library("atan"),
    math.atan2: _library("atan2"),
    math.ceil: _to_whole("ceil"),
    math.copysign: _copysign,
    math.cos: _intrinsic("cos"),
    math.exp: _intrinsic("exp"),
    math.fabs: _intrinsic("fabs"),
    math.floor: _to_whole("floor"),
    math.hypot: _hypot,
    math.isfinite: _is("olt", math.inf),
    math.isinf: _is("oeq", math.inf),
    math.isnan: _is("une", math.nan),
    math.log: _intrinsic("log"),
    math.log2: _intrinsic("log2"),
    math.sin: _intrinsic("sin"),
    math.sqrt: _intrinsic("sqrt"),
    math.tan: _library("tan"),
    math.trunc: _to_whole("trunc"),
}
_COUNTS = {
    min: (2, 99),
    max: (2, 99),
    math.atan2: (2, 2),
    math.copysign: (2, 2),
    math.hypot: (2, 2),
}

CALLS = {
    function: Builtin(compute, *_COUNTS.get(function, (1, 1)))
    for function, compute in _COMPUTED.items()
}
"""By the function itself: Python's `min` of numbers, say."""
