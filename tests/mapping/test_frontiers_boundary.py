"""Polygons around what is to be explored."""

from __future__ import annotations

import numpy as np
import pytest

from gazelle.mapping.frontiers import are_inside, perimeter_m

L_SHAPE = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]


def test_points_of_a_hollow_are_outside() -> None:
    points = [(0.5, 0.5), (1.5, 0.5), (0.5, 1.5), (1.5, 1.5), (-0.1, 0.5), (0.5, 2.1)]
    assert are_inside(points, L_SHAPE).tolist() == [True, True, True, False, False, False]


@pytest.mark.parametrize("turned", [0, 1, 4])
def test_it_does_not_matter_where_or_which_way_the_outline_begins(turned: int) -> None:
    points = np.random.default_rng(turned).uniform(-1, 3, (500, 2))
    inside = are_inside(points, L_SHAPE)
    assert 0 < inside.sum() < len(points)
    assert (are_inside(points, np.roll(L_SHAPE, turned, axis=0)) == inside).all()
    assert (are_inside(points, L_SHAPE[::-1]) == inside).all()


def test_fewer_than_three_corners_hold_nothing() -> None:
    for corners in ([], [(0, 0)], [(0, 0), (1, 1)]):
        assert not are_inside([(0.5, 0.5)], corners).any()


def test_perimeter() -> None:
    assert perimeter_m(L_SHAPE) == pytest.approx(8.0)
    assert perimeter_m([]) == 0.0
