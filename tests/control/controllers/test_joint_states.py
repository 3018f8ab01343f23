"""joint_state_controller and joint_state_broadcaster."""

from __future__ import annotations

import math

import numpy as np
import pytest
from tests.control.plant import MS, PlantJoint, make_controller, make_robot, run
from tests.control.recording_ports import RecordingPorts

from gazelle.control.controllers.joint_state_broadcaster import JointStateBroadcaster
from gazelle.control.controllers.joint_state_controller import JointStateController
from gazelle.control.controllers.publish_rate import PublishRate
from gazelle.control.errors import ControllerError
from gazelle.control.hardware.lifecycle import HardwareState
from gazelle.description.model import Joint, JointType, Model
from gazelle.diagnostics import Diagnostics

ROWS = [
    PlantJoint("a", position=0.1, velocity=1.0),
    PlantJoint("b", position=0.2, velocity=2.0, states=("position",)),
]


def _times_ms(messages: list[object]) -> list[int]:
    stamps = [m.header.stamp for m in messages]  # type: ignore[attr-defined]
    return [stamp.sec * 1000 + stamp.nanosec // MS for stamp in stamps]


def test_states_of_all_joints_at_the_rate_with_the_first_update() -> None:
    robot, _ = make_robot(ROWS)
    controller, ports = make_controller(JointStateController, robot, {"publish_rate": 50})
    controller.start(7 * MS)
    run(robot, controller, 1000, time_ns=7 * MS)
    messages = ports.publishers["joint_states"].messages
    assert _times_ms(messages) == list(range(7, 1007, 20))
    first = messages[0]
    assert first.name == ["a", "b"]
    assert list(first.position) == [0.1, 0.2]
    assert list(first.velocity) == [1.0, 0.0]
    assert messages[1].position[0] == pytest.approx(0.12)
    assert first.header.frame_id == ""


def test_rate_counts_from_the_first_update_however_long_the_world_stood() -> None:
    robot, _ = make_robot(ROWS)
    controller, ports = make_controller(JointStateController, robot, {"publish_rate": 50})
    controller.start(0)
    run(robot, controller, 60, time_ns=MS)
    assert _times_ms(ports.publishers["joint_states"].messages) == [1, 21, 41]


@pytest.mark.parametrize("rate_hz", [30.0, 50.0, 60.0, 333.0, 1000.0, 5000.0])
def test_rate_is_exact_on_average(rate_hz: float) -> None:
    rate = PublishRate(rate_hz, at_once=True)
    rate.start(0)
    count = sum(rate.due(k * MS) for k in range(20_000))
    assert count == pytest.approx(min(rate_hz, 1000.0) * 20, abs=1)


def test_rate_of_zero_never_publishes_and_restarts_keep_the_beat() -> None:
    never = PublishRate(0.0)
    never.start(0)
    assert not any(never.due(k * MS) for k in range(100))
    rate = PublishRate(50.0, at_once=True)
    rate.start(0)
    assert rate.due(0) and not rate.due(5 * MS)
    rate.start(5 * MS)
    assert not rate.due(5 * MS) and rate.due(20 * MS)
    rate.start(0)
    assert rate.due(0), "the world was reset"


def test_joints_are_chosen_and_extra_ones_stand_still() -> None:
    robot, _ = make_robot(ROWS)
    extra = [{"name": "wheel", "position": 0.5, "velocity": 1}, {"name": "bare"}]
    parameters = {"publish_rate": 10, "joints": ["b"], "extra_joints": extra}
    controller, ports = make_controller(JointStateController, robot, parameters)
    controller.start(0)
    run(robot, controller, 1)
    message = ports.publishers["joint_states"].last
    assert message.name == ["b", "wheel", "bare"]
    assert list(message.position) == [0.2, 0.5, 0.0]
    assert list(message.velocity) == [0.0, 1.0, 0.0]


def test_bad_extra_joints_are_said_in_the_original_s_words() -> None:
    robot, _ = make_robot(ROWS)
    found = Diagnostics()
    rows = ["x", {"position": 1.0}, {"name": "a"}, {"name": "c", "effort": "much"}]
    make_controller(
        JointStateController, robot, {"publish_rate": 10, "extra_joints": rows}, diagnostics=found
    )
    texts = [one.message for one in found.by_code("parameter.bad-value")]
    assert len(texts) == 4
    assert "is not a struct" in texts[0] and "does not specify name" in texts[1]
    assert "already contains specified extra joint 'a'" in texts[2]
    assert "Extra joint 'c' does not specify a valid default effort" in texts[3]


def test_missing_rate_is_an_error() -> None:
    robot, _ = make_robot(ROWS)
    with pytest.raises(ControllerError, match="no 'publish_rate' given"):
        make_controller(JointStateController, robot, {})


def test_nothing_is_built_while_nobody_listens() -> None:
    robot, _ = make_robot(ROWS)
    ports = RecordingPorts(subscribed=False)
    first, _ = make_controller(JointStateController, robot, {"publish_rate": 100}, ports=ports)
    second, _ = make_controller(JointStateBroadcaster, robot, {}, ports=ports)
    first.start(0)
    second.start(0)
    run(robot, [first, second], 50)
    assert set(ports.publishers) == {"joint_states", "dynamic_joint_states"}
    assert not any(publisher.messages for publisher in ports.publishers.values())


def test_broadcaster_publishes_everything_at_every_update() -> None:
    robot, _ = make_robot(ROWS, ros_version=2, sensors={"imu": {"orientation.x": 0.5}})
    controller, ports = make_controller(JointStateBroadcaster, robot, {"extra_joints": ["e", "a"]})
    controller.start(0)
    run(robot, controller, 3)
    messages = ports.publishers["joint_states"].messages
    assert _times_ms(messages) == [0, 1, 2]
    first = messages[0]
    assert (first.name, first.header.frame_id) == (["a", "b", "e"], "base_link")
    assert list(first.position) == [0.1, 0.2, 0.0]
    assert first.velocity[0] == 1.0 and math.isnan(first.velocity[1]) and first.velocity[2] == 0.0
    dynamic = ports.publishers["dynamic_joint_states"].messages[0]
    assert dynamic.joint_names == ["a", "b", "imu", "e"]
    assert [list(one.interface_names) for one in dynamic.interface_values] == [
        ["position", "velocity", "effort"],
        ["position"],
        ["orientation.x"],
        ["position", "velocity", "effort"],
    ]
    assert list(dynamic.interface_values[2].values) == [0.5]


def test_broadcaster_maps_interfaces_and_filters_by_urdf() -> None:
    joints = (Joint("a", JointType.REVOLUTE, "x", "y"),)
    robot, _ = make_robot(
        ROWS,
        ros_version=2,
        sensors={"a2": {"angle": 0.7}, "b2": {"position": 9.0}},
        model=Model("robot", joints=joints),
    )
    mapping = {"map_interface_to_joint_state": {"position": "angle"}}
    free = {**mapping, "use_urdf_to_filter": False, "use_local_topics": True}
    controller, ports = make_controller(JointStateBroadcaster, robot, free)
    run(robot, controller, 1)
    message = ports.publishers["~/joint_states"].last
    assert message.name == ["a", "b", "a2", "b2"]
    assert message.position[2] == 0.7
    controller, ports = make_controller(JointStateBroadcaster, robot, {})
    run(robot, controller, 1)
    assert ports.publishers["joint_states"].last.name == ["a"]


def test_broadcaster_publishes_chosen_interfaces_of_chosen_joints() -> None:
    robot, _ = make_robot(ROWS, ros_version=2)
    found = Diagnostics()
    parameters = {
        "joints": ["b", "a"],
        "interfaces": ["position"],
        "publish_dynamic_joint_states": False,
        "map_interface_to_joint_state": {"position": "velocity"},
        "frame_id": "world",
    }
    controller, ports = make_controller(JointStateBroadcaster, robot, parameters, diagnostics=found)
    run(robot, controller, 1)
    message = ports.publishers["joint_states"].last
    assert (message.name, message.header.frame_id) == (["b", "a"], "world")
    assert list(message.position) == [0.2, 0.1]
    assert np.isnan(message.velocity).all()
    assert set(ports.publishers) == {"joint_states"}
    (one,) = found.by_code("parameter.idle")
    assert "Mapping from 'velocity' to interface 'position' will not be done" in one.message
    with pytest.raises(ControllerError, match="'b' has position"):
        parameters["interfaces"] = ["velocity"]
        make_controller(JointStateBroadcaster, robot, parameters)


def test_broadcaster_takes_what_is_configured_when_it_starts() -> None:
    robot, _ = make_robot(ROWS)
    robot.lifecycle.owners = {
        name: name.split("/")[0] for name in robot.interface_values.state_index
    }
    robot.lifecycle.set("b", HardwareState.UNCONFIGURED)
    controller, ports = make_controller(JointStateBroadcaster, robot, {})
    for state, names in ((HardwareState.INACTIVE, ["a", "b"]), (HardwareState.UNCONFIGURED, ["a"])):
        robot.lifecycle.set("b", state)
        controller.start(0)
        run(robot, controller, 1)
        assert ports.publishers["joint_states"].messages[-1].name == names
