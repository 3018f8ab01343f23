"""Collisions inside each other."""

from __future__ import annotations

import numpy as np
import pytest
from tests.description.checks.pain import finding, place

from gazelle.description.checks.self_collisions import overlap_m
from gazelle.geometry import box_mesh, sphere_mesh

CUBE = box_mesh((2.0, 2.0, 2.0)).vertices_m


@pytest.mark.parametrize(
    ("shift", "depth"), [((1.5, 0, 0), 0.5), ((0, 0, 1.9), 0.1), ((1.8, 1.9, 1.7), 0.1)]
)
def test_depth_of_boxes_is_exact(shift: tuple[float, ...], depth: float) -> None:
    assert overlap_m(CUBE, CUBE + np.asarray(shift)) == pytest.approx(depth)


def test_depth_of_spheres_is_that_of_their_distance() -> None:
    ball = sphere_mesh(1.0).vertices_m
    shift = 1.9 * np.array([1.0, 2.0, 2.0]) / 3.0
    assert overlap_m(ball, ball + shift) == pytest.approx(0.1, abs=0.03)


def test_boxes_that_miss_each_other_only_along_a_diagonal_do_not_overlap() -> None:
    turned = CUBE @ np.array([[1, 1, 0], [-1, 1, 0], [0, 0, np.sqrt(2)]]) / np.sqrt(2)
    assert overlap_m(CUBE, turned + np.array([1.75, 1.75, 0.0])) == 0.0
    assert overlap_m(CUBE, turned + np.array([1.65, 1.65, 0.0])) > 0.0


def test_overlap_of_self_colliding_links_is_reported() -> None:
    item = finding("pain_15_contact/self_overlap.urdf")
    assert item.code == "robot.self-overlap"
    assert "the collisions of 'base_link' and 'box' overlap by 20 mm" in item.message
    assert place(item) == "<collision>"
    assert "remove <self_collide>" in item.fix
