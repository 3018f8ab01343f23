from __future__ import annotations

import numpy as np
import pytest

from gazelle.diagnostics import Diagnostics
from gazelle.geometry import MeshError, load_mesh, load_mesh_reported

OBJ = """# a square
mtllib a.mtl
o plate
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vn 0 0 2
usemtl red
f 1/1/1 2/2/1 3/3/1 4/4/1
g other
usemtl photo
f -4 -3 -2
"""
MTL = """newmtl red
Ka 0.1 0.1 0.1
Kd 1 0 0
Ks 0.5 0.5 0.5
Ke 0 0 0.2
Ns 30
d 0.5
newmtl photo
Kd 1 1 1
Tr 0.25
map_Kd -s 1 1 1 p.png
"""


def test_groups_materials_and_texture_coordinates_are_read(write, assert_well_formed):
    write("a.mtl", MTL)
    picture = write("p.png", b"png")
    mesh = load_mesh(write("a.obj", OBJ))
    assert mesh.submesh_names == ("plate", "other")
    plate, other = mesh.parts
    for part in mesh.parts:
        assert_well_formed(part)
    assert (len(plate.vertices_m), len(plate.faces)) == (4, 2)
    np.testing.assert_array_equal(plate.uv, plate.vertices_m[:, :2])
    material = plate.material
    assert (material.name, material.diffuse, material.ambient) == (
        "red",
        (1, 0, 0, 0.5),
        (0.1, 0.1, 0.1, 1),
    )
    assert (material.specular, material.emissive) == ((0.5, 0.5, 0.5, 1), (0, 0, 0.2, 1))
    assert material.shininess == 30
    assert (other.uv, other.material.texture) == (None, picture)
    assert other.material.diffuse == (1, 1, 1, 0.75)
    assert mesh.notes == ()


def test_a_missing_library_and_texture_are_told(write):
    diagnostics = Diagnostics()
    load_mesh_reported(write("a.obj", OBJ), diagnostics)
    (found,) = diagnostics.by_code("mesh.missing-material")
    assert "material library 'a.mtl' not found" in found.message
    write("b/a.mtl", MTL)
    load_mesh_reported(write("b/a.obj", OBJ), diagnostics)
    (texture,) = diagnostics.by_code("mesh.missing-texture")
    assert "texture 'p.png' not found" in texture.message


def test_an_unknown_material_and_statement_are_told(write):
    write("a.mtl", "newmtl blue\nKd 1 x\n")
    mesh = load_mesh(write("a.obj", OBJ + "curv 0 1 2\n"))
    texts = [note.message for note in mesh.notes]
    assert "material 'red' is in no library" in texts
    assert any("'a.mtl' line 2: 'Kd 1 x' cannot be understood" in text for text in texts)
    assert any("'curv' is not supported" in text for text in texts)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("v 0 0 0\n", "the OBJ has no faces"),
        ("v 0 x 0\n", "line 1: 'v 0 x 0': could not convert"),
        ("v 0 0 0\nf 1 2 3\n", "line 2: 'f 1 2 3': index 2 is outside the 1 vertices so far"),
        ("v 0 0 0\nf 1 1\n", "line 2: 'f 1 1': a face needs at least three corners"),
        ("v 0 0\n", "line 1: 'v 0 0': three numbers are needed"),
        ("v 0 0 nan\nv 1 0 0\nv 1 1 0\nf 1 2 3\n", "not a finite number"),
    ],
)
def test_a_broken_file_says_what_and_where(write, text, reason):
    with pytest.raises(MeshError) as caught:
        load_mesh(write("b.obj", text))
    assert reason in str(caught.value)


@pytest.mark.reference
def test_trimesh_reads_the_same(write, tmp_path):
    trimesh = pytest.importorskip("trimesh")
    theirs = trimesh.creation.icosphere(subdivisions=2)
    theirs.export(tmp_path / "s.obj")
    ours = load_mesh(tmp_path / "s.obj")
    assert len(ours.faces) == len(theirs.faces)
    np.testing.assert_allclose(ours.bounds_m, theirs.bounds, atol=1e-7)
