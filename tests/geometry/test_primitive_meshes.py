from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.geometry import (
    box_mesh,
    capsule_mesh,
    cone_mesh,
    cylinder_mesh,
    ellipsoid_mesh,
    is_closed,
    mesh_area_m2,
    mesh_volume_m3,
    plane_mesh,
    sphere_mesh,
)

SOLIDS = [
    (box_mesh((1, 2, 3)), 6.0, (0.5, 1, 1.5)),
    (sphere_mesh(2.0), 4 / 3 * math.pi * 8, (2, 2, 2)),
    (ellipsoid_mesh((1, 2, 3)), 4 / 3 * math.pi * 6, (1, 2, 3)),
    (cylinder_mesh(1, 4), 4 * math.pi, (1, 1, 2)),
    (cone_mesh(1, 3), math.pi, (1, 1, 1.5)),
    (capsule_mesh(1, 2), 2 * math.pi + 4 / 3 * math.pi, (1, 1, 2)),
]


@pytest.mark.parametrize(
    ("part", "volume", "half"), SOLIDS, ids=[part.name for part, _, _ in SOLIDS]
)
def test_solids_are_closed_centred_and_of_right_volume(part, volume, half, assert_well_formed):
    assert_well_formed(part)
    assert is_closed(part)
    np.testing.assert_allclose(part.vertices_m.max(axis=0), half, atol=1e-9)
    np.testing.assert_allclose(part.vertices_m.min(axis=0), np.negative(half), atol=1e-9)
    assert mesh_volume_m3(part) <= volume * (1 + 1e-9)
    assert mesh_volume_m3(part) == pytest.approx(volume, rel=0.02)
    assert part.uv.min() >= -1e-12
    assert part.uv.max() <= 1 + 1e-12


def test_finer_divisions_come_nearer_to_the_sphere():
    errors = [4 / 3 * math.pi - mesh_volume_m3(sphere_mesh(1, segments=n)) for n in (16, 32, 64)]
    assert errors[0] > 3.5 * errors[1] > 12 * errors[2] > 0


def test_sphere_normals_are_radial():
    part = sphere_mesh(2.0)
    np.testing.assert_allclose(part.normals, part.vertices_m / 2, atol=1e-12)


def test_each_side_of_a_box_shows_the_picture_upright():
    part = box_mesh((2, 2, 2))
    assert (len(part.vertices_m), len(part.faces)) == (24, 12)
    side = part.normals[:, 2] == 0
    np.testing.assert_array_equal(part.uv[side, 1], (part.vertices_m[side, 2] + 1) / 2)
    top = part.normals[:, 2] == 1
    np.testing.assert_array_equal(part.uv[top], (part.vertices_m[top, :2] + 1) / 2)


@pytest.mark.parametrize("normal", [(0, 0, 1), (0, 0, -2), (1, 0, 0), (0.3, -0.4, 0.5)])
def test_a_plane_faces_its_normal(normal, assert_well_formed):
    part = plane_mesh((2, 3), normal)
    assert_well_formed(part)
    assert mesh_area_m2(part) == pytest.approx(6)
    unit = np.divide(normal, np.linalg.norm(normal))
    np.testing.assert_allclose(part.normals, [unit] * 4)
    np.testing.assert_allclose(part.vertices_m @ unit, 0, atol=1e-12)


def test_a_level_plane_has_x_along_u():
    part = plane_mesh((2, 3))
    np.testing.assert_allclose(part.vertices_m[:, :2], (part.uv - 0.5) * (2, 3), atol=1e-12)
