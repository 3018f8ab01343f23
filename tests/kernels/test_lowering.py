"""Statements and expressions of kernels do what they do in Python; what is not theirs is told."""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable
from typing import Any, NamedTuple

import llvmlite.binding
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.kernels.python_oracle import assert_as_in_python, exact

from gazelle.kernels import External, Kernel, kernel
from gazelle.kernels.kernel_types import INT64
from gazelle.kernels.program import Program

_FEW = st.integers(-6, 6)

# Loops and branches


@kernel
def _branches(a, b):
    found = 0
    if a > b:
        found += 1
        if a > 2 * b:
            found += 10
        else:
            found += 20
    elif a == b:
        found += 100
    else:
        found -= 1
    if not (a < 0 or b < 0) and a + b > 3:
        found += 1000
    if a:
        found += 10_000
    return found


@given(_FEW, _FEW)
def test_branches_go_as_in_python(a: int, b: int) -> None:
    assert_as_in_python(_branches, a, b)


@kernel
def _returns(a):
    if a > 3:
        return 1
    elif a > 0:  # noqa: RET505 - this is what is tested
        return 2
    else:
        while True:
            a += 1
            if a > 2:
                return a * 100


@given(_FEW)
def test_a_kernel_returns_from_everywhere(a: int) -> None:
    assert_as_in_python(_returns, a)


@kernel
def _loops(n, m):
    seen = 0
    for i in range(n):
        if i == 4:
            break
        for j in range(m):
            if j == i:
                continue
            if j > 3:
                break
            seen = seen * 3 + i + 2 * j
        else_ = i
        k = 0
        while k < i:
            k += 1
            if k == 2:
                continue
            if k > else_ + 1:
                break
            seen += k
    while True:
        seen += 1
        if seen % 7 == 0:
            break
    return seen


@given(_FEW, _FEW)
def test_break_and_continue_are_those_of_their_loop(n: int, m: int) -> None:
    assert_as_in_python(_loops, n, m)


@kernel
def _ranges(first, last, step):
    up = down = unknown = 0
    for k in range(first, last):
        up = up * 7 + k
    for k in range(first, last, -2):
        down = down * 7 + k
    for k in range(first, last, step):
        unknown = unknown * 7 + k
    for k in range(first, last, 3):
        up = up * 5 + k
    for k in range(first, -1, -1):
        down = down * 5 + k // 2
    return up, down, unknown


@given(_FEW, _FEW, st.integers(-3, 3).filter(bool))
def test_ranges_count_up_and_down(first: int, last: int, step: int) -> None:
    assert_as_in_python(_ranges, first, last, step)


@kernel
def _after(n):
    k = -5
    for k in range(n):
        if k == 3:
            break
    j = 0
    for j in range(2, n, 3):
        k += j
    return k, j


@given(_FEW)
def test_a_loops_name_keeps_its_last_value(n: int) -> None:
    assert_as_in_python(_after, n)


@kernel
def _own_count(n):
    total = 0
    for k in range(n):
        k += 10  # noqa: PLW2901 - the range goes on as it was
        total += k
        n = 0
    return total


def test_a_range_is_settled_when_its_loop_begins() -> None:
    assert_as_in_python(_own_count, 4)


@kernel
def _of_tuple(a, b):
    total, seen = 0.0, 0
    for value in (a, b, 2.5, -a):
        if value < 0:
            continue
        total += value
    for place in (3, 1, 2):
        seen = seen * 10 + place
    for sign in (-1, 1):
        seen += sign // 2
    return total, seen


@kernel
def _over_arrays(row, matrix):
    total = 0.0
    for one in row:
        if one < 0:
            break
        total += one
    for part in matrix:
        total += part[0] * part.size
    return total


@given(st.lists(st.integers(-1, 9), max_size=5))
def test_a_loop_goes_over_the_rows_of_an_array(numbers: list[int]) -> None:
    row = np.array(numbers, float)
    for layout in (row, np.repeat(row, 2)[::2], row[::-1]):
        assert_as_in_python(_over_arrays, layout, np.arange(6.0).reshape(3, 2).T)


@given(st.floats(-5, 5), st.floats(-5, 5))
def test_a_loop_goes_over_a_tuple_of_numbers(a: float, b: float) -> None:
    assert_as_in_python(_of_tuple, a, b)


