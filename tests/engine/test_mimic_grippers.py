"""Grippers whose fingers follow one joint, on arms that hold and that fall."""

from __future__ import annotations

import copy

import mujoco
import numpy as np
import pytest

from gazelle.description.model import Inertial, Joint, JointAxis, JointType, Link, Mimic, Model
from gazelle.geometry import Pose

FOLLOWERS = {"b": 1.0, "c": -1.0, "d": 1.0}


def gripper(damping: float = 0.0, arm: JointType = JointType.REVOLUTE) -> Model:
    """A link on the world with four light fingers, as light as a Robotiq 2F-85's."""
    palm = Inertial(1.0, Pose((0, 0, 0.3)), (1e-3, 0, 0, 1e-3, 0, 1e-3))
    finger = Inertial(0.01, Pose((0, 0.02, 0)), (1e-6, 0, 0, 1e-6, 0, 1e-6))
    links = [Link("palm", inertial=palm)]
    joints = [Joint("arm", arm, "world", "palm", axis=JointAxis((1, 0, 0)))]
    for name in ("a", *FOLLOWERS):
        mimic = Mimic("a", FOLLOWERS[name], 0.0) if name in FOLLOWERS else None
        axis = JointAxis((1, 0, 0), lower=-1.5, upper=1.5, effort=10.0, damping=damping)
        pose = Pose((0, 0, 0.4))
        links.append(Link(name, pose, inertial=finger))
        joints.append(Joint(name, JointType.REVOLUTE, "palm", name, pose, axis=axis, mimic=mimic))
    return Model("gripper", links=tuple(links), joints=tuple(joints))


def fingers(engine):
    group = engine.joint_group([f"gripper::{name}" for name in ("a", *FOLLOWERS)])
    position, velocity = np.empty((2, 4))
    group.read(position, velocity)
    signs = np.array([1.0, *FOLLOWERS.values()])
    return position * signs, velocity * signs


@pytest.mark.parametrize("damping", [0.0, 0.1, 1.0])
def test_fingers_follow_a_driven_one_however_damped(build, damping):
    engine = build.engine(gripper(damping, JointType.FIXED))
    engine.joint("gripper::a").set_velocity_target(1.0, 5.0)
    engine.step(10)
    for _ in range(500):
        engine.step()
        position, velocity = fingers(engine)
        assert np.ptp(position) < 5e-6
        assert velocity == pytest.approx(np.ones(4), abs=2e-3)


def test_motor_of_a_light_damped_joint_reaches_its_speed_at_once(build):
    engine = build.engine(build.wheel(inertia=1e-6, damping=1.0))
    joint = engine.joint("wheel::joint")
    joint.set_velocity_target(2.0, 5.0)
    engine.step(3)
    assert joint.velocity == pytest.approx(2.0, rel=1e-3)
    assert joint.effort == pytest.approx(2.0, rel=1e-2)


def test_damping_acts_on_the_speed_at_the_end_of_a_step(build):
    engine = build.engine(build.wheel(inertia=0.01, damping=5.0), step_s=0.01)
    joint = engine.joint("wheel::joint")
    joint.set_state(velocity=3.0)
    engine.step(2)
    assert joint.velocity == pytest.approx(3.0 / (1 + 0.01 * 5.0 / 0.01) ** 2, rel=1e-9)


def test_falling_arm_with_mimic_fingers_keeps_its_energy(build):
    """Fingers that swing on a falling, undamped arm are fast, but gain nothing."""
    engine = build.engine(gripper())
    engine.model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_ENERGY)
    engine.joint("gripper::arm").set_state(0.5)
    engine.joint("gripper::a").set_state(0.05)
    for name, factor in FOLLOWERS.items():
        engine.joint(f"gripper::{name}").set_state(0.05 * factor)
    energies, fastest = [], 0.0
    for _ in range(40):
        engine.step(10)
        data = copy.copy(engine.data)
        mujoco.mj_forward(engine.model, data)
        energies.append(float(data.energy.sum()))
        position, _ = fingers(engine)
        assert np.ptp(position) < 1e-5
        fastest = max(fastest, engine.link("gripper::b").velocity_world().linear_m_s[1])
    assert fastest > 1.0
    assert np.ptp(energies) < 1.5e-2 * abs(energies[0])
