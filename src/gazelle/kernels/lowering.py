"""Kernels as LLVM's intermediate language: statements and expressions of a part of Python.

What a kernel may hold: numbers, arrays of one to many dimensions, tuples and named tuples of them;
``if``, ``while``, ``for`` over ``range`` or a tuple of numbers, ``break``, ``continue`` and
``return``; calls of other kernels and of what `calls.CALLS` has. Each name has one type in a
function: that which holds all that it is given.
"""

from __future__ import annotations

import ast
import builtins
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from types import ModuleType
from typing import Any, NamedTuple, Protocol

import numpy as np

from gazelle.kernels.array_operations import (
    Cut,
    copied,
    element_address,
    field_address,
    field_of,
    fill,
    made,
    part,
    require_writeable,
    size_of,
    store,
)
from gazelle.kernels.array_operations import load as loaded
from gazelle.kernels.calls import CALLS, Call
from gazelle.kernels.function_text import FunctionText
from gazelle.kernels.kernel_types import (
    BOOL,
    FLOAT64,
    INT64,
    NONE,
    Array,
    KernelType,
    Record,
    Scalar,
    Tuple,
    described,
    element_of,
    has_arrays,
    joined,
    parts_of,
    result_ir,
)
from gazelle.kernels.kernel_values import (
    ArrayValue,
    Known,
    Nothing,
    Number,
    RecordValue,
    TupleValue,
    Value,
    constant,
    from_parts,
    parts,
    type_of_value,
)
from gazelle.kernels.scalar_operations import (
    arithmetic,
    compared,
    converted,
    least_or_most,
    negated,
    truth,
)
from gazelle.kernels.source import External, KernelSource, settled_names, stored_names, tree_of

__all__ = ["Compiled", "Functions", "called", "lowered"]

_MOST_ROUNDS = 60
_UNSET = object()
_COUNTED = "kernels count through ranges, arrays and tuples of numbers only"


class Compiled(NamedTuple):
    """A function of the program.

    Attributes:
        name: in it.
        result: its type.
        is_lasting: it returns arrays, which the caller gives back.
    """

    name: str
    result: KernelType
    is_lasting: bool


class Functions(Protocol):
    """The functions that call each other, as one of them sees the others."""

    def function(self, source: KernelSource, types: tuple[KernelType, ...]) -> Compiled:
        """Return a kernel for arguments of some types, compiled where it is not yet."""

    def external(self, function: External) -> str:
        """Return the name of a library's function."""

    def note_use(self, module: str, name: str, thing: Any) -> None:
        """Note that what is compiled depends on something of a module."""


def lowered(
    functions: Functions, source: KernelSource, types: tuple[KernelType, ...], name: str
) -> tuple[str, Compiled]:
    """Return the text of a kernel's function for arguments of some types, and what it is like.

    Args:
        functions: the others.
        source: of the kernel.
        types: of the arguments.
        name: of the function in LLVM's language.

    Raises:
        TypeError: something in its source is not for kernels, with its place.
    """
    return _State(source, types, name).compiled(functions)


def called(text: FunctionText, compiled: Compiled, words: str) -> Value:
    """Write a call of a function, its arguments as words, and return what it gives."""
    kinds, ir = parts_of(compiled.result), result_ir(compiled.result)
    call = f"call {ir} {compiled.name}({words})"
    if not kinds:
        text.do(call)
        return from_parts(compiled.result, [])
    whole = text.let(call)
    if len(kinds) == 1:
        return from_parts(compiled.result, [whole])
    each = [text.let(f"extractvalue {ir} {whole}, {k}") for k in range(len(kinds))]
    return from_parts(compiled.result, each)


class _Variable(NamedTuple):
    kind: KernelType
    rooms: tuple[str, ...]
    is_natural: bool


@dataclass
class _Loop:
    again: str
    end: str
    has_break: bool = False


