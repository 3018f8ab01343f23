"""Numbers and turns of urdfdom."""

from __future__ import annotations

import math

import pytest

from gazelle.description.urdfdom_emulation.values import (
    BadValueError,
    check_colour,
    number_of,
    quaternion_from_rpy,
    rpy_from_quaternion,
    vector_of,
)


@pytest.mark.parametrize(
    ("text", "value"),
    [("1", 1.0), (" +.5", 0.5), ("\n-2.", -2.0), ("1e-3", 1e-3), ("1e-999", 0.0)],
)
def test_numbers_of_a_stream(text: str, value: float) -> None:
    assert number_of(text) == value


@pytest.mark.parametrize("text", ["", "1 ", "1.5kg", "nan", "inf", "0x10", "1e", "1_0", "1e999"])
def test_no_numbers_of_a_stream(text: str) -> None:
    with pytest.raises(BadValueError):
        number_of(text)


def test_only_spaces_part_a_vector() -> None:
    assert vector_of("  1  2 3 ") == (1.0, 2.0, 3.0)
    with pytest.raises(BadValueError, match=r"component \[2\t3\] to a double"):
        vector_of("1 2\t3")
    with pytest.raises(BadValueError, match=r"found 2 elements but 3 expected .* \[1 2\]"):
        vector_of("1 2")


def test_colours_are_judged_by_range_only() -> None:
    check_colour("1 0.5")
    for text in ("1 2", "red", "-0.1 0 0 1"):
        with pytest.raises(BadValueError, match="while parsing a color value"):
            check_colour(text)


@pytest.mark.parametrize("rpy", [(0.0, 0.0, 0.0), (0.1, 0.2, 0.3), (-3.0, 1.5, 3.1)])
def test_turns_come_back(rpy: tuple[float, float, float]) -> None:
    assert rpy_from_quaternion(quaternion_from_rpy(rpy)) == pytest.approx(rpy)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_at_the_pole_yaw_takes_all(sign: float) -> None:
    roll, pitch, yaw = rpy_from_quaternion(quaternion_from_rpy((0.0, sign * math.pi / 2, 0.4)))
    assert (roll, pitch) == (0.0, sign * math.pi / 2)
    assert yaw == pytest.approx(0.4) or math.isclose(abs(yaw - 0.4), 2 * math.pi)
