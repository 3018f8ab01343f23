"""Worlds written as MJCF move in plain MuJoCo as in the engine."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest
from tests.shared_files import SHARED, shared_cases

from gazelle.description.loader import load_world
from gazelle.description.model import (
    Box,
    Collision,
    Cylinder,
    Ellipsoid,
    Inertial,
    Link,
    Material,
    Model,
    Plane,
    Surface,
    Visual,
    World,
)
from gazelle.description.writers import OutputFiles
from gazelle.diagnostics import Diagnostics
from gazelle.engine import Engine
from gazelle.engine.mjcf import to_mjcf
from gazelle.geometry import Pose
from gazelle.workspace import Workspace

EXAMPLES = Path(__file__).parents[3] / "examples"
SCOUT = EXAMPLES / "scout_ws/src/scout_robot/urdf/scout.urdf.xacro"
ROBOTS = (
    "catkin_ws/src/slam_robot/urdf/slam_robot_gazebo.urdf",
    "catkin_ws/src/urdf_exam/urdf/mira_gazebo.urdf",
    "ros2_ws/src/luck_description/urdf/luck_description.urdf",
    "turtlebot3_ws/src/turtlebot3/turtlebot3_description/urdf/turtlebot3_burger.urdf.xacro",
    "gazebo_models/my_robot/model.sdf",
)


@pytest.fixture(scope="module")
def workspace() -> Workspace:
    """The examples, and the samples where they are."""
    samples = SHARED / "workspaces"
    roots = [*sorted(EXAMPLES.glob("*_ws")), *sorted(samples.glob("*_ws"))]
    environ = {
        "ROS_PACKAGE_PATH": ":".join(str(root / "src") for root in roots),
        "GAZEBO_MODEL_PATH": str(samples / "gazebo_models"),
    }
    return Workspace.discover(environ=environ, cwd=EXAMPLES)


def written(world: World, folder: Path) -> tuple[mujoco.MjModel, Diagnostics, str]:
    """Write a world's MJCF and load it with plain MuJoCo."""
    found = Diagnostics()
    output_files = OutputFiles(folder, "world", relative=True)
    converted = to_mjcf(world, diagnostics=found, output_files=output_files)
    for name, data in converted.files.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_bytes(data)
    (folder / "world.xml").write_text(converted.text, encoding="utf-8")
    return mujoco.MjModel.from_xml_path(str(folder / "world.xml")), found, converted.text


def ground() -> Model:
    plane = Collision("plane", Plane(size_m=(10, 10)))
    return Model("ground", static=True, links=(Link("link", collisions=(plane,)),))


def block(**surface: float) -> Model:
    inertial = Inertial(2.0, inertia_kg_m2=(0.01, 0, 0, 0.02, 0, 0.03))
    shape = Collision("box", Box((0.1, 0.2, 0.3)), surface=Surface(**surface))
    link = Link("link", inertial=inertial, collisions=(shape,))
    return Model("block", Pose.from_xyz_rpy((0, 0, 0.4), (0.3, 0.2, 0.1)), links=(link,))


