"""Joint types, mimics, loops and gearboxes."""

from __future__ import annotations

import copy
import math
from dataclasses import replace

import mujoco
import pytest

from gazelle.description.model import (
    Inertial,
    Joint,
    JointAxis,
    JointType,
    Link,
    Mimic,
    Model,
    World,
)
from gazelle.diagnostics import Diagnostics
from gazelle.engine import Engine
from gazelle.engine.velocity_limits import VelocityLimits
from gazelle.errors import EngineError
from gazelle.geometry import Pose

Z = JointAxis((0, 0, 1))
SMALL = Inertial(1.0, inertia_kg_m2=(0.01, 0, 0, 0.01, 0, 0.01))


def discs(count=2, **models):
    """Discs side by side that turn about vertical axes on the world."""
    links = [Link(f"disc{i}", Pose((i, 0, 0)), inertial=SMALL) for i in range(count)]
    joints = [
        Joint(f"joint{i}", JointType.CONTINUOUS, "world", f"disc{i}", Pose((i, 0, 0)), axis=Z)
        for i in range(count)
    ]
    return links, joints


def engine_of(model, diagnostics=None, **world):
    return Engine(World(models=(model,), **world), diagnostics=diagnostics)


def test_mimic_follows_with_multiplier_and_offset():
    links, joints = discs()
    follower = Joint(
        "joint1", JointType.REVOLUTE, "world", "disc1", Pose((1, 0, 0)),
        axis=Z, mimic=Mimic("joint0", -2.0, 0.3),
    )  # fmt: skip
    engine = engine_of(Model("gear", links=tuple(links), joints=(joints[0], follower)))
    engine.joint("gear::joint0").set_effort(0.05)
    engine.step(2000)
    leader = engine.joint("gear::joint0")
    assert leader.position == pytest.approx(0.5 * 0.05 / (0.01 * 5) * 4, rel=0.01)
    assert engine.joint("gear::joint1").position == pytest.approx(
        -2 * leader.position + 0.3, abs=2e-3
    )


def test_gearbox_turns_the_other_way_by_its_ratio():
    links, joints = discs()
    gearbox = Joint("box", JointType.GEARBOX, "disc0", "disc1", axis=Z, axis2=Z, gearbox_ratio=3.0)
    engine = engine_of(Model("gear", links=tuple(links), joints=(*joints, gearbox)))
    engine.joint("gear::joint0").set_velocity_target(1.0, 10.0)
    engine.step(1000)
    first, second = (engine.joint(f"gear::joint{i}") for i in range(2))
    assert first.velocity == pytest.approx(1.0, abs=1e-3)
    assert second.position == pytest.approx(-3 * first.position, abs=3e-3)


def test_gearbox_without_its_joints_is_reported():
    links, joints = discs()
    gearbox = Joint("box", JointType.GEARBOX, "disc0", "disc1", axis=Z, axis2=Z)
    diagnostics = Diagnostics()
    engine_of(Model("gear", links=tuple(links), joints=(joints[0], gearbox)), diagnostics)
    (finding,) = diagnostics.by_code("engine.gearbox")
    assert "needs a revolute joint between its reference body 'world' and link 'disc1'" in (
        finding.message
    )


def test_screw_advances_by_its_pitch():
    joint = Joint("j", JointType.SCREW, "world", "nut", axis=Z, thread_pitch_rad_m=50.0)
    model = Model("screw", links=(Link("nut", inertial=SMALL),), joints=(joint,))
    engine = engine_of(model, gravity_m_s2=(0, 0, 0))
    engine.joint("screw::j").set_velocity_target(5.0, 100.0)
    engine.step(1000)
    angle = engine.joint("screw::j").position
    assert angle == pytest.approx(5.0, rel=0.01)
    height = engine.link("screw::nut").T_world_link().position_m[2]
    assert height == pytest.approx(angle / 50.0, abs=2e-5)


def test_prismatic_joint_slides_along_its_axis():
    joint = Joint("j", JointType.PRISMATIC, "world", "cart", axis=JointAxis((1, 0, 0)))
    engine = engine_of(Model("m", links=(Link("cart", inertial=SMALL),), joints=(joint,)))
    engine.joint("m::j").set_effort(2.0)
    engine.step(1000)
    assert engine.joint("m::j").position == pytest.approx(1.0, rel=2e-3)
    assert engine.link("m::cart").T_world_link().position_m == pytest.approx((1, 0, 0), rel=2e-3)


