"""MIRA with its controllers: holds itself up, follows commands, takes gains live (M8–M11)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.control.serial_chain import gravity_effort, mass_matrix, read_chain
from tests.patience import stretched

from gazelle.geometry import Pose
from gazelle.interfaces import message_type, ros1_message_type, ros1_service_type, service_type
from gazelle.simulator import Simulation

pytestmark = pytest.mark.tutorial

_CONTROLLERS = (
    "roll_joint_position_controller",
    "pitch_joint_position_controller",
    "yaw_joint_position_controller",
    "joint_state_controller",
)
_ROLL = "/mira/roll_joint_position_controller"
_EFFORT_LIMIT_NM, _VELOCITY_LIMIT_RAD_S, _P = 0.1, 0.005, 1.0


@pytest.fixture
def mira(workspaces_dir: Path) -> Iterator[Simulation]:
    """MIRA on the ground with its controllers running, in this process."""
    package = workspaces_dir / "catkin_ws/src/urdf_exam"
    with Simulation.load(
        package / "urdf/mira_gazebo_controller.urdf",
        pose=Pose((0.0, 0.0, 0.045)),
        parameters=package / "config/mira_control.yaml",
    ) as sim:
        manager = sim.controller_manager("/mira")
        for name in _CONTROLLERS:
            manager.spawn(name)
        yield sim


def test_launch_starts_controllers_before_time_does_and_mira_stays_up(
    in_workspace: Callable,
) -> None:
    robot = in_workspace("roslaunch", "urdf_exam", "mira_spawn_controller.launch", "--fast")
    robot.wait_for_line(r"Started controllers: .*joint_state_controller")
    kind = ros1_service_type("controller_manager_msgs/ListControllers")
    client = robot.node.create_client("/mira/controller_manager/list_controllers", kind)
    listed = client.call(kind._request_class(), timeout_s=stretched())
    assert [(row.name, row.state) for row in listed.controller] == [
        (name, "running") for name in _CONTROLLERS
    ]
    world = robot.call("/gazebo/get_world_properties", "gazebo_msgs/srv/GetWorldProperties")
    assert world.sim_time == 0.0
    (said,) = [line for line in robot.lines if "roll_joint_position_controller/pid/i'" in line]
    assert "no i_clamp" in said

    robot.call("/gazebo/unpause_physics", "std_srvs/srv/Empty")
    states = robot.messages({"/mira/joint_states": 101})["/mira/joint_states"]
    stamps_ns = [m.header.stamp.sec * 10**9 + m.header.stamp.nanosec for m in states]
    assert set(np.diff(stamps_ns)) == {20_000_000}
    assert states[-1].name == ["roll_joint", "pitch_joint", "yaw_joint"]
    # Without controllers pitch and roll fall to their limits, 0.44 and −0.2, within 1.5 s.
    assert np.abs(states[-1].position).max() < 0.01
    frames = {t.child_frame_id for m in robot.messages({"/tf": 20})["/tf"] for t in m.transforms}
    assert {"roll_M1_link", "pitch_M2_link", "yaw_M3_link"} <= frames

    publisher = robot.node.create_publisher(f"{_ROLL}/command", "std_msgs/msg/Float64", latch=True)
    publisher.publish(message_type("std_msgs/Float64")(data=0.1))

    def roll() -> float:
        return float(robot.messages({"/mira/joint_states": 1})["/mira/joint_states"][0].position[0])

    robot.eventually(lambda: abs(roll() - 0.1) < 2e-3)

    words = ("rosrun", "dynamic_reconfigure", "dynparam")
    assert in_workspace(*words, "set", f"{_ROLL}/pid", "p", "5.0", port=robot.port).wait() == 0
    told = in_workspace(*words, "get", f"{_ROLL}/pid", port=robot.port)
    assert told.wait() == 0
    assert "'p': 5.0" in told.text


def test_roll_joint_moves_as_an_independent_integration_does(
    mira: Simulation, workspaces_dir: Path
) -> None:
    urdf = workspaces_dir / "catkin_ws/src/urdf_exam/urdf/mira_gazebo_controller.urdf"
    chain = read_chain(urdf, "base_link")
    inertia = mass_matrix(chain, np.zeros(3))[0, 0]
    # The joint's axis lies level: gravity's effort is a sine of the angle.
    upright = gravity_effort(chain, np.zeros(3))[0]
    lying = gravity_effort(chain, np.array([np.pi / 2, 0.0, 0.0]))[0]

    mira.run(seconds=1.0)
    joint, h = mira.joint("roll_joint"), mira.step_s
    q, v = joint.position, joint.velocity
    effort = _effort(0.0, q, v)
    mira.publish(f"{_ROLL}/command", message_type("std_msgs/Float64")(data=0.1))
    reference, simulated = [], []
    for _ in range(3000):
        v += h * (effort + upright * np.cos(q) + lying * np.sin(q)) / inertia
        q += h * v
        effort = _effort(0.1, q, v)
        mira.step()
        reference.append(q)
        simulated.append(joint.position)
    assert np.ptp(reference) > 0.1
    assert np.abs(np.array(simulated) - reference).max() < 2e-4
    assert abs(mira.joint("pitch_joint").position) < 1e-4


def _effort(command: float, q: float, v: float) -> float:
    """PID without effect of i (no i_clamp), and joint limits as EffortJointSaturationHandle."""
    highest = 0.0 if v > _VELOCITY_LIMIT_RAD_S else _EFFORT_LIMIT_NM
    lowest = 0.0 if v < -_VELOCITY_LIMIT_RAD_S else -_EFFORT_LIMIT_NM
    return min(max(_P * (command - q), lowest), highest)


def test_gains_changed_live_change_the_effort_of_the_next_update(mira: Simulation) -> None:
    joint = mira.joint("roll_joint")
    mira.publish(f"{_ROLL}/command", message_type("std_msgs/Float64")(data=0.1))
    mira.step(3)
    assert joint.effort == pytest.approx(_effort(0.1, joint.position, joint.velocity), abs=1e-9)
    _set_gain(mira, "p", 0.3)
    mira.reset()
    mira.publish(f"{_ROLL}/command", message_type("std_msgs/Float64")(data=0.1))
    mira.step()
    soft = joint.effort
    _set_gain(mira, "p", 0.6)
    mira.reset()
    mira.publish(f"{_ROLL}/command", message_type("std_msgs/Float64")(data=0.1))
    mira.step()
    assert soft == pytest.approx(0.03, rel=0.02)
    assert joint.effort == pytest.approx(2 * soft, rel=1e-6)


def _set_gain(mira: Simulation, name: str, value: float) -> None:
    reconfigure = service_type("dynamic_reconfigure/Reconfigure")
    request = reconfigure.Request()
    row = message_type("dynamic_reconfigure/DoubleParameter")
    request.config.doubles = [row(name=name, value=value)]
    answer = mira.server.node.call(f"{_ROLL}/pid/set_parameters", request)  # type: ignore[attr-defined]
    assert {item.name: item.value for item in answer.config.doubles}[name] == value


def test_descriptions_of_the_gains_are_those_that_rqt_reads(mira: Simulation) -> None:
    heard: dict[str, Any] = {}
    for topic in ("parameter_descriptions", "parameter_updates"):
        mira.subscribe(f"{_ROLL}/pid/{topic}", lambda m, topic=topic: heard.update({topic: m}))
    description, update = heard["parameter_descriptions"], heard["parameter_updates"]
    names = [row.name for group in description.groups for row in group.parameters]
    assert names == ["p", "i", "d", "i_clamp_min", "i_clamp_max", "antiwindup"]
    assert {row.name: row.value for row in update.doubles}["p"] == 1.0
    real = ros1_message_type("dynamic_reconfigure/ConfigDescription")
    assert real._md5sum == "757ce9d44ba8ddd801bb30bc456f946f"
