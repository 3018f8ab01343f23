"""What Python may give to a kernel, and what it gets back."""

from __future__ import annotations

import enum
import gc
import sys
import threading
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
import pytest
from tests.kernels.python_oracle import assert_as_in_python, exact

from gazelle.kernels import Kernel, kernel

_NAMES = (
    "bool", "int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64", "float32",
    "float64",
)  # fmt: skip


class _Pair(NamedTuple):
    a: Any
    b: Any


class _Swapped(NamedTuple):
    b: Any
    a: Any


def _same(a):
    return a


def _ten_less(a):
    return a - 10


def _third(a):
    return a / 3


def _first(row):
    return row[0]


def _field(pair):
    return pair.a


def _told(run: Kernel, *arguments: Any) -> str:
    with pytest.raises(TypeError) as error:
        run(*arguments)
    return str(error.value)


def _types(run: Kernel) -> list[str]:
    return [" ".join(getattr(kind, "name", "") for kind in types) for types in run.signatures]


# Numbers


def test_numbers_of_every_type_are_taken() -> None:
    run = kernel(_same)
    numbers = [np.dtype(name).type(1) for name in _NAMES]
    for number in (*numbers, *reversed(numbers), 1, 1.0, True):
        assert exact(run(number)) == exact(number.item() if hasattr(number, "item") else number)
    # Integers with a sign are Python's.
    assert _types(run) == [
        "bool", "int64", "uint8", "uint16", "uint32", "uint64", "float32", "float64"
    ]  # fmt: skip


@pytest.mark.parametrize("first", [1.5, True, np.float32(1), np.uint64(1)])
def test_what_came_first_plays_no_part(first: Any) -> None:
    run, third = kernel(_ten_less), kernel(_third)
    run(first)
    third(first)
    for _ in range(2):
        assert exact(run(5)) == exact(-5)
        assert exact(run(300)) == exact(290)
        assert exact(run(2**53 + 1)) == exact(2**53 - 9)
        assert exact(run(True)) == exact(-9)
        assert exact(run(np.bool_(False))) == exact(-10)
        assert exact(run(2.0)) == exact(-8.0)
        assert exact(run(np.int8(-5))) == exact(-15)
        assert exact(third(0.1)) == exact(0.1 / 3)
        assert exact(third(np.float64(0.1))) == exact(0.1 / 3)
        assert exact(third(2)) == exact(2 / 3)


def test_single_precision_stays_single() -> None:
    def divided(a, b):
        return np.full(1, a / b)

    run = kernel(divided)
    for _ in range(2):
        assert exact(run(np.float32(1), np.float32(3))) == exact(np.float32([1]) / np.float32(3))
        assert exact(run(1.0, 3.0)) == exact(np.float64([1]) / 3)
        assert exact(run(np.float32(0.1), 3.0)) == exact(np.full(1, float(np.float32(0.1)) / 3.0))


class _Colour(enum.IntEnum):
    RED = 7


def test_a_named_number_is_its_number() -> None:
    run = kernel(_ten_less)
    for _ in range(2):
        assert exact(run(_Colour.RED)) == exact(-3)


@pytest.mark.parametrize("first", [1, 1.0, np.uint64(1)])
def test_integers_are_of_64_bits(first: Any) -> None:
    run = kernel(_same)
    run(first)
    for _ in range(2):
        assert run(2**63 - 1) == 2**63 - 1
        assert run(-(2**63)) == -(2**63)
        for large in (2**63, -(2**63) - 1, 2**200):
            assert _told(run, large) == (
                "tests.kernels.test_python_entry._same() cannot be given (int64) as they are"
            )
        assert run(np.uint64(2**64 - 1)) == 2**64 - 1
        assert run(-1) == -1


class _Floating:
    def __float__(self) -> float:
        return 3.0

    def __index__(self) -> int:
        return 3


