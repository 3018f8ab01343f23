"""Arrays of kernels: places in them, parts of them, and memory for new ones.

An index counts from the end where it is negative, and nothing asks whether it is too large.
What a function makes is given back when it returns; where it returns arrays its caller does that.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from gazelle.kernels.function_text import FunctionText
from gazelle.kernels.kernel_types import INT64, Record, Scalar
from gazelle.kernels.kernel_values import ArrayValue, Number, RecordValue, constant
from gazelle.kernels.scalar_operations import arithmetic, converted, least_or_most

__all__ = [
    "MEMORY",
    "Cut",
    "copied",
    "element_address",
    "field_of",
    "fill",
    "load",
    "made",
    "part",
    "require_writeable",
    "size_of",
    "store",
]

MEMORY = """
declare noalias ptr @malloc(i64)
declare noalias ptr @calloc(i64, i64)
declare void @free(ptr)
declare void @perror(ptr)
declare void @abort() noreturn

@gazelle_no_memory = private constant [38 x i8] c"Gazelle: no room for a kernel's array\\00"

define internal noalias ptr @gazelle_memory(ptr %arena, i64 %size, i1 %cleared) noinline nounwind {
entry:
  %is_negative = icmp slt i64 %size, 0
  br i1 %is_negative, label %none, label %begin
begin:
  %whole = add i64 %size, 16
  br i1 %cleared, label %clear, label %plain
clear:
  %a = call ptr @calloc(i64 1, i64 %whole)
  br label %join
plain:
  %b = call ptr @malloc(i64 %whole)
  br label %join
join:
  %block = phi ptr [ %a, %clear ], [ %b, %plain ]
  %is_none = icmp eq ptr %block, null
  br i1 %is_none, label %none, label %some
none:
  call void @perror(ptr @gazelle_no_memory)
  call void @abort()
  unreachable
some:
  %before = load ptr, ptr %arena
  store ptr %before, ptr %block
  store ptr %block, ptr %arena
  %first = getelementptr i8, ptr %block, i64 16
  ret ptr %first
}

define internal void @gazelle_give_back(ptr %arena, ptr %mark) noinline nounwind {
entry:
  br label %test
test:
  %block = load ptr, ptr %arena
  %done = icmp eq ptr %block, %mark
  br i1 %done, label %end, label %next
next:
  %before = load ptr, ptr %block
  store ptr %before, ptr %arena
  call void @free(ptr %block)
  br label %test
end:
  ret void
}
"""
"""Memory of a call: a list of blocks, the newest first. Where there is none the process ends."""


class Cut(NamedTuple):
    """A slice of one dimension; None where it has no such end."""

    first: Number | None
    last: Number | None


def _size(element: Scalar | Record) -> int:
    return element.size if isinstance(element, Record) else element.bits // 8


def _stored(element: Scalar | Record) -> str:
    return f"[{element.size} x i8]" if isinstance(element, Record) else element.stored_ir


def size_of(text: FunctionText, array: ArrayValue) -> Number:
    """Return how many elements an array has."""
    return _product(text, array.shape)


def _product(text: FunctionText, numbers: Sequence[Number]) -> Number:
    product = constant(1)
    for number in numbers:
        product = number if product.known == 1 else arithmetic(text, "Mult", product, number)
    return product


def _index(text: FunctionText, index: Number, count: Number) -> Number:
    """Return an index that counts from the beginning."""
    if not index.scalar.is_integer:
        raise TypeError(f"an index is an integer, not {index.scalar.name}")
    whole = converted(text, index, INT64)
    if whole.is_natural or index.scalar.kind == "u":
        return whole
    behind = arithmetic(text, "Add", whole, count)
    if whole.known is not None:
        return behind
    is_negative = text.let(f"icmp slt i64 {whole.operand}, 0")
    chosen = f"select i1 {is_negative}, i64 {behind.operand}, i64 {whole.operand}"
    return Number(INT64, text.let(chosen), True)


def _strides(text: FunctionText, array: ArrayValue) -> tuple[Number, ...]:
    """Return the strides in elements (contiguous) or in bytes."""
    if array.strides:
        return tuple(Number(INT64, stride) for stride in array.strides)
    strides = [constant(1)]
    for count in reversed(array.shape[1:]):
        strides.append(arithmetic(text, "Mult", strides[-1], count))
    return tuple(reversed(strides))


def element_address(text: FunctionText, array: ArrayValue, indices: Sequence[Number]) -> str:
    """Return where the element at as many indices as the array has dimensions lies."""
    if len(indices) != len(array.shape):
        raise TypeError(f"{len(indices)} indices of an array of {len(array.shape)} dimensions")
    pairs = zip(indices, array.shape, strict=True)
    whole = [_index(text, index, count) for index, count in pairs]
    if array.strides:
        place = constant(0)
        for index, stride in zip(whole, _strides(text, array), strict=True):
            place = arithmetic(text, "Add", place, arithmetic(text, "Mult", index, stride))
        return text.let(f"getelementptr inbounds i8, ptr {array.address}, i64 {place.operand}")
    place = whole[0]
    for index, count in zip(whole[1:], array.shape[1:], strict=True):
        place = arithmetic(text, "Add", arithmetic(text, "Mult", place, count), index)
    kind = _stored(array.element)
    return text.let(f"getelementptr inbounds {kind}, ptr {array.address}, i64 {place.operand}")


def load(text: FunctionText, scalar: Scalar, address: str) -> Number:
    """Return the number at an address."""
    found = text.let(f"load {scalar.stored_ir}, ptr {address}")
    if scalar.kind == "b":
        found = text.let(f"trunc i8 {found} to i1")
    return Number(scalar, found, scalar.kind in "ub")


def store(text: FunctionText, scalar: Scalar, address: str, number: Number) -> None:
    """Write a number to an address."""
    operand = converted(text, number, scalar).operand
    if scalar.kind == "b":
        operand = text.let(f"zext i1 {operand} to i8")
    text.do(f"store {scalar.stored_ir} {operand}, ptr {address}")


def field_of(text: FunctionText, value: RecordValue, name: str) -> Number | ArrayValue | None:
    """Return a record's field, None where it has none of this name."""
    for field in value.record.fields:
        if field.name == name:
            address = field_address(text, value, field.offset)
            if not field.shape:
                return load(text, field.scalar, address)
            shape = tuple(map(constant, field.shape))
            return ArrayValue(field.scalar, address, shape, is_writeable=value.is_writeable)
    return None


