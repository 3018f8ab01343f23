"""Costs near obstacles."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.ndimage import distance_transform_edt

from gazelle.navigation.costmap import (
    CostGrid,
    Footprint,
    InflationOptions,
    inflated,
    inflation_costs,
    occupancy_of_costs,
)

_ROUND = Footprint.of_radius(0.2)


def test_costs_follow_the_formula_of_inflation_layer() -> None:
    options = InflationOptions(inflation_radius=1.0, cost_scaling_factor=3.0)
    costs = inflation_costs(options, 0.2, 0.1)
    assert costs[0] == 254
    assert costs[1] == costs[4] == 253
    assert costs[25] == int(252 * math.exp(-3.0 * (0.5 - 0.2)))
    assert len(costs) == 101


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_every_cell_has_the_cost_of_its_distance(seed: int) -> None:
    rng = np.random.default_rng(seed)
    lethal = rng.random((60, 80)) < 0.01
    options = InflationOptions(inflation_radius=0.7, cost_scaling_factor=2.0)
    grid = inflated(CostGrid(np.where(lethal, 254, 0).astype(np.uint8), 0.05), options, _ROUND)
    squares = np.rint(distance_transform_edt(~lethal) ** 2).astype(int)
    table = inflation_costs(options, _ROUND.inscribed_m, 0.05)
    want = np.where(squares < len(table), table[squares.clip(0, len(table) - 1)], 0)
    np.testing.assert_array_equal(grid.costs, want)


def test_higher_costs_stay() -> None:
    costs = np.full((9, 9), 150, np.uint8)
    costs[4, 4] = 254
    options = InflationOptions(inflation_radius=2.0, cost_scaling_factor=50.0)
    grid = inflated(CostGrid(costs, 0.5), options, _ROUND)
    assert (grid.costs == 150).sum() == 80


@pytest.mark.parametrize(("inflate_unknown", "far"), [(False, 255), (True, 140)])
def test_unknown_cells_take_only_what_touches(inflate_unknown: bool, far: int) -> None:
    costs = np.full((1, 12), 255, np.uint8)
    costs[0, 0] = 254
    options = InflationOptions(
        inflation_radius=0.4, cost_scaling_factor=3.0, inflate_unknown=inflate_unknown
    )
    row = inflated(CostGrid(costs, 0.1), options, _ROUND).costs[0]
    assert list(row[:2]) == [254, 253]
    assert row[4] == far or row[4] == int(252 * math.exp(-3.0 * (0.4 - _ROUND.inscribed_m)))
    assert row[5] == 255


def test_around_unknown_counts_it_as_an_obstacle() -> None:
    costs = np.zeros((1, 9), np.uint8)
    costs[0, 4] = 255
    options = InflationOptions(inflation_radius=0.3, inflate_around_unknown=True)
    row = inflated(CostGrid(costs, 0.1), options, _ROUND).costs[0]
    assert row[3] == row[5] == 253


def test_published_costs_are_those_of_the_publisher() -> None:
    costs = np.array([0, 1, 127, 252, 253, 254, 255], np.uint8)
    np.testing.assert_array_equal(occupancy_of_costs(costs), [0, 1, 49, 98, 99, 100, -1])
