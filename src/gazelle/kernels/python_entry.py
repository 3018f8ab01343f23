"""How Python calls a kernel: a function of its C interface, in LLVM's language.

It takes arrays by the buffer protocol, and hands back `gazelle_mismatch` (`NotImplemented`) where
an argument is not of the type that it was compiled for. Other threads run meanwhile. Arrays that a
kernel returns come as their bytes with their shape. Only what Python keeps stable is used.
"""

from __future__ import annotations

import ctypes
import hashlib
from collections.abc import Iterable

import numpy as np

from gazelle.kernels.array_operations import size_of
from gazelle.kernels.function_text import FunctionText
from gazelle.kernels.kernel_types import (
    Array,
    KernelType,
    NoneType,
    Record,
    Scalar,
    Tuple,
    parts_of,
)
from gazelle.kernels.kernel_values import (
    ArrayValue,
    Nothing,
    Number,
    TupleValue,
    Value,
)
from gazelle.kernels.lowering import Compiled, called

__all__ = ["SYMBOLS", "classes_of", "entry"]

_BUFFER = 80
"""Bytes of a ``Py_buffer``; where its fields lie: the address 0, items' size 24, dimensions 36,
format 40, shape 48, strides 56."""
_FORMAT_AND_STRIDES = 0x1C
_READ, _WRITE = 0x1C, 0x01
"""Of a request: with format and strides; not of what is read only."""
_LONG = 8 * ctypes.sizeof(ctypes.c_long)
_LETTERS = {
    "bool": "?", "int8": "b", "uint8": "B", "int16": "h", "uint16": "H",
    "int32": "il" if _LONG == 32 else "i", "uint32": "IL" if _LONG == 32 else "I",
    "int64": "q" if _LONG == 32 else "lq", "uint64": "Q" if _LONG == 32 else "LQ",
    "float32": "f", "float64": "d",
}  # fmt: skip

_FUNCTIONS = {
    "PyBool_FromLong": f"ptr (i{_LONG})",
    "PyByteArray_FromStringAndSize": "ptr (ptr, i64)",
    "PyBuffer_Release": "void (ptr)",
    "PyErr_Clear": "void ()",
    "PyErr_Occurred": "ptr ()",
    "PyEval_RestoreThread": "void (ptr)",
    "PyEval_SaveThread": "ptr ()",
    "PyFloat_AsDouble": "double (ptr)",
    "PyFloat_FromDouble": "ptr (double)",
    "PyLong_AsLongLong": "i64 (ptr)",
    "PyLong_AsUnsignedLongLong": "i64 (ptr)",
    "PyLong_FromLongLong": "ptr (i64)",
    "PyLong_FromUnsignedLongLong": "ptr (i64)",
    "PyNumber_Index": "ptr (ptr)",
    "PyObject_GetBuffer": "i32 (ptr, ptr, i32)",
    "PyObject_IsInstance": "i32 (ptr, ptr)",
    "PyObject_IsTrue": "i32 (ptr)",
    "PyObject_Type": "ptr (ptr)",
    "PyTuple_GetItem": "ptr (ptr, i64)",
    "PyTuple_New": "ptr (i64)",
    "PyTuple_SetItem": "i32 (ptr, i64, ptr)",
    "PyTuple_Size": "i64 (ptr)",
    "Py_DecRef": "void (ptr)",
    "Py_IncRef": "void (ptr)",
}
_OBJECTS = {
    "gazelle_false": False,
    "gazelle_mismatch": NotImplemented,
    "gazelle_none": None,
    "gazelle_true": True,
    "gazelle_class_float": float,
    "gazelle_class_int": int,
    "gazelle_class_ndarray": np.ndarray,
    "gazelle_class_signed": np.signedinteger,
    "gazelle_class_truth": bool,
    "gazelle_class_tuple": tuple,
    **{
        f"gazelle_class_{name}": getattr(np, name)
        for name in ("bool", "float32", "float64", "uint8", "uint16", "uint32", "uint64")
    },
}