@kernel
def _sieve(n):
    """A docstring is no statement."""
    is_prime = np.ones(n + 1, np.bool_)
    is_prime[:2] = False
    k = 2
    while k * k <= n:
        if is_prime[k]:
            for multiple in range(k * k, n + 1, k):
                is_prime[multiple] = False
        k += 1
    count = 0
    for k in range(n + 1):
        count += is_prime[k]
    return count, is_prime


def test_a_sieve_finds_the_primes() -> None:
    for n in (2, 30, 100):
        assert_as_in_python(_sieve, n)


# Names


@kernel
def _widened(n):
    total = 0
    step = 1
    for k in range(n):
        total += step
        step = step * 0.5
        if k > 2:
            total = total + 1
    return total, step


def test_a_name_holds_all_that_it_is_given() -> None:
    for n in (1, 2, 5):
        assert _widened(n) == _widened.source.function(n)
    # It has one type, also where the loop is never entered.
    assert exact(_widened(0)) == exact((0.0, 1.0))


@kernel
def _widened_by_another(n):
    a, b, c = 0, 0, 0
    for k in range(n):
        a = b
        b = c
        c = k * 0.25
    return a, b, c


def test_names_are_widened_one_by_the_other() -> None:
    assert exact(_widened_by_another(2)) == exact((0.0, 0.0, 0.25))
    assert exact(_widened_by_another(6)) == exact((0.75, 1.0, 1.25))


@kernel
def _widened_elements(row, is_late):
    value = row[0]
    if is_late:
        value = 1000
    other = row[1]
    for k in range(3):
        other += k
    return value, other


def test_a_small_integer_is_widened_to_what_it_becomes() -> None:
    for name in ("int8", "uint8", "uint16", "int32"):
        assert _widened_elements(np.array([100, 100], name), True) == (1000, 103)
        assert _widened_elements(np.array([100, 127], name), False) == (100, 130)


@kernel
def _read_before(n):
    total = 0
    for k in range(n):
        if k > 0:
            total += before  # noqa: F821
        before = k  # noqa: F841
    return total


def test_a_name_is_read_above_where_the_round_before_gave_it_a_value() -> None:
    assert_as_in_python(_read_before, 5)


@kernel
def _signs(n):
    k = n - n
    seen = 0
    for _ in range(3):
        seen = seen * 100 + k // 2 + k % 3
        k -= 3
    j = 10
    while j > -10:
        seen += j // 4 + j % 4
        j = j - 7
    return seen, (k if n else j) // 2, -(k // 4)


def test_a_name_that_becomes_negative_is_divided_as_such() -> None:
    for n in (0, 1):
        assert_as_in_python(_signs, n)


@kernel
def _arguments_change(a, row):
    a += 1
    row = row[1:]
    if a > 3:
        a = a * 2
        row = row[1:]
    return a, row.copy()


def test_arguments_are_names_like_others() -> None:
    for a in (0, 5):
        assert_as_in_python(_arguments_change, a, np.arange(4.0))


@kernel
def _one_or_other(first, second, is_first):
    row = first
    if not is_first:
        row = second
    row[0] += 1
    other = second if is_first else first
    other[-1] = 10
    return len(row), row[1] + other[1]


def test_a_name_stands_for_one_array_or_another() -> None:
    long, short, strided = np.arange(4.0), np.arange(3.0), np.arange(8.0)[::2]
    for first, second in ((long, short), (long, strided), (strided, short), (strided, strided)):
        for is_first in (True, False):
            assert_as_in_python(_one_or_other, first, second, is_first)


@kernel
def _swapped_arrays(n):
    now, then = np.zeros(3), np.ones(3)
    for k in range(n):
        now[k % 3] += then[0] + k
        now, then = then, now
    return now, then


def test_arrays_change_their_names() -> None:
    for n in range(5):
        assert_as_in_python(_swapped_arrays, n)


# Tuples


class _Pair(NamedTuple):
    a: float
    b: float


class _Nested(NamedTuple):
    row: Any
    pair: _Pair
    size: tuple[int, int]


@kernel
def _unpacked(a, b):
    a, b = b, a
    (c, d), e = (a + 1, b + 2), 3
    f = g = c
    row = np.array([a, b, c])
    row[0], row[1] = row[1], row[0]
    pair = a, b
    x, y = pair
    for _ in range(2):
        x, y = y, x + y
    p, q = pair
    return a, b, c, d, e, f, g, row, pair, x, y, p, q, pair[0], pair[-1], len(pair)


@given(_FEW, _FEW)
def test_tuples_are_taken_apart_and_made(a: int, b: int) -> None:
    assert_as_in_python(_unpacked, a, b)


