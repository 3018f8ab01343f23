from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests.shared_files import SHARED

from gazelle.geometry import MeshError, load_mesh, mesh_volume_m3

ASCII = """solid a vertex in the name
  facet normal 0 0 0
    outer loop
      vertex 0 0 0
      vertex 1 0 0
      vertex 0 1e0 0
    endloop
  endfacet
endsolid a
"""


def test_a_binary_box_is_read_with_flat_normals(write, binary_stl, assert_well_formed):
    mesh = load_mesh(write("box.stl", binary_stl()))
    (part,) = mesh.parts
    assert_well_formed(part)
    assert (len(part.vertices_m), len(part.faces)) == (24, 12)
    assert mesh.bounds_m == ((-0.5, -1.0, -1.5), (0.5, 1.0, 1.5))
    assert mesh_volume_m3(mesh) == pytest.approx(6)
    assert set(np.abs(part.normals).max(axis=1)) == {1.0}


def test_a_binary_file_that_starts_with_solid_is_binary(write, binary_stl):
    path = write("box.stl", binary_stl(header=b"solid exported by a modeller"))
    assert len(load_mesh(path).faces) == 12


def test_an_ascii_file_is_read(write, assert_well_formed):
    (part,) = load_mesh(write("a.STL", ASCII)).parts
    assert_well_formed(part)
    assert part.normals.tolist() == [[0, 0, 1]] * 3
    assert part.vertices_m[part.faces[0]].tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]


def test_ascii_and_binary_give_the_same(write, binary_stl, box_corners):
    lines = ["solid box"]
    for triangle in box_corners:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += [f"vertex {x:.9g} {y:.9g} {z:.9g}" for x, y, z in triangle]
        lines += ["endloop", "endfacet"]
    text = load_mesh(write("a.stl", "\n".join([*lines, "endsolid box", ""])))
    binary = load_mesh(write("b.stl", binary_stl()))
    np.testing.assert_array_equal(text.vertices_m, binary.vertices_m)
    np.testing.assert_array_equal(text.faces, binary.faces)


def test_a_curved_surface_is_smooth_and_its_edge_sharp(write, binary_stl):
    from gazelle.geometry import cylinder_mesh

    made = cylinder_mesh(1.0, 2.0)
    path = write("c.stl", binary_stl(corners=made.vertices_m[made.faces]))
    (part,) = load_mesh(path).parts
    side = np.abs(part.normals[:, 2]) < 0.5
    radial = part.vertices_m[side] * (1, 1, 0)
    np.testing.assert_allclose(part.normals[side], radial, atol=0.05)
    assert np.allclose(np.abs(part.normals[~side, 2]), 1)
    assert len(part.vertices_m) <= 4 * 33


def test_a_truncated_binary_says_what_was_promised_and_found(write, binary_stl):
    path = write("t.stl", binary_stl()[:-60])
    with pytest.raises(MeshError) as caught:
        load_mesh(path)
    assert str(caught.value) == (
        f"mesh '{path}': truncated binary STL: the header promises 12 triangles (684 bytes), "
        "the file holds 10 (624 bytes)"
    )


def test_bytes_after_the_last_triangle_are_told(write, binary_stl):
    mesh = load_mesh(write("e.stl", binary_stl() + b"xyz"))
    assert len(mesh.faces) == 12
    (note,) = mesh.notes
    assert note.code == "mesh.extra-bytes"
    assert "3 bytes after the last of 12 triangles" in note.message


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (b"", "the file is empty"),
        (b"\0" * 83, "83 bytes are too few for an STL file"),
        (b"\0" * 84, "the STL has no triangles"),
        (ASCII[:-12].encode(), "'endsolid' is missing after 1 triangles"),
        (ASCII.replace("      vertex 0 1e0 0\n", "").encode(), "2 vertices do not make whole"),
        (ASCII.replace("1e0", "1,0").encode(), "line 6: 'vertex 0 1,0 0'"),
        (ASCII.replace("vertex 0 1e0 0", "vertex 0 1").encode(), "line 6: 'vertex 0 1'"),
        (ASCII.replace("1e0", "nan").encode(), "triangle 0 has a coordinate that is not a finite"),
        (b"version https://git-lfs.github.com/spec/v1\n", "run 'git lfs pull'"),
    ],
)
def test_a_broken_file_says_what_and_where(write, data, reason):
    with pytest.raises(MeshError) as caught:
        load_mesh(write("broken.stl", data))
    assert reason in str(caught.value)


@pytest.mark.reference
def test_sample_meshes_are_as_trimesh_reads_them(examples_dir: Path):
    trimesh = pytest.importorskip("trimesh")
    files = sorted(examples_dir.glob("*/src/*/meshes/*.stl"))
    assert len(files) >= 10
    if SHARED.is_dir():
        others = sorted((SHARED / "workspaces").glob("*/src/*/meshes/**/*.[sS][tT][lL]"))
        assert len(others) >= 17
        files += others
    for path in files:
        ours, theirs = load_mesh(path), trimesh.load(path, process=True, force="mesh")
        assert len(ours.faces) == len(theirs.faces), path
        assert len(np.unique(ours.vertices_m, axis=0)) == len(theirs.vertices), path
        np.testing.assert_allclose(ours.bounds_m, theirs.bounds, atol=1e-9)
        np.testing.assert_allclose(mesh_volume_m3(ours), theirs.volume, rtol=1e-6)