_CHECKS = """
define internal i1 @gazelle_failed(i1 %odd) noinline nounwind {
entry:
  br i1 %odd, label %ask, label %good
ask:
  %error = call ptr @PyErr_Occurred()
  %failed = icmp ne ptr %error, null
  ret i1 %failed
good:
  ret i1 false
}

define internal ptr @gazelle_class(ptr %object) noinline nounwind {
entry:
  %class = call ptr @PyObject_Type(ptr %object)
  call void @Py_DecRef(ptr %class)
  ret ptr %class
}

define internal i1 @gazelle_float(ptr %object, ptr %class, ptr %other, ptr %out) noinline nounwind {
entry:
  %found = call ptr @gazelle_class(ptr %object)
  %is_class = icmp eq ptr %found, %class
  br i1 %is_class, label %take, label %ask
ask:
  %code = call i32 @PyObject_IsInstance(ptr %object, ptr %other)
  %is_other = icmp eq i32 %code, 1
  br i1 %is_other, label %take, label %bad
take:
  %number = call double @PyFloat_AsDouble(ptr %object)
  store double %number, ptr %out
  %odd = fcmp oeq double %number, -1.0
  %failed = call i1 @gazelle_failed(i1 %odd)
  %good = xor i1 %failed, true
  ret i1 %good
bad:
  ret i1 false
}

define internal i1 @gazelle_int(ptr %object, ptr %out) noinline nounwind {
entry:
  %found = call ptr @gazelle_class(ptr %object)
  %is_int = icmp eq ptr %found, @gazelle_class_int
  br i1 %is_int, label %take, label %ask
ask:
  %code = call i32 @PyObject_IsInstance(ptr %object, ptr @gazelle_class_signed)
  %is_signed = icmp eq i32 %code, 1
  br i1 %is_signed, label %take, label %ask_again
ask_again:
  ; As numbers with names are; truth values are no integers here.
  %other = call i32 @PyObject_IsInstance(ptr %object, ptr @gazelle_class_int)
  %is_whole = icmp eq i32 %other, 1
  %is_bool = icmp eq ptr %found, @gazelle_class_truth
  %is_number = xor i1 %is_bool, true
  %is_one = and i1 %is_whole, %is_number
  br i1 %is_one, label %take, label %bad
take:
  %number = call i64 @PyLong_AsLongLong(ptr %object)
  store i64 %number, ptr %out
  %odd = icmp eq i64 %number, -1
  %failed = call i1 @gazelle_failed(i1 %odd)
  %good = xor i1 %failed, true
  ret i1 %good
bad:
  ret i1 false
}

define internal i1 @gazelle_unsigned(ptr %object, ptr %class, ptr %out) noinline nounwind {
entry:
  %found = call ptr @gazelle_class(ptr %object)
  %is_class = icmp eq ptr %found, %class
  br i1 %is_class, label %take, label %bad
take:
  %whole = call ptr @PyNumber_Index(ptr %object)
  %number = call i64 @PyLong_AsUnsignedLongLong(ptr %whole)
  call void @Py_DecRef(ptr %whole)
  store i64 %number, ptr %out
  ret i1 true
bad:
  ret i1 false
}

define internal i1 @gazelle_bool(ptr %object, ptr %out) noinline nounwind {
entry:
  %found = call ptr @gazelle_class(ptr %object)
  %is_numpys = icmp eq ptr %found, @gazelle_class_bool
  %is_true = icmp eq ptr %object, @gazelle_true
  %is_false = icmp eq ptr %object, @gazelle_false
  %is_pythons = or i1 %is_true, %is_false
  %is_one = or i1 %is_numpys, %is_pythons
  br i1 %is_one, label %take, label %bad
take:
  %code = call i32 @PyObject_IsTrue(ptr %object)
  store i32 %code, ptr %out
  ret i1 true
bad:
  ret i1 false
}

define internal i1 @gazelle_array(ptr %object, ptr %buffers, ptr %held, i8 %letter, i8 %other,
                                  i32 %ndim, i1 %contiguous, i32 %flags) noinline nounwind {
entry:
  %class = call ptr @gazelle_class(ptr %object)
  %is_plain = icmp eq ptr %class, @gazelle_class_ndarray
  br i1 %is_plain, label %take, label %ask
ask:
  %is = call i32 @PyObject_IsInstance(ptr %object, ptr @gazelle_class_ndarray)
  %is_array = icmp eq i32 %is, 1
  br i1 %is_array, label %take, label %bad
take:
  %count = load i64, ptr %held
  %buffer = getelementptr [80 x i8], ptr %buffers, i64 %count
  %code = call i32 @PyObject_GetBuffer(ptr %object, ptr %buffer, i32 %flags)
  %taken = icmp eq i32 %code, 0
  br i1 %taken, label %look, label %bad
look:
  %more = add i64 %count, 1
  store i64 %more, ptr %held
  %ndim_place = getelementptr i8, ptr %buffer, i64 36
  %found_ndim = load i32, ptr %ndim_place
  %same_ndim = icmp eq i32 %found_ndim, %ndim
  %format_place = getelementptr i8, ptr %buffer, i64 40
  %format = load ptr, ptr %format_place
  %found = load i8, ptr %format
  %is_letter = icmp eq i8 %found, %letter
  %is_other = icmp eq i8 %found, %other
  %is_one = or i1 %is_letter, %is_other
  %next_place = getelementptr i8, ptr %format, i64 1
  %fits = and i1 %same_ndim, %is_one
  br i1 %fits, label %end_of_format, label %bad
end_of_format:
  ; Of records the caller compares all of it.
  %is_record = icmp eq i8 %found, 84
  br i1 %is_record, label %order, label %one_letter
one_letter:
  %next = load i8, ptr %next_place
  %ended = icmp eq i8 %next, 0
  br i1 %ended, label %order, label %bad
order:
  br i1 %contiguous, label %begin, label %good
begin:
  %size_place = getelementptr i8, ptr %buffer, i64 24
  %size = load i64, ptr %size_place
  %shape_place = getelementptr i8, ptr %buffer, i64 48
  %shape = load ptr, ptr %shape_place
  %strides_place = getelementptr i8, ptr %buffer, i64 56
  %strides = load ptr, ptr %strides_place
  %wide = sext i32 %ndim to i64
  br label %test
test:
  %left = phi i64 [ %wide, %begin ], [ %k, %on ]
  %wanted = phi i64 [ %size, %begin ], [ %larger, %on ]
  %is_done = icmp eq i64 %left, 0
  br i1 %is_done, label %good, label %dimension
dimension:
  %k = sub i64 %left, 1
  %extent_place = getelementptr i64, ptr %shape, i64 %k
  %extent = load i64, ptr %extent_place
  %stride_place = getelementptr i64, ptr %strides, i64 %k
  %stride = load i64, ptr %stride_place
  %right = icmp eq i64 %stride, %wanted
  %short = icmp slt i64 %extent, 2
  %alright = or i1 %right, %short
  %larger = mul i64 %wanted, %extent
  br i1 %alright, label %on, label %empty
on:
  br label %test
empty:
  ; Strides mean nothing in an array without elements.
  br label %any
any:
  %m = phi i64 [ 0, %empty ], [ %m_next, %any_on ]
  %m_done = icmp eq i64 %m, %wide
  br i1 %m_done, label %bad, label %any_look
any_look:
  %m_place = getelementptr i64, ptr %shape, i64 %m
  %m_extent = load i64, ptr %m_place
  %m_zero = icmp eq i64 %m_extent, 0
  br i1 %m_zero, label %good, label %any_on
any_on:
  %m_next = add i64 %m, 1
  br label %any
good:
  ret i1 true
bad:
  ret i1 false
}

define internal void @gazelle_release(ptr %buffers, ptr %held) noinline nounwind {
entry:
  br label %test
test:
  %count = load i64, ptr %held
  %done = icmp eq i64 %count, 0
  br i1 %done, label %end, label %next
next:
  %k = sub i64 %count, 1
  store i64 %k, ptr %held
  %buffer = getelementptr [80 x i8], ptr %buffers, i64 %k
  call void @PyBuffer_Release(ptr %buffer)
  br label %test
end:
  ret void
}
"""


