"""Arithmetic of kernels is that of Python, and of NumPy where types are joined."""

from __future__ import annotations

import itertools
import math
import operator
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st
from tests.kernels.python_oracle import assert_as_in_python, exact

from gazelle.kernels import kernel
from gazelle.kernels.kernel_types import element_of, joined_floats

_SMALL = st.integers(-(2**31), 2**31 - 1)
_WHOLE = st.integers(-(2**63) + 1, 2**63 - 1)
_UNSIGNED = st.integers(0, 2**64 - 1).map(np.uint64)
_FLOATS = st.floats()
_ODD_FLOATS = (0.0, -0.0, 1.0, -1.0, 2.5, -2.5, math.inf, -math.inf, math.nan, 5e-324, 1.7e308)
_INTEGER_NAMES = ("int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64")


@kernel
def _integers(a, b):
    return (
        (a + b, a - b, a * b, -a, +a, abs(a), a & b, a | b, a ^ b),
        (a < b, a <= b, a == b, a != b, a >= b, a > b),
        (min(a, b), max(a, b), min(a, b, 7), max(a, b, 7)),
        (not a, bool(a), int(a), float(a), round(a), math.floor(a), math.ceil(a)),
    )


@given(_SMALL, _SMALL)
@example(0, 0)
@example(-(2**31), -(2**31))
def test_integers_are_computed_with_as_in_python(a: int, b: int) -> None:
    assert_as_in_python(_integers, a, b)


@kernel
def _wrapped(a, b):
    return a + b, a - b, a * b


@given(_WHOLE, _WHOLE)
def test_what_is_larger_than_64_bits_loses_its_front(a: int, b: int) -> None:
    expected = [(x + 2**63) % 2**64 - 2**63 for x in (a + b, a - b, a * b)]
    assert list(_wrapped(a, b)) == expected


@kernel
def _divided(a, b):
    return a // b, a % b


@given(_WHOLE, _WHOLE)
@example(7, -2)
@example(-7, 2)
@example(-8, 2)
@example(8, -2)
@example(-7, -2)
@example(-(2**63) + 1, 1)
@example(-(2**63) + 1, -1)
def test_whole_division_rounds_down_and_its_rest_has_the_divisors_sign(a: int, b: int) -> None:
    assume(b)
    assert_as_in_python(_divided, a, b)


def test_the_least_integer_is_divided_by_minus_one() -> None:
    assert _divided(-(2**63), -1) == (-(2**63), 0)


@given(_WHOLE)
def test_dividing_an_integer_by_zero_gives_zero(a: int) -> None:
    assert _divided(a, 0) == (0, 0)


@kernel
def _natural_divided(row, n):
    many = len(row)
    return many // 3, many % 3, many // n, many % n, (many - 10) // 3, (many - 10) % 4, -many // n


@given(st.integers(0, 30), st.integers(-5, 5).filter(bool))
def test_what_counts_is_divided_as_other_numbers_are(count: int, n: int) -> None:
    assert_as_in_python(_natural_divided, np.zeros(count), n)


@kernel
def _true_quotient(a, b):
    return a / b


@given(st.integers(-(2**53), 2**53), st.integers(-(2**53), 2**53))
def test_the_quotient_of_integers_is_a_float(a: int, b: int) -> None:
    assume(b)
    assert_as_in_python(_true_quotient, a, b)


def test_the_quotient_by_zero_is_infinity_or_nan() -> None:
    assert exact((_true_quotient(1, 0), _true_quotient(-1, 0), _true_quotient(0, 0))) == exact(
        (math.inf, -math.inf, math.nan)
    )
    assert exact((_true_quotient(1.0, 0.0), _true_quotient(1.0, -0.0))) == exact(
        (math.inf, -math.inf)
    )


