from __future__ import annotations

import numpy as np
import pytest

from gazelle.geometry import Mesh, box_mesh, mesh_volume_m3, sphere_mesh


@pytest.fixture
def pair() -> Mesh:
    shift = np.eye(4)
    shift[:3, 3] = (10, 0, 0)
    return Mesh((box_mesh((1, 2, 3)), sphere_mesh(1.0).transformed(shift)))


def test_parts_merge_into_one_indexed_mesh(pair):
    assert len(pair.faces) == sum(len(part.faces) for part in pair.parts)
    assert pair.faces.dtype == np.int32
    assert mesh_volume_m3(pair) == pytest.approx(sum(map(mesh_volume_m3, pair.parts)))
    np.testing.assert_allclose(pair.bounds_m, [(-0.5, -1, -1.5), (11, 1, 1.5)])


def test_scaling_keeps_normals_upright(pair, assert_well_formed):
    scaled = pair.scaled((2.0, 0.5, 1.0))
    np.testing.assert_allclose(scaled.bounds_m, [(-1, -0.5, -1.5), (22, 0.5, 1.5)])
    for part in scaled.parts:
        assert_well_formed(part)
    assert pair.scaled((1, 1, 1)) is pair


def test_mirroring_keeps_the_outside_outside(pair, assert_well_formed):
    mirrored = pair.scaled((-1.0, 1.0, 1.0))
    assert mesh_volume_m3(mirrored) == pytest.approx(mesh_volume_m3(pair))
    for part in mirrored.parts:
        assert_well_formed(part)


def test_submeshes_are_chosen_by_name_and_centred(pair):
    assert pair.submesh_names == ("box", "sphere")
    assert pair.submesh("cone") is None
    chosen = pair.submesh("sphere")
    assert chosen.bounds_m[0][0] == pytest.approx(9)
    centred = pair.submesh("sphere", center=True)
    np.testing.assert_allclose(centred.bounds_m, [(-1, -1, -1), (1, 1, 1)], atol=1e-12)
