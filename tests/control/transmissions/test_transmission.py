from __future__ import annotations

import numpy as np
import pytest

from gazelle.control.transmissions import (
    Transmission,
    differential_transmission,
    four_bar_linkage_transmission,
    simple_transmission,
)

TRANSMISSIONS = {
    "simple": simple_transmission(-50.0, 0.3),
    "differential": differential_transmission((30.0, -20.0), (2.0, 0.5), (0.1, -0.2)),
    "four bar linkage": four_bar_linkage_transmission((30.0, -20.0), (2.0, 0.5), (0.1, -0.2)),
}
each = pytest.mark.parametrize("transmission", TRANSMISSIONS.values(), ids=TRANSMISSIONS)


def sample(transmission: Transmission, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).normal(size=len(transmission.offsets))


@each
def test_power_is_the_same_on_both_sides(transmission: Transmission) -> None:
    for seed in range(20):
        efforts, speeds = sample(transmission, seed), sample(transmission, seed + 100)
        joints = transmission.joint_efforts(efforts) @ transmission.joint_velocities(speeds)
        assert joints == pytest.approx(efforts @ speeds, rel=1e-12)


@each
def test_there_and_back_changes_nothing(transmission: Transmission) -> None:
    values = sample(transmission, 1)
    for kind in ("positions", "velocities", "efforts"):
        joints = getattr(transmission, f"joint_{kind}")(values)
        back = getattr(transmission, f"actuator_{kind}")(joints)
        assert back == pytest.approx(values, rel=1e-12), kind


@each
def test_velocities_are_the_rates_of_positions(transmission: Transmission) -> None:
    start, speed, h = sample(transmission, 2), sample(transmission, 3), 1e-3
    moved = transmission.joint_positions(start + h * speed) - transmission.joint_positions(start)
    assert moved / h == pytest.approx(transmission.joint_velocities(speed), rel=1e-9)


def test_simple_transmission_divides_speed_and_multiplies_effort_by_its_reduction() -> None:
    gear = simple_transmission(50.0, offset=0.5)
    assert gear.joint_positions(np.array([100.0])) == pytest.approx([2.5])
    assert gear.joint_velocities(np.array([100.0])) == pytest.approx([2.0])
    assert gear.joint_efforts(np.array([0.1])) == pytest.approx([5.0])


def test_differential_moves_joint_1_by_the_sum_and_joint_2_by_the_difference() -> None:
    # The formulas of transmission_interface, differential_transmission.h.
    a1, a2, j1, j2 = 30.0, 20.0, 2.0, 0.5
    gear = differential_transmission((a1, a2), (j1, j2), (0.1, 0.2))
    x1, x2 = 7.0, 3.0
    expected = [(x1 / a1 + x2 / a2) / (2 * j1), (x1 / a1 - x2 / a2) / (2 * j2)]
    assert gear.joint_velocities(np.array([x1, x2])) == pytest.approx(expected)
    positions = gear.joint_positions(np.array([x1, x2]))
    assert positions == pytest.approx([expected[0] + 0.1, expected[1] + 0.2])
    efforts = [j1 * (x1 * a1 + x2 * a2), j2 * (x1 * a1 - x2 * a2)]
    assert gear.joint_efforts(np.array([x1, x2])) == pytest.approx(efforts)


def test_four_bar_linkage_moves_joint_2_relative_to_joint_1() -> None:
    # The velocities of transmission_interface, four_bar_linkage_transmission.h.
    a1, a2, j1, j2 = 30.0, 20.0, 2.0, 0.5
    gear = four_bar_linkage_transmission((a1, a2), (j1, j2))
    x1, x2 = 7.0, 3.0
    first = x1 / (j1 * a1)
    expected = [first, (x2 / a2 - first) / j2]
    assert gear.joint_velocities(np.array([x1, x2])) == pytest.approx(expected)


def test_a_reduction_of_zero_is_refused() -> None:
    with pytest.raises(ValueError, match="a reduction of 0 transmits nothing"):
        simple_transmission(0.0)
    with pytest.raises(ValueError, match="reduction of 0"):
        differential_transmission((1.0, 0.0))