@kernel
def _row_unpacked(rows):
    total = 0.0
    x, y, z = np.array([1.5, 2.5, 3.5])
    for k in range(len(rows)):
        total += rows[k, 0] * x + y - z
    return total


def test_an_array_of_known_size_is_taken_apart() -> None:
    assert_as_in_python(_row_unpacked, np.arange(4.0).reshape(2, 2))


@kernel
def _picked(a, b, k):
    return (a, b, a + b)[k % 3], ((a, 1), (b, 2))[k % 2]


def test_an_item_of_a_tuple_of_one_type_is_counted() -> None:
    for k in range(4):
        assert_as_in_python(_picked, 5, 7, k)


@kernel
def _sum_of(a, b, c):
    return a + 10 * b + 100 * c


@kernel
def _starred(pair):
    whole = (*pair, 3)
    return _sum_of(*pair, 3), _sum_of(*whole), (*whole, *pair), min(*pair), max(*pair)


def test_a_star_spreads_a_tuple() -> None:
    assert_as_in_python(_starred, (1, 2))
    assert_as_in_python(_starred, _Pair(2.5, 1.0))


@kernel
def _named(pair, k):
    swapped = _Pair(pair.b, pair.a)
    if k > 0:
        swapped = _Pair(swapped.a * k, 0.5)
    nested = _Nested(np.zeros(2), swapped, (k, 2))
    nested.row[0] = nested.pair.a + nested.size[0] + nested[1][1]
    a, b = swapped
    return swapped, nested, swapped.a + a, b, nested.pair, len(pair)


def test_named_tuples_are_given_made_and_returned() -> None:
    for k in (0, 2):
        assert_as_in_python(_named, _Pair(1.0, 2.0), k)
    assert type(_named(_Pair(1.0, 2.0), 1)[1].pair) is _Pair


@kernel
def _by_name(a):
    return _Pair(b=a, a=2.5), _Pair(1.5, b=a)


def test_named_tuples_are_made_by_names() -> None:
    assert_as_in_python(_by_name, 0.5)


@kernel
def _nested_fields(whole):
    whole.row[1] = whole.pair.b
    return whole.row[0] + whole.pair.a + whole.size[1], whole.pair


def test_named_tuples_hold_arrays_and_others() -> None:
    for row in (np.arange(3.0), np.arange(6.0)[::2]):
        assert_as_in_python(_nested_fields, _Nested(row, _Pair(1.0, 2.0), (3, 4)))


# Conditions


@kernel
def _guarded(row, k):
    seen = 0
    if k < len(row) and row[k] > 0:
        seen += 1
    if k >= len(row) or row[k] > 0:
        seen += 10
    is_inside = k < len(row) and row[k] > 0
    is_outside = k >= len(row) or row[k] > 0
    value = row[k] if k < len(row) else -1.0
    while k < len(row) and row[k] >= 0:
        k += 1
    return seen, is_inside, is_outside, value, not is_inside, k


@kernel
def _far(row, k):
    # Where it looked, this would be far outside of all memory.
    far = k * 2**40
    if k == 0 or row[far] > 0.0:
        return 1
    if k != 0 and row[far] > 0.0:
        return 2
    return row[far] if k != 0 else 3


def test_the_other_side_of_and_and_or_is_looked_at_only_where_it_counts() -> None:
    for k in range(4):
        assert_as_in_python(_guarded, np.array([1.0, -1.0, 2.0]), k)
    assert _far(np.ones(1), 0) == 1


@kernel
def _count_calls(calls):
    calls[0] += 1
    return True


@kernel
def _calls_of_conditions(calls, a):
    first = a > 0 and _count_calls(calls)
    second = a > 0 or _count_calls(calls)
    third = 1 if not (a > 0 and a < 5 and _count_calls(calls)) else 2
    fourth = not _count_calls(calls) or a > 3
    return first, second, third, fourth


def test_conditions_call_as_often_as_in_python() -> None:
    for a in (-1, 1, 9):
        assert_as_in_python(_calls_of_conditions, np.zeros(1), a)


@kernel
def _chained(a, b, c):
    return a < b < c, a <= b == c, a != b >= c > a, a > -2, (a < b) == (b < c)


@given(_FEW, _FEW, _FEW)
def test_comparisons_are_chained(a: int, b: int, c: int) -> None:
    assert_as_in_python(_chained, a, b, c)


@kernel
def _chosen(a, b):
    low, high = (a, b) if a < b else (b, a)
    pair = _Pair(1.0, 2.0) if a > 0 else _Pair(2.5, 0.5) if b > 0 else _Pair(3.0, 3.0)
    x = (1 if b else 2) + (a if a > 0 else -a)
    return low, high, pair, x, (7 if a == b else 8) // 2


