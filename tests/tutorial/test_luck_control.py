"""The arm of document LUCK under its own controllers, over the graph (L4, L5)."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from tests.patience import stretched

from gazelle.description.xacro import expand_xacro
from gazelle.diagnostics import Diagnostics
from gazelle.graph.actions import ActionClient
from gazelle.interfaces import action_type
from gazelle.workspace import Workspace

pytestmark = pytest.mark.tutorial

_JOINTS = [f"joint_{number}" for number in range(1, 7)]
_LAUNCH = """<launch>
  <include file="$(find gazebo_ros)/launch/empty_world.launch">
    <arg name="paused" value="true"/>
  </include>
  <param name="robot_description" textfile="{folder}/luck.urdf"/>
  <node name="spawn" pkg="gazebo_ros" type="spawn_model" output="screen"
        args="-urdf -param robot_description -model luck -z 0.1"/>
  <node name="controllers" pkg="controller_manager" type="spawner" output="screen"
        args="joint_state_broadcaster test_group_controller -c /controller_manager"/>
</launch>"""


def test_arm_is_held_from_the_start_and_follows_a_goal_of_another_process(
    gazelle: Callable, workspaces_dir: Path, tmp_path: Path
) -> None:
    source = workspaces_dir / "ros2_ws" / "src"
    (tmp_path / "luck.urdf").write_text(_description(source), encoding="utf-8")
    launch = tmp_path / "luck.launch"
    launch.write_text(_LAUNCH.format(folder=tmp_path), encoding="utf-8")
    arm = gazelle("roslaunch", str(launch), cwd=tmp_path, ROS_PACKAGE_PATH=str(source))
    arm.wait_for_line("Configured and activated test_group_controller")
    listed = arm.call(
        "/controller_manager/list_controllers", "controller_manager_msgs/srv/ListControllers"
    )
    assert [(row.name, row.state) for row in listed.controller] == [
        ("joint_state_broadcaster", "active"),
        ("test_group_controller", "active"),
    ]
    world = arm.call("/gazebo/get_world_properties", "gazebo_msgs/srv/GetWorldProperties")
    assert world.sim_time == 0.0
    arm.wait_for_line(r"control\.idle-gains")

    arm.call("/gazebo/unpause_physics", "std_srvs/srv/Empty")
    state = arm.messages({"/joint_states": 1})["/joint_states"][-1]
    assert list(state.name) == _JOINTS
    assert max(map(abs, state.position)) < 1e-6

    kind = action_type("control_msgs/FollowJointTrajectory")
    client = ActionClient(arm.node, "/test_group_controller/follow_joint_trajectory", kind)
    assert client.wait_for_server(stretched())
    target = [0.5, 0.2, 0.1, 0.0, -0.3, 0.4]
    points = [{"positions": target, "time_from_start": {"sec": 1, "nanosec": 0}}]
    goal = client.send_goal({"trajectory": {"joint_names": _JOINTS, "points": points}})
    assert goal.wait(stretched())
    assert goal.status.name == "SUCCEEDED"
    assert goal.result.error_code == 0
    state = arm.messages({"/joint_states": 1})["/joint_states"][-1]
    assert list(state.position) == pytest.approx(target, abs=1e-3)


def _description(source: Path) -> str:
    """Expand the document's xacro as its launch file does, and name the controllers' file."""
    workspace, diagnostics = Workspace.discover(environ={}, extra=[source]), Diagnostics()
    folder = source / "luck_robot" / "config"
    mappings = {
        "use_sim": "true",
        "initial_positions_file": str(folder / "initial_positions.yaml"),
    }
    expanded = expand_xacro(
        folder / "luck_description.urdf.xacro",
        mappings=mappings,
        workspace=workspace,
        diagnostics=diagnostics,
    )
    assert expanded is not None
    plugin = '<plugin filename="libgazebo_ros2_control.so" name="gazebo_ros2_control">'
    assert plugin in expanded.text
    file = source / "luck_gazebo" / "config" / "controllers.yaml"
    return expanded.text.replace(plugin, f"{plugin}<parameters>{file}</parameters>")