def test_effort_is_clamped_to_its_limit():
    axis = JointAxis((1, 0, 0), effort=0.5)
    joint = Joint("j", JointType.PRISMATIC, "world", "cart", axis=axis)
    engine = engine_of(Model("m", links=(Link("cart", inertial=SMALL),), joints=(joint,)))
    handle = engine.joint("m::j")
    handle.set_effort(100.0)
    engine.step(1000)
    assert handle.effort == 0.5
    assert handle.velocity == pytest.approx(0.5, rel=1e-6)


def cart(**axis):
    """A cart of 1 kg on a rail along gravity, which pulls with 1 m/s²."""
    joint = Joint("j", JointType.PRISMATIC, "world", "cart", axis=JointAxis((1, 0, 0), **axis))
    model = Model("m", links=(Link("cart", inertial=SMALL),), joints=(joint,))
    engine = engine_of(model, gravity_m_s2=(1.0, 0.0, 0.0))
    return engine, engine.joint("m::j")


@pytest.mark.parametrize("steps", [1, 100])
def test_effort_ends_in_the_step_after_the_one_that_passed_the_velocity_limit(steps):
    """Joint::CheckAndTruncateForce in Gazebo: 1 mm/s a step of weight, and as much of effort."""
    engine, handle = cart(velocity=0.005)
    handle.set_effort(1.0)
    for _ in range(100 // steps):
        engine.step(steps)
    assert handle.velocity == pytest.approx(0.006 + 0.097, rel=1e-6)
    assert handle.effort == 1.0
    handle.set_effort(-2.0)
    engine.step(3)
    assert handle.velocity == pytest.approx(0.1, rel=1e-6)


def test_velocity_limit_does_not_hold_what_no_effort_drives():
    engine, handle = cart(velocity=0.0)
    engine.step(100)
    assert handle.velocity == pytest.approx(0.1, rel=1e-6)
    handle.set_effort(1.0)
    engine.step(100)
    assert handle.velocity == pytest.approx(0.2, rel=1e-6)


def test_effort_turns_a_joint_without_a_limit_by_a_quarter_turn_a_step():
    """Faster turning would throw light robots about."""
    found = Diagnostics()
    feather = Inertial(1e-6, inertia_kg_m2=(1e-9, 0, 0, 1e-9, 0, 1e-9))
    joint = Joint("spin", JointType.CONTINUOUS, "world", "rim", axis=Z)
    engine = engine_of(Model("m", links=(Link("rim", inertial=feather),), joints=(joint,)), found)
    handle = engine.joint("m::spin")
    handle.set_effort(1e-3)
    engine.step(1)
    assert handle.velocity == pytest.approx(1000.0, rel=1e-6)
    assert not found.by_code("engine.quarter-turn")
    engine.step(100)
    engine.delete("m")
    engine.spawn(Model("m", links=(Link("rim", inertial=feather),), joints=(joint,)))
    again = engine.joint("m::spin")
    again.set_effort(-1e-3)
    engine.step(100)
    assert (handle.velocity, again.velocity) == pytest.approx((-2000.0, -2000.0), rel=1e-6)
    assert [item.message for item in found.by_code("engine.quarter-turn")] == [
        "joint 'spin' of model 'm' turns by more than a quarter turn in a step (2000 rad/s);"
        " its effort does nothing while it is that fast"
    ]


def test_light_finger_presses_with_all_its_effort(build):
    """An effort counts less where it would throw a joint, not where something holds it."""
    tip = build.ball("tip", mass=0.02, radius=0.05).links[0]
    axis = JointAxis((1, 0, 0), lower=-1.0, upper=1.0, velocity=0.2)
    joint = Joint("j", JointType.PRISMATIC, "world", "link", axis=axis)
    finger = Model("finger", links=(tip,), joints=(joint,))
    wall = replace(build.block("wall", Pose((0.3, 0.0, 0.0))), static=True)
    engine = build.engine(finger, wall, gravity_m_s2=(0.0, 0.0, 0.0))
    handle = engine.joint("finger::j")
    handle.set_effort(20.0)
    engine.step(800)
    assert handle.position == pytest.approx(0.15, abs=5e-3)
    assert handle.effort == 20.0
    forces_n = []
    for _ in range(100):
        engine.step()
        forces_n += [abs(touch.forces_n[:, 0].sum()) for touch in engine.contacts()]
    assert sum(forces_n) / 100 == pytest.approx(20.0, rel=0.01)


def test_joint_that_its_stops_hold_is_not_said_to_turn_by_a_quarter_turn():
    found = Diagnostics()
    feather = Inertial(1e-6, inertia_kg_m2=(1e-8, 0, 0, 1e-8, 0, 1e-8))
    axis = JointAxis((0, 0, 1), lower=-1.0, upper=1.0)
    joint = Joint("flap", JointType.REVOLUTE, "world", "leaf", axis=axis)
    engine = engine_of(Model("m", links=(Link("leaf", inertial=feather),), joints=(joint,)), found)
    handle = engine.joint("m::flap")
    # 200 rad/s a step, were it free: an eighth of a quarter turn.
    handle.set_effort(2e-3)
    engine.step(50)
    assert handle.position == pytest.approx(1.0, abs=0.11)
    assert not found.by_code("engine.quarter-turn")


def test_step_that_holds_nothing_back_is_an_ordinary_step(build):
    """To the bit, so that what is looked at does not change what happens."""
    hashes = []
    for visuals in (False, True):
        engine = build.engine(build.ground(), build.arm(name="arm"), build.ball("ball"))
        joint = engine.joint("arm::joint")
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(VelocityLimits, "throws", lambda *_, visuals=visuals: visuals)
            for step in range(300):
                joint.set_effort(0.3 * math.sin(0.1 * step))
                engine.step()
        hashes.append(engine.state_hash())
    assert hashes[0] == hashes[1]


def test_light_castors_under_efforts_do_not_throw_their_robot_about():
    """0.5 N·m on each joint of a fork and a wheel, each a few grams: they spin on the spot."""
    light = Inertial(0.02, inertia_kg_m2=(2e-6, 0, 0, 2e-6, 0, 2e-6))
    body = Inertial(2.0, inertia_kg_m2=(0.02, 0, 0, 0.02, 0, 0.02))
    links = (
        Link("body", inertial=body),
        Link("fork", Pose((0.1, 0, 0)), inertial=light),
        Link("wheel", Pose((0.12, 0, -0.02)), inertial=light),
    )
    joints = (
        Joint("fork", JointType.CONTINUOUS, "body", "fork", Pose((0.1, 0, 0)), axis=Z),
        Joint(
            "wheel", JointType.CONTINUOUS, "fork", "wheel", Pose((0.12, 0, -0.02)),
            axis=JointAxis((0, 1, 0)),
        ),
    )  # fmt: skip
    engine = engine_of(Model("m", links=links, joints=joints), gravity_m_s2=(0.0, 0.0, 0.0))
    for name in ("fork", "wheel"):
        engine.joint(f"m::{name}").set_effort(0.5)
    engine.step(3000)
    for name in ("fork", "wheel"):
        assert abs(engine.joint(f"m::{name}").velocity) < 5000.0


def test_velocity_limits_are_those_of_the_models_that_are_there():
    engine, handle = cart(velocity=0.005)
    handle.set_effort(1.0)
    state = engine.save_state()
    engine.step(100)
    faster, speed = engine.state_hash(), handle.velocity
    engine.delete("m")
    engine.step(1)
    engine.restore_state(state)
    engine.step(100)
    assert (engine.state_hash(), handle.velocity) == (faster, speed)


def test_universal_joint_has_two_axes():
    joint = Joint(
        "j", JointType.UNIVERSAL, "world", "stick", axis=JointAxis((1, 0, 0)),
        axis2=JointAxis((0, 1, 0)),
    )  # fmt: skip
    engine = engine_of(Model("m", links=(Link("stick", inertial=SMALL),), joints=(joint,)))
    engine.joint("m::j", axis=1).set_state(0.2)
    engine.joint("m::j").set_state(0.1)
    turned = Pose.from_xyz_rpy((0, 0, 0), (0.1, 0, 0)) @ Pose.from_xyz_rpy((0, 0, 0), (0, 0.2, 0))
    assert engine.link("m::stick").T_world_link().quat_xyzw == pytest.approx(turned.quat_xyzw)


def swinging(kind, *axes, **more):
    """A link whose centre of mass is off every axis of its joint, let go from rest."""
    bob = Link("bob", inertial=Inertial(1.0, Pose((0.1, -0.1, 0.1)), (6e-3, 0, 0, 6e-3, 0, 1e-3)))
    names = dict(zip(("axis", "axis2"), (JointAxis(xyz) for xyz in axes), strict=False))
    joint = Joint("j", kind, "world", "bob", **names, **more)
    return Model("m", links=(bob,), joints=(joint,))


@pytest.mark.parametrize(
    "model",
    [
        swinging(JointType.BALL),
        swinging(JointType.UNIVERSAL, (1, 0, 0), (0, 1, 0)),
        swinging(JointType.REVOLUTE2, (1, 0, 0), (0, 0, 1)),
        swinging(JointType.UNIVERSAL, (0, 1, 0), (0, 1, 0)),
        swinging(JointType.SCREW, (0, 1, 0), thread_pitch_rad_m=20.0),
    ],
    ids=["ball", "universal", "revolute2", "parallel", "screw"],
)
def test_link_that_swings_in_space_never_gains_energy(model):
    engine = engine_of(model)
    engine.model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_ENERGY)
    energies = []
    for _ in range(60):
        engine.step(1000)
        data = copy.copy(engine.data)
        mujoco.mj_forward(engine.model, data)
        energies.append(float(data.energy.sum()))
    # At rest it was 0.1 m above its joint.
    assert max(energies) < 1.01 * 9.8 * 0.1
    assert min(energies) > -1.01 * 9.8 * 0.18