@given(_FEW, _FEW)
def test_either_tuple_can_be_chosen(a: int, b: int) -> None:
    assert_as_in_python(_chosen, a, b)


@kernel
def _mixed_choice(a):
    return 1 if a else 2.5


def test_a_choice_has_the_type_of_both_sides() -> None:
    assert exact((_mixed_choice(1), _mixed_choice(0))) == exact((1.0, 2.5))


# Calls

_GAIN = 3
_OFFSETS = (1.5, -2.0)
_ORIGIN = _Pair(4.0, 5.0)
_SCALE = np.float32(0.1)


@kernel
def _double(x):
    return x + x


@kernel
def _of_types(a, b, row):
    return _double(a), _double(b), _double(row[0]), _double(a) + _double(a), _double(True)


def test_a_kernel_is_called_for_several_types() -> None:
    assert_as_in_python(_of_types, 2, 2.5, np.array([100], np.int64))
    assert _of_types(2, 2.5, np.array([100], np.int8))[2] == 200


@kernel
def _of_module(x):
    return x * _GAIN + _OFFSETS[1], _OFFSETS, _ORIGIN.b, _ORIGIN, len(_OFFSETS), math.pi, math.inf


def test_constants_of_the_module_are_compiled_in() -> None:
    assert_as_in_python(_of_module, 2.0)


@kernel
def _single_constant(x):
    return np.full(1, _SCALE * x)


def test_a_constant_has_its_own_precision() -> None:
    assert _single_constant(np.float32(3.0))[0] == np.float32(0.1) * np.float32(3.0)


@kernel
def _of_numbers(x):
    return _sum_of(2, x, 1) + _sum_of(3, x, x) + _sum_of(-1, 2, x)


def test_a_kernel_is_not_compiled_for_each_number_that_it_is_given() -> None:
    assert_as_in_python(_of_numbers, 10)
    program = Program()
    program.function(_of_numbers.source, (INT64,))
    assert program.text().count('define internal i64 @"_sum_of.') == 1


_note = External("gazelle_test_note", 2)


@kernel
def _calls_library(n, row):
    for k in range(n):
        _note(k, row[k])
    return n


def test_functions_of_libraries_are_called_with_addresses_and_numbers() -> None:
    noted: list[tuple[int, int]] = []
    kind = ctypes.CFUNCTYPE(None, ctypes.c_int64, ctypes.c_int64)
    function = kind(lambda *numbers: noted.append(numbers))
    llvmlite.binding.add_symbol(_note.name, ctypes.cast(function, ctypes.c_void_p).value)
    assert _calls_library(3, np.array([2**40, -1, 7])) == 3
    assert noted == [(0, 2**40), (1, -1), (2, 7)]


@kernel
def _nothing(row):
    row[0] = 1.0


@kernel
def _early(row, k):
    if k > 0:
        return
    row[0] = 5.0


@kernel
def _calls_nothing(row, k):
    _nothing(row)
    _early(row[1:], k)
    none = None
    if k:
        return none
    return None


def test_a_kernel_may_return_nothing() -> None:
    for k in (0, 1):
        assert_as_in_python(_nothing, np.zeros(2))
        assert_as_in_python(_early, np.zeros(2), k)
        assert_as_in_python(_calls_nothing, np.zeros(2), k)


@kernel
def _strided_callee(row):
    row[0] += 1
    return row[len(row) - 1]


@kernel
def _strided_caller(matrix):
    return (
        _strided_callee(matrix[:, 1]) + _strided_callee(matrix[0]) + _strided_callee(matrix[1:, 0])
    )


def test_a_part_is_given_to_another_kernel() -> None:
    for matrix in (np.arange(6.0).reshape(3, 2), np.arange(6.0).reshape(2, 3).T):
        assert_as_in_python(_strided_caller, matrix)


# What is not for kernels


def _told(function: Any, *arguments: Any, line: int, column: int, text: str) -> None:
    """Compile a function and see what it is told; the line counts from the decorator's."""
    compiled = function if isinstance(function, Kernel) else kernel(function)
    where = compiled.source.function.__code__.co_firstlineno + line
    with pytest.raises(TypeError) as error:
        compiled(*arguments)
    assert str(error.value) == f"kernel {__file__}:{where}:{column}: {text}"


def _with_list(n):
    row = [k for k in range(n)]  # noqa: C416
    return row[0]


