from __future__ import annotations

import numpy as np
import pytest

from gazelle.geometry import Mesh, box_mesh, is_closed, mesh_volume_m3, polyline_mesh, sphere_mesh
from gazelle.geometry.building import part_from_soup
from gazelle.geometry.convex import _welded
from gazelle.geometry.decimation import decimated


def _finer(mesh: Mesh, times: int) -> Mesh:
    """Split every triangle into four, a number of times; the surface stays."""
    corners = mesh.vertices_m[mesh.faces]
    for _ in range(times):
        a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
        ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
        four = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        corners = np.concatenate([np.stack(one, axis=1) for one in four])
    return Mesh((part_from_soup(corners, name="fine"),))


def _decimated(mesh: Mesh, most_faces: int, tolerance_ratio: float = 0.01) -> Mesh:
    vertices, faces = decimated(
        *_welded(mesh), most_faces=most_faces, tolerance_ratio=tolerance_ratio
    )
    return Mesh((part_from_soup(vertices[faces], name="fewer"),))


def test_a_box_of_many_triangles_keeps_its_corners_and_volume():
    box = _finer(Mesh((box_mesh((1, 2, 3)),)), 4)
    fewer = _decimated(box, 400)
    assert len(box.faces) == 12 * 4**4
    assert len(fewer.faces) <= 400
    assert is_closed(fewer)
    assert mesh_volume_m3(fewer) == pytest.approx(6.0, rel=1e-3)
    np.testing.assert_allclose(np.ptp(fewer.vertices_m, axis=0), (1, 2, 3), rtol=1e-3)


def test_a_hollow_stays_hollow():
    outline = [(0, 0), (4, 0), (4, 3), (3, 3), (3, 1), (1, 1), (1, 3), (0, 3)]
    bracket = _finer(Mesh((polyline_mesh([outline], 1.0),)), 4)
    fewer = _decimated(bracket, 200)
    assert len(fewer.faces) <= 200
    assert is_closed(fewer)
    assert mesh_volume_m3(fewer) == pytest.approx(8.0, rel=1e-2)


def test_the_tolerance_counts_more_than_the_aim():
    ball = Mesh((sphere_mesh(1.0),))
    rough, fine = _decimated(ball, 20, 0.1), _decimated(ball, 20, 1e-4)
    assert len(rough.faces) < len(fine.faces)
    assert mesh_volume_m3(fine) == pytest.approx(mesh_volume_m3(ball), rel=0.01)


def test_equal_surfaces_get_equal_results_and_the_given_one_is_not_changed():
    vertices, faces = _welded(_finer(Mesh((box_mesh((1, 2, 3)),)), 3))
    kept = vertices.copy(), faces.copy()
    first = decimated(vertices, faces, most_faces=50, tolerance_ratio=0.01)
    second = decimated(vertices, faces, most_faces=50, tolerance_ratio=0.01)
    for one, other in zip((*first, *kept), (*second, vertices, faces), strict=True):
        np.testing.assert_array_equal(one, other)


def test_few_triangles_are_left_as_they_are():
    vertices, faces = _welded(Mesh((box_mesh((1, 2, 3)),)))
    same = decimated(vertices, faces, most_faces=12, tolerance_ratio=0.01)
    np.testing.assert_array_equal(same[0], vertices)
    np.testing.assert_array_equal(same[1], faces)
