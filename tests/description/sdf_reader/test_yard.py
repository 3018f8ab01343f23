"""A world of our own with its models: what the documents' workspaces show, in a clone alone."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from gazelle.description.model import Box, Cylinder, JointType, Plane
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader import read_model_file, read_world_file
from gazelle.description.sdf_reader.model_config import read_model_config
from gazelle.diagnostics import Diagnostics
from gazelle.workspace import Workspace


@pytest.fixture
def yard(own_workspaces_dir: Path) -> Path:
    return own_workspaces_dir / "ros1/src/yard_gazebo"


@pytest.fixture
def workspace(yard: Path, tmp_path: Path) -> Workspace:
    environ = {"GAZEBO_MODEL_PATH": str(yard / "models"), "HOME": str(tmp_path)}
    return Workspace.discover(environ=environ, cwd=tmp_path)


@pytest.fixture
def found() -> Diagnostics:
    return Diagnostics()


@pytest.mark.parametrize("stage", [1, 2])
def test_stages_without_link_say_so_in_gazebos_words(yard: Path, found, stage: int) -> None:
    path = yard / f"stages/barrow_{stage}.sdf"
    assert read_model_file(path, workspace=None, diagnostics=found) is None
    (error,) = found
    assert error.message == "model 'barrow' has no link, so there is nothing to load"
    assert error.phrase == "A model must have at least one link."
    assert (error.span.line, error.span.file) == (3, str(path))


@pytest.mark.parametrize(
    ("stage", "links", "joints"), [(3, 1, 0), (4, 1, 0), (5, 2, 0), (6, 3, 0), (7, 3, 2)]
)
def test_stages_with_links_load_in_silence(yard: Path, found, stage, links, joints) -> None:
    path = yard / f"stages/barrow_{stage}.sdf"
    model = read_model_file(path, workspace=None, diagnostics=found)
    assert (len(model.links), len(model.joints)) == (links, joints)
    assert not len(found)


def test_links_without_inertial_have_the_masses_that_gazebo_gives_them(yard: Path, found) -> None:
    model = read_model_file(yard / "models/barrow", workspace=None, diagnostics=found)
    assert {link.inertial.mass_kg for link in model.links} == {1.0}
    assert {link.inertial.inertia_kg_m2 for link in model.links} == {(1, 0, 0, 1, 0, 1)}
    wheel = model.link("left_wheel")
    assert wheel.T_model_link.position_m == (0.15, 0.18, 0.12)
    assert wheel.collisions[0].shape == Cylinder(0.12, 0.04)
    foot = model.link("tray").collisions[1].surface
    assert (foot.mu1, foot.mu2, foot.slip1) == (0, 0, 0.8)


def test_configuration_names_two_versions(yard: Path, workspace: Workspace, found) -> None:
    config = read_model_config(yard / "models/barrow", ReadContext(workspace, found, "here"))
    assert config.name == "Barrow (motor)"
    assert config.sdf_files == (((1, 4), "model-1_4.sdf"), ((1, 6), "model.sdf"))
    assert config.best_file == "model.sdf"


@pytest.mark.parametrize("file", ["model.sdf", "model-1_4.sdf"])
def test_axes_lie_in_the_frame_of_the_documents_version(yard: Path, found, file: str) -> None:
    """The joint's frame is the wheel's, whose z lies along the axle; SDF 1.4 says it by y."""
    model = read_model_file(yard / "models/barrow" / file, workspace=None, diagnostics=found)
    for side in ("left", "right"):
        joint = model.joint(f"{side}_hinge")
        assert joint.type is JointType.REVOLUTE
        assert math.isinf(joint.axis.upper)
        assert joint.T_model_joint.rotate(joint.axis.xyz) == pytest.approx((0, 1, 0), abs=1e-5)
    assert not len(found)


def test_world_of_sdf_1_4_includes_models_of_the_path(yard: Path, workspace, found) -> None:
    world = read_world_file(yard / "worlds/yard.world", workspace=workspace, diagnostics=found)
    assert [model.name for model in world.models] == ["gravel", "shed"]
    assert [light.name for light in world.lights] == ["sun"]
    assert world.gravity_m_s2 == (0, 0, -9.81)
    assert (world.scene.ambient, world.scene.sky) == ((0.5, 0.55, 0.6, 1), True)
    assert not found.errors
    shed = world.model("shed")
    assert shed.static
    assert shed.T_world_model.rpy_rad == pytest.approx((0, 0, -0.6))
    wall = shed.link("back_wall")
    place = (shed.T_world_model @ wall.T_model_link).position_m
    # What is 3 m along y before the turn.
    assert place == pytest.approx((1 + 3 * math.sin(0.6), 3 * math.cos(0.6), 1))
    assert wall.collisions[0].shape == Box((4, 0.1, 2))


def test_ground_shows_the_picture_of_its_script(yard: Path, workspace, found) -> None:
    model = read_model_file(yard / "models/gravel", workspace=workspace, diagnostics=found)
    visual, collision = model.links[0].visuals[0], model.links[0].collisions[0]
    assert visual.shape == Plane((0, 0, 1), (24, 24))
    assert visual.material.texture.name == "gravel.png"
    assert visual.material.texture_scale == pytest.approx((4, 2))
    assert (visual.material.diffuse, visual.material.shininess) == ((0.4, 0.45, 0.5, 1), 8)
    assert not visual.cast_shadows
    assert (collision.surface.mu1, collision.surface.mu2) == (0.9, 0.7)
    assert not len(found)


def test_missing_models_are_searched_locally_and_explained(yard: Path, tmp_path, found) -> None:
    environ = {"GAZEBO_MODEL_PATH": str(tmp_path), "HOME": str(tmp_path)}
    alone = Workspace.discover(environ=environ, cwd=tmp_path)
    # Beside its package the world's models would be found.
    path = tmp_path / "yard.world"
    path.write_bytes((yard / "worlds/yard.world").read_bytes())
    world = read_world_file(path, workspace=alone, diagnostics=found)
    assert [light.name for light in world.lights] == ["sun"]
    messages = found.by_code("sdf.missing-model")
    assert [item.span.line for item in messages] == [19, 25]
    assert str(tmp_path) in messages[0].message
    assert not found.errors
