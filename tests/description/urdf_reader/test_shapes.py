from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.description.model import Box, Capsule, Cylinder, MeshShape, Sphere
from gazelle.description.read_context import ReadContext
from gazelle.description.urdf_reader import read_urdf
from gazelle.diagnostics import Diagnostics
from gazelle.workspace import Workspace


def _visual(shape: str) -> str:
    return f"<visual><geometry>{shape}</geometry></visual>"


@pytest.mark.parametrize(
    ("text", "shape"),
    [
        ('<box size="1 2 3"/>', Box((1.0, 2.0, 3.0))),
        ('<sphere radius="0.5"/>', Sphere(0.5)),
        ('<cylinder radius="0.5" length="2"/>', Cylinder(0.5, 2.0)),
        ('<capsule radius="0.5" length="2"/>', Capsule(0.5, 2.0)),
    ],
)
def test_every_shape(text: str, shape: object, read_link) -> None:
    found = read_link(_visual(text))
    assert found.robot.link("a").visuals[0].shape == shape
    assert not found.codes


@pytest.mark.parametrize(
    ("text", "code", "words"),
    [
        ("<box/>", "urdf.geometry-incomplete", 'a box needs size="x y z"'),
        ("<capsule radius='1'/>", "urdf.geometry-incomplete", 'a capsule needs length="…"'),
        ("<mesh/>", "urdf.geometry-incomplete", "a mesh needs filename"),
        ("<spere radius='1'/>", "urdf.geometry-unknown", "did you mean 'sphere'"),
        ("", "urdf.geometry-missing", "has no shape in <geometry>"),
        ("<sphere radius='-1'/>", "urdf.bad-size", "a size (-1) that is not positive; left out"),
        ("<box size='1 0 -1'/>", "urdf.bad-size", "a size (1 0 -1) that is not positive"),
        ("<box size='1 1e30 1'/>", "urdf.bad-size", "that is too large to be metres"),
        ("<sphere radius='0,5'/>", "xml.bad-number", "a dot, not a comma"),
    ],
)
def test_unusable_shapes_are_left_out_and_said(text: str, code: str, words: str, read_link) -> None:
    found = read_link(_visual(text))
    assert words in found.message(code)
    assert found.robot.link("a").visuals == ()


@pytest.mark.parametrize(
    ("text", "shape", "shown"),
    [
        ("<box size='5 5 0'/>", Box((5.0, 5.0, 1e-4)), "box of link 'a' has a size (5 5 0)"),
        ("<sphere radius='0'/>", Sphere(1e-4), "sphere of link 'a' has a size (0)"),
    ],
)
def test_a_length_of_0_is_as_thin_as_in_gazebo(
    text: str, shape: object, shown: str, read_link
) -> None:
    found = read_link(_visual(text))
    assert found.robot.link("a").visuals[0].shape == shape
    words = f"the {shown} that is 0; 0.0001 m is used, as in Gazebo"
    assert words in found.message("urdf.bad-size")


def test_missing_visual_mesh_is_a_warning_and_the_visual_stays(read_link, tmp_path: Path) -> None:
    found = read_link(_visual('<mesh filename="part.stl" scale="2 2 2"/>'), base_dir=tmp_path)
    message = found.message("urdf.mesh-missing")
    assert "warning: the visual mesh of link 'a' cannot be seen" in message
    assert str(tmp_path / "part.stl") in message
    shape = found.robot.link("a").visuals[0].shape
    assert isinstance(shape, MeshShape)
    assert (shape.path, shape.uri, shape.scale) == (None, "part.stl", (2.0, 2.0, 2.0))


def test_missing_collision_mesh_says_that_nothing_touches(read_link, tmp_path: Path) -> None:
    collision = "<collision><geometry><mesh filename='package://p/a.stl'/></geometry></collision>"
    message = read_link(collision, base_dir=tmp_path).message("urdf.collision-mesh-missing")
    assert "the collision mesh of link 'a' will not touch anything" in message


def test_mesh_beside_the_file_is_found(read_link, tmp_path: Path) -> None:
    (tmp_path / "part.stl").write_bytes(b"")
    found = read_link(_visual('<mesh filename="part.stl"/>'), base_dir=tmp_path)
    assert found.robot.link("a").visuals[0].shape.path == tmp_path / "part.stl"
    assert not found.codes


def test_mesh_of_a_package_and_of_other_case(tmp_path: Path) -> None:
    meshes = tmp_path / "src" / "p" / "meshes"
    meshes.mkdir(parents=True)
    (meshes / "Arm.STL").write_bytes(b"")
    (meshes.parent / "package.xml").write_text(
        '<package format="2"><name>p</name><version>0.0.0</version></package>', encoding="utf-8"
    )
    diagnostics = Diagnostics()
    workspace = Workspace.discover(environ={}, cwd=tmp_path)
    context = ReadContext(workspace, diagnostics, "robot.urdf", None)
    uris = (
        "package://p/meshes/Arm.STL",
        "package://p/meshes/arm.stl",
        "package://p/meshes/Amr.STL",
    )
    visuals = "".join(_visual(f"<mesh filename='{uri}'/>") for uri in uris)
    inertial = (
        "<inertial><mass value='1'/>"
        "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>"
    )
    text = f"<robot name='r'><link name='a'>{inertial}{visuals}</link></robot>"
    model = read_urdf(text, context=context)
    assert model is not None
    paths = [visual.shape.path for visual in model.links[0].visuals]
    assert paths == [meshes / "Arm.STL", meshes / "Arm.STL", None]
    note, missing = diagnostics
    assert note.code == "urdf.file-note"
    assert "upper and lower case differ" in note.message
    assert "did you mean 'package://p/meshes/Arm.STL'" in missing.message
