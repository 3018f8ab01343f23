from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
import trimesh

from gazelle.diagnostics import Diagnostics, SourceSpan
from gazelle.geometry import (
    MESH_SUFFIXES,
    MeshError,
    load_mesh,
    load_mesh_reported,
    mesh_mass_properties,
)


def test_an_unchanged_file_is_read_once(write, binary_stl):
    path = write("a.stl", binary_stl())
    first = load_mesh(path)
    assert load_mesh(str(path)) is first
    path.write_bytes(binary_stl(corners=first.vertices_m[first.faces] * 2))
    os.utime(path, ns=(1, 1))
    assert load_mesh(path).bounds_m[1] == (1, 2, 3)


def test_shared_arrays_cannot_be_changed(write, binary_stl):
    mesh = load_mesh(write("a.stl", binary_stl()))
    for array in (mesh.vertices_m, mesh.faces, mesh.parts[0].normals):
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


def test_a_collada_file_under_a_wrong_name_is_recognised(write):
    with pytest.raises(MeshError, match="Collada"):
        load_mesh(write("a.stl", "<?xml version='1.0'?><COLLADA></COLLADA>"))


def test_an_unknown_format_says_which_are_known(write):
    assert MESH_SUFFIXES == (".dae", ".glb", ".gltf", ".obj", ".stl")
    with pytest.raises(MeshError) as caught:
        load_mesh(write("a.blend", b"BLENDER"))
    assert "'.blend' is no known mesh format; known are .dae, .glb, .gltf, .obj, .stl" in str(
        caught.value
    )


def test_a_missing_file_says_so(tmp_path):
    with pytest.raises(MeshError, match="cannot be read: No such file"):
        load_mesh(tmp_path / "a.stl")
    with pytest.raises(MeshError, match="cannot be read: Is a directory"):
        load_mesh(tmp_path)


def test_an_unreadable_mesh_is_reported_at_its_reference(tmp_path):
    diagnostics = Diagnostics()
    span = SourceSpan("robot.urdf", 12, 5)
    assert load_mesh_reported(tmp_path / "a.stl", diagnostics, span) is None
    (found,) = diagnostics.by_code("mesh.unreadable")
    assert found.span == span
    assert "No such file" in found.message
    assert found.phrase == "Could not load resource"


def test_notes_are_reported_with_the_file(write, binary_stl):
    diagnostics = Diagnostics()
    path = write("a.stl", binary_stl() + b"rest")
    load_mesh_reported(path, diagnostics)
    (found,) = diagnostics.by_code("mesh.extra-bytes")
    assert found.message.startswith(f"mesh '{path}': 4 bytes after")


def test_mesh_for_computing_has_the_same_body_as_the_one_for_drawing(tmp_path: Path) -> None:
    path = tmp_path / "sphere.stl"
    trimesh.creation.icosphere(subdivisions=2).export(path)
    plain, smooth = load_mesh(path, smooth=False), load_mesh(path)
    assert len(plain.vertices_m) == 162
    np.testing.assert_allclose(np.linalg.norm(plain.parts[0].normals, axis=1), 1.0)
    ours, other = (
        mesh_mass_properties(plain, mass_kg=2.0),
        mesh_mass_properties(smooth, mass_kg=2.0),
    )
    np.testing.assert_allclose(ours.inertia_kg_m2, other.inertia_kg_m2, atol=1e-12)
    # Once there are normals to draw with, everybody gets them.
    assert load_mesh(path, smooth=False) is plain
    assert load_mesh(path) is smooth
