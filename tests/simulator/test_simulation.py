from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import pytest

import gazelle
from gazelle.description.model import Box, Collision, Inertial, Link, Model, World
from gazelle.errors import EngineError, NotFoundError, UserFileError
from gazelle.geometry import Pose
from gazelle.simulator import Simulation

PENDULUM = """<robot name="pendulum"><link name="world"/>
  <joint name="swing" type="revolute"><parent link="world"/><child link="bob"/>
    <origin xyz="0 0 2"/><axis xyz="0 1 0"/><limit lower="-3" upper="3" effort="50" velocity="9"/>
  </joint>
  <link name="bob"><inertial><origin xyz="0 0 -0.5"/><mass value="1"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link></robot>"""


def a_box(name: str = "box") -> Model:
    link = Link(
        "link",
        inertial=Inertial(1.0, inertia_kg_m2=(0.01, 0, 0, 0.01, 0, 0.01)),
        collisions=(Collision("collision", Box((0.2, 0.2, 0.2))),),
    )
    return Model(name, links=(link,), canonical_link="link")


def test_the_package_offers_it_lazily() -> None:
    assert gazelle.Simulation is Simulation


def test_a_joint_goes_where_it_is_commanded(load: Callable[..., Simulation]) -> None:
    sim = load(PENDULUM, world=None)
    sim.joint("swing").command(0.4)
    sim.run(seconds=2.0)
    assert abs(sim.joint("pendulum::swing").position - 0.4) < 1e-3
    assert abs(sim.joint("swing").velocity) < 1e-3


def test_velocity_and_effort_commands_act_and_release_ends_them(
    load: Callable[..., Simulation],
) -> None:
    sim = load(PENDULUM, world=None)
    joint = sim.joint("swing")
    joint.command_velocity(0.5)
    sim.run(seconds=0.5)
    assert abs(joint.velocity - 0.5) < 1e-3
    joint.command_effort(0.0)
    joint.release()
    sim.run(seconds=0.2)
    assert abs(joint.velocity - 0.5) > 0.1


def test_time_goes_on_in_whole_steps(load: Callable[..., Simulation]) -> None:
    sim = load(world=None)
    sim.run(seconds=0.0015)
    assert sim.time_ns == 2_000_000
    sim.step(3)
    assert sim.time_s == pytest.approx(0.005)
    with pytest.raises(ValueError, match="0 s or more"):
        sim.run(seconds=-1)
    with pytest.raises(ValueError, match="0 s or more"):
        sim.run(seconds=math.nan)


def test_a_spawned_box_falls_onto_the_ground(load: Callable[..., Simulation]) -> None:
    sim = load(world="empty")
    box = sim.spawn(a_box(), pose=Pose((0.0, 0.0, 1.0)))
    sim.run(seconds=2.0)
    assert abs(box.pose.position_m[2] - 0.1) < 2e-3
    assert sim.link("box::link").pose.position_m[2] == pytest.approx(box.pose.position_m[2])
    sim.delete("box")
    with pytest.raises(NotFoundError, match="model 'box' not found"):
        sim.model("box")


def test_a_name_that_is_taken_is_an_error(load: Callable[..., Simulation]) -> None:
    sim = load(a_box(), world=None)
    with pytest.raises(EngineError, match="model name box already exist"):
        sim.spawn(a_box())


def test_moving_a_model_and_pushing_a_link(load: Callable[..., Simulation]) -> None:
    sim = load(a_box(), world=World(gravity_m_s2=(0.0, 0.0, 0.0)))
    sim.model("box").pose = Pose((1.0, 2.0, 3.0))
    sim.link("link").apply_wrench((2.0, 0.0, 0.0), seconds=0.5)
    sim.run(seconds=1.0)
    # 2 N on 1 kg for half a second.
    assert sim.link("link").linear_velocity_m_s[0] == pytest.approx(1.0, abs=5e-3)
    assert sim.model("box").pose.position_m[1:] == pytest.approx((2.0, 3.0))


def test_reset_gives_the_same_run_again(load: Callable[..., Simulation]) -> None:
    sim = load(PENDULUM, world=None)
    sim.joint("swing").handle.set_state(0.0, 1.0)
    sim.run(seconds=0.5)
    first = sim.state_hash()
    sim.reset()
    assert sim.time_ns == 0
    assert sim.joint("swing").position == 0.0
    sim.joint("swing").handle.set_state(0.0, 1.0)
    sim.run(seconds=0.5)
    assert sim.state_hash() == first


def test_unknown_names_get_the_nearest(load: Callable[..., Simulation]) -> None:
    sim = load(PENDULUM, world=None)
    with pytest.raises(NotFoundError, match="joint 'swng' not found; did you mean 'swing'"):
        sim.joint("swng")
    with pytest.raises(NotFoundError, match="link 'bobb' not found; did you mean 'bob'"):
        sim.link("bobb")
    with pytest.raises(NotFoundError, match="sensor 'eye' not found"):
        sim.sensor("eye")


def test_a_missing_file_is_one_clear_error(load: Callable[..., Simulation]) -> None:
    with pytest.raises(NotFoundError, match=r"file or model 'robbot\.urdf' not found"):
        load("robbot.urdf")
    with pytest.raises(NotFoundError, match="world 'emptyy' not found"):
        load(world="emptyy")


def test_all_errors_of_a_file_come_at_once(load: Callable[..., Simulation]) -> None:
    broken = PENDULUM.replace('mass value="1"', 'mass value="1,5"').replace('"0 1 0"', '"0 1 x"')
    with pytest.raises(UserFileError) as caught:
        load(broken, world=None)
    codes = [item.code for item in caught.value.diagnostics]
    assert codes.count("xml.bad-number") == 2


def test_sensors_are_read_without_any_topic(
    load: Callable[..., Simulation], cart_urdf: Callable[..., str]
) -> None:
    sim = load(cart_urdf(), world="empty")
    sim.spawn(a_box(), pose=Pose((2.1, 0.0, 0.1)))
    wall = Model(
        "wall",
        static=True,
        links=(Link("link", collisions=(Collision("c", Box((0.2, 4.0, 2.0))),)),),
        canonical_link="link",
    )
    sim.spawn(wall, pose=Pose((3.1, 0.0, 1.0)))
    record = sim.sensor("scanner").read()
    assert record.ranges_m.shape == (1, 9)
    assert record.ranges_m[0, 4] == pytest.approx(3.0, abs=2e-3)
    assert sim.sensor("cart::base_link::scanner").description.type == "ray"


def test_it_is_a_context_manager(bare_workspace: object, tmp_path: Path) -> None:
    path = tmp_path / "pendulum.urdf"
    path.write_text(PENDULUM)
    with Simulation.load(path, world=None, workspace=bare_workspace) as sim:  # type: ignore[arg-type]
        sim.step()
        assert sim.model("pendulum").joints == ("swing",)


WORLD = """<sdf version="1.6"><world name="own"><model name="stone"><static>true</static>
  <link name="link"/></model></world></sdf>"""


@pytest.mark.parametrize("name", ["own.sdf", "own.world"])
def test_a_file_that_holds_a_world_stands_for_itself(
    load: Callable[..., Simulation], tmp_path: Path, name: str
) -> None:
    (tmp_path / name).write_text(WORLD)
    world = load(tmp_path / name).world
    assert (world.name, [model.name for model in world.models]) == ("own", ["stone"])


def test_text_that_holds_a_world_stands_for_itself(load: Callable[..., Simulation]) -> None:
    assert load(WORLD).world.name == "own"