class _State:
    """What is known of a function after a round of compiling it, until a round changes nothing."""

    def __init__(self, source: KernelSource, types: tuple[KernelType, ...], name: str) -> None:
        self.source, self.types, self.name = source, types, name
        self.tree = tree_of(source)
        self.settled = settled_names(self.tree)
        self.stored = stored_names(self.tree)
        self.unknown: dict[str, TypeError] = {}
        self.variables: dict[str, tuple[KernelType, bool]] = {}
        self.result: KernelType | None = None
        self.takes_memory = False
        self.has_changed = False

    def compiled(self, functions: Functions) -> tuple[str, Compiled]:
        """Return the function's text and its signature."""
        for _ in range(_MOST_ROUNDS):
            self.has_changed = False
            unknown, self.unknown = self.unknown, {}
            lowering = _Lowering(functions, self)
            try:
                text = lowering.text()
            except _Changed:
                continue
            except TypeError:
                # It may come of what a name was taken for.
                if self.has_changed:
                    continue
                raise
            if self.unknown and not self.has_changed and self.unknown.keys() == unknown.keys():
                raise next(iter(self.unknown.values()))
            if not self.has_changed and not self.unknown:
                result = self.result or NONE
                return text, Compiled(self.name, result, has_arrays(result))
        raise TypeError(f"{self.source.name}: the types of its names depend on each other")

    def note_unknown(self, name: str, error: TypeError) -> None:
        """Note that a name was read that nothing has been given to so far."""
        self.unknown.setdefault(name, error)

    def widen(self, name: str, kind: KernelType, *, is_natural: bool) -> None:
        """Note that a name holds more than was known."""
        self.variables[name] = kind, is_natural
        self.has_changed = True


class _Changed(Exception):  # noqa: N818 - it is no error
    """A round was begun with a wrong type and makes no sense further on."""


class _NotYetError(TypeError):
    """A name has no type yet."""

    def __init__(self, name: str) -> None:
        super().__init__(f"'{name}' has no value here")
        self.name = name


