"""Every type name there is: one law for each, and no type without one."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from tests.control.controllers import drive_laws, trajectory_laws
from tests.control.controllers.type_bench import Scenario, TypeBench
from tests.control.plant import PlantJoint

from gazelle.control.controllers.registry import known_types
from gazelle.control.controllers.sensor_messages import (
    IMU_INTERFACES,
    POSE_INTERFACES,
    WRENCH_INTERFACES,
)
from gazelle.control.errors import ControllerError
from gazelle.interfaces import action_type, message_type

Float64 = message_type("std_msgs/Float64")
Array64 = message_type("std_msgs/Float64MultiArray")
INERTIA = {"a": 2.0, "b": 3.0, "c": 4.0}
ABC = [PlantJoint(name, inertia) for name, inertia in INERTIA.items()]
GOALS = (1.5, -0.5)
SECONDS = 0.8


def moved(interface: str, joint: str, value: float, seconds: float) -> float:
    """How far a command takes a joint that stood at 0."""
    if interface == "effort":
        return value / INERTIA[joint] * seconds**2 / 2
    return value * seconds if interface == "velocity" else value


def one_number(bench: TypeBench, interface: str) -> None:
    """A number moves one joint by that interface; the others stay."""
    assert bench.record.commands == (f"c/{interface}",)
    bench.ports.send("~/command", Float64(data=GOALS[0]))
    bench.run(SECONDS)
    wanted = moved(interface, "c", GOALS[0], SECONDS)
    assert bench.plant.position == pytest.approx([0.0, 0.0, wanted])


def array(bench: TypeBench, about: tuple[str, str]) -> None:
    """Numbers move joints in the order of the parameters, not of the robot; the others stay."""
    topic, interface = about
    assert bench.record.commands == (f"c/{interface}", f"a/{interface}")
    bench.ports.send(topic, Array64(data=GOALS))
    bench.run(SECONDS)
    for_c, for_a = (moved(interface, *row, SECONDS) for row in zip("ca", GOALS, strict=True))
    assert bench.plant.position == pytest.approx([for_a, 0.0, for_c])


def several_interfaces(bench: TypeBench, about: None) -> None:
    """Numbers go to the interfaces of one joint in the order of the parameters."""
    assert bench.record.commands == ("b/velocity", "b/position")
    bench.ports.send("~/commands", Array64(data=GOALS))
    bench.run(0.002)
    assert (bench.command("b/velocity"), bench.command("b/position")) == GOALS
    assert np.isnan([bench.command("a/velocity"), bench.command("c/position")]).all()


def damped(inertia: float, goal: float, omega: float) -> np.ndarray:
    """PD of critical damping on an inertia: I·ẍ = p·e + d·ė, the step of e included."""
    t = np.arange(1, round(SECONDS * 1000) + 1) * 1e-3
    return goal * (1.0 - (1.0 - omega * t) * np.exp(-omega * t))


def critical(name: str, omega: float = 10.0) -> dict[str, float]:
    """Gains of critical damping on a joint's inertia."""
    return {"p": omega**2 * INERTIA[name], "d": 2 * omega * INERTIA[name]}


def pid_of_position(bench: TypeBench, about: tuple[str, Any, tuple[str, ...]]) -> None:
    """A PD on a known inertia moves as its differential equation, solved by hand, says."""
    topic, message, names = about
    bench.ports.send(topic, message)
    bench.run(SECONDS)
    for name, goal in zip(names, GOALS, strict=False):
        path = np.array(bench.trace)[:, "abc".index(name)]
        assert path == pytest.approx(damped(INERTIA[name], goal, 10.0), abs=0.02 * abs(goal))
        assert path[-1] == pytest.approx(goal, abs=0.005)
    assert np.array(bench.trace)[-1, 1] == 0.0


def velocity_of_position(bench: TypeBench, p: float) -> None:
    """A velocity of p times the error brings the error down by exp(-p·t)."""
    bench.ports.send("~/command", Float64(data=GOALS[0]))
    bench.run(SECONDS)
    steps = np.arange(1, len(bench.trace) + 1)
    wanted = GOALS[0] * (1.0 - (1.0 - p * 1e-3) ** steps)
    assert np.array(bench.trace)[:, 2] == pytest.approx(wanted)


