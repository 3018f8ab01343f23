"""ros2_control_node: controllers on mock hardware, without a world."""

from __future__ import annotations

import json
import threading
from pathlib import Path
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.errors import LaunchError
from gazelle.graph.actions import ActionClient
from gazelle.interfaces import action_type, message_type
from gazelle.nodes.host import run_node

_NODE = "controller_manager/ros2_control_node"
_ROBOT = """<robot name="r"><link name="a"/><link name="b"/>
<joint name="j" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
  <limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
<ros2_control name="arm" type="system"><hardware><plugin>{plugin}</plugin></hardware>
  <joint name="j"><command_interface name="position"/>
    <state_interface name="position"><param name="initial_value">0.25</param></state_interface>
    <state_interface name="velocity"/></joint></ros2_control></robot>"""
_PARAMETERS = """
controller_manager:
  ros__parameters:
    update_rate: 200
    states: {type: joint_state_broadcaster/JointStateBroadcaster}
    arm: {type: joint_trajectory_controller/JointTrajectoryController}
arm:
  ros__parameters:
    joints: [j]
    command_interfaces: [position]
    state_interfaces: [position, velocity]
"""


def _publish(bench: Any, plugin: str) -> Any:
    kind: Any = message_type("std_msgs/msg/String")
    publisher = bench.node.create_publisher("/robot_description", kind, latch=True)
    publisher.publish(kind(data=_ROBOT.format(plugin=plugin)))
    return publisher


def _states_of(bench: Any) -> dict[str, str]:
    kind = "controller_manager_msgs/srv/ListControllers"
    listed = bench.call("/controller_manager/list_controllers", kind).controller
    return {one.name: one.state for one in listed}


