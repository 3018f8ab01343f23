"""Document LUCK's launch file as it is printed, then what its person does in RViz (L3 to L6)."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from tests.patience import stretched

from gazelle.graph.actions import ActionClient
from gazelle.interfaces import action_type, fill, service_type

pytestmark = [pytest.mark.tutorial, pytest.mark.slow(40)]

_LAUNCH = ("ros2", "launch", "luck_gazebo", "gazebo_moveit.launch.py")
# Of the launch file: seconds, and what starts then.
_TIMES = {"spawn_entity.py": 8.0, "spawner": 10.0, "move_group": 12.0, "rviz2": 17.0}
# A machine that does other things starts processes late, the first one too.
_FIRST_LATE_S = 5.0

_JOINTS = [f"joint_{number}" for number in range(1, 7)]
_HOME = [0.0] * 6
_READY = [0.0, 0.5, -0.6, 0.0, 0.4, 0.0]
_KIND = action_type("moveit_msgs/MoveGroup")


# Document LUCK has GenericSystem behind use_sim:=false, and no launch file for it.
_WITHOUT_SIMULATOR = """
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node
from moveit_configs_utils import MoveItConfigsBuilder


def generate_launch_description():
    config = f"{get_package_share_directory('luck_robot')}/config"
    mappings = {
        "use_sim": "false", "initial_positions_file": f"{config}/initial_positions.yaml",
    }
    built = MoveItConfigsBuilder("luck_description", package_name="luck_robot")
    moveit_config = built.robot_description(mappings=mappings).to_moveit_configs()
    description = moveit_config.robot_description
    controllers = f"{get_package_share_directory('luck_gazebo')}/config/controllers.yaml"
    return LaunchDescription([
        Node(package="robot_state_publisher", executable="robot_state_publisher",
             parameters=[description]),
        Node(package="controller_manager", executable="ros2_control_node", output="screen",
             parameters=[description, controllers]),
        Node(package="controller_manager", executable="spawner", output="screen",
             arguments=["joint_state_broadcaster", "test_group_controller"]),
        Node(package="moveit_ros_move_group", executable="move_group", output="screen",
             parameters=[moveit_config.to_dict()]),
    ])
