"""Branch and bound against trying every pose."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from gazelle.mapping.scan_matching.branch_and_bound import WideSearch, best_of_sectors
from gazelle.mapping.scan_matching.likelihood_field import Field, field_of

TURNS: NDArray[np.float64] = np.linspace(-0.3, 0.3, 7)


@pytest.fixture(scope="module")
def points() -> NDArray[np.float64]:
    return np.random.default_rng(3).uniform(-2.0, 2.0, (300, 2))


@pytest.fixture(scope="module")
def field(points: NDArray[np.float64]) -> Field:
    """The points, moved, and others."""
    clutter = np.random.default_rng(4).uniform(-3.0, 3.0, (200, 2))
    moved = np.concatenate([points + np.array([0.43, -0.21]), clutter])
    return field_of(moved, (0.0, 0.0), 4.0, cell_m=0.1, sigma_m=0.1)


def values_at(
    field: Field, points: NDArray[np.float64], center: NDArray[np.float64], reach: int
) -> NDArray[np.float64]:
    """Return the mean value of every pose of a window, (turns, rows, columns)."""
    height, width = field.values.shape
    steps = np.arange(-reach, reach + 1)
    out = np.zeros((len(TURNS), len(steps), len(steps)))
    for t, turn in enumerate(TURNS):
        cos, sin = np.cos(center[2] + turn), np.sin(center[2] + turn)
        x = (points @ np.array([cos, -sin]) + (center[0] - field.x_m)) / field.cell_m
        y = (points @ np.array([sin, cos]) + (center[1] - field.y_m)) / field.cell_m
        column, row = np.floor(x).astype(int), np.floor(y).astype(int)
        for a, up in enumerate(steps):
            for b, right in enumerate(steps):
                c, r = column + right, row + up
                inside = (c >= 0) & (r >= 0) & (c < width) & (r < height)
                out[t, a, b] = field.values[r[inside], c[inside]].sum() / len(points)
    return out


@pytest.mark.parametrize("reach", [1, 3, 6, 9])
@pytest.mark.parametrize("center", [(0.0, 0.0, 0.0), (0.2, 0.1, 0.1), (2.4, -2.6, 0.0)])
def test_best_pose_is_that_of_trying_all(
    field: Field, points: NDArray[np.float64], reach: int, center: tuple[float, float, float]
) -> None:
    middle = np.array(center)
    values, window_m = values_at(field, points, middle, reach), (reach - 0.5) * field.cell_m
    found = WideSearch(field, points, middle, TURNS).best(window_m, least=0.05)
    t, row, column = np.unravel_index(values.argmax(), values.shape)
    assert found is not None
    assert found.value == pytest.approx(values.max(), abs=1e-6)
    shift = np.array([column - reach, row - reach]) * field.cell_m
    assert found.pose[:2] == pytest.approx(middle[:2] + shift)
    assert found.pose[2] == pytest.approx(middle[2] + TURNS[t])


def test_nothing_is_found_that_does_not_exceed_the_least(
    field: Field, points: NDArray[np.float64]
) -> None:
    center = np.zeros(3)
    most = values_at(field, points, center, 5).max()
    search = WideSearch(field, points, center, TURNS)
    assert search.best(0.45, least=most + 1e-6) is None
    assert search.best(0.45, least=most - 1e-6) is not None


@pytest.mark.parametrize("done", [1, 2, 4])
def test_window_that_was_searched_is_left_out(
    field: Field, points: NDArray[np.float64], done: int
) -> None:
    center, reach = np.zeros(3), 7
    values = values_at(field, points, center, reach)
    inner = slice(reach - done, reach + done + 1)
    values[:, inner, inner] = 0.0
    search = WideSearch(field, points, center, TURNS)
    found = search.best(0.65, least=0.05, done_m=(done - 0.5) * field.cell_m)
    assert found is not None
    assert found.value == pytest.approx(values.max(), abs=1e-6)


def test_every_sector_has_its_own_best(field: Field, points: NDArray[np.float64]) -> None:
    found = best_of_sectors(
        field, points, np.zeros(3), reach_m=0.6, reach_rad=0.9, sector_rad=0.3, least=0.0
    )
    headings = [one.pose[2] for one in found]
    assert len(found) == 6
    assert headings == sorted(headings)
    best = max(found, key=lambda one: one.value)
    assert best.pose[:2] == pytest.approx((0.43, -0.21), abs=field.cell_m)


def test_no_points_have_no_place(field: Field) -> None:
    found = best_of_sectors(
        field, np.empty((0, 2)), np.zeros(3), reach_m=1.0, reach_rad=1.0, sector_rad=0.3, least=0.1
    )
    assert found == []