def test_axes_in_one_direction_are_one_axis():
    found = Diagnostics()
    engine = engine_of(swinging(JointType.UNIVERSAL, (0, 0, 1), (0, 0, -1)), found)
    assert [item.message for item in found.by_code("engine.parallel-axes")] == [
        "both axes of universal joint 'j' have the same direction; it turns about one"
    ]
    assert engine.joint("m::j").is_driveable
    assert not engine.joint("m::j", axis=1).is_driveable


def test_planar_joint_moves_in_its_plane_only():
    joint = Joint("j", JointType.PLANAR, "world", "puck", axis=JointAxis((0, 0, 1)))
    engine = engine_of(Model("m", links=(Link("puck", inertial=SMALL),), joints=(joint,)))
    engine.link("m::puck").apply_wrench((1.0, 2.0, 5.0))
    engine.step(1000)
    x, y, z = engine.link("m::puck").T_world_link().position_m
    assert (x, y, z) == pytest.approx((0.5, 1.0, 0.0), rel=2e-3, abs=1e-9)


def test_ball_joint_swings_both_ways():
    point = Inertial(1.0, Pose((0, 0, -1)), (1e-6, 0, 0, 1e-6, 0, 1e-6))
    joint = Joint("j", JointType.BALL, "world", "bob")
    engine = engine_of(Model("m", links=(Link("bob", inertial=point),), joints=(joint,)))
    engine.link("m::bob").apply_wrench((1.0, 1.0, 0), duration_ns=100_000_000)
    engine.step(200)
    x, y, z = engine.link("m::bob").com_world()
    assert x == pytest.approx(y, rel=1e-6) and x > 0.005
    assert math.hypot(x, y, z) == pytest.approx(1.0, rel=1e-6)