"""


class _Arm:
    """The launched arm with a client of move_group."""

    def __init__(self, launched: Any) -> None:
        self.launched = launched
        launched.wait_for_line("You can start planning now!")
        self.client = ActionClient(launched.node, "/move_action", _KIND)
        assert self.client.wait_for_server(stretched())

    def go(self, positions: list[float]) -> Any:
        """Plan to positions of the joints, execute, and return the result."""
        rows = [
            {"joint_name": name, "position": value, "tolerance_above": 1e-4,
             "tolerance_below": 1e-4, "weight": 1.0}
            for name, value in zip(_JOINTS, positions, strict=True)
        ]  # fmt: skip
        return self._go({"joint_constraints": rows})

    def go_to_point(self, point: tuple[float, float, float]) -> Any:
        """Plan to a place of link_6, m, execute, and return the result."""
        pose = {"position": dict(zip("xyz", point, strict=True)), "orientation": {"w": 1.0}}
        region = {"primitives": [{"type": 2, "dimensions": [0.001]}], "primitive_poses": [pose]}
        place = {"link_name": "link_6", "header": {"frame_id": "world"}, "weight": 1.0}
        return self._go({"position_constraints": [place | {"constraint_region": region}]})

    def hardware(self) -> Any:
        """Return what the controllers drive."""
        return self.launched.call(
            "/controller_manager/list_hardware_components",
            "controller_manager_msgs/srv/ListHardwareComponents",
        ).component

    def _go(self, constraints: dict[str, Any]) -> Any:
        goal: Any = _KIND.Goal()
        fill(goal.request, {
            "group_name": "test_group", "num_planning_attempts": 1, "allowed_planning_time": 10.0,
            "max_velocity_scaling_factor": 1.0, "max_acceleration_scaling_factor": 1.0,
            "goal_constraints": [constraints],
        })  # fmt: skip
        sent = self.client.send_goal(goal)
        assert sent.wait(stretched()), self.launched.text
        return sent.result

    def positions(self) -> list[float]:
        """Where the joints are in the simulation."""
        message = self.launched.messages({"/joint_states": 2})["/joint_states"][-1]
        by_name = dict(zip(message.name, message.position, strict=True))
        return [by_name[name] for name in _JOINTS]

    def call(self, name: str, kind: str, **fields: Any) -> Any:
        """Call a service of move_group."""
        service = service_type(f"moveit_msgs/{kind}")
        request = service.Request()
        fill(request, fields)
        client = self.launched.node.create_client(name, service)
        assert client.wait_for_service(stretched())
        return client.call(request, timeout_s=stretched())

    def tip(self, row: list[float]) -> np.ndarray:
        """Where link_6 is at positions of the joints, m."""
        state = {"joint_state": {"name": _JOINTS, "position": list(row)}}
        answer = self.call(
            "/compute_fk", "GetPositionFK", fk_link_names=["link_6"], robot_state=state
        )
        assert answer.pose_stamped[0].header.frame_id == "world"
        place = answer.pose_stamped[0].pose.position
        return np.array([place.x, place.y, place.z])


def _box(name: str, at: np.ndarray, size: float) -> dict[str, Any]:
    place = dict(zip("xyz", map(float, at), strict=True))
    return {
        "id": name,
        "header": {"frame_id": "world"},
        "primitives": [{"type": 1, "dimensions": [size] * 3}],
        "primitive_poses": [{"position": place, "orientation": {"w": 1.0}}],
    }


class _Luck(NamedTuple):
    """The launched arm, before anybody moves it.

    Attributes:
        launched: the command.
        text: what it has written.
        log: what its log has.
        positions: of all joints, from the first message on.
    """

    launched: Any
    text: str
    log: str
    positions: list[float]


@pytest.fixture(scope="module")
def luck(module_gazelle: Callable[..., Any], workspaces_dir: Path) -> Iterator[_Luck]:
    """The arm by the document's launch file, up to its last timer; nothing is left of it."""
    launched = module_gazelle(*_LAUNCH, cwd=workspaces_dir / "ros2_ws")
    spawned = r"Spawn status: SpawnEntity: Successfully spawned entity \[luck_robot\]"
    launched.wait_for_line(spawned)

    def joints() -> Any:
        message = launched.messages({"/joint_states": 1})["/joint_states"][0]
        assert sorted(message.name) == _JOINTS
        return message.position

    positions = [*joints()]
    launched.wait_for_line("Configured and activated test_group_controller")
    positions += joints()
    launched.wait_for_line(r"\[rviz2-\d+\]: process started")
    # The screen is told before the file.
    launched.eventually(lambda: "[rviz2-" in _log(launched))
    nodes = {"/move_group", "/rviz2"}
    launched.eventually(lambda: nodes <= set(launched.graph.node_names()))
    positions += joints()
    yield _Luck(launched, launched.text, _log(launched), positions)
    assert launched.stop() == 0
    assert launched.processes() == {}


def _log(launched: Any) -> str:
    line = launched.wait_for_line("All log files can be found below")
    folder = Path(line.rpartition("below ")[2])
    return (folder / "launch.log").read_text(encoding="utf-8")


def _started(log: str) -> dict[str, float]:
    """Return the seconds from the first process to each, by name, by launch's own log."""
    found = {
        match["name"]: float(match["time"])
        for line in reversed(log.splitlines())
        if (match := re.match(r"(?P<time>[\d.]+) \[INFO\] \[(?P<name>.*)-\d+\]: process st", line))
    }
    return {name: at - min(found.values()) for name, at in found.items()}


def test_arm_comes_up_in_the_order_of_its_timers_and_holds_its_pose(luck: _Luck) -> None:
    assert max(map(abs, luck.positions)) < 1e-3
    started = _started(luck.log)
    assert sorted(_TIMES, key=started.__getitem__) == list(_TIMES)
    for name, seconds in _TIMES.items():
        assert started[name] > seconds - _FIRST_LATE_S, started
    # Nothing was complained about.
    assert "[ERROR]" not in luck.text and ": error:" not in luck.text


