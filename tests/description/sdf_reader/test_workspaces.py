"""Files of the documents and of the recorded runs, read as they are."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from tests.shared_files import skip_module_without_shared

from gazelle.description.model import Box, Cylinder, JointType, Plane
from gazelle.description.sdf_reader import read_model_file, read_world_file
from gazelle.description.sdf_reader.model_config import read_model_config
from gazelle.diagnostics import Diagnostics
from gazelle.workspace import Workspace

skip_module_without_shared()

TURTLEBOT = "turtlebot3_ws/src/turtlebot3_simulations/turtlebot3_gazebo"


@pytest.fixture
def workspace(workspaces_dir: Path, tmp_path: Path) -> Workspace:
    folders = (workspaces_dir / "gazebo_models", workspaces_dir / TURTLEBOT / "models")
    environ = {"GAZEBO_MODEL_PATH": ":".join(map(str, folders)), "HOME": str(tmp_path)}
    return Workspace.discover(environ=environ, cwd=tmp_path)


@pytest.fixture
def found() -> Diagnostics:
    return Diagnostics()


@pytest.mark.tutorial
@pytest.mark.parametrize("stage", [1, 2])
def test_stages_without_link_say_so_in_gazebos_words(workspaces_dir, found, stage):
    path = workspaces_dir / f"gazebo_models/stages/my_robot_{stage}.sdf"
    assert read_model_file(path, workspace=None, diagnostics=found) is None
    (error,) = found
    assert error.message == "model 'my_robot' has no link, so there is nothing to load"
    assert error.phrase == "A model must have at least one link."
    assert (error.span.line, error.span.file) == (3, str(path))


@pytest.mark.tutorial
@pytest.mark.parametrize(
    ("stage", "links", "joints"), [(3, 1, 0), (4, 1, 0), (5, 2, 0), (6, 3, 0), (7, 3, 2)]
)
def test_stages_with_links_load_in_silence(workspaces_dir, found, stage, links, joints):
    path = workspaces_dir / f"gazebo_models/stages/my_robot_{stage}.sdf"
    model = read_model_file(path, workspace=None, diagnostics=found)
    assert (len(model.links), len(model.joints)) == (links, joints)
    assert not len(found)


@pytest.mark.tutorial
def test_my_robot_has_the_masses_and_axes_that_gazebo_gives_it(workspaces_dir, found):
    folder = workspaces_dir / "gazebo_models/my_robot"
    model = read_model_file(folder, workspace=None, diagnostics=found)
    assert {link.inertial.mass_kg for link in model.links} == {1.0}
    assert {link.inertial.inertia_kg_m2 for link in model.links} == {(1, 0, 0, 1, 0, 1)}
    wheel = model.link("left_wheel")
    assert wheel.T_model_link.position_m == (0.1, 0.13, 0.1)
    assert wheel.collisions[0].shape == Cylinder(0.1, 0.05)
    hinge = model.joint("left_wheel_hinge")
    assert hinge.T_model_joint.rotate(hinge.axis.xyz) == pytest.approx((0, 1, 0), abs=1e-9)
    assert hinge.T_model_joint.position_m == pytest.approx((0.1, 0.1, 0.1), abs=1e-4)
    caster = model.link("chassis").collisions[1].surface
    assert (caster.mu1, caster.mu2, caster.slip1) == (0, 0, 1)


@pytest.mark.tutorial
def test_slam_robots_world_of_sdf_1_4(workspaces_dir, workspace, found):
    path = workspaces_dir / "catkin_ws/src/slam_robot/worlds/slam_robot_world.world"
    world = read_world_file(path, workspace=workspace, diagnostics=found)
    assert [model.name for model in world.models] == ["ISCAS_groundplane", "ISCAS_Museum"]
    assert [light.name for light in world.lights] == ["sun"]
    assert world.gravity_m_s2 == (0, 0, -9.8)
    assert (world.scene.ambient, world.scene.sky) == ((0.68, 0.68, 0.68, 1), True)
    assert not found.errors
    museum = world.model("ISCAS_Museum")
    assert museum.static
    assert museum.T_world_model.rpy_rad == pytest.approx((0, 0, -1.57))
    wall = museum.link("wall_north")
    # A quarter turn to the right: what lay 7 m along y lies 7 m along x.
    place = (museum.T_world_model @ wall.T_model_link).position_m
    assert place == pytest.approx((7 * math.sin(1.57), 7 * math.cos(1.57), 1.25))
    assert wall.collisions[0].shape == Box((20, 0.15, 2.5))


@pytest.mark.tutorial
def test_ground_of_slam_robots_world_shows_its_picture(workspaces_dir, workspace, found):
    path = workspaces_dir / "gazebo_models/ISCAS_groundplane"
    model = read_model_file(path, workspace=workspace, diagnostics=found)
    visual, collision = model.links[0].visuals[0], model.links[0].collisions[0]
    assert visual.shape == Plane((0, 0, 1), (30, 30))
    assert visual.material.texture.name == "ISCAS_groundplane.png"
    assert visual.material.texture_scale == pytest.approx((1 / 0.12, 1 / 0.12))
    assert (visual.material.diffuse, visual.material.shininess) == ((0.5, 0.5, 0.5, 1), 5)
    assert not visual.cast_shadows
    assert (collision.surface.mu1, collision.surface.mu2) == (100, 50)
    assert not len(found)


@pytest.mark.tutorial
def test_missing_museum_is_searched_locally_and_explained(workspaces_dir, tmp_path, found):
    path = workspaces_dir / "catkin_ws/src/slam_robot/worlds/slam_robot_world.world"
    environ = {"GAZEBO_MODEL_PATH": str(tmp_path), "HOME": str(tmp_path)}
    alone = Workspace.discover(environ=environ, cwd=tmp_path)
    world = read_world_file(path, workspace=alone, diagnostics=found)
    assert [light.name for light in world.lights] == ["sun"]
    messages = found.by_code("sdf.missing-model")
    assert [item.span.line for item in messages] == [21, 27]
    assert str(tmp_path) in messages[0].message
    assert not found.errors


@pytest.mark.parametrize(
    ("name", "models"),
    [
        ("empty", ["ground_plane"]),
        ("turtlebot3_world", ["ground_plane", "ros_symbol"]),
        ("turtlebot3_house", ["ground_plane", "turtlebot3_house"]),
    ],
)
def test_turtlebots_worlds(workspaces_dir, workspace, found, name, models):
    path = workspaces_dir / TURTLEBOT / "worlds" / f"{name}.world"
    world = read_world_file(path, workspace=workspace, diagnostics=found)
    assert [model.name for model in world.models] == models
    assert world.physics.solver_iters == 150
    assert world.physics.contact_surface_layer_m == 0.01
    assert not found.errors
    assert not found.by_code("xml.unknown-tag")


def test_turtlebots_configuration_names_two_versions(workspaces_dir, workspace, found):
    from gazelle.description.read_context import ReadContext

    folder = workspaces_dir / TURTLEBOT / "models/turtlebot3_burger"
    config = read_model_config(folder, ReadContext(workspace, found, "here"))
    assert config.name == "TurtleBot3(Burger)"
    assert config.sdf_files == (((1, 4), "model-1_4.sdf"), ((1, 5), "model.sdf"))
    assert config.best_file == "model.sdf"


@pytest.mark.parametrize("robot", ["burger", "waffle", "waffle_pi"])
@pytest.mark.parametrize("file", ["model.sdf", "model-1_4.sdf"])
def test_turtlebots_wheels_turn_about_the_same_axis_in_both_versions(
    workspaces_dir, workspace, found, robot, file
):
    path = workspaces_dir / TURTLEBOT / "models" / f"turtlebot3_{robot}" / file
    model = read_model_file(path, workspace=workspace, diagnostics=found)
    for side in ("left", "right"):
        joint = model.joint(f"{side}_wheel_joint")
        assert joint.type is JointType.REVOLUTE
        assert math.isinf(joint.axis.upper)
        if file == "model-1_4.sdf":
            assert joint.T_model_joint.rotate(joint.axis.xyz) == pytest.approx((0, 1, 0), abs=1e-9)
    assert not found.errors
    assert {item.code for item in found} <= {"sdf.missing-file"}


@pytest.mark.reference
def test_sdformats_own_conversion_of_a_urdf_is_read_with_the_urdfs_numbers(oracles_dir, found):
    """Joints relative to their parent link, links relative to their joint, as sdformat writes."""
    model = read_model_file(oracles_dir / "sdf/gz_urdf.sdf", workspace=None, diagnostics=found)
    assert model.canonical_link == "base_footprint"
    assert model.link("arm").T_model_link.position_m == pytest.approx((0, 0, 0.4))
    wheel, joint = model.link("left_wheel"), model.joint("left_joint")
    assert wheel.T_model_link == joint.T_model_joint
    assert wheel.T_model_link.position_m == pytest.approx((0, 0.22, 0.1))
    assert wheel.T_model_link.rpy_rad == pytest.approx((-1.5707963, 0, 0))
    assert (joint.axis.damping, joint.axis.friction) == (0.1, 0.2)
    assert (joint.axis.spring_stiffness, joint.axis.spring_reference) == (5, 0.2)
    assert (joint.provide_feedback, joint.implicit_spring_damper) == (True, True)
    assert (joint.limit_cfm, joint.limit_erp) == (0.1, 0.3)
    base = model.link("base_footprint")
    assert [item.surface.mu1 for item in base.collisions] == [0.5, 0.2]
    assert [item.surface.mu2 for item in base.collisions] == [0.5, None]
    assert base.inertial.mass_kg == 20.3
    assert base.visuals[0].material.diffuse == (0, 0, 1, 1)
    assert wheel.visuals[0].material.name == "Gazebo/Black"
    assert (wheel.gravity, wheel.self_collide, wheel.linear_damping) == (False, True, 0.3)
    arm = model.joint("arm_joint")
    assert arm.axis.xyz == pytest.approx((0, math.sqrt(0.5), math.sqrt(0.5)))
    assert (arm.axis.lower, arm.axis.upper, arm.axis.effort) == (-0.1, 0.4, 100)
    sensor = base.sensors[0]
    assert (sensor.type, sensor.update_rate_hz, sensor.spec.samples) == ("ray", 10, 360)
    assert [plugin.name for plugin in model.plugins] == ["diff", "p3d"]
    assert {item.code for item in found} == {"sdf.missing-file"}