def test_floating_joint_in_the_world_is_free():
    joint = Joint("j", JointType.FLOATING, "world", "a")
    engine = engine_of(Model("m", links=(Link("a", inertial=SMALL),), joints=(joint,)))
    engine.step(1000)
    assert engine.link("m::a").T_world_link().position_m[2] == pytest.approx(-4.9, rel=2e-3)


def test_four_bar_loop_stays_closed():
    def bar(name, x, y):
        return Link(
            name, Pose((x, 0, y)), inertial=Inertial(1.0, inertia_kg_m2=(0.1, 0, 0, 0.1, 0, 0.1))
        )

    hinge = JointAxis((0, 1, 0))
    joints = (
        Joint("a", JointType.CONTINUOUS, "world", "left", Pose((0, 0, 0)), axis=hinge),
        Joint("b", JointType.CONTINUOUS, "world", "right", Pose((1, 0, 0)), axis=hinge),
        Joint("c", JointType.CONTINUOUS, "left", "top", Pose((0, 0, 1)), axis=hinge),
        Joint("d", JointType.CONTINUOUS, "right", "top", Pose((1, 0, 1)), axis=hinge),
    )
    links = (bar("left", 0, 0), bar("right", 1, 0), bar("top", 0, 1))
    engine = engine_of(Model("four", links=links, joints=joints))
    engine.joint("four::a").set_velocity_target(0.5, 100.0)
    engine.step(2000)
    left, right = engine.joint("four::a"), engine.joint("four::b")
    assert left.position == pytest.approx(1.0, abs=0.02)
    assert right.position == pytest.approx(left.position, abs=1e-3)
    assert not engine.joint("four::d").is_driveable