def pid_of_velocity(bench: TypeBench, p: float) -> None:
    """An effort of p times the velocity's error is a lag of first order: I/p."""
    bench.ports.send("~/command", Float64(data=GOALS[0]))
    bench.run(SECONDS)
    wanted = GOALS[0] * (1.0 - math.exp(-p / INERTIA["c"] * SECONDS))
    assert bench.plant.velocity == pytest.approx([0.0, 0.0, wanted], rel=0.01)


def joint_states(bench: TypeBench, about: tuple[str, float]) -> None:
    """States are those of the plant at the message's time, by name, at the rate."""
    frame, period_s = about
    bench.run(0.1)
    messages = bench.messages("joint_states")
    stamps = [m.header.stamp.sec + m.header.stamp.nanosec * 1e-9 for m in messages]
    assert stamps == pytest.approx(np.arange(len(stamps)) * period_s)
    assert len(stamps) == round(0.1 / period_s)
    last, time_s = messages[-1], stamps[-1]
    assert (last.name, last.header.frame_id) == (["x", "y"], frame)
    assert list(last.velocity) == pytest.approx([1.0 + 3.0 * time_s, -2.0])
    assert list(last.position) == pytest.approx(
        [0.5 + time_s + 1.5 * time_s**2, 0.25 - 2.0 * time_s]
    )


def sensor(bench: TypeBench, about: tuple[str, float, str, dict[str, float]]) -> None:
    """A message has the sensor's values, its frame and the time of its update, at the rate."""
    topic, rate_hz, frame, values = about
    bench.run(0.2)
    messages = bench.messages(topic)
    assert len(messages) == pytest.approx(rate_hz * 0.2, abs=1.01)
    stamps = [m.header.stamp.nanosec * 1e-9 for m in messages]
    assert np.diff(stamps) == pytest.approx(1.0 / rate_hz)
    assert messages[-1].header.frame_id == frame
    for path, value in values.items():
        found: Any = messages[-1]
        for word in path.split("."):
            found = getattr(found, word)
        assert found == value, path


def gripper(bench: TypeBench, about: tuple[Any, Any]) -> None:
    """A finger reaches a goal and tells so; a jammed one stalls after its second and aborts."""
    request, reached_at = about
    sent = bench.ports.send_goal("~/gripper_cmd", request(0.03))
    bench.run(1.0)
    assert sent.state == "succeeded"
    assert bench.plant.position[0] == pytest.approx(0.03, abs=reached_at)
    assert sent.result["reached_goal"] and not sent.result["stalled"]
    bench.jammed = True
    stuck = bench.ports.send_goal("~/gripper_cmd", request(0.0))
    bench.run(0.99)
    assert stuck.state == "active"
    bench.run(0.1)
    assert stuck.state == "aborted"
    assert stuck.result["stalled"] and not stuck.result["reached_goal"]


def gripper_command(position: float) -> Any:
    command = message_type("control_msgs/GripperCommand")(position=position, max_effort=5.0)
    return message_type("control_msgs/GripperCommandGoal")(command=command)


def parallel_command(position: float) -> Any:
    command = message_type("sensor_msgs/JointState")(position=[position])
    return action_type("control_msgs/ParallelGripperCommand").Goal(command=command)


def numbered(names: tuple[str, ...]) -> dict[str, float]:
    return {name: 0.1 * k for k, name in enumerate(names, 1)}


def vectors(*rows: tuple[str, int]) -> dict[str, float]:
    """Values of x, y, z of some fields, numbered from a start."""
    return {
        f"{path}.{axis}": 0.1 * (start + k) for path, start in rows for k, axis in enumerate("xyz")
    }