class _Lowering:
    """One round of compiling a function."""

    def __init__(self, functions: Functions, state: _State) -> None:
        self._functions, self._state = functions, state
        flags = state.source.flags
        self._text = FunctionText(f"{flags} " if flags else "")
        self._names: dict[str, Value] = {}
        self._variables: dict[str, _Variable] = {}
        self._loops: list[_Loop] = []
        self._is_lasting = state.result is not None and has_arrays(state.result)

    def text(self) -> str:
        state, text = self._state, self._text
        arguments = state.tree.args.args
        if len(arguments) != len(state.types):
            raise TypeError(
                f"{state.source.name}() takes {len(arguments)} arguments, not {len(state.types)}"
            )
        given: list[str] = []
        for argument, kind in zip(arguments, state.types, strict=True):
            operands = [f"%a{len(given) + k}" for k in range(len(parts_of(kind)))]
            given += [f"{ir} {name}" for ir, name in zip(parts_of(kind), operands, strict=True)]
            self._assign_name(argument.arg, from_parts(kind, operands))
        self._body(state.tree.body)
        if not text.is_closed:
            try:
                self._return(Nothing())
            except TypeError as error:
                raise self._placed(error, state.tree) from error
        result = state.result or NONE
        words = ", ".join(("ptr %arena", *given))
        head = f"define internal {result_ir(result)} {state.name}({words}) nounwind"
        opening = ["%mark = load ptr, ptr %arena"] if self._gives_back() else []
        return text.text(head, opening)

    def _gives_back(self) -> bool:
        return self._state.takes_memory and not self._is_lasting

    def _note_memory(self, *, takes: bool) -> None:
        if takes and not self._state.takes_memory:
            self._state.takes_memory = self._state.has_changed = True

    # Statements

    def _body(self, statements: Sequence[ast.stmt]) -> None:
        for statement in statements:
            if self._text.is_closed:
                return
            try:
                self._statement(statement)
            except _NotYetError as unknown:
                # It is stored further on, as in the round of a loop before.
                self._state.note_unknown(unknown.name, self._placed(unknown, statement))
                self._text.begin(self._text.label())
            except TypeError as error:
                raise self._placed(error, statement) from error

    def _placed(self, error: TypeError, node: ast.stmt | ast.expr) -> TypeError:
        file = self._state.source.function.__code__.co_filename
        text = str(error)
        if text.startswith("kernel "):
            return error
        return TypeError(f"kernel {file}:{node.lineno}:{node.col_offset + 1}: {text}")

    def _statement(self, statement: ast.stmt) -> None:
        match statement:
            case ast.Assign():
                value = self._value(statement.value)
                for target in statement.targets:
                    self._assign(target, value)
            case ast.AugAssign():
                self._assign_more(statement)
            case ast.If():
                self._if(statement)
            case ast.For(orelse=[]):
                self._for(statement)
            case ast.While(orelse=[]):
                self._while(statement)
            case ast.Return():
                self._return(Nothing() if statement.value is None else self._value(statement.value))
            case ast.Break():
                self._loops[-1].has_break = True
                self._text.go_to(self._loops[-1].end)
            case ast.Continue():
                self._text.go_to(self._loops[-1].again)
            case ast.Expr(value=ast.Constant()) | ast.Pass():
                pass
            case ast.Expr():
                self._value(statement.value)
            case _:
                raise TypeError(f"kernels have no {type(statement).__name__}")

    def _assign(self, target: ast.expr, value: Value) -> None:
        match target:
            case ast.Name():
                self._assign_name(target.id, value)
            case ast.Tuple():
                items = self._items(value)
                if len(items) != len(target.elts):
                    raise TypeError(f"{len(items)} values for {len(target.elts)} names")
                for one, item in zip(target.elts, items, strict=True):
                    self._assign(one, item)
            case ast.Subscript():
                self._assign_element(target, value)
            case ast.Attribute():
                record = self._value(target.value)
                if not isinstance(record, RecordValue) or not isinstance(value, Number):
                    raise TypeError("only numbers of a record's fields can be assigned")
                field = next((f for f in record.record.fields if f.name == target.attr), None)
                if field is None or field.shape:
                    raise TypeError(f"the record has no number '{target.attr}'")
                require_writeable(record)
                address = field_address(self._text, record, field.offset)
                store(self._text, field.scalar, address, value)
            case _:
                raise TypeError(f"kernels assign nothing to a {type(target).__name__}")

    def _items(self, value: Value) -> tuple[Value, ...]:
        if isinstance(value, TupleValue):
            return value.items
        if isinstance(value, ArrayValue) and value.shape[0].known is not None:
            return tuple(
                self._element(value, [constant(k)]) for k in range(int(value.shape[0].known))
            )
        raise TypeError("only a tuple can be taken apart")

    def _assign_name(self, name: str, value: Value) -> None:
        state, text = self._state, self._text
        if name in state.settled:
            self._names[name] = value
            return
        kind = type_of_value(value)
        is_natural = isinstance(value, Number) and (value.is_natural or value.scalar != INT64)
        state.variables.setdefault(name, (kind, is_natural))
        variable = self._variable(name)
        wide = joined(variable.kind, kind)
        if wide is None:
            given, before = described(kind), described(variable.kind)
            raise TypeError(f"'{name}' is given {given} here, and {before} elsewhere")
        if wide != variable.kind:
            state.widen(name, wide, is_natural=variable.is_natural and is_natural)
            raise _Changed
        if variable.is_natural and not is_natural and kind == INT64:
            state.widen(name, variable.kind, is_natural=False)
        for operand, ir, room in zip(
            parts(self._as(value, wide)), parts_of(wide), variable.rooms, strict=True
        ):
            text.do(f"store {ir} {operand}, ptr {room}")

    def _as(self, value: Value, kind: KernelType) -> Value:
        """Return a value as one of a type that holds it."""
        match value, kind:
            case Number(), Scalar():
                return converted(self._text, value, kind)
            case ArrayValue(strides=()), Array(is_contiguous=False):
                return self._strided(value)
            case TupleValue(), Tuple():
                items = map(self._as, value.items, kind.elements)
                return TupleValue(tuple(items), kind.maker)
        return value

    def _strided(self, value: ArrayValue) -> ArrayValue:
        size = value.element.size if isinstance(value.element, Record) else value.element.bits // 8
        strides = [constant(size)]
        for count in reversed(value.shape[1:]):
            strides.append(arithmetic(self._text, "Mult", strides[-1], count))
        return value._replace(strides=tuple(one.operand for one in reversed(strides)))

    def _assign_element(self, target: ast.Subscript, value: Value) -> None:
        array, text = self._value(target.value), self._text
        if not isinstance(array, ArrayValue):
            raise TypeError("only elements of arrays can be assigned")
        keys = self._keys(target.slice)
        if len(keys) == len(array.shape) and not any(isinstance(key, Cut) for key in keys):
            if not isinstance(value, Number) or isinstance(array.element, Record):
                raise TypeError("only numbers can be written to an array's element")
            require_writeable(array)
            address = element_address(text, array, keys)  # type: ignore[arg-type]
            store(text, array.element, address, value)
            return
        if not isinstance(value, Number | ArrayValue):
            raise TypeError("only a number or an array can be written to a part of an array")
        fill(text, part(text, array, keys), value)

    def _assign_more(self, statement: ast.AugAssign) -> None:
        word, text = type(statement.op).__name__, self._text
        target = statement.target
        if isinstance(target, ast.Name):
            before = self._read(target.id)
            self._assign_name(target.id, self._combined(word, before, self._value(statement.value)))
            return
        if isinstance(target, ast.Subscript):
            array, keys = self._value(target.value), self._keys(target.slice)
            is_one = not any(isinstance(key, Cut) for key in keys)
            if isinstance(array, ArrayValue) and isinstance(array.element, Scalar) and is_one:
                require_writeable(array)
                address = element_address(text, array, keys)  # type: ignore[arg-type]
                before = loaded(text, array.element, address)
                value = self._value(statement.value)
                store(text, array.element, address, self._combined(word, before, value))
                return
        raise TypeError("only a name's value or an array's element can be changed in place")

    def _if(self, statement: ast.If) -> None:
        text = self._text
        then, otherwise, end = text.label(), text.label(), text.label()
        has_else = bool(statement.orelse)
        self._condition(statement.test, then, otherwise if has_else else end)
        text.begin(then)
        self._body(statement.body)
        is_end_reached = not has_else or not text.is_closed
        if not text.is_closed:
            text.go_to(end)
        if has_else:
            text.begin(otherwise)
            self._body(statement.orelse)
            is_end_reached = is_end_reached or not text.is_closed
        if is_end_reached:
            text.begin(end)

    def _while(self, statement: ast.While) -> None:
        text = self._text
        test, body, end = text.label(), text.label(), text.label()
        text.begin(test)
        is_endless = isinstance(statement.test, ast.Constant) and bool(statement.test.value)
        if is_endless:
            text.go_to(body)
        else:
            self._condition(statement.test, body, end)
        text.begin(body)
        with self._in_loop(test, end) as loop:
            self._body(statement.body)
        if not text.is_closed:
            text.go_to(test)
        if loop.has_break or not is_endless:
            text.begin(end)

    @contextmanager
    def _in_loop(self, again: str, end: str) -> Iterator[_Loop]:
        self._loops.append(_Loop(again, end))
        yield self._loops[-1]
        self._loops.pop()

    def _for(self, statement: ast.For) -> None:
        match statement.iter:
            case ast.Call(func=ast.Name(id="range"), args=args):
                self._for_range(statement, [self._whole(self._value(one)) for one in args])
                return
        counted = self._value(statement.iter)
        if isinstance(counted, ArrayValue):
            self._for_elements(statement, counted)
            return
        numbers = counted.items if isinstance(counted, TupleValue) else ()
        if not numbers or not all(isinstance(number, Number) for number in numbers):
            raise TypeError(_COUNTED)
        kind: KernelType | None = type_of_value(numbers[0])
        for number in numbers:
            kind = joined(kind, type_of_value(number)) if kind is not None else None
        assert isinstance(kind, Scalar)
        text = self._text
        shape = (constant(len(numbers)),)
        room = text.room(f"[{len(numbers) * 8} x i8]", align=16)
        row = ArrayValue(kind, room, shape)
        for k, number in enumerate(numbers):
            assert isinstance(number, Number)
            store(text, kind, element_address(text, row, [constant(k)]), number)

        def bind(place: Number) -> None:
            number = loaded(text, kind, element_address(text, row, [place]))
            is_natural = all(isinstance(one, Number) and one.is_natural for one in numbers)
            self._assign(statement.target, number._replace(is_natural=is_natural))

        self._counted(statement, constant(0), shape[0], constant(1), bind)

    def _for_elements(self, statement: ast.For, row: ArrayValue) -> None:
        def bind(place: Number) -> None:
            self._assign(statement.target, self._element(row, [place]))

        self._counted(statement, constant(0), row.shape[0], constant(1), bind)

    def _for_range(self, statement: ast.For, ends: list[Number]) -> None:
        first, step = constant(0), constant(1)
        if len(ends) == 1:
            last = ends[0]
        elif len(ends) == 2:
            first, last = ends
        else:
            first, last, step = ends
        self._counted(
            statement, first, last, step, lambda number: self._assign(statement.target, number)
        )

    def _counted(
        self,
        statement: ast.For,
        first: Number,
        last: Number,
        step: Number,
        bind: Callable[[Number], None],
    ) -> None:
        text = self._text
        test, body, again, end = text.label(), text.label(), text.label(), text.label()
        room = text.room("i64")
        text.do(f"store i64 {first.operand}, ptr {room}")
        text.begin(test)
        number = text.let(f"load i64, ptr {room}")
        is_below = f"icmp slt i64 {number}, {last.operand}"
        is_above = f"icmp sgt i64 {number}, {last.operand}"
        if step.known is not None:
            goes_on = text.let(is_below if step.known > 0 else is_above)
            from_below = step.known > 0 and first.is_natural
            is_natural = from_below or (
                step.known < 0 and last.known is not None and last.known >= -1
            )
        else:
            is_up = text.let(f"icmp sgt i64 {step.operand}, 0")
            below, above = text.let(is_below), text.let(is_above)
            goes_on = text.let(f"select i1 {is_up}, i1 {below}, i1 {above}")
            is_natural = first.is_natural and step.is_natural
        text.choose(goes_on, body, end)
        text.begin(body)
        bind(Number(INT64, number, is_natural))
        with self._in_loop(again, end):
            self._body(statement.body)
        text.begin(again)
        text.do(f"store i64 {text.let(f'add nsw i64 {number}, {step.operand}')}, ptr {room}")
        text.go_to(test)
        text.begin(end)

    def _return(self, value: Value) -> None:
        state, text = self._state, self._text
        kind = type_of_value(value)
        wide = kind if state.result is None else joined(state.result, kind)
        if wide is None:
            before = described(state.result or NONE)
            raise TypeError(f"{described(kind)} is returned here, and {before} elsewhere")
        if wide != state.result:
            state.result = wide
            state.has_changed = True
        operands = parts(self._as(value, wide))
        if self._gives_back():
            text.do("call void @gazelle_give_back(ptr %arena, ptr %mark)")
        words = parts_of(wide)
        if not words:
            text.do("ret void")
        elif len(words) == 1:
            text.do(f"ret {words[0]} {operands[0]}")
        else:
            whole, ir = "poison", result_ir(wide)
            for k, (word, operand) in enumerate(zip(words, operands, strict=True)):
                whole = text.let(f"insertvalue {ir} {whole}, {word} {operand}, {k}")
            text.do(f"ret {ir} {whole}")
        text.is_closed = True

    # Conditions

    def _condition(self, node: ast.expr, then: str, otherwise: str) -> None:
        """Go on at one of two blocks."""
        text = self._text
        match node:
            case ast.BoolOp(op=ast.And()):
                for one in node.values[:-1]:
                    more = text.label()
                    self._condition(one, more, otherwise)
                    text.begin(more)
                self._condition(node.values[-1], then, otherwise)
            case ast.BoolOp():
                for one in node.values[:-1]:
                    more = text.label()
                    self._condition(one, then, more)
                    text.begin(more)
                self._condition(node.values[-1], then, otherwise)
            case ast.UnaryOp(op=ast.Not()):
                self._condition(node.operand, otherwise, then)
            case _:
                text.choose(truth(text, self._number(self._value(node))).operand, then, otherwise)

    def _either(
        self, test: ast.expr, one: Callable[[], Value], other: Callable[[], Value]
    ) -> Value:
        """Return one of two values; only that one is computed."""
        text = self._text
        then, otherwise, end = text.label(), text.label(), text.label()
        self._condition(test, then, otherwise)
        sides: list[tuple[list[str], str, Value]] = []
        for label, side in ((then, one), (otherwise, other)):
            lines: list[str] = []
            with text.aside(lines):
                text.is_closed = True
                text.begin(label)
                value = side()
                sides.append((lines, text.block, value))
        kind = joined(type_of_value(sides[0][2]), type_of_value(sides[1][2]))
        if kind is None:
            raise TypeError("both sides of an 'if' have different types")
        ways: list[tuple[tuple[str, ...], str]] = []
        for lines, block, value in sides:
            with text.aside(lines):
                text.block, text.is_closed = block, False
                ways.append((parts(self._as(value, kind)), text.block))
                text.go_to(end)
            text.take(lines)
        text.begin(end)
        merged = [
            text.merged(ir, [(operands[k], block) for operands, block in ways])
            for k, ir in enumerate(parts_of(kind))
        ]
        found = from_parts(kind, merged)
        if isinstance(found, Number):
            naturals = (isinstance(side[2], Number) and side[2].is_natural for side in sides)
            return found._replace(is_natural=all(naturals))
        return found

    # Expressions

    def _number(self, value: Value) -> Number:
        if not isinstance(value, Number):
            raise TypeError("a number is needed here")
        return value

    def _whole(self, value: Value) -> Number:
        number = self._number(value)
        if not number.scalar.is_integer:
            raise TypeError("a whole number is needed here")
        return converted(self._text, number, INT64)

    def _value(self, node: ast.expr) -> Value:
        text = self._text
        match node:
            case ast.Constant():
                return _of_python(node.value)
            case ast.Name():
                return self._read(node.id)
            case ast.BinOp():
                one, other = self._value(node.left), self._value(node.right)
                return self._combined(type(node.op).__name__, one, other)
            case ast.UnaryOp(op=ast.USub()):
                return negated(text, self._number(self._value(node.operand)))
            case ast.UnaryOp(op=ast.UAdd()):
                number = self._number(self._value(node.operand))
                return converted(text, number, INT64) if number.scalar == BOOL else number
            case ast.UnaryOp(op=ast.Not()):
                is_so = truth(text, self._number(self._value(node.operand)))
                return Number(BOOL, text.let(f"xor i1 {is_so.operand}, true"), True)
            case ast.Compare():
                return self._compare(node)
            case ast.BoolOp() | ast.IfExp():
                return self._choice(node)
            case ast.Tuple() | ast.List():
                return TupleValue(tuple(self._unstarred(node.elts)))
            case ast.Subscript():
                return self._subscript(node)
            case ast.Attribute():
                return self._attribute(self._value(node.value), node.attr)
            case ast.Call():
                try:
                    return self._call(node)
                except TypeError as error:
                    raise self._placed(error, node) from error
        raise TypeError(f"kernels have no {type(node).__name__}")

    def _unstarred(self, nodes: Sequence[ast.expr]) -> Iterator[Value]:
        for node in nodes:
            if isinstance(node, ast.Starred):
                yield from self._items(self._value(node.value))
            else:
                yield self._value(node)

    def _read(self, name: str) -> Value:
        if name in self._names:
            return self._names[name]
        if name in self._variables:
            return self._read_variable(name)
        if name in self._state.stored:
            if name not in self._state.variables:
                raise _NotYetError(name)
            return self._read_variable(name)
        function = self._state.source.function
        thing = function.__globals__.get(name, _UNSET)
        if thing is _UNSET:
            thing = getattr(builtins, name, _UNSET)
            if thing is _UNSET:
                raise TypeError(f"'{name}' has no value here")
        else:
            self._functions.note_use(function.__module__, name, thing)
        return _of_python(thing)

    def _read_variable(self, name: str) -> Value:
        variable = self._variable(name)
        operands = [
            self._text.let(f"load {ir}, ptr {room}")
            for ir, room in zip(parts_of(variable.kind), variable.rooms, strict=True)
        ]
        value = from_parts(variable.kind, operands)
        if isinstance(value, Number) and value.scalar == INT64:
            return value._replace(is_natural=variable.is_natural)
        return value

    def _variable(self, name: str) -> _Variable:
        """Return where a name's value is, of the type that is known of it."""
        if name not in self._variables:
            kind, is_natural = self._state.variables[name]
            rooms = tuple(self._text.room(ir) for ir in parts_of(kind))
            self._variables[name] = _Variable(kind, rooms, is_natural)
        return self._variables[name]

    def _combined(self, word: str, one: Value, other: Value) -> Number:
        return arithmetic(self._text, word, self._number(one), self._number(other))

    def _compare(self, node: ast.Compare) -> Number:
        text = self._text
        values = [self._number(self._value(one)) for one in (node.left, *node.comparators)]
        holds: Number | None = None
        for operator, one, other in zip(node.ops, values, values[1:], strict=False):
            found = compared(text, type(operator).__name__, one, other)
            if holds is None:
                holds = found
            else:
                both = text.let(f"and i1 {holds.operand}, {found.operand}")
                holds = Number(BOOL, both, True)
        assert holds is not None
        return holds

    def _choice(self, node: ast.BoolOp | ast.IfExp) -> Value:
        if isinstance(node, ast.IfExp):
            return self._either(
                node.test, lambda: self._value(node.body), lambda: self._value(node.orelse)
            )
        return self._connected(node.values, is_and=isinstance(node.op, ast.And))

    def _connected(self, nodes: Sequence[ast.expr], *, is_and: bool) -> Number:
        """Return whether all (`is_and`) or any hold; those behind one that decides are left."""
        text = self._text
        first = self._number(self._value(nodes[0]))
        if first.scalar != BOOL:
            raise TypeError("'and' and 'or' connect truth values only, in what is no condition")
        if len(nodes) == 1:
            return first
        begun, more, end = text.block, text.label(), text.label()
        text.choose(first.operand, more if is_and else end, end if is_and else more)
        ways = [("false" if is_and else "true", begun)]
        if first.known is not None and first.known != is_and:
            ways = [(first.operand, begun)]
        text.begin(more)
        rest = self._connected(nodes[1:], is_and=is_and)
        ways.append((rest.operand, text.block))
        text.begin(end)
        return Number(BOOL, text.merged("i1", ways), True)

    def _keys(self, node: ast.expr) -> list[Number | Cut]:
        nodes = node.elts if isinstance(node, ast.Tuple) else [node]
        keys: list[Number | Cut] = []
        for one in nodes:
            if isinstance(one, ast.Slice):
                if one.step is not None:
                    raise TypeError("kernels take no slices with a step")
                ends = (one.lower, one.upper)
                keys.append(
                    Cut(*(None if end is None else self._whole(self._value(end)) for end in ends))
                )
            else:
                keys.append(self._number(self._value(one)))
        return keys

    def _subscript(self, node: ast.Subscript) -> Value:
        whole, keys = self._value(node.value), self._keys(node.slice)
        if isinstance(whole, ArrayValue):
            if any(isinstance(key, Cut) for key in keys) or len(keys) < len(whole.shape):
                return part(self._text, whole, keys)
            return self._element(whole, keys)  # type: ignore[arg-type]
        if isinstance(whole, TupleValue) and len(keys) == 1 and isinstance(keys[0], Number):
            return self._item(whole, keys[0])
        raise TypeError("only arrays and tuples have elements")

    def _element(self, array: ArrayValue, indices: Sequence[Number]) -> Value:
        if len(indices) < len(array.shape):
            return part(self._text, array, indices)
        address = element_address(self._text, array, indices)
        if isinstance(array.element, Record):
            return RecordValue(array.element, address, array.is_writeable)
        return loaded(self._text, array.element, address)

    def _item(self, whole: TupleValue, index: Number) -> Value:
        if index.known is not None:
            return whole.items[int(index.known)]
        text = self._text
        kind = type_of_value(whole.items[0])
        if any(type_of_value(item) != kind for item in whole.items):
            raise TypeError("an item of a tuple of different types is taken by a known number only")
        index = self._whole(index)
        if not index.is_natural:
            raise TypeError("an item of a tuple is not counted from its end")
        found = list(parts(whole.items[0]))
        for k, item in enumerate(whole.items[1:], 1):
            is_it = text.let(f"icmp eq i64 {index.operand}, {k}")
            for place, (ir, operand) in enumerate(zip(parts_of(kind), parts(item), strict=True)):
                chosen = f"select i1 {is_it}, {ir} {operand}, {ir} {found[place]}"
                found[place] = text.let(chosen)
        return from_parts(kind, found)

    def _attribute(self, value: Value, name: str) -> Value:
        match value:
            case Known(thing=ModuleType() as module):
                thing = getattr(module, name)
                self._functions.note_use(module.__name__, name, thing)
                return _of_python(thing)
            case TupleValue() if name in value.names:
                return value.items[value.names.index(name)]
            case ArrayValue() if name == "shape":
                return TupleValue(value.shape)
            case ArrayValue() if name == "size":
                return size_of(self._text, value)
            case RecordValue():
                field = field_of(self._text, value, name)
                if field is not None:
                    return field
        raise TypeError(f"there is no '{name}' of this")

    # Calls

    def _call(self, node: ast.Call) -> Value:
        if isinstance(node.func, ast.Attribute):
            array = self._value(node.func.value)
            if isinstance(array, ArrayValue):
                arguments = list(self._unstarred(node.args))
                return self._method(array, node.func.attr, arguments)
            function = self._attribute(array, node.func.attr)
        else:
            function = self._value(node.func)
        if not isinstance(function, Known):
            raise TypeError("this cannot be called")
        arguments = list(self._unstarred(node.args))
        named = {str(one.arg): self._value(one.value) for one in node.keywords}
        return self._called(function.thing, arguments, named)

    def _called(self, thing: Any, arguments: list[Value], named: dict[str, Value]) -> Value:
        text = self._text
        source = getattr(thing, "source", None)
        if isinstance(source, KernelSource) and not named:
            return self._call_kernel(source, arguments)
        if isinstance(thing, External):
            if len(arguments) != thing.arguments:
                raise TypeError(f"{thing.name}() takes {thing.arguments} addresses")
            words = ", ".join(f"i64 {self._whole(one).operand}" for one in arguments)
            text.do(f"call void {self._functions.external(thing)}({words})")
            return Nothing()
        if isinstance(thing, type) and hasattr(thing, "_fields"):
            return _named_tuple(thing, arguments, named)
        if isinstance(thing, type) and issubclass(thing, np.generic):
            scalar = element_of(thing)
            assert isinstance(scalar, Scalar)
            if len(arguments) != 1 or named:
                raise TypeError(f"{scalar.name}() takes one number")
            return converted(text, self._number(arguments[0]), scalar)
        if thing in _MAKERS:
            return self._make(thing, arguments, named)
        found = CALLS.get(thing)
        if found is None or named or not found.least <= len(arguments) <= found.most:
            raise TypeError(f"kernels have no {getattr(thing, '__name__', thing)}() like this")
        return found.compute(Call(text, arguments))

    def _call_kernel(self, source: KernelSource, arguments: list[Value]) -> Value:
        text = self._text
        types = tuple(map(type_of_value, arguments))
        compiled = self._functions.function(source, types)
        self._note_memory(takes=compiled.is_lasting)
        words = ["ptr %arena"]
        for kind, value in zip(types, arguments, strict=True):
            words += [f"{ir} {one}" for ir, one in zip(parts_of(kind), parts(value), strict=True)]
        return called(text, compiled, ", ".join(words))

    def _method(self, array: ArrayValue, name: str, arguments: list[Value]) -> Value:
        if name == "copy" and not arguments:
            new, takes = copied(self._text, array, is_local=self._is_local())
            self._note_memory(takes=takes)
            return new
        if name == "ravel" and not arguments and not array.strides:
            return array._replace(shape=(size_of(self._text, array),))
        if name == "reshape" and not array.strides:
            shape = arguments
            if len(arguments) == 1 and isinstance(arguments[0], TupleValue):
                shape = list(arguments[0].items)
            return array._replace(shape=self._counts(array, list(map(self._whole, shape))))
        raise TypeError(f"kernels have no .{name}() of such an array")

    def _counts(self, array: ArrayValue, shape: list[Number]) -> tuple[Number, ...]:
        """Return the shape that an array is given; one number may be -1, for what is left."""
        left = size_of(self._text, array)
        for number in shape:
            if number.known != -1:
                left = arithmetic(self._text, "FloorDiv", left, number)
        counts = (left if number.known == -1 else number for number in shape)
        return tuple(number._replace(is_natural=True) for number in counts)

    def _is_local(self) -> bool:
        return not self._loops and not self._is_lasting

    def _make(self, thing: Any, arguments: list[Value], named: dict[str, Value]) -> ArrayValue:
        text = self._text
        needed = 2 if thing is np.full else 1
        dtype = named.pop("dtype", None)
        if dtype is None and len(arguments) > needed:
            dtype = arguments.pop()
        if named or len(arguments) != needed or not isinstance(dtype, Known | None):
            raise TypeError(f"kernels have no np.{thing.__name__}() like this")
        element = element_of(dtype.thing) if dtype is not None else None
        if thing is np.array:
            return self._make_of_items(arguments[0], element)
        if thing is np.arange:
            return self._make_count(self._whole(arguments[0]), element)
        shape = arguments[0]
        counts = shape.items if isinstance(shape, TupleValue) else (shape,)
        value: Number | None = constant(1.0) if thing is np.ones else None
        if thing is np.full:
            value = self._number(arguments[1])
        if element is None:
            element = FLOAT64 if value is None else value.scalar
        array = self._new(element, tuple(map(self._whole, counts)), is_cleared=thing is np.zeros)
        if value is not None:
            fill(text, array, value)
        return array

    def _make_of_items(self, value: Value, element: Scalar | Record | None) -> ArrayValue:
        items = [self._number(item) for item in self._items(value)]
        kind: KernelType | None = element or (items[0].scalar if items else FLOAT64)
        for item in items if element is None else ():
            kind = joined(kind, item.scalar) if kind is not None else None
        if not isinstance(kind, Scalar):
            raise TypeError("these have no type in common")
        row = self._new(kind, (constant(len(items)),), is_cleared=False)
        for k, item in enumerate(items):
            store(self._text, kind, element_address(self._text, row, [constant(k)]), item)
        return row

    def _make_count(self, count: Number, element: Scalar | Record | None) -> ArrayValue:
        text = self._text
        count = least_or_most(text, "Gt", [count, constant(0)])
        kind = element or INT64
        if not isinstance(kind, Scalar):
            raise TypeError("numbers are no records")
        row = self._new(kind, (count,), is_cleared=False)

        def write(operand: str) -> None:
            number = Number(INT64, operand, True)
            store(text, kind, element_address(text, row, [number]), number)

        text.count_up(count.operand, write)
        return row

    def _new(
        self, element: Scalar | Record, shape: Sequence[Number], *, is_cleared: bool
    ) -> ArrayValue:
        array, takes = made(
            self._text, element, shape, is_cleared=is_cleared, is_local=self._is_local()
        )
        self._note_memory(takes=takes)
        return array


def _named_tuple(maker: Any, arguments: list[Value], named: dict[str, Value]) -> TupleValue:
    """Return a named tuple of the arguments that its class is called with."""
    names = maker._fields[len(arguments) :]
    if len(arguments) > len(maker._fields) or set(named) != set(names):
        raise TypeError(f"{maker.__name__}() takes {', '.join(maker._fields)}")
    return TupleValue((*arguments, *(named[name] for name in names)), maker)


_MAKERS = (np.empty, np.zeros, np.ones, np.full, np.array, np.arange)


def _of_python(thing: Any) -> Value:
    """Return what a name of Python's stands for in a kernel."""
    if thing is None:
        return Nothing()
    if isinstance(thing, bool | int | float | np.number | np.bool_):
        return constant(thing)  # type: ignore[arg-type]
    if isinstance(thing, tuple) and not isinstance(thing, External):
        return TupleValue(
            tuple(map(_of_python, thing)), None if type(thing) is tuple else type(thing)
        )
    return Known(thing)