def field_address(text: FunctionText, value: RecordValue, offset: int) -> str:
    """Return where a record's field lies."""
    return text.let(f"getelementptr inbounds i8, ptr {value.address}, i64 {offset}")


def part(text: FunctionText, array: ArrayValue, keys: Sequence[Number | Cut]) -> ArrayValue:
    """Return a part of an array, which shares its memory.

    Args:
        text: where it is computed.
        array: of which.
        keys: of the first dimensions, an index, which takes the dimension away, or a slice.
    """
    if len(keys) > len(array.shape):
        raise TypeError(f"{len(keys)} indices of an array of {len(array.shape)} dimensions")
    strides = _strides(text, array)
    is_plain = not array.strides
    place, shape, kept = constant(0), list[Number](), list[Number]()
    for key, count, stride in zip(keys, array.shape, strides, strict=False):
        if isinstance(key, Cut):
            first = constant(0) if key.first is None else _clipped(text, key.first, count)
            last = count if key.last is None else _clipped(text, key.last, count)
            is_whole = key.first is None and key.last is None
            left = arithmetic(text, "Sub", last, first)
            if first.known == 0:
                left = left._replace(is_natural=True)
            else:
                left = least_or_most(text, "Gt", [left, constant(0)])
            # A row of rows lies behind the other only where nothing is left out between them.
            is_plain = is_plain and (is_whole or not shape)
            shape.append(count if is_whole else left)
            kept.append(stride)
            index = first
        else:
            is_plain = is_plain and not shape
            index = _index(text, key, count)
        place = arithmetic(text, "Add", place, arithmetic(text, "Mult", index, stride))
    shape += array.shape[len(keys) :]
    kept += strides[len(keys) :]
    step = "i8" if array.strides else _stored(array.element)
    address = array.address
    if place.known != 0:
        address = text.let(f"getelementptr {step}, ptr {address}, i64 {place.operand}")
    if is_plain:
        return array._replace(address=address, shape=tuple(shape))
    unit = constant(1 if array.strides else _size(array.element))
    far = tuple(arithmetic(text, "Mult", stride, unit).operand for stride in kept)
    return array._replace(address=address, shape=tuple(shape), strides=far)