MOVING = [
    PlantJoint("x", 1.0, position=0.5, velocity=1.0, load=3.0),
    PlantJoint("y", 1.0, position=0.25, velocity=-2.0),
]
FINGER = [PlantJoint("finger", 0.5)]
FINGER_GAINS = {"gains": {"finger": {"p": 200.0, "d": 20.0}}}
HALF = math.sqrt(0.5)
POSE = dict(zip(POSE_INTERFACES, (1.0, 2.0, 3.0, 0.0, 0.0, HALF, HALF), strict=True))
FIX = {"status": 0.0, "service": 1.0, "latitude": 48.1, "longitude": 11.5, "altitude": 520.0}
SENSORS = {
    "imu": numbered(IMU_INTERFACES),
    "wrist": numbered(WRENCH_INTERFACES),
    "eye": {"range": 1.5},
    "pose": POSE,
    "gps": FIX,
}
FRAMES = {"imu": "imu_link", "wrist": "wrist_link"}
IMU_VALUES = vectors(("orientation", 1), ("angular_velocity", 5), ("linear_acceleration", 8))
IMU_VALUES["orientation.w"] = 0.4
WRENCH_VALUES = vectors(("wrench.force", 1), ("wrench.torque", 4))
POSE_VALUES = {f"pose.position.{axis}": k for axis, k in zip("xyz", (1.0, 2.0, 3.0), strict=True)}
POSE_VALUES |= {"pose.orientation.z": HALF, "pose.orientation.w": HALF}


def _sensing(type_name: str, ros_version: int, topic: str, values: Any, **parameters: Any) -> Any:
    # ROS 1 publishes where the sensor is; ROS 2 in the frame it is told, at every update.
    frame = parameters.get("frame_id", FRAMES.get(topic, ""))
    about = (topic, parameters.get("publish_rate", 1000), frame, values)
    return Scenario(type_name, sensor, parameters, (), ros_version, about, SENSORS, FRAMES)