def assert_same_motion(world: World, model: mujoco.MjModel, steps: int) -> None:
    data = mujoco.MjData(model)
    if model.nkey:
        mujoco.mj_resetDataKeyframe(model, data, 0)
    engine = Engine(world)
    engine.model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)
    assert np.array_equal(engine.data.qpos, data.qpos)
    for _ in range(steps // 50):
        engine.step(50)
        mujoco.mj_step(model, data, 50)
        assert np.abs(engine.data.qpos - data.qpos).max() < 1e-9


def assert_robot_moves_the_same(file: Path, workspace: Workspace, folder: Path) -> None:
    world = load_world(file, workspace=workspace, diagnostics=Diagnostics())
    world = replace(world, models=(ground(), *world.models))
    model, found, _ = written(world, folder)
    assert_same_motion(world, model, 300)
    own = {model.body(i).name for i in range(model.nbody)}
    assert {f"{item.name}::{link.name}" for item in world.models for link in item.links} <= own
    assert not found.errors


@pytest.mark.parametrize(
    "file",
    [SCOUT, *shared_cases(*(SHARED / "workspaces" / name for name in ROBOTS))],
    ids=lambda file: file.name,
)
def test_robots_move_the_same_on_the_ground(file, workspace, tmp_path) -> None:
    assert_robot_moves_the_same(file, workspace, tmp_path)


def test_springy_contacts_keep_their_springs(tmp_path) -> None:
    world = World(models=(ground(), block(kp=2e3, kd=10, mu1=0.4, mu2=0.2, restitution=0.3)))
    model, _, _ = written(world, tmp_path)
    assert model.npair == 1
    assert_same_motion(world, model, 1000)


def test_joints_that_start_elsewhere_have_a_keyframe(tmp_path) -> None:
    text = (
        '<sdf version="1.9"><model name="m"><joint name="hold" type="fixed"><parent>world</parent>'
        '<child>a</child></joint><link name="a"/><link name="b"><pose>0.5 0 0 0 0 0</pose></link>'
        '<joint name="j" type="revolute"><parent>a</parent><child>b</child><axis><xyz>0 1 0</xyz>'
        "<initial_position>0.7</initial_position></axis></joint></model></sdf>"
    )
    world = load_world(text, workspace=None, diagnostics=Diagnostics())
    model, _, _ = written(world, tmp_path)
    assert model.key("start").qpos[0] == 0.7
    assert_same_motion(world, model, 200)


def test_every_number_is_exact_and_short(tmp_path) -> None:
    world = World(models=(block(),), gravity_m_s2=(0.1, 0.2, -9.81))
    model, _, text = written(world, tmp_path)
    assert 'gravity="0.1 0.2 -9.81"' in text
    assert tuple(model.opt.gravity) == (0.1, 0.2, -9.81)


def test_visuals_are_seen_and_touch_nothing(tmp_path) -> None:
    red = Material("r", ambient=(1, 0, 0, 1), diffuse=(1, 0, 0, 1))
    visuals = (
        Visual("egg", Ellipsoid((0.1, 0.2, 0.3)), material=red, transparency=0.5),
        Visual("rod", Cylinder(0.1, 0.4), Pose((0, 0, 1))),
        Visual("sheet", Plane(size_m=(1, 2))),
    )
    base = block()
    world = World(models=(replace(base, links=(replace(base.links[0], visuals=visuals),)),))
    model, _, _ = written(world, tmp_path)
    seen = [i for i in range(model.ngeom) if model.geom_group[i] == 2]
    assert len(seen) == 3
    assert not model.geom_contype[seen].any()
    assert not model.geom_conaffinity[seen].any()
    egg = model.geom("block::link//visual egg")
    assert np.allclose(model.mat_rgba[egg.matid[0]], (1, 0, 0, 0.5))
    assert list(egg.size) == [0.1, 0.2, 0.3]
    assert model.geom("block::link::box").group[0] == 3
    assert (tmp_path / "world_files" / "plane.obj").is_file()


def test_textures_are_written_as_png(tmp_path) -> None:
    from PIL import Image

    Image.new("RGB", (4, 2), (10, 200, 30)).save(tmp_path / "grass.jpg", quality=95)
    appearance = Material("g", diffuse=(1, 1, 1, 1), texture=tmp_path / "grass.jpg")
    base = block()
    visual = Visual("v", Plane(size_m=(1, 1)), material=appearance)
    world = World(models=(replace(base, links=(replace(base.links[0], visuals=(visual,)),)),))
    model, _, _ = written(world, tmp_path)
    assert model.ntex == 1
    assert (model.tex_width[0], model.tex_height[0]) == (4, 2)
    assert (tmp_path / "world_files" / "grass.png").read_bytes().startswith(b"\x89PNG")
    found = Diagnostics()
    to_mjcf(world, diagnostics=found)
    [item] = found.by_code("convert.left-out")
    assert "grass.jpg' is left out: it needs a file beside the text" in item.message


@pytest.mark.parametrize(
    ("file", "plugins", "words"),
    [
        (SCOUT, 4, "4 plug-ins, 3 sensors"),
        *shared_cases(
            (SHARED / "workspaces" / ROBOTS[0], 3, "3 plug-ins, 2 sensors, 2 transmissions")
        ),
    ],
)
def test_what_acts_from_outside_is_told(file, plugins, words, workspace, tmp_path) -> None:
    world = load_world(file, workspace=workspace, diagnostics=Diagnostics())
    _, found, text = written(world, tmp_path)
    [item] = found.by_code("convert.mjcf-outside")
    assert words in item.message
    assert item.span.file == str(file)
    assert f"is not in the file: {plugins} plug-ins" in text


def test_velocity_decay_and_slip_are_told(tmp_path) -> None:
    base = block()
    link = replace(base.links[0], linear_damping=0.1, angular_damping=0.2)
    world = World(models=(replace(base, links=(link,)),))
    model, found, _ = written(world, tmp_path)
    assert "velocity_decay of link 'block::link'" in found.by_code("convert.left-out")[0].message
    assert not model.dof_damping.any()


def test_text_without_a_folder_holds_its_meshes(examples_dir) -> None:
    workspace = Workspace.discover(environ={}, cwd=examples_dir, extra=[examples_dir / "arm_ws"])
    file = workspace.package("heron_description").path / "urdf" / "heron.urdf.xacro"
    world = load_world(file, workspace=workspace, diagnostics=Diagnostics())
    converted = to_mjcf(world, diagnostics=Diagnostics())
    assert converted.files == {}
    assert mujoco.MjModel.from_xml_string(converted.text).nmesh > 5