def test_mock_arm_follows_a_trajectory(
    bench: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "controllers.yaml"
    # As launch files write it: for every node of the process.
    text = json.dumps(_ROBOT.format(plugin="mock_components/GenericSystem"))
    head = f"/**:\n  ros__parameters:\n    robot_description: {text}"
    file.write_text(f"{head}\n{_PARAMETERS}")
    bench.start(_NODE, "--ros-args", "--params-file", str(file))
    states = bench.listen("/joint_states", "sensor_msgs/msg/JointState")
    bench.start("controller_manager/spawner", "states", "arm", "--ros-args")
    bench.eventually(lambda: states)
    assert list(states[0].position) == [0.25]
    # Its stamps are those of the wall, which other nodes go by.
    assert abs(states[0].header.stamp.sec - bench.node.clock.now_ns() // 10**9) < 60
    kind = action_type("control_msgs/FollowJointTrajectory")
    client = ActionClient(bench.node, "/arm/follow_joint_trajectory", kind)
    assert client.wait_for_server(stretched(30.0))
    # The server is there from configuring on, and refuses goals until the controller is active.
    bench.eventually(lambda: _states_of(bench)["arm"] == "active")
    point = {"positions": [1.0], "time_from_start": {"sec": 0, "nanosec": 200_000_000}}
    goal = client.send_goal({"trajectory": {"joint_names": ["j"], "points": [point]}})
    assert goal.wait(stretched(30.0))
    assert goal.status.name == "SUCCEEDED"
    bench.eventually(lambda: states[-1].position[0] == pytest.approx(1.0))
    hardware = bench.call(
        "/controller_manager/list_hardware_components",
        "controller_manager_msgs/srv/ListHardwareComponents",
    )
    assert [one.name for one in hardware.component] == ["arm"]
    assert bench.stop() == [0, 0]
    # Mock hardware is what is wanted where there is no world.
    assert "[control." not in capsys.readouterr().err


def test_parameters_of_the_manager_have_one_server(bench: Any, tmp_path: Path) -> None:
    file = tmp_path / "controllers.yaml"
    file.write_text(_PARAMETERS)
    publisher = _publish(bench, "mock_components/GenericSystem")
    bench.start(_NODE, "--ros-args", "--params-file", str(file))
    bench.call(
        "/controller_manager/list_controllers", "controller_manager_msgs/srv/ListControllers"
    )
    kind: Any = message_type("rcl_interfaces/msg/Parameter")
    parameter = kind(name="other.params_file")
    parameter.value.type, parameter.value.string_array_value = 9, [str(file)]
    for name in ("get_parameters", "set_parameters", "list_parameters"):
        wanted = f"/controller_manager/{name}"
        # The manager offers these after the services of its controllers.
        service = bench.eventually(
            lambda wanted=wanted: next(
                (one for one in bench.graph.services() if one.name == wanted), None
            )
        )
        assert len(service.servers) == 1, name
    answer = bench.call(
        "/controller_manager/set_parameters",
        "rcl_interfaces/srv/SetParameters",
        parameters=[parameter],
    )
    assert [(one.successful, one.reason) for one in answer.results] == [(True, "")]
    publisher.unregister()


def test_hardware_of_a_world_is_refused(bench: Any, capsys: pytest.CaptureFixture[str]) -> None:
    _publish(bench, "gazebo_ros2_control/GazeboSystem")
    bench.start(_NODE, "--ros-args")
    bench.eventually(lambda: "/controller_manager" in bench.graph.node_names())
    kind = "controller_manager_msgs/srv/ListHardwareComponents"
    assert not bench.call("/controller_manager/list_hardware_components", kind).component
    assert bench.stop() == [0]
    text = capsys.readouterr().err
    assert (
        "hardware 'arm' has class 'GazeboSystem' of package 'gazebo_ros2_control', which runs in "
        "a world only; lost with it, for every controller: joint 'j'" in text
    )
    assert "mock_components/GenericSystem" in text


def test_missing_hardware_is_one_error_that_controllers_refer_to(
    bench: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "controllers.yaml"
    file.write_text(_PARAMETERS)
    _publish(bench, "shop_driver/ArmHardware")
    words = ["-p", "hardware_components_initial_state.inactive:=[arm]"]
    bench.start(_NODE, "--ros-args", "--params-file", str(file), *words)
    bench.eventually(lambda: "/controller_manager" in bench.graph.node_names())
    refusals = {}
    for name in ("states", "arm"):
        for step in ("load", "configure"):
            kind = f"controller_manager_msgs/srv/{step.capitalize()}Controller"
            address = f"/controller_manager/{step}_controller"
            refusals[name, step] = bench.call(address, kind, name=name).ok
    assert [step for (_, step), is_done in refusals.items() if not is_done] == ["configure"] * 2
    assert bench.stop() == [0]
    captured = capsys.readouterr()
    text = captured.out + captured.err
    assert text.count(" error: ") == 1
    assert "class 'ArmHardware' of package 'shop_driver', which is compiled code" in text
    assert "controller 'arm' cannot run without 'j': hardware 'arm', which has it, was not" in text
    assert "No state interfaces found to publish. Hardware 'arm' was not loaded" in text
    assert "<ros2_control> block" not in text
    assert "is unknown" not in text


def _hardware(bench: Any) -> dict[str, Any]:
    kind = "controller_manager_msgs/srv/ListHardwareComponents"
    found = bench.call("/controller_manager/list_hardware_components", kind).component
    return {one.name: one for one in found}


def test_compiled_hardware_is_mocked_where_that_is_asked_for(
    bench: Any, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("GAZELLE_MOCK_HARDWARE", "1")
    _publish(bench, "shop_driver/ArmHardware")
    bench.start(_NODE, "--ros-args")
    bench.eventually(lambda: "/controller_manager" in bench.graph.node_names())
    arm = _hardware(bench)["arm"]
    assert (arm.plugin_name, arm.state.label) == ("shop_driver/ArmHardware", "active")
    assert [one.name for one in arm.command_interfaces] == ["j/position"]
    assert bench.stop() == [0]
    text = capsys.readouterr().err
    assert (
        "hardware 'arm' is mock_components/GenericSystem in the place of shop_driver/ArmHardware, "
        "as GAZELLE_MOCK_HARDWARE asks for" in text
    )
    assert "[control.hardware-mocked]" in text


def test_the_variable_is_offered_for_compiled_hardware(
    bench: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    _publish(bench, "shop_driver/ArmHardware")
    bench.start(_NODE, "--ros-args")
    bench.eventually(lambda: "/controller_manager" in bench.graph.node_names())
    assert not _hardware(bench)
    assert bench.stop() == [0]
    assert "or start with GAZELLE_MOCK_HARDWARE=1" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "label"),
    [
        (("hardware_components_initial_state.inactive:=[arm]",), "inactive"),
        (("hardware_components_initial_state.unconfigured:=[arm]",), "unconfigured"),
        (("activate_components_on_start:=[other]",), "unconfigured"),
        ((), "active"),
    ],
)
def test_hardware_begins_in_the_state_that_parameters_name(
    bench: Any, words: tuple[str, ...], label: str, capsys: pytest.CaptureFixture[str]
) -> None:
    _publish(bench, "mock_components/GenericSystem")
    bench.start(_NODE, "--ros-args", *(word for one in words for word in ("-p", one)))
    bench.eventually(lambda: "/controller_manager" in bench.graph.node_names())
    assert _hardware(bench)["arm"].state.label == label
    assert bench.stop() == [0]
    captured = capsys.readouterr()
    told = "Setting component 'arm' to '" in captured.out + captured.err
    assert told is (label != "active")


def test_hardware_spawner_configures_and_activates(
    bench: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    _publish(bench, "mock_components/GenericSystem")
    words = ["-p", "hardware_components_initial_state.unconfigured:=[arm]"]
    bench.start(_NODE, "--ros-args", *words)
    spawner = "controller_manager/hardware_spawner"
    for word, label in (("--configure", "inactive"), ("--activate", "active")):
        bench.start(spawner, "arm", "amr", word, "--ros-args")
        bench.eventually(lambda label=label: _hardware(bench)["arm"].state.label == label)
    assert bench.stop() == [0, 0, 0]
    captured = capsys.readouterr()
    text = captured.out + captured.err
    assert "activated component 'arm'. Hardware now in state: lifecycle_msgs.msg.State(id=3" in text
    assert (
        "Hardware Component 'amr' is not loaded - state can not be changed. did you mean 'arm'"
        in text
    )


def test_hardware_spawner_needs_to_know_what_for(bench: Any) -> None:
    request = {"node": "controller_manager/hardware_spawner", "argv": ["arm", "--ros-args"]}
    with pytest.raises(LaunchError, match="one of the arguments --activate --configure is requir"):
        run_node(request, bench.graph, threading.Event())


def test_unknown_hardware_of_the_initial_state_is_told(
    bench: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    _publish(bench, "mock_components/GenericSystem")
    bench.start(_NODE, "--ros-args", "-p", "hardware_components_initial_state.inactive:=[amr]")
    bench.eventually(lambda: "/controller_manager" in bench.graph.node_names())
    assert _hardware(bench)["arm"].state.label == "active"
    assert bench.stop() == [0]
    captured = capsys.readouterr()
    assert "Hardware component 'amr' is unknown" in captured.out + captured.err


def test_robot_that_is_none_ends_the_node(bench: Any) -> None:
    words = ["--ros-args", "-p", "robot_description:='<robot'"]
    bench.start(_NODE, *words)
    assert bench.wait() == [1]


def test_unknown_parameters_are_told_and_those_of_controllers_are_none(
    bench: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "controllers.yaml"
    file.write_text(
        _PARAMETERS.replace("update_rate: 200", "upd_rate: 200\n    arm.params_file: [a.yaml]")
        .replace("arm: {type:", "slow: {tpye:")
    )  # fmt: skip
    _publish(bench, "mock_components/GenericSystem")
    bench.start(_NODE, "--ros-args", "--params-file", str(file), "-p", "lock_memory:=false")
    _hardware(bench)
    assert bench.stop() == [0]
    captured = capsys.readouterr()
    told = [
        line for line in (captured.out + captured.err).splitlines() if "it has no effect" in line
    ]
    assert len(told) == 2
    assert "parameter 'upd_rate' is not one of ros2_control_node; it has no effect" in told[0]
    assert "parameter 'slow.tpye' is not one of ros2_control_node; it has no effect" in told[1]


@pytest.mark.parametrize(
    ("value", "text"), [("fast", "'/controller_manager/update_rate' is 'fast', not a number"),
                        ("0", "parameter 'update_rate' is 0 Hz; it must be more than 0")],
)  # fmt: skip
def test_update_rate_that_is_none_ends_the_node(
    bench: Any, value: str, text: str, capsys: pytest.CaptureFixture[str]
) -> None:
    _publish(bench, "mock_components/GenericSystem")
    bench.start(_NODE, "--ros-args", "-p", f"update_rate:={value}")
    assert bench.wait() == [1]
    captured = capsys.readouterr()
    assert text in captured.out + captured.err
