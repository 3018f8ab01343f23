"""ROS 1's effort controller on a pendulum arm in the simulator, through libgazebo_ros_control."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.control.trajectory_messages import goal, point, trajectory

from gazelle.control.trajectory.waypoints import ErrorCode
from gazelle.simulator import Simulation

JOINTS = ("shoulder", "elbow")
ACTION = "/arm/trajectory_controller/follow_joint_trajectory"
REST = [0.0, 0.0]

_LINK = """
  <link name="{name}"><inertial><origin xyz="0 0 0.2"/><mass value="1"/>
    <inertia ixx="0.02" iyy="0.02" izz="0.002" ixy="0" ixz="0" iyz="0"/></inertial></link>
"""
_JOINT = """
  <joint name="{name}" type="revolute"><parent link="{parent}"/><child link="{child}"/>
    <origin xyz="0 0 {z}"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" effort="60" velocity="10"/></joint>
  <transmission name="{name}_transmission"><type>transmission_interface/SimpleTransmission</type>
    <joint name="{name}">
      <hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>
    <actuator name="{name}_motor"><mechanicalReduction>1</mechanicalReduction></actuator>
  </transmission>
"""
URDF = "".join(
    [
        '<robot name="arm"><link name="world"/><link name="base"/>',
        '<joint name="fixed" type="fixed"><parent link="world"/><child link="base"/></joint>',
        *(_LINK.format(name=name) for name in ("upper", "lower")),
        _JOINT.format(name="shoulder", parent="base", child="upper", z=1.0),
        _JOINT.format(name="elbow", parent="upper", child="lower", z=0.4),
        '<gazebo><plugin name="control" filename="libgazebo_ros_control.so"/></gazebo></robot>',
    ]
)
GAINS = {"p": 400.0, "i": 300.0, "d": 30.0, "i_clamp": 30.0}
PARAMETERS = {
    "/arm/trajectory_controller": {
        "type": "effort_controllers/JointTrajectoryController",
        "joints": list(JOINTS),
        "gains": dict.fromkeys(JOINTS, GAINS),
        "constraints": {"goal_time": 1.0, "shoulder": {"trajectory": 0.2, "goal": 0.02}},
        "stop_trajectory_duration": 0.3,
    }
}


@pytest.fixture
def sim() -> Any:
    with Simulation.load(URDF, world=None, parameters=PARAMETERS) as made:
        manager = made.controller_manager()
        manager.load("trajectory_controller")
        manager.start("trajectory_controller")
        yield made


def positions(sim: Simulation) -> np.ndarray:
    return np.array([sim.joint(name).position for name in JOINTS])


def send(sim: Simulation, time_s: float, target: list[float], **tolerances: Any) -> Any:
    message = trajectory(JOINTS, point(time_s, target, REST, REST))
    return sim.send_goal(ACTION, goal(message, **tolerances))


def test_it_follows_against_gravity_and_succeeds(sim: Simulation) -> None:
    states: list[Any] = []
    sim.subscribe("/arm/trajectory_controller/state", states.append)
    sim.run(seconds=0.1)
    sent = send(sim, 2.0, [1.0, -0.8])
    sim.run(seconds=2.8)
    assert sent.status.name == "SUCCEEDED"
    assert sent.result.error_code == ErrorCode.SUCCESSFUL
    assert positions(sim) == pytest.approx([1.0, -0.8], abs=0.02)
    assert len(states) == pytest.approx(2.9 * 50, abs=2)
    errors = np.array([state.error.positions for state in states])
    assert 1e-4 < np.abs(errors).max() < 0.05


def test_leaving_the_path_aborts(sim: Simulation) -> None:
    sent = send(sim, 0.2, [2.5, 0.0])
    sim.run(seconds=0.3)
    assert sent.status.name == "ABORTED"
    assert sent.result.error_code == ErrorCode.PATH_TOLERANCE_VIOLATED
    assert sent.result.error_string.startswith("shoulder path error ")


def test_a_new_goal_preempts_and_cancelling_stops(sim: Simulation) -> None:
    first = send(sim, 2.0, [1.0, 0.5])
    sim.run(seconds=1.0)
    second = send(sim, 2.0, [0.0, 0.0])
    assert first.status.name == "PREEMPTED"
    sim.run(seconds=1.0)
    second.cancel()
    sim.run(seconds=0.4)
    assert second.status.name == "PREEMPTED"
    held = positions(sim)
    sim.run(seconds=1.0)
    np.testing.assert_allclose(positions(sim), held, atol=0.05)
    assert held[0] > 0.2


def test_a_topics_command_moves_it(sim: Simulation) -> None:
    sim.publish(
        "/arm/trajectory_controller/command", trajectory(JOINTS, point(1.0, [0.4, 0.4], REST))
    )
    sim.run(seconds=2.0)
    np.testing.assert_allclose(positions(sim), [0.4, 0.4], atol=0.02)