def test_arm_runs_its_controllers_on_the_simulators_hardware(luck: _Luck) -> None:
    listed = luck.launched.call(
        "/controller_manager/list_controllers", "controller_manager_msgs/srv/ListControllers"
    )
    assert {row.name: row.state for row in listed.controller} == {
        "joint_state_broadcaster": "active",
        "test_group_controller": "active",
    }
    types = {row.plugin_name or row.class_type for row in _Arm(luck.launched).hardware()}
    assert types == {"gazebo_ros2_control/GazeboSystem"}


def test_arm_goes_to_ready_around_an_obstacle_and_says_why_it_cannot(luck: _Luck) -> None:
    arm = _Arm(luck.launched)
    _goes_to_ready_and_home_around_a_lamp(arm)
    _says_why_it_cannot(arm)


def test_arm_without_a_simulator_does_the_same(
    gazelle: Callable[..., Any], workspaces_dir: Path, tmp_path: Path
) -> None:
    file = tmp_path / "luck_mock.launch.py"
    file.write_text(_WITHOUT_SIMULATOR, encoding="utf-8")
    launched = gazelle("ros2", "launch", str(file), cwd=workspaces_dir / "ros2_ws")
    first = launched.messages({"/joint_states": 1})["/joint_states"][0]
    assert list(first.position) == _HOME
    arm = _Arm(launched)
    types = {row.plugin_name or row.class_type for row in arm.hardware()}
    assert types == {"mock_components/GenericSystem"}
    assert arm.positions() == _HOME
    _goes_to_ready_and_home_around_a_lamp(arm)
    _says_why_it_cannot(arm)
    assert launched.stop() == 0
    assert "[WARN]" not in launched.text and ": warning:" not in launched.text


def _goes_to_ready_and_home_around_a_lamp(arm: _Arm) -> None:
    result = arm.go(_READY)
    assert result.error_code.val == 1, result.error_code
    assert arm.positions() == pytest.approx(_READY, abs=0.01)

    # Something in the middle of the straight way home has to be gone around.
    rows = [p.positions for p in result.planned_trajectory.joint_trajectory.points]
    middle = arm.tip(list(rows[len(rows) // 2]))
    scene = {"is_diff": True, "world": {"collision_objects": [_box("lamp", middle, 0.06)]}}
    assert arm.call("/apply_planning_scene", "ApplyPlanningScene", scene=scene).success
    state = {"joint_state": {"name": _JOINTS, "position": list(rows[len(rows) // 2])}}
    seen = arm.call(
        "/check_state_validity", "GetStateValidity", group_name="test_group", robot_state=state
    )
    assert not seen.valid
    assert "lamp" in (seen.contacts[0].contact_body_1, seen.contacts[0].contact_body_2)
    result = arm.go(_HOME)
    assert result.error_code.val == 1, result.error_code
    assert arm.positions() == pytest.approx(_HOME, abs=0.01)
    for point in result.planned_trajectory.joint_trajectory.points:
        state = {"joint_state": {"name": _JOINTS, "position": list(point.positions)}}
        seen = arm.call(
            "/check_state_validity", "GetStateValidity", group_name="test_group", robot_state=state
        )
        assert seen.valid, seen.contacts


def _says_why_it_cannot(arm: _Arm) -> None:
    """What cannot be is told with MoveIt's code and with what is in the way."""
    at_ready = arm.tip(_READY)
    scene = {"is_diff": True, "world": {"collision_objects": [_box("safe", at_ready, 0.1)]}}
    assert arm.call("/apply_planning_scene", "ApplyPlanningScene", scene=scene).success
    result = arm.go(_READY)
    assert result.error_code.val == -12
    assert "object 'safe'" in result.error_code.message
    assert "link 'link_" in result.error_code.message
    arm.launched.wait_for_line("GOAL_IN_COLLISION: goal: .* collides with ")
    result = arm.go_to_point((3.0, 0.0, 0.5))
    assert result.error_code.val == -31
    assert "nothing" in result.error_code.message or "no configuration" in result.error_code.message
    assert "link 'link_6' at (3.000, 0.000, 0.500) m" in result.error_code.message
    result = arm.go([9.0, *_READY[1:]])
    assert result.error_code.val == -16
    assert "joint 'joint_1' is at 9, outside [-3.14, 3.14]" in result.error_code.message
    assert arm.positions() == pytest.approx(_HOME, abs=0.01)