ROWS = (
    *(
        Scenario(
            f"{word}_controllers/Joint{word.capitalize()}Controller",
            one_number,
            {"joint": "c"},
            ABC,
            about=word,
        )
        for word in ("effort", "velocity", "position")
    ),
    *(
        Scenario(
            f"{word}_controllers/JointGroup{word.capitalize()}Controller",
            array,
            {"joints": ["c", "a"]},
            ABC,
            ros_version,
            ("~/command" if ros_version == 1 else "~/commands", word),
        )
        for word in ("effort", "velocity", "position")
        for ros_version in (1, 2)
    ),
    Scenario(
        "forward_command_controller/ForwardCommandController",
        array,
        {"joints": ["c", "a"], "interface_name": "velocity"},
        ABC,
        2,
        ("~/commands", "velocity"),
    ),
    Scenario(
        "forward_command_controller/MultiInterfaceForwardCommandController",
        several_interfaces,
        {"joint": "b", "interface_names": ["velocity", "position"]},
        ABC,
        2,
    ),
    Scenario(
        "effort_controllers/JointPositionController",
        pid_of_position,
        {"joint": "c", "pid": critical("c")},
        ABC,
        about=("~/command", Float64(data=GOALS[0]), ("c",)),
    ),
    Scenario(
        "velocity_controllers/JointPositionController",
        velocity_of_position,
        {"joint": "c", "pid": {"p": 6.0}},
        ABC,
        about=6.0,
    ),
    Scenario(
        "effort_controllers/JointVelocityController",
        pid_of_velocity,
        {"joint": "c", "pid": {"p": 20.0}},
        ABC,
        about=20.0,
    ),
    Scenario(
        "effort_controllers/JointGroupPositionController",
        pid_of_position,
        {"joints": ["c", "a"], "c": {"pid": critical("c")}, "a": {"pid": critical("a")}},
        ABC,
        about=("~/command", Array64(data=GOALS), ("c", "a")),
    ),
    Scenario(
        "pid_controller/PidController",
        pid_of_position,
        {
            "dof_names": ["c", "a"],
            "command_interface": "effort",
            "reference_and_state_interfaces": ["position"],
            "gains": {"c": critical("c"), "a": critical("a")},
        },
        ABC,
        2,
        (
            "~/reference",
            message_type("control_msgs/MultiDOFCommand")(dof_names=["c", "a"], values=GOALS),
            ("c", "a"),
        ),
    ),
    Scenario(
        "joint_state_controller/JointStateController",
        joint_states,
        {"publish_rate": 50},
        MOVING,
        about=("", 0.02),
    ),
    Scenario(
        "joint_state_broadcaster/JointStateBroadcaster",
        joint_states,
        {},
        MOVING,
        2,
        ("base_link", 0.001),
    ),
    _sensing("imu_sensor_controller/ImuSensorController", 1, "imu", IMU_VALUES, publish_rate=100),
    _sensing(
        "force_torque_sensor_controller/ForceTorqueSensorController",
        1,
        "wrist",
        WRENCH_VALUES,
        publish_rate=50,
    ),
    _sensing(
        "imu_sensor_broadcaster/IMUSensorBroadcaster",
        2,
        "~/imu",
        IMU_VALUES,
        sensor_name="imu",
        frame_id="f",
    ),
    _sensing(
        "force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster",
        2,
        "~/wrench",
        WRENCH_VALUES,
        sensor_name="wrist",
        frame_id="f",
    ),
    _sensing(
        "range_sensor_broadcaster/RangeSensorBroadcaster",
        2,
        "~/range",
        {"range": 1.5, "min_range": 0.25, "max_range": 2.5},
        sensor_name="eye",
        frame_id="f",
        min_range=0.25,
        max_range=2.5,
    ),
    _sensing(
        "pose_broadcaster/PoseBroadcaster", 2, "~/pose", POSE_VALUES, pose_name="pose", frame_id="f"
    ),
    _sensing(
        "gps_sensor_broadcaster/GPSSensorBroadcaster",
        2,
        "~/gps/fix",
        {"latitude": 48.1, "longitude": 11.5, "altitude": 520.0, "status.service": 1},
        sensor_name="gps",
        frame_id="f",
    ),
    *(
        Scenario(
            f"{word}_controllers/GripperActionController",
            gripper,
            {"joint": "finger", "goal_tolerance": 0.002, **gains},
            FINGER,
            ros_version,
            (gripper_command, 0.002),
        )
        for word, gains in (("position", {}), ("effort", FINGER_GAINS))
        for ros_version in (1, 2)
    ),
    Scenario(
        "parallel_gripper_action_controller/GripperActionController",
        gripper,
        {"joint": "finger"},
        FINGER,
        2,
        (parallel_command, 1e-9),
    ),
    *drive_laws.ROWS,
    *trajectory_laws.ROWS,
)


@pytest.mark.parametrize("scenario", [pytest.param(row, id=row.id) for row in ROWS])
def test_every_type_does_what_its_law_says(scenario: Scenario) -> None:
    scenario.check()


def misspelt(value: Any, names: set[str]) -> Any:
    """Parameters with an x behind every name of a joint or sensor."""
    if isinstance(value, dict):
        return {misspelt(key, names): misspelt(item, names) for key, item in value.items()}
    if isinstance(value, list):
        return [misspelt(item, names) for item in value]
    return f"{value}x" if isinstance(value, str) and value in names else value


def named(scenario: Scenario) -> set[str]:
    return {joint.name for joint in scenario.joints} | set(scenario.sensors)


@pytest.mark.parametrize(
    "scenario",
    [
        pytest.param(row, id=row.id)
        for row in ROWS
        if misspelt(dict(row.parameters), named(row)) != row.parameters
    ],
)
def test_every_type_says_the_nearest_name_of_a_wrong_joint_or_sensor(scenario: Scenario) -> None:
    wrong = misspelt(dict(scenario.parameters), named(scenario))
    with pytest.raises(ControllerError) as caught:
        TypeBench(replace(scenario, parameters=wrong))
    found = re.search(
        r"the hardware has no joint or sensor '(\w+)x'; did you mean '(\w+)'", str(caught.value)
    )
    assert found is not None
    assert found[1] == found[2]
    if scenario.ros_version == 1:
        assert f"(Could not find resource '{found[1]}x')" in str(caught.value)


def test_no_type_is_without_a_law() -> None:
    assert tuple(sorted({row.type_name for row in ROWS})) == known_types()