def _declared(name: str, kind: str) -> str:
    result, _, arguments = kind.partition(" ")
    return f"declare {result} @{name}{arguments}"


_OPENING = "\n".join(
    [
        *(_declared(name, kind) for name, kind in _FUNCTIONS.items()),
        "declare i32 @strcmp(ptr, ptr)",
        *(f"@{name} = external global i8" for name in _OBJECTS),
        _CHECKS,
    ]
)

SYMBOLS: dict[str, int] = {
    **{
        name: ctypes.cast(getattr(ctypes.pythonapi, name), ctypes.c_void_p).value or 0
        for name in _FUNCTIONS
    },
    **{name: id(thing) for name, thing in _OBJECTS.items()},
}
"""Where what the entries call lies in this process."""


def entry(name: str, types: tuple[KernelType, ...], compiled: Compiled) -> str:
    """Return the text of the function that Python calls.

    Args:
        name: its name.
        types: of the arguments.
        compiled: what it calls.

    Raises:
        TypeError: a kernel that Python calls takes or returns something else.
    """
    return _Entry(types, compiled).text(name)


class _Entry:
    def __init__(self, types: tuple[KernelType, ...], compiled: Compiled) -> None:
        self._types, self._compiled = types, compiled
        self._text = FunctionText()
        self._arrays = sum(map(_count_of_arrays, types))
        self._buffers = self._text.room(f"[{_BUFFER * max(self._arrays, 1)} x i8]", align=16)
        self._held = self._text.room("i64")
        self._arena = self._text.room("ptr")
        self._taken = 0
        self._formats: list[str] = []

    def text(self, name: str) -> str:
        text = self._text
        text.do(f"store i64 0, ptr {self._held}")
        text.do(f"store ptr null, ptr {self._arena}")
        self._require(f"icmp eq i64 %count, {len(self._types)}")
        words = [f"ptr {self._arena}"]
        for place, kind in enumerate(self._types):
            item = text.let(f"getelementptr ptr, ptr %given, i64 {place}")
            operands = self._unboxed(kind, text.let(f"load ptr, ptr {item}"))
            words += [f"{ir} {one}" for ir, one in zip(parts_of(kind), operands, strict=True)]
        state = text.let("call ptr @PyEval_SaveThread()")
        result = called(text, self._compiled, ", ".join(words))
        text.do(f"call void @PyEval_RestoreThread(ptr {state})")
        boxed = self._boxed(result)
        text.do(f"call void @gazelle_give_back(ptr {self._arena}, ptr null)")
        text.do(f"call void @gazelle_release(ptr {self._buffers}, ptr {self._held})")
        text.do(f"ret ptr {boxed}")
        text.is_closed = True
        text.begin("mismatch")
        text.do("call void @PyErr_Clear()")
        text.do(f"call void @gazelle_release(ptr {self._buffers}, ptr {self._held})")
        text.do("call void @Py_IncRef(ptr @gazelle_mismatch)")
        text.do("ret ptr @gazelle_mismatch")
        head = f"define ptr @{name}(ptr %self, ptr %given, i64 %count) nounwind"
        classes = (f"@{name} = external global i8" for name in classes_of(self._types))
        return "\n".join((_OPENING, *classes, *self._formats, text.text(head)))

    def _require(self, test: str) -> None:
        good = self._text.label()
        self._text.choose(self._text.let(test), good, "mismatch")
        self._text.begin(good)

    def _unboxed(self, kind: KernelType, thing: str) -> list[str]:
        match kind:
            case Scalar():
                return [self._number(kind, thing)]
            case Array():
                return self._array(kind, thing)
            case Tuple():
                text = self._text
                found = text.let(f"call ptr @gazelle_class(ptr {thing})")
                symbol = "gazelle_class_tuple" if kind.maker is None else _symbol(kind.maker)
                self._require(f"icmp eq ptr {found}, @{symbol}")
                size = text.let(f"call i64 @PyTuple_Size(ptr {thing})")
                self._require(f"icmp eq i64 {size}, {len(kind.elements)}")
                operands: list[str] = []
                for place, element in enumerate(kind.elements):
                    item = text.let(f"call ptr @PyTuple_GetItem(ptr {thing}, i64 {place})")
                    operands += self._unboxed(element, item)
                return operands
            case NoneType():
                self._require(f"icmp eq ptr {thing}, @gazelle_none")
                return []
        raise TypeError("kernels take no records from Python")

    def _number(self, scalar: Scalar, thing: str) -> str:
        text = self._text
        if scalar.kind == "b":
            room = self._taken_by("gazelle_bool", f"ptr {thing}", "i32")
            return text.let(f"icmp ne i32 {text.let(f'load i32, ptr {room}')}, 0")
        if scalar.kind == "f":
            own = "float64" if scalar.bits == 64 else "float32"
            other = "float" if scalar.bits == 64 else "float32"
            words = f"ptr {thing}, ptr @gazelle_class_{own}, ptr @gazelle_class_{other}"
            number = text.let(
                f"load double, ptr {self._taken_by('gazelle_float', words, 'double')}"
            )
            return number if scalar.bits == 64 else text.let(f"fptrunc double {number} to float")
        if scalar.kind == "i":
            room = self._taken_by("gazelle_int", f"ptr {thing}", "i64")
        else:
            words = f"ptr {thing}, ptr @gazelle_class_{scalar.name}"
            room = self._taken_by("gazelle_unsigned", words, "i64")
        number = text.let(f"load i64, ptr {room}")
        return number if scalar.bits == 64 else text.let(f"trunc i64 {number} to {scalar.ir}")

    def _taken_by(self, function: str, words: str, kind: str) -> str:
        """Return where a function has written a number, after it could."""
        room, good = self._text.room(kind), self._text.label()
        took = self._text.let(f"call i1 @{function}({words}, ptr {room})")
        self._text.choose(took, good, "mismatch")
        self._text.begin(good)
        return room

    def _array(self, kind: Array, thing: str) -> list[str]:
        text = self._text
        letters = "T" if isinstance(kind.element, Record) else _LETTERS[kind.element.name]
        words = (
            f"ptr {thing}, ptr {self._buffers}, ptr {self._held}, i8 {ord(letters[0])}, "
            f"i8 {ord(letters[-1])}, i32 {kind.ndim}, i1 {str(kind.is_contiguous).lower()}, "
            f"i32 {_READ | (_WRITE if kind.is_writeable else 0)}"
        )
        fits = text.let(f"call i1 @gazelle_array({words})")
        good = text.label()
        text.choose(fits, good, "mismatch")
        text.begin(good)
        buffer = text.let(f"getelementptr i8, ptr {self._buffers}, i64 {_BUFFER * self._taken}")
        self._taken += 1
        if isinstance(kind.element, Record):
            self._require_format(kind.element.format, buffer)
        operands = [text.let(f"load ptr, ptr {buffer}")]
        for offset in (48,) if kind.is_contiguous else (48, 56):
            if not kind.ndim:
                break
            place = text.let(f"getelementptr i8, ptr {buffer}, i64 {offset}")
            row = text.let(f"load ptr, ptr {place}")
            for k in range(kind.ndim):
                item = text.let(f"getelementptr i64, ptr {row}, i64 {k}")
                operands.append(text.let(f"load i64, ptr {item}"))
        return operands

    def _require_format(self, wanted: str, buffer: str) -> None:
        text = self._text
        name, content = f"@format.{self._taken}", wanted.encode()
        self._formats.append(f'{name} = private constant [{len(content) + 1} x i8] c"{wanted}\\00"')
        place = text.let(f"getelementptr i8, ptr {buffer}, i64 40")
        found = text.let(f"load ptr, ptr {place}")
        order = text.let(f"call i32 @strcmp(ptr {found}, ptr {name})")
        self._require(f"icmp eq i32 {order}, 0")

    def _boxed(self, value: Value) -> str:
        text = self._text
        match value:
            case Nothing():
                text.do("call void @Py_IncRef(ptr @gazelle_none)")
                return "@gazelle_none"
            case Number():
                return self._boxed_number(value)
            case TupleValue():
                return self._tuple([self._boxed(item) for item in value.items])
            case ArrayValue(strides=()):
                size = size_of(text, value).operand
                if not isinstance(value.element, Scalar):
                    raise TypeError("kernels return no records to Python")
                size = text.let(f"mul i64 {size}, {value.element.bits // 8}")
                call = f"call ptr @PyByteArray_FromStringAndSize(ptr {value.address}, i64 {size})"
                content = text.let(call)
                shape = self._tuple([self._boxed_number(count) for count in value.shape])
                return self._tuple([content, shape])
        raise TypeError("kernels return numbers, tuples, and arrays in C's order to Python")

    def _boxed_number(self, number: Number) -> str:
        text, scalar, operand = self._text, number.scalar, number.operand
        if scalar.kind == "b":
            wide = text.let(f"zext i1 {operand} to i{_LONG}")
            return text.let(f"call ptr @PyBool_FromLong(i{_LONG} {wide})")
        if scalar.kind == "f":
            if scalar.bits == 32:
                operand = text.let(f"fpext float {operand} to double")
            return text.let(f"call ptr @PyFloat_FromDouble(double {operand})")
        if scalar.bits < 64:
            word = "sext" if scalar.kind == "i" else "zext"
            operand = text.let(f"{word} {scalar.ir} {operand} to i64")
        sign = "" if scalar.kind == "i" else "Unsigned"
        return text.let(f"call ptr @PyLong_From{sign}LongLong(i64 {operand})")

    def _tuple(self, items: list[str]) -> str:
        text = self._text
        whole = text.let(f"call ptr @PyTuple_New(i64 {len(items)})")
        for place, item in enumerate(items):
            words = f"ptr {whole}, i64 {place}, ptr {item}"
            text.let(f"call i32 @PyTuple_SetItem({words})")
        return whole


def classes_of(types: Iterable[KernelType]) -> dict[str, int]:
    """Return where the classes of named tuples lie in this process that an entry asks for."""
    found: dict[str, int] = {}
    for kind in types:
        if isinstance(kind, Tuple):
            found |= classes_of(kind.elements)
            if kind.maker is not None:
                found[_symbol(kind.maker)] = id(kind.maker)
    return found


def _symbol(maker: type) -> str:
    name = f"{maker.__module__}.{maker.__qualname__}"
    return f"gazelle_class_{hashlib.sha256(name.encode()).hexdigest()[:16]}"


def _count_of_arrays(kind: KernelType) -> int:
    if isinstance(kind, Tuple):
        return sum(map(_count_of_arrays, kind.elements))
    return int(isinstance(kind, Array))
