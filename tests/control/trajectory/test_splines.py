"""Splines against the linear equations that define them."""

from __future__ import annotations

import numpy as np
import pytest

from gazelle.control.trajectory.splines import JointState, PieceSampler, quintic, stacked

RNG = np.random.default_rng(7)


def by_equations(start: list[float], end: list[float], duration_s: float) -> np.ndarray:
    """Return coefficients of the polynomial with given derivatives at both ends."""
    order = 2 * len(start)
    rows, values = [], []
    for time, given in ((0.0, start), (duration_s, end)):
        for derivative, value in enumerate(given):
            row = np.zeros(order)
            for power in range(derivative, order):
                factor = np.prod(np.arange(power - derivative + 1, power + 1))
                row[power] = factor * time ** (power - derivative)
            rows.append(row)
            values.append(value)
    return np.linalg.solve(np.array(rows), np.array(values))


def state(orders: int, values: np.ndarray) -> JointState:
    rows = [values[k] if k < orders else None for k in range(3)]
    return JointState(*rows)


@pytest.mark.parametrize("orders", [1, 2, 3])
@pytest.mark.parametrize("duration_s", [0.004, 0.7, 3.0, 20.0])
def test_splines_equal_the_published_formulas(orders: int, duration_s: float) -> None:
    a, b = RNG.uniform(-2, 2, (2, 3, 5))
    pieces = stacked(quintic(state(orders, a), state(orders, b), duration_s))
    sampler = PieceSampler(5)
    for time_s in np.linspace(0.0, duration_s, 23):
        sampler.sample(pieces, float(time_s))
        for joint in range(5):
            polynomial = np.polynomial.Polynomial(
                by_equations(list(a[:orders, joint]), list(b[:orders, joint]), duration_s)
            )
            for derivative in range(3):
                scale = max(1.0, duration_s**-derivative * 10)
                expected = (
                    polynomial.deriv(derivative)(time_s) if derivative else polynomial(time_s)
                )
                assert sampler.state[derivative, joint] == pytest.approx(expected, abs=1e-9 * scale)


@pytest.mark.parametrize(
    ("first", "second", "expected"), [(1, 3, 1), (3, 1, 1), (2, 3, 2), (3, 2, 2)]
)
def test_the_lower_order_of_two_waypoints_counts(first: int, second: int, expected: int) -> None:
    a, b = RNG.uniform(-1, 1, (2, 3, 2))
    mixed = quintic(state(first, a), state(second, b), 1.5)
    np.testing.assert_array_equal(mixed, quintic(state(expected, a), state(expected, b), 1.5))


def test_accelerations_without_velocities_give_a_line() -> None:
    a = JointState(np.zeros(1), None, np.ones(1))
    b = JointState(np.ones(1), None, np.ones(1))
    np.testing.assert_array_equal(quintic(a, b, 2.0)[:, 0], [0, 0.5, 0, 0, 0, 0])


@pytest.mark.parametrize("orders", [1, 2, 3])
def test_no_duration_gives_value_and_slope_of_the_start(orders: int) -> None:
    a, b = RNG.uniform(-1, 1, (2, 3, 2))
    coefficients = quintic(state(orders, a), state(orders, b), 0.0)
    slopes = a[1] if orders > 1 else np.zeros(2)
    bends = 0.5 * a[2] if orders > 2 else np.zeros(2)
    np.testing.assert_array_equal(coefficients[:3], [a[0], slopes, bends])
    assert not coefficients[3:].any()
