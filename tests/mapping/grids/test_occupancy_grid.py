"""Cells and metres."""

from __future__ import annotations

import numpy as np
import pytest

from gazelle.mapping.grids import OccupancyGrid


def _grid(origin: tuple[float, float, float] = (-1.0, 2.0, 0.0)) -> OccupancyGrid:
    return OccupancyGrid(np.zeros((4, 6), np.int8), 0.5, origin)


def test_lower_left_corner_is_in_cell_0_0() -> None:
    np.testing.assert_array_equal(_grid().world_to_cell(-0.99, 2.01), (0, 0))
    np.testing.assert_array_equal(_grid().world_to_cell(-1.01, 2.01), (-1, 0))


def test_centre_of_a_cell_is_half_a_cell_from_its_corner() -> None:
    np.testing.assert_array_equal(_grid().cell_to_world(0, 0), (-0.75, 2.25))


@pytest.mark.parametrize("yaw", [0.0, 0.7, -2.0])
def test_cells_come_back_from_their_centres(yaw: float) -> None:
    grid = _grid((-1.0, 2.0, yaw))
    columns, rows = np.meshgrid(np.arange(6), np.arange(4))
    back = grid.world_to_cell(*grid.cell_to_world(columns, rows))
    np.testing.assert_array_equal(back, (columns, rows))


def test_contains_knows_the_edges() -> None:
    np.testing.assert_array_equal(
        _grid().contains([-1, 0, 5, 6, 0], [0, 0, 3, 0, 4]), [False, True, True, False, False]
    )


@pytest.mark.parametrize("resolution", [0.0, -0.05, float("nan")])
def test_resolution_is_above_0(resolution: float) -> None:
    with pytest.raises(ValueError, match="must be above 0"):
        OccupancyGrid(np.zeros((1, 1), np.int8), resolution)


def test_cells_are_int8_in_two_dimensions() -> None:
    with pytest.raises(ValueError, match="int8"):
        OccupancyGrid(np.zeros((1, 1)), 0.05)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="finite"):
        OccupancyGrid(np.zeros((1, 1), np.int8), 0.05, (0.0, float("inf"), 0.0))
