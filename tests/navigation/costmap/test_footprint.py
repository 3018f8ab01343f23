"""Outlines of robots and the costs under them."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.navigation.costmap import CostGrid, Footprint, footprint_cost

_BURGER = [[-0.105, -0.105], [-0.105, 0.105], [0.041, 0.105], [0.041, -0.105]]


def _grid(cells: int = 40) -> CostGrid:
    return CostGrid(np.zeros((cells, cells), np.uint8), 0.05, (-1.0, -1.0))


def test_radii_of_the_turtlebot3_burger() -> None:
    footprint = Footprint.parse(_BURGER)
    assert footprint.inscribed_m == pytest.approx(0.041)
    assert footprint.circumscribed_m == pytest.approx(math.hypot(0.105, 0.105))


def test_padding_moves_corners_outwards() -> None:
    padded = Footprint.parse("[[1, 1], [-1, 1], [0, -1]]").padded(0.1)
    assert padded.corners == ((1.1, 1.1), (-1.1, 1.1), (0.0, -1.1))


def test_round_robots_have_16_corners() -> None:
    footprint = Footprint.of_radius(0.2)
    assert len(footprint.corners) == 16
    assert footprint.circumscribed_m == pytest.approx(0.2)
    assert footprint.inscribed_m == pytest.approx(0.2 * math.cos(math.pi / 16))


@pytest.mark.parametrize(
    ("value", "says"),
    [
        ("[[1, 1], [2, 2]]", "at least 3 corners, this has 2"),
        ("[[1, 1], [2], [3, 3]]", r"a corner of a footprint is \[x, y\], not \[2\]"),
        ("[[1, 1", "is not"),
        (5, "5 is not"),
        ([[0, 0], [1, 0], [0, float("nan")]], "is finite"),
    ],
)
def test_what_is_no_footprint_is_told(value: object, says: str) -> None:
    with pytest.raises(ValueError, match=says):
        Footprint.parse(value)


def test_corners_turn_with_the_robot() -> None:
    corners = Footprint.parse("[[1, 0], [0, 1], [-1, 0]]").at((2.0, 3.0, math.pi / 2))
    np.testing.assert_allclose(corners, [[2, 4], [1, 3], [2, 2]], atol=1e-12)


def test_cost_is_the_highest_under_centre_and_outline() -> None:
    grid, footprint = (
        _grid(),
        Footprint.parse("[[0.3, 0.3], [-0.3, 0.3], [-0.3, -0.3], [0.3, -0.3]]"),
    )
    assert footprint_cost(grid, footprint, (0.0, 0.0, 0.0)) == 0
    grid.costs[20, 20] = 30
    assert footprint_cost(grid, footprint, (0.01, 0.01, 0.0)) == 30
    grid.costs[20, 26] = 200
    assert footprint_cost(grid, footprint, (0.01, 0.01, 0.0)) == 200
    # Turned by 45° the outline goes elsewhere.
    assert footprint_cost(grid, footprint, (0.01, 0.01, math.pi / 4)) == 30


@pytest.mark.parametrize(("cost", "verdict"), [(254, -1), (255, -2), (253, 253)])
def test_lethal_and_unknown_cells_are_told_apart(cost: int, verdict: int) -> None:
    grid = _grid()
    grid.costs[:, 24] = cost
    assert footprint_cost(grid, Footprint.of_radius(0.3), (0.0, 0.0, 0.0)) == verdict


def test_outside_of_the_grid_is_no_place() -> None:
    footprint = Footprint.of_radius(0.3)
    assert footprint_cost(_grid(), footprint, (5.0, 0.0, 0.0)) == -3
    assert footprint_cost(_grid(), footprint, (0.9, 0.0, 0.0)) == -3