def test_fixed_loop_welds_two_chains():
    links, joints = discs()
    weld = Joint("weld", JointType.FIXED, "disc0", "disc1")
    engine = engine_of(Model("pair", links=tuple(links), joints=(*joints, weld)))
    engine.joint("pair::joint0").set_effort(0.1)
    engine.step(1000)
    assert abs(engine.joint("pair::joint0").position) < 1e-2


def test_prismatic_loop_lets_its_links_slide_only():
    """Two carriages on rails of their own, tied to each other across the rails."""
    x, y = JointAxis((1, 0, 0)), JointAxis((0, 1, 0))
    links = tuple(Link(name, Pose((0, i, 0)), inertial=SMALL) for i, name in enumerate("ab"))
    rails = (
        Joint("rail_a", JointType.PRISMATIC, "world", "a", axis=x),
        Joint("rail_b", JointType.PLANAR, "world", "b", Pose((0, 1, 0)), axis=Z),
    )
    loop = Joint("tie", JointType.PRISMATIC, "a", "b", Pose((0, 1, 0)), axis=y)
    engine = engine_of(Model("m", links=links, joints=(*rails, loop)))
    engine.joint("m::rail_a").set_effort(1.0)
    engine.joint("m::tie").set_effort(0.5)
    engine.step(1000)
    first, second = (engine.link(f"m::{name}").T_world_link() for name in "ab")
    assert first.position_m[0] == pytest.approx(0.25, rel=0.02)
    assert second.position_m[0] == pytest.approx(first.position_m[0], abs=1e-3)
    assert second.position_m[1] == pytest.approx(1.25, rel=0.02)
    assert engine.joint("m::tie").position == pytest.approx(0.25, rel=0.02)
    assert second.rpy_rad[2] == pytest.approx(0.0, abs=1e-3)


def test_screw_loop_turns_what_slides():
    z = JointAxis((0, 0, 1))
    links = (Link("nut", inertial=SMALL), Link("spindle", inertial=SMALL))
    joints = (
        Joint("slide", JointType.PRISMATIC, "world", "nut", axis=z),
        Joint("turn", JointType.CONTINUOUS, "world", "spindle", axis=z),
        Joint("thread", JointType.SCREW, "nut", "spindle", axis=z, thread_pitch_rad_m=10.0),
    )
    engine = engine_of(Model("m", links=links, joints=joints), gravity_m_s2=(0, 0, 0))
    engine.joint("m::turn").set_effort(0.02)
    engine.step(1000)
    turned = engine.joint("m::turn").position
    assert turned == pytest.approx(0.5 * 0.02 / (0.01 + 1.0 / 10.0**2), rel=0.05)
    assert engine.joint("m::slide").position == pytest.approx(-turned / 10.0, rel=1e-2)


def test_joint_of_the_world_ties_two_models():
    def cube(name, x):
        return Model(name, Pose((x, 0, 0)), links=(Link("l", inertial=SMALL),))

    tie = Joint("tie", JointType.FIXED, "a::l", "b::l")
    engine = Engine(
        World(models=(cube("a", 0), cube("b", 1)), joints=(tie,), gravity_m_s2=(0, 0, 0))
    )
    engine.link("a::l").apply_wrench((2.0, 0, 0))
    engine.step(1000)
    a, b = (engine.model_pose(name).position_m[0] for name in "ab")
    assert b - a == pytest.approx(1.0, abs=1e-3)
    assert b == pytest.approx(1.5, rel=0.01)


def test_fixed_joint_cannot_be_driven():
    joint = Joint("j", JointType.FIXED, "world", "a")
    engine = engine_of(Model("m", links=(Link("a", inertial=SMALL),), joints=(joint,)))
    with pytest.raises(EngineError, match=r"joint 'm::j' \(fixed\) has no single coordinate"):
        engine.joint("m::j").set_effort(1.0)
    assert engine.joint("m::j").position == 0.0


def test_effort_that_is_not_finite_is_refused(build):
    engine = build.engine(build.wheel())
    with pytest.raises(EngineError, match="was given nan: a finite number is needed"):
        engine.joint("wheel::joint").set_effort(math.nan)


@pytest.mark.parametrize("inertia", [1e-8, 1e-6, 1e-3])
def test_friction_holds_a_joint_against_less_effort_whatever_its_inertia(build, inertia):
    engine = build.engine(build.wheel(inertia=inertia, friction=10.0))
    joint = engine.joint("wheel::joint")
    joint.set_effort(9.0)
    engine.step(1000)
    assert abs(joint.position) < 0.1
    joint.set_effort(12.0)
    engine.step(100)
    assert joint.position > 0.05