@pytest.mark.parametrize(
    ("thing", "text"),
    [
        ([1.0], "kernels take no list"),
        ("1.0", "kernels take no str"),
        (1j, "kernels take no complex"),
        ({}, "kernels take no dict"),
        (b"1", "kernels take no bytes"),
        (bytearray(8), "kernels take no bytearray"),
        (memoryview(bytearray(8)), "kernels take no memoryview"),
        (Fraction(1), "kernels take no Fraction"),
        (_Floating(), "kernels take no _Floating"),
        ((1.0, [2.0]), "kernels take no list"),
        (np.zeros(2, complex), "kernels take no arrays of complex128"),
        (np.zeros(2, np.float16), "kernels take no arrays of float16"),
        (np.zeros(2, object), "kernels take no arrays of object"),
        (np.zeros(2, "U3"), "kernels take no arrays of <U3"),
        (np.zeros(2, "M8[s]"), "kernels take no arrays of datetime64[s]"),
        (np.zeros(2, ">f8"), "kernels take no arrays of >f8"),
        (
            np.zeros(3, [("a", "i1"), ("x", "f8")])["x"],
            "kernels take no array whose elements are not aligned",
        ),
    ],
)
def test_what_is_no_number_array_or_tuple_is_refused_also_later(thing: Any, text: str) -> None:
    for run in (kernel(_same), _known):
        for _ in range(2):
            assert _told(run, thing) == text
            # No error is left behind for what comes next.
            assert run(1) == 1


@kernel
def _known(a):
    return a


@pytest.fixture(autouse=True, scope="module")
def _all_known() -> None:
    _known(1.0)
    for thing in (1, True, np.uint8(1), np.float32(1), np.zeros(1), np.zeros(1, np.uint8), None):
        _known(thing)
    _known((1.0, 2.0))


def test_none_is_an_argument() -> None:
    run = kernel(_same)
    for value in (None, 1, None, 2.5):
        assert run(value) is value or run(value) == value
    assert run(None) is None


def test_another_count_of_arguments_is_told() -> None:
    run = kernel(_same)
    name = "tests.kernels.test_python_entry._same()"
    for _ in range(2):
        assert _told(run, 1, 2) == f"{name} takes 1 arguments, not 2"
        assert _told(run) == f"{name} takes 1 arguments, not 0"
        assert run(1) == 1


# Arrays


@pytest.mark.parametrize("first", ["bool", "int8", "uint64", "float32"])
def test_an_array_of_another_type_is_another_kind_of_argument(first: str) -> None:
    run = kernel(_first)
    run(np.ones(2, first))
    for name in ("int32", "float64", "bool", "uint8", first):
        assert exact(run(np.ones(2, name))) == exact(np.ones(2, name)[0])
    for shape in ((3, 2), (2, 3, 2)):
        rows = np.arange(np.prod(shape)).reshape(shape).astype(first)
        assert exact(run(rows)) == exact(rows[0])


def test_arrays_of_the_c_librarys_other_names_are_taken() -> None:
    run = kernel(_first)
    for kind in (np.longlong, np.int_, np.intc, np.byte, np.ulonglong, np.uintc, np.short):
        assert run(np.array([7], kind)) == 7


def test_arrays_lie_in_any_order() -> None:
    def weighed(rows):
        total = 0.0
        for k in range(rows.shape[0]):
            for j in range(rows.shape[1]):
                total += (7 * k + j) * rows[k, j]
        return total

    run, rows = kernel(weighed), np.arange(12.0).reshape(3, 4)
    for _ in range(2):
        for layout in (rows, rows.T, rows[::-1], rows[:, ::2], np.broadcast_to(rows[0], (5, 4))):
            assert run(layout) == weighed(layout)
    # In order, in any other order, and in any other order and read only.
    assert len(run.signatures) == 3


def test_an_array_that_lies_in_order_but_for_its_strides_is_taken() -> None:
    # NumPy calls it contiguous: no stride of a dimension of one element, or of none, matters.
    run = kernel(_first)
    for rows in (np.zeros((4, 6))[::4, :3], np.zeros((1, 3))[:, ::-1][:, :1], np.zeros((5, 1)).T):
        assert exact(run(rows)) == exact(rows[0])


def test_an_array_without_dimensions_is_taken() -> None:
    run = kernel(_same)
    for _ in range(2):
        assert exact(run(np.array(2.5))) == exact(np.array(2.5))
        assert exact(run(2.5)) == exact(2.5)
        assert exact(run(np.float64(2.5))) == exact(2.5)
        assert exact(run(np.uint8(2))) == exact(2)


def test_arrays_of_one_element_are_no_numbers() -> None:
    run = kernel(_same)
    run(1.0)
    assert exact(run(np.array([2.0]))) == exact(np.array([2.0]))
    assert exact(run(np.array(3))) == exact(np.array(3))


def _set_first(row):
    row[0] = 5.0


def _set_part(row):
    row[1:] = 5.0


def _set_more(row):
    row[0] += 5.0


def _set_by_another(row):
    _setter(row)


