"""Motors: velocity with a torque limit, position, release."""

from __future__ import annotations

import math

import pytest

from gazelle.geometry import Pose


def test_motor_accelerates_with_its_torque_over_inertia(build):
    engine = build.engine(build.wheel(inertia=0.01))
    joint = engine.joint("wheel::joint")
    joint.set_velocity_target(10.0, 0.05)
    engine.step(500)
    assert joint.velocity == pytest.approx(0.05 / 0.01 * 0.5, rel=1e-3)
    assert joint.effort == pytest.approx(0.05, rel=1e-3)


@pytest.mark.parametrize("inertia", [1e-6, 1e-3, 1.0])
def test_strong_motor_reaches_its_speed_without_overshoot(build, inertia):
    engine = build.engine(build.wheel(inertia=inertia))
    joint = engine.joint("wheel::joint")
    joint.set_velocity_target(4.0, 1e4)
    speeds = []
    for _ in range(100):
        engine.step()
        speeds.append(joint.velocity)
    assert max(speeds) < 4.001
    assert speeds[-1] == pytest.approx(4.0, abs=1e-3)


def test_motor_keeps_its_speed_under_load_and_yields_beyond_its_torque(build):
    engine = build.engine(build.wheel(inertia=0.01))
    joint = engine.joint("wheel::joint")
    joint.set_velocity_target(4.0, 1.0)
    joint.set_effort(-0.9)
    engine.step(1000)
    assert joint.velocity == pytest.approx(4.0, rel=1e-2)
    joint.set_effort(-1.5)
    before = joint.velocity
    engine.step(100)
    assert joint.velocity - before == pytest.approx(-0.5 / 0.01 * 0.1, rel=0.02)


def test_released_motor_coasts(build):
    engine = build.engine(build.wheel())
    joint = engine.joint("wheel::joint")
    joint.set_velocity_target(4.0, 1.0)
    engine.step(500)
    joint.release()
    engine.step(2000)
    assert joint.velocity == pytest.approx(4.0, rel=1e-3)
    assert joint.effort == 0.0


def test_motor_reacts_on_what_carries_it(build):
    """Angular momentum: a free body with a wheel turns the other way."""
    from gazelle.description.model import Inertial, Joint, JointAxis, JointType, Link, Model

    def inertial(value):
        return Inertial(1.0, inertia_kg_m2=(value, 0, 0, value, 0, value))

    joint = Joint("j", JointType.CONTINUOUS, "body", "wheel", axis=JointAxis())
    links = (Link("body", inertial=inertial(0.03)), Link("wheel", inertial=inertial(0.01)))
    engine = build.engine(Model("sat", links=links, joints=(joint,)), gravity_m_s2=(0, 0, 0))
    engine.joint("sat::j").set_velocity_target(4.0, 10.0)
    engine.step(100)
    assert engine.link("sat::body").velocity_world().angular_rad_s[2] == pytest.approx(
        -1.0, rel=1e-3
    )


def test_position_motor_goes_there_and_holds(build):
    engine = build.engine(build.arm(mass=2.0))
    joint = engine.joint("arm::joint")
    joint.set_position_target(1.0, max_velocity=2.0)
    engine.step(1000)
    assert joint.position == pytest.approx(1.0, abs=1e-4)
    engine.step(20000)
    assert joint.position == pytest.approx(1.0, abs=1e-4)
    assert joint.effort == pytest.approx(2 * build.G * math.sin(1.0), rel=1e-2)


def test_position_motor_yields_beyond_its_effort(build):
    engine = build.engine(build.arm(mass=2.0))
    joint = engine.joint("arm::joint")
    joint.set_state(1.5)
    joint.set_position_target(1.5, max_effort=5.0)
    lowest = math.inf
    for _ in range(100):
        engine.step(20)
        lowest = min(lowest, joint.position)
    assert lowest < 0.2


def test_zero_velocity_motor_lets_a_robot_sleep_and_wakes_it(build):
    engine = build.engine(build.wheel())
    joint = engine.joint("wheel::joint")
    joint.set_velocity_target(0.0, 1.0)
    engine.step(200)
    body = engine.body_id("wheel::disc")
    assert engine.is_asleep(body)
    joint.set_velocity_target(2.0, 1.0)
    engine.step(100)
    assert joint.velocity == pytest.approx(2.0, rel=1e-3)


def test_commands_survive_recompiles(build):
    engine = build.engine(build.wheel())
    joint = engine.joint("wheel::joint")
    joint.set_velocity_target(3.0, 1.0)
    engine.step(500)
    engine.spawn(build.block(pose=Pose((9, 0, 9))))
    engine.step(500)
    assert joint.velocity == pytest.approx(3.0, rel=1e-3)


def test_max_effort_respects_the_joints_own_limit(build):
    engine = build.engine(build.wheel(inertia=0.01, effort=0.02))
    joint = engine.joint("wheel::joint")
    joint.set_velocity_target(10.0, 5.0)
    engine.step(500)
    assert joint.velocity == pytest.approx(0.02 / 0.01 * 0.5, rel=1e-3)


def test_effort_limit_of_zero_stops_efforts_but_not_motors(build):
    """Gazebo's SetForce clamps to it, ODE's fmax does not know it."""
    engine = build.engine(build.wheel(effort=0.0))
    joint = engine.joint("wheel::joint")
    joint.set_effort(1.0)
    engine.step(100)
    assert joint.velocity == 0.0
    joint.set_velocity_target(1.0, 1.0)
    engine.step(100)
    assert joint.velocity == pytest.approx(1.0, rel=1e-3)


def test_robot_that_holds_a_position_can_sleep(build):
    engine = build.engine(build.arm(mass=2.0))
    engine.joint("arm::joint").set_position_target(0.4)
    engine.step(3000)
    assert engine.is_asleep(engine.body_id("arm::rod"))
    assert engine.joint("arm::joint").position == pytest.approx(0.4, abs=1e-5)
