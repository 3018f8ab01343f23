"""The types a kernel's values have, and what Python's values are of."""

from __future__ import annotations

import functools
import operator
from typing import Any, NamedTuple, TypeAlias

import numpy as np

__all__ = [
    "BOOL",
    "FLOAT32",
    "FLOAT64",
    "INT64",
    "NONE",
    "UINT64",
    "Array",
    "Field",
    "KernelType",
    "NoneType",
    "Record",
    "Scalar",
    "Tuple",
    "described",
    "element_of",
    "has_arrays",
    "joined",
    "joined_floats",
    "parts_of",
    "result_ir",
    "type_of",
]


class Scalar(NamedTuple):
    """A number.

    Attributes:
        name: NumPy's, e.g. ``float64``.
        kind: ``b``, ``i``, ``u`` or ``f``, as NumPy's.
        bits: of memory.
    """

    name: str
    kind: str
    bits: int

    @property
    def is_integer(self) -> bool:
        """Also for truth values, which count as 0 and 1."""
        return self.kind != "f"

    @property
    def ir(self) -> str:
        """LLVM's type of a value."""
        if self.kind == "f":
            return "double" if self.bits == 64 else "float"
        return "i1" if self.kind == "b" else f"i{self.bits}"

    @property
    def stored_ir(self) -> str:
        """LLVM's type in memory."""
        return "i8" if self.kind == "b" else self.ir


BOOL = Scalar("bool", "b", 8)
INT64 = Scalar("int64", "i", 64)
UINT64 = Scalar("uint64", "u", 64)
FLOAT32 = Scalar("float32", "f", 32)
FLOAT64 = Scalar("float64", "f", 64)
_SCALARS = {
    scalar.name: scalar
    for scalar in (
        BOOL, INT64, UINT64, FLOAT32, FLOAT64,
        *(Scalar(f"int{bits}", "i", bits) for bits in (8, 16, 32)),
        *(Scalar(f"uint{bits}", "u", bits) for bits in (8, 16, 32)),
    )
}  # fmt: skip


class Field(NamedTuple):
    """A field of a record: where it lies, and its shape, empty for one number."""

    name: str
    offset: int
    scalar: Scalar
    shape: tuple[int, ...]


class Record(NamedTuple):
    """An element of an array of records.

    Attributes:
        fields: of it.
        size: bytes.
        format: of the buffer protocol.
    """

    fields: tuple[Field, ...]
    size: int
    format: str


class Array(NamedTuple):
    """An array.

    Attributes:
        element: of it.
        ndim: dimensions.
        is_contiguous: it lies in C's order; otherwise each dimension has its stride.
        is_writeable: a kernel may write to it.
    """

    element: Scalar | Record
    ndim: int
    is_contiguous: bool = True
    is_writeable: bool = True


class Tuple(NamedTuple):
    """A tuple.

    Attributes:
        elements: types of its items.
        maker: the `NamedTuple` that it is one of.
    """

    elements: tuple[KernelType, ...]
    maker: type | None = None


class NoneType(NamedTuple):
    """Of what returns nothing."""


NONE = NoneType()
KernelType: TypeAlias = Scalar | Record | Array | Tuple | NoneType


def element_of(dtype: Any) -> Scalar | Record:
    """Return the type of an array's elements.

    Raises:
        TypeError: kernels have none of this kind.
    """
    dtype = np.dtype(dtype)
    if dtype.fields is not None and dtype.names is not None:
        fields = tuple(_field(dtype, name) for name in dtype.names)
        return Record(fields, dtype.itemsize, np.empty(2, dtype).data.format)
    if not dtype.isnative or dtype.name not in _SCALARS:
        raise TypeError(f"kernels take no arrays of {dtype}")
    return _SCALARS[dtype.name]


def _field(dtype: np.dtype[Any], name: str) -> Field:
    kind, offset = dtype.fields[name][:2]  # type: ignore[index]
    scalar = element_of(kind.base)
    if not isinstance(scalar, Scalar):
        raise TypeError("kernels take no records in records")
    return Field(name, offset, scalar, kind.shape)