_setter = kernel(_set_first)


@pytest.mark.parametrize("function", [_set_first, _set_part, _set_more, _set_by_another])
def test_an_array_that_is_read_only_is_not_written_to(function: Any) -> None:
    run, row = kernel(function), np.zeros(3)
    row.flags.writeable = False
    for _ in range(2):
        assert "this array cannot be written to" in _told(run, row)
        assert not row.any()
        run(np.zeros(3))


def test_the_place_of_writing_to_an_array_that_is_read_only_is_told() -> None:
    row = np.zeros(3)
    row.flags.writeable = False
    line = _set_first.__code__.co_firstlineno + 1
    assert _told(kernel(_set_first), row) == (
        f"kernel {__file__}:{line}:5: this array cannot be written to"
    )


def test_an_array_that_is_read_only_is_read() -> None:
    run, row = kernel(_first), np.ones(3)
    row.flags.writeable = False
    assert run(row) == run(np.ones(3)) == run(row) == 1.0


# Tuples


def test_tuples_are_known_by_their_class_and_their_items() -> None:
    run = kernel(_same)
    things = [
        (), (None,), (1,), (1, 2), (1.5, 2), _Pair(1, 2), _Swapped(1, 2), _Pair(1.5, 2),
        ((1, 2), 3.0),
        (_Pair(_Swapped(1, 2), 3), 4), (1, (2, (3, (4.5, True)))), (None, 1),
    ]  # fmt: skip
    for thing in (*things, *reversed(things)):
        found = run(thing)
        assert exact(found) == exact(thing)
        assert type(found) is type(thing)


@pytest.mark.parametrize("first", [_Pair(1.0, 2.0), _Swapped(a=1.0, b=2.0)])
def test_a_named_tuple_of_another_class_is_another_kind_of_argument(first: Any) -> None:
    run = kernel(_field)
    for _ in range(2):
        assert run(first) == 1.0
        assert run(_Pair(3.0, 4.0)) == 3.0
        assert run(_Swapped(3.0, 4.0)) == 4.0


def test_classes_of_the_same_name_are_told_apart() -> None:
    def made(*names: str) -> Any:
        return NamedTuple("Made", [(name, float) for name in names])  # type: ignore[misc]

    run = kernel(_field)
    one, other, again = made("a", "b"), made("b", "a"), made("a", "b")
    for _ in range(2):
        assert run(one(1.0, 2.0)) == 1.0
        assert run(other(1.0, 2.0)) == 2.0
        assert run(again(1.0, 2.0)) == 1.0


def test_tuples_hold_arrays() -> None:
    def changed(whole):
        (one, other), scale = whole
        one[0] += scale
        other[0, 1] = one[0]
        return one[0] + other[1, 0]

    run = kernel(changed)
    matrix = np.arange(6.0).reshape(3, 2)
    for other in (matrix, matrix.T, matrix[::2]):
        assert_as_in_python(run, ((np.arange(2.0), other), 3.0))
        assert_as_in_python(run, ((np.arange(4)[::2], other), 3))


# Results


def test_arrays_of_every_type_come_back() -> None:
    def copied(row, matrix):
        return row.copy(), (matrix.copy(), len(row))

    run = kernel(copied)
    for name in _NAMES:
        for n in (0, 3):
            row = np.arange(n).astype(name)
            matrix = np.arange(2 * n).reshape(n, 2).astype(name)
            assert_as_in_python(run, row, matrix)
            found = run(row, matrix)[0]
            assert found.flags.writeable
            assert found.flags.c_contiguous


def test_an_array_that_comes_back_is_one_of_its_own() -> None:
    run, row = kernel(_same), np.zeros(3)
    found = run(row)
    found[0] = 1.0
    assert row[0] == 0.0
    assert run(row) is not row


def test_what_does_not_lie_in_order_or_is_of_records_does_not_come_back() -> None:
    run = kernel(_same)
    assert _told(run, np.zeros((2, 3)).T) == (
        "kernels return numbers, tuples, and arrays in C's order to Python"
    )
    records = np.zeros(2, np.dtype([("x", np.float64)]))
    assert _told(run, records) == "kernels return no records to Python"
    nested = np.zeros(2, np.dtype([("p", [("x", np.float64)])]))
    assert _told(run, nested) == "kernels take no records in records"


# References


class _Whole(NamedTuple):
    row: Any
    pair: Any


