"""What a kernel computes with while it is compiled: numbers, arrays and tuples by their parts."""

from __future__ import annotations

import struct
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from gazelle.kernels.kernel_types import (
    BOOL,
    FLOAT64,
    INT64,
    NONE,
    UINT64,
    Array,
    KernelType,
    NoneType,
    Record,
    Scalar,
    Tuple,
    element_of,
)

__all__ = [
    "ArrayValue",
    "Known",
    "Nothing",
    "Number",
    "RecordValue",
    "TupleValue",
    "Value",
    "constant",
    "from_parts",
    "parts",
    "type_of_value",
]


class Number(NamedTuple):
    """A number.

    Attributes:
        scalar: its type.
        operand: LLVM's name of it, or the number.
        is_natural: it is not negative for certain.
        known: the number where it is known, else None.
    """

    scalar: Scalar
    operand: str
    is_natural: bool = False
    known: int | float | bool | None = None


class ArrayValue(NamedTuple):
    """An array.

    Attributes:
        element: of it.
        address: where it begins.
        shape: of it.
        strides: bytes, where it is not contiguous.
        is_writeable: a kernel may write to it.
    """

    element: Scalar | Record
    address: str
    shape: tuple[Number, ...]
    strides: tuple[str, ...] = ()
    is_writeable: bool = True


class RecordValue(NamedTuple):
    """A record in an array, and whether a kernel may write to it."""

    record: Record
    address: str
    is_writeable: bool = True


class TupleValue(NamedTuple):
    """A tuple, and the `NamedTuple` that it is one of."""

    items: tuple[Value, ...]
    maker: Any = None

    @property
    def names(self) -> tuple[str, ...]:
        """The names of its items, where they have names."""
        return tuple(getattr(self.maker, "_fields", ()))


class Known(NamedTuple):
    """What Python knows while it compiles: a function, a module, a type."""

    thing: Any


class Nothing(NamedTuple):
    """None."""


Value: TypeAlias = Number | ArrayValue | RecordValue | TupleValue | Known | Nothing


def constant(value: float, scalar: Scalar | None = None) -> Number:
    """Return a number that is known, of Python's type for it where none is given.

    Raises:
        TypeError: an integer is too large.
    """
    if scalar is None:
        scalar = _scalar_of(value)
    if scalar.kind == "f":
        return Number(scalar, _digits(float(value), scalar), known=float(value))
    if scalar.kind == "b":
        return Number(scalar, "true" if value else "false", True, bool(value))
    whole = int(value)
    least = -(1 << (scalar.bits - 1)) if scalar.kind == "i" else 0
    if not least <= whole < least + (1 << scalar.bits):
        raise TypeError(f"{whole} does not fit into {scalar.name}")
    return Number(scalar, str(whole), whole >= 0, whole)


def _scalar_of(value: float) -> Scalar:
    if isinstance(value, np.generic):
        found = element_of(value.dtype)
        assert isinstance(found, Scalar)
        return INT64 if found.kind == "i" else found
    if isinstance(value, bool):
        return BOOL
    if isinstance(value, int):
        return UINT64 if value >= 1 << 63 else INT64
    return FLOAT64


def _digits(value: float, scalar: Scalar) -> str:
    if scalar.bits == 32:
        value = float(np.float32(value))
    return f"0x{struct.pack('>d', value).hex().upper()}"


def type_of_value(value: Value) -> KernelType:
    """Return the type of a value.

    Raises:
        TypeError: it is something that only Python knows.
    """
    match value:
        case Number():
            return value.scalar
        case ArrayValue():
            ndim, is_contiguous = len(value.shape), not value.strides
            return Array(value.element, ndim, is_contiguous, value.is_writeable)
        case RecordValue():
            return value.record
        case TupleValue():
            return Tuple(tuple(map(type_of_value, value.items)), value.maker)
        case Nothing():
            return NONE
    raise TypeError(f"{value.thing!r} is no value of a kernel")


def parts(value: Value) -> tuple[str, ...]:
    """Return the operands of a value's parts, in the order of `kernel_types.parts_of`."""
    match value:
        case Number():
            return (value.operand,)
        case ArrayValue():
            return (value.address, *(number.operand for number in value.shape), *value.strides)
        case RecordValue():
            return (value.address,)
        case TupleValue():
            return tuple(part for item in value.items for part in parts(item))
    return ()


def from_parts(kind: KernelType, operands: Sequence[str]) -> Value:
    """Return a value of the parts of it."""
    return _taken(kind, iter(operands))


def _taken(kind: KernelType, operands: Iterator[str]) -> Value:
    match kind:
        case Scalar():
            # Numbers without a sign are never negative, nor are truth values.
            return Number(kind, next(operands), kind.kind in "ub")
        case Record():
            return RecordValue(kind, next(operands))
        case Array():
            address = next(operands)
            shape = tuple(Number(INT64, next(operands), True) for _ in range(kind.ndim))
            count = 0 if kind.is_contiguous else kind.ndim
            strides = tuple(next(operands) for _ in range(count))
            return ArrayValue(kind.element, address, shape, strides, kind.is_writeable)
        case Tuple():
            return TupleValue(tuple(_taken(each, operands) for each in kind.elements), kind.maker)
        case NoneType():
            return Nothing()
