"""Made surfaces are closed, face outwards and lie where the shapes do."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.sensors.tessellation import (
    SIDES,
    unit_box,
    unit_cone,
    unit_cylinder,
    unit_plane,
    unit_tube,
)

ALL = (unit_box, unit_cone, unit_cylinder, unit_plane, unit_tube)


@pytest.mark.parametrize("make", ALL)
def test_faces_turn_the_way_their_normals_point(make) -> None:
    facets = make()
    a, b, c = (facets.vertices[facets.faces[:, corner]] for corner in range(3))
    across = np.cross(b - a, c - a)
    meant = facets.normals[facets.faces].sum(axis=1)
    assert (np.einsum("ij,ij->i", across, meant) > 0).all()


@pytest.mark.parametrize("make", ALL)
def test_normals_have_unit_length_and_uv_stay_within_the_picture(make) -> None:
    facets = make()
    assert np.allclose(np.linalg.norm(facets.normals, axis=1), 1, atol=1e-6)
    assert facets.uv.min() >= -1e-5
    assert facets.uv.max() <= 1 + 1e-5


def test_cylinder_lies_within_the_stated_bound_of_its_radius() -> None:
    tube = unit_tube()
    bound = (math.pi / SIDES) ** 2 / 4 * 1.01 + 1e-7
    corners = np.linalg.norm(tube.vertices[:, :2], axis=1)
    middles = np.linalg.norm(
        (tube.vertices[:SIDES, :2] + tube.vertices[1 : SIDES + 1, :2]) / 2, axis=1
    )
    assert np.abs(corners - 1).max() < bound
    assert np.abs(middles - 1).max() < bound


@pytest.mark.parametrize(
    ("make", "volume"), [(unit_box, 1.0), (unit_cylinder, math.pi), (unit_cone, math.pi / 3)]
)
def test_closed_surfaces_hold_the_volume_of_the_shape(make, volume) -> None:
    facets = make()
    a, b, c = (facets.vertices[facets.faces[:, corner]].astype(float) for corner in range(3))
    assert np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6 == pytest.approx(volume, rel=1e-4)