def _clipped(text: FunctionText, number: Number, count: Number) -> Number:
    whole = _index(text, number, count)
    if number.known == 0:
        return whole
    if not number.is_natural:
        whole = least_or_most(text, "Gt", [whole, constant(0)])
    return least_or_most(text, "Lt", [whole, count])._replace(is_natural=True)


def made(
    text: FunctionText,
    element: Scalar | Record,
    shape: Sequence[Number],
    *,
    is_cleared: bool,
    is_local: bool,
    most_local: int = 2048,
) -> tuple[ArrayValue, bool]:
    """Return a new array, and whether it takes memory that is to be given back.

    Args:
        text: where it is made.
        element: of it.
        shape: of it.
        is_cleared: all of it is zero.
        is_local: it is gone when the function returns, and made only once until then: where its
            size is known and small it is memory of the function itself.
        most_local: bytes, the largest of these.
    """
    counts = tuple(converted(text, number, INT64)._replace(is_natural=True) for number in shape)
    known = [number.known for number in counts]
    if is_local and None not in known:
        many = math.prod(map(int, known)) * _size(element)  # type: ignore[arg-type]
        if 0 < many <= most_local:
            address = text.room(f"[{many} x i8]", align=16)
            if is_cleared:
                clear = "call void @llvm.memset.p0.i64"
                text.do(f"{clear}(ptr align 16 {address}, i8 0, i64 {many}, i1 false)")
            return ArrayValue(element, address, counts), False
    size = arithmetic(text, "Mult", _product(text, counts), constant(_size(element)))
    cleared = "true" if is_cleared else "false"
    call = f"call ptr @gazelle_memory(ptr %arena, i64 {size.operand}, i1 {cleared})"
    return ArrayValue(element, text.let(call), counts), True


def fill(text: FunctionText, array: ArrayValue, value: Number | ArrayValue) -> None:
    """Write a number everywhere, or an array of the same shape, which may lie in the same memory.

    Raises:
        TypeError: their dimensions differ, there are records in them, or it is not writeable.
    """
    scalar = array.element
    if isinstance(scalar, Record) or (
        isinstance(value, ArrayValue) and len(value.shape) != len(array.shape)
    ):
        raise TypeError("only a number, or an array of as many dimensions, can be written there")
    require_writeable(array)
    if isinstance(value, Number):
        _each(text, array, converted(text, value, scalar), scalar, [])
    elif value.element == scalar and not value.strides and not array.strides:
        size = arithmetic(text, "Mult", size_of(text, array), constant(_size(scalar))).operand
        move = "call void @llvm.memmove.p0.p0.i64"
        text.do(f"{move}(ptr {array.address}, ptr {value.address}, i64 {size}, i1 false)")
    else:
        # Where they overlap, what is written first would be read afterwards.
        assert isinstance(value.element, Scalar)
        mark = text.let("load ptr, ptr %arena")
        spare, _ = made(text, value.element, value.shape, is_cleared=False, is_local=False)
        _each(text, spare, value, value.element, [])
        _each(text, array, spare, scalar, [])
        text.do(f"call void @gazelle_give_back(ptr %arena, ptr {mark})")


def require_writeable(value: ArrayValue | RecordValue) -> None:
    """Let a kernel write there.

    Raises:
        TypeError: it must not.
    """
    if not value.is_writeable:
        raise TypeError("this array cannot be written to")


def _each(
    text: FunctionText,
    array: ArrayValue,
    value: Number | ArrayValue,
    scalar: Scalar,
    indices: list[Number],
) -> None:
    if len(indices) < len(array.shape):
        text.count_up(
            array.shape[len(indices)].operand,
            lambda number: _each(
                text, array, value, scalar, [*indices, Number(INT64, number, True)]
            ),
        )
        return
    number = value
    if isinstance(value, ArrayValue):
        assert isinstance(value.element, Scalar)
        number = load(text, value.element, element_address(text, value, indices))
    assert isinstance(number, Number)
    store(text, scalar, element_address(text, array, indices), number)


def copied(text: FunctionText, array: ArrayValue, *, is_local: bool) -> tuple[ArrayValue, bool]:
    """Return an array of its own with the same elements; see `made`."""
    new, takes = made(text, array.element, array.shape, is_cleared=False, is_local=is_local)
    fill(text, new, array)
    return new, takes
