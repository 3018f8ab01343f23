""""""

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
    heightmap_mesh,
    is_closed,
    mesh_area_m2,
    mesh_volume_m3,
    plane_mesh,
    polyline_mesh,
    sphere_mesh,
)

SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4)]

L_SHAPE = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]


def inner(x0, y0, x1, y1):
    return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]


@pytest.mark.parametrize(
    ("outlines", "area"),
    [
        ([SQUARE], 16),
        ([SQUARE[::-1]], 16),
        ([[*SQUARE, SQUARE[0]]], 16),
        ([L_SHAPE], 5),
        ([SQUARE, inner(1, 1, 2, 2)], 15),
        ([SQUARE, inner(0.5, 0.5, 1.5, 1.5), inner(2.5, 0.5, 3.5, 3.5)[::-1]], 12),
        ([SQUARE, inner(1, 1, 3, 3), inner(1.5, 1.5, 2.5, 2.5)], 13),
        ([SQUARE, inner(6, 0, 7, 1)], 17),
    ],
)
def test_outlines_become_closed_solids(outlines, area, assert_well_formed):
    part = polyline_mesh(outlines, 2.0)
    assert_well_formed(part)
    assert is_closed(part)
    assert mesh_volume_m3(part) == pytest.approx(2 * area)
    assert part.vertices_m[:, 2].tolist().count(0) == part.vertices_m[:, 2].tolist().count(2)


def test_a_star_with_many_teeth_is_cut_right():
    angle = np.linspace(0, 2 * np.pi, 80, endpoint=False)
    radius = np.where(np.arange(80) % 2, 1.0, 3.0)
    star = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    x, y = star.T
    area = abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2
    assert mesh_volume_m3(polyline_mesh([star], 1.0)) == pytest.approx(area)


@pytest.mark.parametrize(
    ("outlines", "height", "reason"),
    [
        ([], 1.0, "at least three different points"),
        ([[(0, 0), (1, 1), (1, 1)]], 1.0, "at least three different points"),
        ([SQUARE], 0.0, "height must be positive, found 0"),
    ],
)
def test_impossible_outlines_say_why(outlines, height, reason):
    with pytest.raises(ValueError, match=reason):
        polyline_mesh(outlines, height)


def test_a_heightmap_spans_its_size_with_the_picture_upright(assert_well_formed):
    heights = np.zeros((3, 5))
    heights[0, 4] = 1.0
    part = heightmap_mesh(heights, (8.0, 4.0, 2.0), (1.0, 0.0, 0.5))
    assert_well_formed(part)
    assert len(part.faces) == 16
    peak = part.vertices_m[np.argmax(part.vertices_m[:, 2])]
    assert peak.tolist() == [5, 2, 2.5]
    np.testing.assert_allclose(part.uv[np.argmax(part.vertices_m[:, 2])], (1, 1))


def test_flat_ground_has_upright_normals_and_its_area():
    part = heightmap_mesh(np.full((4, 4), 0.5), (3, 3, 1))
    np.testing.assert_allclose(part.normals, [(0, 0, 1)] * 16, atol=1e-12)
    assert mesh_area_m2(part) == pytest.approx(9)


def test_too_small_a_picture_says_so():
    with pytest.raises(ValueError, match="at least 2 x 2 heights, found 1 x 4"):
        heightmap_mesh(np.zeros((1, 4)), (1, 1, 1))


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
