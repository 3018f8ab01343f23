"""Joints that follow others by a plug-in."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from tests.simulator.plugins.test_pushing import lever

from gazelle.simulator import Simulation

Load = Callable[..., Simulation]
LIBRARY = "libroboticsgroup_upatras_gazebo_mimic_joint_plugin.so"
KEYS = "<joint>one_joint</joint><mimicJoint>two_joint</mimicJoint><multiplier>2</multiplier>"


def test_a_mimic_of_the_description_goes_before_the_plug_in(load: Load) -> None:
    robot = lever(LIBRARY, KEYS + "<hasPID/><maxEffort>1</maxEffort>")
    place = robot.index("</joint>", robot.index('"two_joint"'))
    robot = f'{robot[:place]}<mimic joint="one_joint" multiplier="-1"/>{robot[place:]}'
    sim = load(robot, world=None)
    sim.joint("one_joint").handle.set_state(velocity=1.0)
    sim.run(seconds=0.5)
    one = sim.joint("one_joint").position
    assert one > 0.1
    assert sim.joint("two_joint").position == pytest.approx(-one, abs=1e-3)


def test_a_joint_within_the_sensitiveness_is_left_alone(load: Load) -> None:
    sim = load(lever(LIBRARY, KEYS + "<sensitiveness>0.1</sensitiveness>"), world=None)
    sim.joint("one_joint").handle.set_state(position=0.04)
    sim.run(seconds=0.1)
    assert sim.joint("two_joint").position == 0.0
    sim.joint("one_joint").handle.set_state(position=0.2)
    sim.run(seconds=0.1)
    assert sim.joint("two_joint").position == pytest.approx(0.4, abs=1e-3)


def test_a_joint_that_is_missing_leaves_the_plug_in_out(load: Load) -> None:
    sim = load(lever(LIBRARY, KEYS.replace("two_joint", "tow_joint")), world=None)
    (found,) = sim.diagnostics.by_code("plugin.missing-joint")
    assert "needs joint 'tow_joint'" in found.message
    assert found.fix.startswith("did you mean 'two_joint'")