@kernel
def _with_constants(a):
    return (
        (a // 4, a % 4, a // -3, a % -3, a // 1, a % 1, 100 // a, 100 % a, -100 // a, -100 % a),
        (a * 8, a << 3, a >> 3, a & 7, a | 7, a ^ 7, a & -8, a | -8, a ^ -1),
        (a**0, a**1, a**2, a**3),
        (a < 5, a >= -5, a == 0, a / 4),
        (3 * 4 + 2, 7 & 5, 7 | 8, 7 ^ 2, 1 << 5, -64 >> 3, 5 - 9, 17 // 5, 17 % 5, -17 // 5),
        (-17 % 5, 17 // -5, 17 % -5, 2**10, 7 / 2, min(3, 2), max(3, 2), abs(-4), 9 - -4),
    )


@given(st.integers(-(2**20), 2**20))
def test_operations_with_constants_are_those_of_python(a: int) -> None:
    assume(a)
    assert_as_in_python(_with_constants, a)


@kernel
def _shifted(a, k):
    return a << k, a >> k


@given(st.integers(-(2**20), 2**20), st.integers(0, 40))
def test_shifts_are_those_of_python(a: int, k: int) -> None:
    assert_as_in_python(_shifted, a, k)


@given(_WHOLE, st.integers(0, 63))
def test_shifting_right_keeps_the_sign(a: int, k: int) -> None:
    assert _shifted(a, k)[1] == a >> k


@kernel
def _float_power(a, b):
    return a**b


@kernel
def _float_powers(a):
    return a**0, a**1, a**2, a**3, a**0.5, a**-1, a**2.0


@given(st.floats(0.01, 100.0), st.floats(-50.0, 50.0))
def test_powers_of_floats_are_those_of_python(a: float, b: float) -> None:
    assert _float_power(a, b) == pytest.approx(a**b, rel=1e-14)
    assert _float_powers(a) == pytest.approx((1.0, a, a**2, a**3, a**0.5, a**-1, a**2), rel=1e-14)


def test_a_power_whose_exponent_is_not_known_is_a_float() -> None:
    assert exact(_float_power(3, 4)) == exact(81.0)
    assert exact(_float_power(-2, 3)) == exact(-8.0)
    assert exact(_float_power(2, -1)) == exact(0.5)


@kernel
def _floats(a, b):
    return (
        (a + b, a - b, a * b, -a, +a, abs(a)),
        (a < b, a <= b, a == b, a != b, a >= b, a > b),
        (min(a, b), max(a, b), min(b, a), max(b, a), min(a, b, 0.5), max(a, 0.5, b)),
        (not a, bool(a), math.copysign(a, b), math.fabs(a)),
        (math.isnan(a), math.isinf(a), math.isfinite(a)),
        (a + 1, 2 * a, a - 0.5, a > 1, a == 0),
    )


@given(_FLOATS, _FLOATS)
def test_floats_are_computed_with_as_in_python(a: float, b: float) -> None:
    assert_as_in_python(_floats, a, b)


@pytest.mark.parametrize("a", _ODD_FLOATS)
def test_odd_floats_are_computed_with_as_in_python(a: float) -> None:
    for b in _ODD_FLOATS:
        assert_as_in_python(_floats, a, b)


@kernel
def _rest(a, b):
    return a % b


@kernel
def _floored(a, b):
    return a // b


@given(_FLOATS, _FLOATS)
def test_the_rest_of_floats_is_that_of_python_with_its_sign(a: float, b: float) -> None:
    assume(b)
    assert_as_in_python(_rest, a, b)


@given(_FLOATS, _FLOATS)
def test_whole_division_of_floats_is_that_of_python(a: float, b: float) -> None:
    assume(b)
    assert_as_in_python(_floored, a, b)


@pytest.mark.parametrize("a", _ODD_FLOATS)
def test_odd_floats_are_divided_as_in_python(a: float) -> None:
    for b in _ODD_FLOATS:
        if b:
            assert_as_in_python(_rest, a, b)
            assert_as_in_python(_floored, a, b)


def test_a_float_divided_by_zero_has_no_rest() -> None:
    assert exact((_rest(1.0, 0.0), _floored(0.0, 0.0))) == exact((math.nan, math.nan))


@kernel
def _to_whole(x):
    return int(x), round(x), math.floor(x), math.ceil(x), math.trunc(x)


@given(st.floats(-(2.0**53), 2.0**53) | st.integers(-999, 999).map(lambda k: k / 2))
@example(0.5)
@example(1.5)
@example(2.5)
@example(-0.5)
@example(-2.5)
@example(0.49999999999999994)
def test_floats_become_integers_as_in_python(x: float) -> None:
    assert_as_in_python(_to_whole, x)


@kernel
def _functions(x, y):
    return math.sin(x), math.cos(x), math.tan(x), math.atan(x), math.atan2(x, y), math.hypot(x, y)


@kernel
def _of_positive(x):
    return math.sqrt(x), math.log(x), math.log2(x)


@kernel
def _of_unit(x):
    return math.asin(x), math.acos(x), math.exp(x)


@given(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6))
def test_functions_of_math_are_those_of_python(x: float, y: float) -> None:
    expected = _functions.source.function(x, y)
    assert _functions(x, y) == pytest.approx(expected, rel=1e-14, abs=1e-150)


@given(st.floats(1e-300, 1e300), st.floats(-1.0, 1.0))
def test_functions_of_math_with_a_domain_are_those_of_python(x: float, unit: float) -> None:
    for function, value in ((_of_positive, x), (_of_unit, unit)):
        assert function(value) == pytest.approx(function.source.function(value), rel=1e-15)
    assert _of_positive(x)[0] == math.sqrt(x)


def test_outside_their_domain_functions_of_math_are_nan_or_infinite() -> None:
    assert exact(_of_positive(-1.0)) == exact((math.nan, math.nan, math.nan))
    assert exact(_of_positive(0.0)) == exact((0.0, -math.inf, -math.inf))
    assert exact(_of_unit(2.0)[:2]) == exact((math.nan, math.nan))


@kernel
def _constants(x):
    return x * math.pi, math.tau, math.inf, -math.inf, math.nan, 1e-310, 0.1, x + np.pi


def test_constants_are_exact() -> None:
    assert_as_in_python(_constants, 3.0)


@kernel
def _truths(a, b):
    return (
        (a & b, a | b, a ^ b, a and b, a or b, not a),
        (a < b, a <= b, a == b, a != b, a >= b, a > b, min(a, b), max(a, b)),
        (a + b, a - b, a * b, -a, +a, abs(a), a / (b + 1), a // (b + 1), a % (b + 1)),
        (int(a), float(a), bool(a), a + 1, a * 2.5, a << 2, a & 1, a == 1),
    )


@pytest.mark.parametrize("b", [False, True])
@pytest.mark.parametrize("a", [False, True])
def test_truth_values_are_computed_with_as_in_python(a: bool, b: bool) -> None:
    assert_as_in_python(_truths, a, b)


# NumPy's types


@kernel
def _of_elements(a, b):
    x, y = a[0], b[0]
    return x + y, x - y, x * y, x & y, x < y, x == y, abs(x), min(x, y), max(x, y)


@pytest.mark.parametrize(
    ("one", "other"),
    [("int8", "int8"), ("uint8", "int8"), ("uint8", "int64"), ("int16", "uint32"),
     ("int32", "int64"), ("uint32", "int32"), ("bool", "int8"), ("bool", "uint16")],
)  # fmt: skip
def test_small_integers_are_computed_with_in_64_bits(one: str, other: str) -> None:
    for a, b in itertools.product(_extremes(one), _extremes(other)):
        found = _of_elements(np.array([a], one), np.array([b], other))
        expected = (a + b, a - b, a * b, a & b, a < b, a == b, abs(a), min(a, b), max(a, b))
        assert found == tuple(map(_signed, expected))


def _signed(number: int) -> int:
    return (number + 2**63) % 2**64 - 2**63


def _extremes(name: str) -> list[int]:
    if name == "bool":
        return [0, 1]
    info = np.iinfo(name)
    return sorted({int(info.min), -1 if info.min else 0, 0, 1, int(info.max)})


@kernel
def _unsigned(a, b):
    return (
        (a + b, a - b, a * b, a & b, a | b, a ^ b, min(a, b), max(a, b)),
        (a < b, a <= b, a == b, a != b, a >= b, a > b),
        (a >> 3, a << 3, a + 1, a * 2, a // 7, a % 7, min(9, a), a & 255, a >= 5),
    )


@given(_UNSIGNED, _UNSIGNED)
def test_integers_without_a_sign_wrap_at_64_bits(first: Any, second: Any) -> None:
    a, b = int(first), int(second)
    sums = a + b, a - b, a * b, a & b, a | b, a ^ b, min(a, b), max(a, b)
    more = a >> 3, a << 3, a + 1, a * 2, a // 7, a % 7, min(a, 9), a & 255
    relations = a < b, a <= b, a == b, a != b, a >= b, a > b
    assert _unsigned(first, second) == (
        tuple(x % 2**64 for x in sums), relations, (*(x % 2**64 for x in more), a >= 5)
    )  # fmt: skip


@given(_UNSIGNED, _UNSIGNED)
def test_integers_without_a_sign_are_divided_as_such(first: Any, second: Any) -> None:
    a, b = int(first), int(second)
    assert _divided(first, second) == ((a // b, a % b) if b else (0, 0))


@pytest.mark.parametrize("name", [*_INTEGER_NAMES, "bool", "float32", "float64"])
def test_a_float_and_another_number_have_the_type_that_numpy_gives_them(name: str) -> None:
    for kind in ("float32", "float64"):
        found = joined_floats(element_of(kind), element_of(name))  # type: ignore[arg-type]
        assert found.name == np.result_type(kind, name).name


@kernel
def _single(a, b):
    x, y = a[0], b[0]
    return np.full(1, x + y), np.full(1, x * y), np.full(1, x / y), np.full(1, min(x, y))


@pytest.mark.parametrize(
    ("one", "other"),
    [("float32", "float32"), ("float32", "int16"), ("uint8", "float32"), ("float32", "int32"),
     ("float32", "float64"), ("int64", "float32"), ("float32", "bool")],
)  # fmt: skip
def test_single_precision_stays_single_where_numpy_keeps_it(one: str, other: str) -> None:
    a, b = np.array([1 / 3], np.float64).astype(one), np.array([7]).astype(other)
    found = _single(a, b)
    expected = a + b, a * b, a / b, np.minimum(a, b)
    assert exact(found) == exact(expected)


@kernel
def _single_functions(a):
    x = a[0]
    return (
        np.full(1, math.sqrt(x)), np.full(1, -x), np.full(1, abs(x)), np.full(1, x % x),
        np.full(1, math.copysign(x, x)), np.full(1, x**2), np.full(1, x * 2), np.full(1, float(x)),
    )  # fmt: skip


def test_functions_of_single_precision_give_single_precision() -> None:
    found = _single_functions(np.array([0.1], np.float32))
    x = np.float32(0.1)
    singles = np.sqrt(x), -x, x, np.float32(0.0), x, x * x
    assert [row[0] for row in found[:6]] == list(singles)
    assert {row.dtype.name for row in found[:6]} == {"float32"}
    # A number of Python's is of 64 bits.
    assert [row.dtype.name for row in found[6:]] == ["float64", "float64"]


@kernel
def _converted(x):
    return (
        (np.int8(x), np.int16(x), np.int32(x), np.int64(x)),
        (np.uint8(x), np.uint16(x), np.uint32(x), np.uint64(x)),
    )


@given(_WHOLE)
def test_types_of_numpy_keep_the_last_bits(x: int) -> None:
    expected = [np.array(x).astype(f"{sign}{n}").item() for sign in "iu" for n in (1, 2, 4, 8)]
    signed, unsigned = _converted(x)
    assert [*signed, *unsigned] == expected


@kernel
def _to_floats(x):
    return np.float32(x), np.float64(x), float(np.float32(x))


@given(st.floats(-1e30, 1e30))
def test_a_float_is_rounded_to_single_precision(x: float) -> None:
    assert _to_floats(x) == (float(np.float32(x)), x, float(np.float32(x)))


@kernel
def _mixed(a, b):
    return a + b


def test_a_uint64_and_an_integer_with_a_sign_have_no_type_in_common() -> None:
    line = _mixed.source.function.__code__.co_firstlineno + 2
    with pytest.raises(TypeError) as error:
        _mixed(np.uint64(1), -1)
    assert str(error.value) == (
        f"kernel {__file__}:{line}:5: a uint64 and an integer with a sign have no type in common"
    )


@kernel
def _with_truth(a, b):
    return a + b, a - b, a * b, a & b, max(a, b), a >= b


@given(_UNSIGNED, st.booleans())
def test_a_truth_value_has_no_sign(first: Any, b: bool) -> None:
    a = int(first)
    expected = a + b, a - b, a * b, a & b, max(a, b), a >= b
    assert _with_truth(first, b) == tuple(x % 2**64 for x in expected)


@kernel
def _bits_of_floats(a, b):
    return a & b


def test_floats_have_no_bits() -> None:
    line = _bits_of_floats.source.function.__code__.co_firstlineno + 2
    with pytest.raises(TypeError) as error:
        _bits_of_floats(1.0, 2)
    assert str(error.value) == f"kernel {__file__}:{line}:5: no operator BitAnd for floats"


@kernel
def _fast_sum(row):
    total = 0.0
    for value in range(len(row)):
        total += row[value]
    return total


_reassociated = kernel(flags="nsz reassoc")(_fast_sum.source.function)


@given(st.lists(st.integers(-1000, 1000)))
def test_flags_change_only_the_rounding(numbers: list[int]) -> None:
    row = np.array(numbers, float)
    assert _reassociated(row) == _fast_sum(row) == operator.add(0.0, sum(numbers))