@kernel
def _of_all(number, row, whole, flag):
    if flag:
        whole.row[0] = number
    return number, row.copy(), whole.pair, _Whole(whole.row.copy(), (number, flag)), None, 10**12


def test_no_reference_is_kept_or_lost() -> None:
    number, row = 123456.789, np.arange(3.0)
    whole = _Whole(np.arange(4.0)[::2], _Pair(123456, 987654321.5))
    things = [number, row, whole, whole.row, whole.pair, whole.pair.a, whole.pair.b]
    shared = [None, True, False, NotImplemented, _Pair, _Whole, float, int, tuple, bool]
    _of_all(number, row, whole, True)
    before = [sys.getrefcount(thing) for thing in (*things, *shared)]
    for _ in range(1000):
        result = _of_all(number, row, whole, True)
    assert {sys.getrefcount(item) for item in result[:4]} == {4}
    assert sys.getrefcount(result[1].base) <= 3
    del result
    after = [sys.getrefcount(thing) for thing in (*things, *shared)]
    # What others of this process do with None and the like is little, or nothing.
    assert after[: len(things)] == before[: len(things)]
    assert max(abs(a - b) for a, b in zip(after, before, strict=True)) < 100


def test_no_reference_is_kept_or_lost_of_what_is_not_taken() -> None:
    row, strided, number, large = np.arange(3.0), np.arange(6)[::2], 12345.5, 2**70
    pair = _Pair(row, number)
    things = [row, strided, number, large, pair, NotImplemented, TypeError, None, float, int]
    kinds: list[tuple[Any, ...]] = [
        (row, number, pair), (number, row, pair), (row, pair, number), (strided, strided, row),
        (row, row, (row, row)), (row, number, (row, number)), (np.float32(1), np.uint8(1), pair),
    ]  # fmt: skip
    for given in kinds:
        _not_last(*given)
    with pytest.raises(TypeError):
        _not_last(row, large, pair)
    gc.collect()
    before = [sys.getrefcount(thing) for thing in things]
    for _ in range(300):
        # All but the last of these go by the entries of others.
        for given in kinds:
            _not_last(*given)
        for wrong in ((row, large, pair), (row, number), (row, number, [row])):
            with pytest.raises(TypeError):
                _not_last(*wrong)
    gc.collect()
    after = [sys.getrefcount(thing) for thing in things]
    assert max(abs(a - b) for a, b in zip(after, before, strict=True)) < 50
    # A buffer that is still held would keep it from changing its shape.
    row.resize(2, refcheck=False)


@kernel
def _not_last(a, b, c):
    return 1


def test_memory_does_not_grow_with_what_is_not_taken() -> None:
    import psutil

    row, process = np.arange(3.0), psutil.Process()
    run = kernel(_not_last.source.function)
    kinds = [(1, 2, 3), (row, row, 1), (row, row, row), (row, row, (row, 1.0))]
    for _ in range(2):
        for given in kinds:
            run(*given)
    before = process.memory_info().rss
    for _ in range(10_000):
        run(*kinds[-1])
    assert process.memory_info().rss - before < 5 * 2**20


# Threads


def _spun(flags, steps):
    while flags[0] == 0 and steps[0] < 4_000_000_000:
        steps[0] += 1
    return flags[0]


def test_other_threads_run_meanwhile() -> None:
    run, flags, steps = kernel(_spun), np.zeros(1, int), np.zeros(1, int)
    flags[0] = 1
    run(flags, steps)
    flags[0] = 0

    def let_go() -> None:
        while not steps[0]:
            pass
        flags[0] = 1

    thread = threading.Thread(target=let_go)
    thread.start()
    # Were this alone as long as it runs, it would end by itself and find nothing.
    assert run(flags, steps) == 1
    thread.join()


def test_several_threads_call_at_once() -> None:
    def summed(row, n):
        work, total = np.zeros(len(row)), 0.0
        for _ in range(n):
            more = row.copy()
            for k in range(len(row)):
                work[k] += more[k]
        for k in range(len(row)):
            total += work[k]
        return total, work

    run, found = kernel(summed), dict[int, Any]()
    run(np.zeros(1), 1)
    barrier = threading.Barrier(4)

    def call(number: int) -> None:
        barrier.wait()
        found[number] = [run(np.full(100, float(number)), 50)[0] for _ in range(50)]

    threads = [threading.Thread(target=call, args=(number,)) for number in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == {number: [100 * 50.0 * number] * 50 for number in range(4)}