def _with_lambda(n):
    f = lambda x: x  # noqa: E731
    return f(n)


def _with_try(n):
    try:  # noqa: SIM105
        n += 1
    except ValueError:
        pass
    return n


def _with_power_of_matrices(n):
    return n @ n


def _with_inverse(n):
    return ~n


def _with_is(n):
    return n is n


def _with_raise(n):
    if n:
        raise ValueError


def _with_assert(n):
    assert n
    return n


def _with_annotation(n):
    m: int = n
    return m


def _with_function(n):
    def inner(x):
        return x

    return inner(n)


def _with_dictionary(n):
    return {1: n}


def _with_walrus(n):
    return (m := n) + m


def _with_step(n):
    row = np.zeros(5)
    return row[::2][n]


def _with_else(n):
    for k in range(n):
        n -= k
        if n < 0:
            break
    else:
        n = 9
    return n


@pytest.mark.parametrize(
    ("function", "line", "column", "text"),
    [
        (_with_list, 1, 5, "kernels have no ListComp"),
        (_with_lambda, 1, 5, "kernels have no Lambda"),
        (_with_try, 1, 5, "kernels have no Try"),
        (_with_power_of_matrices, 1, 5, "no operator MatMult for integers"),
        (_with_inverse, 1, 5, "kernels have no UnaryOp"),
        (_with_is, 1, 5, "no relation Is of numbers"),
        (_with_raise, 2, 9, "kernels have no Raise"),
        (_with_assert, 1, 5, "kernels have no Assert"),
        (_with_annotation, 1, 5, "kernels have no AnnAssign"),
        (_with_function, 1, 5, "kernels have no FunctionDef"),
        (_with_dictionary, 1, 5, "kernels have no Dict"),
        (_with_walrus, 1, 5, "kernels have no NamedExpr"),
        (_with_step, 2, 5, "kernels take no slices with a step"),
        (_with_else, 1, 5, "kernels have no For"),
    ],
)
def test_what_kernels_do_not_have_is_told_with_its_place(
    function: Callable[..., Any], line: int, column: int, text: str
) -> None:
    _told(function, 1, line=line, column=column, text=text)


def _unknown_name(n):
    return n + nowhere  # type: ignore[name-defined] # noqa: F821


def _unknown_attribute(n):
    return np.zeros(n).mean


def _unknown_call(n):
    return math.gamma(n)


def _unknown_method(n):
    return np.zeros(n).sum()


def _called_number(n):
    return n(1)


def _float_index(n):
    return np.zeros(5)[n * 1.0]


def _float_range(n):
    for _ in range(n * 0.5):
        pass


def _three_for_two(n):
    a, b = n, 1, 2
    return a + b


def _number_apart(n):
    a, b = n
    return a + b


def _counted_number(n):
    total = 0
    for one in n:
        total += one
    return total


def _sum_of_tuples(n):
    return (n, 1) + (n, 2)  # noqa: RUF005


def _two_types(n):
    x = n
    if n > 0:
        x = (n, n)
    return x


def _two_results(n):
    if n > 0:
        return n
    return n, n


def _two_sides(n):
    return n if n > 0 else (n, n)


def _item_of_several(n):
    return (1, 2.5)[n]


def _tuple_from_end(n):
    return (1, 2)[n - 3]


def _element_of_number(n):
    return n[0]


def _array_of_tuple(n):
    row = np.zeros(3)
    row[0] = (n, n)
    return row


def _dimensions(n):
    matrix, row = np.zeros((2, 2)), np.zeros(2)
    matrix[:] = row
    return matrix[0, n]


def _tuple_assigned(n):
    pair = (n, n)
    pair[0] = 1
    return pair


def _attribute_of_number(n):
    return n.real


def _length_of_number(n):
    return len(n)


def _value_of_or(n):
    return (n or 3) + 1


def _too_many_arguments(n):
    return math.log(n, 2)


def _too_few_arguments():
    return math.sqrt()  # type: ignore[call-arg]


def _digits_of_round(n):
    return round(n * 1.5, 2)


def _range_from(n):
    return np.arange(n, 5)


def _fields_missing(n):
    return _Pair(n)  # type: ignore[call-arg]


def _too_many_for_a_kernel(n):
    return _double(n, n)


def _calls_itself(n):
    return _itself(n - 1) if n else 0


_itself = kernel(_calls_itself)


def _ends_without(n):  # noqa: RET503
    if n > 0:
        return n


def _too_large(n):
    return n + 2**62 * 4