def type_of(value: Any) -> KernelType:
    """Return the type of an argument.

    Raises:
        TypeError: kernels take nothing of its kind.
    """
    if isinstance(value, np.ndarray):
        flags = value.flags
        if not flags.aligned:
            raise TypeError("kernels take no array whose elements are not aligned")
        element = element_of(value.dtype)
        return Array(element, value.ndim, flags.c_contiguous, flags.writeable)
    if isinstance(value, bool):
        return BOOL
    if isinstance(value, np.generic):
        scalar = element_of(value.dtype)
        assert isinstance(scalar, Scalar)
        # Python's own and NumPy's of the same size are one.
        return INT64 if scalar.kind == "i" else scalar
    if isinstance(value, int):
        return INT64
    if isinstance(value, float):
        return FLOAT64
    if isinstance(value, tuple):
        return Tuple(tuple(map(type_of, value)), None if type(value) is tuple else type(value))
    if value is None:
        return NONE
    raise TypeError(f"kernels take no {type(value).__name__}")


def joined(one: KernelType, other: KernelType) -> KernelType | None:
    """Return the type that holds values of both, None where there is none."""
    if one == other:
        return one
    match one, other:
        case Scalar(), Scalar():
            return _joined_scalars(one, other)
        case Array(), Array() if (one.element, one.ndim) == (other.element, other.ndim):
            is_contiguous = one.is_contiguous and other.is_contiguous
            is_writeable = one.is_writeable and other.is_writeable
            return Array(one.element, one.ndim, is_contiguous, is_writeable)
        case Tuple(), Tuple() if len(one.elements) == len(other.elements):
            elements = tuple(map(joined, one.elements, other.elements))
            if None not in elements:
                return Tuple(elements, one.maker or other.maker)  # type: ignore[arg-type]
    return None


def _joined_scalars(one: Scalar, other: Scalar) -> Scalar:
    if "f" in (one.kind, other.kind):
        return joined_floats(one, other)
    if "b" in (one.kind, other.kind):
        return other if one.kind == "b" else one
    if one.kind == other.kind:
        return max(one, other, key=lambda scalar: scalar.bits)
    return INT64


def joined_floats(one: Scalar, other: Scalar) -> Scalar:
    """Return what a float and another number give: single precision with small integers only."""
    for scalar in (one, other):
        if scalar == FLOAT64 or (scalar.kind != "f" and scalar.bits > 16):
            return FLOAT64
    return FLOAT32


@functools.cache
def parts_of(kind: KernelType) -> tuple[str, ...]:
    """Return LLVM's types of the parts of a value; tuples and arrays are given in parts."""
    match kind:
        case Scalar():
            return (kind.ir,)
        case Record():
            return ("ptr",)
        case Array():
            return ("ptr", *(["i64"] * kind.ndim * (1 if kind.is_contiguous else 2)))
        case Tuple():
            return functools.reduce(operator.add, map(parts_of, kind.elements), ())
    return ()


def result_ir(kind: KernelType) -> str:
    """Return LLVM's type of what a function returns."""
    words = parts_of(kind)
    if len(words) == 1:
        return words[0]
    return f"{{ {', '.join(words)} }}" if words else "void"


def described(kind: KernelType) -> str:
    """Return a type in words: ``float64[:, :]``."""
    match kind:
        case Scalar():
            return kind.name
        case Record():
            return f"record of {', '.join(field.name for field in kind.fields)}"
        case Array():
            return f"{described(kind.element)}[{', '.join(':' * kind.ndim)}]"
        case Tuple():
            name = kind.maker.__name__ if kind.maker is not None else ""
            return f"{name}({', '.join(map(described, kind.elements))})"
    return "None"


def has_arrays(kind: KernelType) -> bool:
    """Tell whether a value refers to memory."""
    if isinstance(kind, Tuple):
        return any(map(has_arrays, kind.elements))
    return isinstance(kind, Array | Record)