def _three_indices(n):
    return np.zeros((2, 2))[0, 1, n]


def _three_indices_of_part(n):
    return np.zeros((2, 2))[0:1, 1, n].size


def _part_in_place(n):
    row = np.zeros(3)
    row[1:] += n
    return row


def _row_in_place(n):
    rows = np.zeros((3, 3))
    rows[1] += n
    return rows


@pytest.mark.parametrize(
    ("function", "line", "column", "text"),
    [
        (_unknown_name, 1, 5, "'nowhere' has no value here"),
        (_unknown_attribute, 1, 5, "there is no 'mean' of this"),
        (_unknown_call, 1, 12, "kernels have no gamma() like this"),
        (_unknown_method, 1, 12, "kernels have no .sum() of such an array"),
        (_called_number, 1, 12, "this cannot be called"),
        (_float_index, 1, 5, "an index is an integer, not float64"),
        (_float_range, 1, 5, "a whole number is needed here"),
        (_three_for_two, 1, 5, "3 values for 2 names"),
        (_number_apart, 1, 5, "only a tuple can be taken apart"),
        (
            _counted_number, 2, 5,
            "kernels count through ranges, arrays and tuples of numbers only",
        ),
        (_sum_of_tuples, 1, 5, "a number is needed here"),
        (_two_sides, 1, 5, "both sides of an 'if' have different types"),
        (
            _item_of_several, 1, 5,
            "an item of a tuple of different types is taken by a known number only",
        ),
        (_tuple_from_end, 1, 5, "an item of a tuple is not counted from its end"),
        (_element_of_number, 1, 5, "only arrays and tuples have elements"),
        (_array_of_tuple, 2, 5, "only numbers can be written to an array's element"),
        (
            _dimensions, 2, 5,
            "only a number, or an array of as many dimensions, can be written there",
        ),
        (_tuple_assigned, 2, 5, "only elements of arrays can be assigned"),
        (_attribute_of_number, 1, 5, "there is no 'real' of this"),
        (_length_of_number, 1, 12, "only arrays and tuples have a length"),
        (
            _value_of_or, 1, 5,
            "'and' and 'or' connect truth values only, in what is no condition",
        ),
        (_too_many_arguments, 1, 12, "kernels have no log() like this"),
        (_digits_of_round, 1, 12, "kernels have no round() like this"),
        (_range_from, 1, 12, "kernels have no np.arange() like this"),
        (_fields_missing, 1, 12, "_Pair() takes a, b"),
        (
            _too_many_for_a_kernel, 1, 12,
            "tests.kernels.test_lowering._double() takes 1 arguments, not 2",
        ),
        (_itself, 1, 12, "tests.kernels.test_lowering._calls_itself calls itself"),
        (_ends_without, 0, 1, "None is returned here, and int64 elsewhere"),
        (_too_large, 1, 5, "18446744073709551616 does not fit into int64"),
        (_three_indices, 1, 5, "3 indices of an array of 2 dimensions"),
        (_three_indices_of_part, 1, 5, "3 indices of an array of 2 dimensions"),
        (
            _part_in_place, 2, 5,
            "only a name's value or an array's element can be changed in place",
        ),
        (_row_in_place, 2, 5, "1 indices of an array of 2 dimensions"),
        (_two_results, 3, 5, "(int64, int64) is returned here, and int64 elsewhere"),
        (_two_types, 3, 9, "'x' is given (int64, int64) here, and int64 elsewhere"),
    ],
)  # fmt: skip
def test_what_makes_no_sense_is_told_with_its_place(
    function: Callable[..., Any], line: int, column: int, text: str
) -> None:
    _told(function, 1, line=line, column=column, text=text)


@kernel
def _wrong_inside(x):
    y = x + 1
    return y.real


@kernel
def _calls_wrong(x):
    return _wrong_inside(x) + 1


def test_what_a_called_kernel_does_wrong_is_told_with_its_own_place() -> None:
    for _ in range(2):
        with pytest.raises(TypeError) as error:
            _calls_wrong(1)
        line = _wrong_inside.source.function.__code__.co_firstlineno + 3
        assert str(error.value) == f"kernel {__file__}:{line}:5: there is no 'real' of this"


def test_a_kernel_that_is_told_off_for_one_type_works_for_another() -> None:
    with pytest.raises(TypeError):
        _first_item(1)
    assert _first_item((4, 5)) == 4
    assert _first_item(np.array([6.0])) == 6.0


@kernel
def _first_item(x):
    return x[0]
