"""The demo of the Fanuc M-10iA with MoveIt 2: an arm with other names and no gripper (Humble)."""

from __future__ import annotations

import pytest
from stage import Stage, robot_parts

DEMO = "ros2 launch moveit_resources_fanuc_moveit_config demo.launch.py"
ARM = [f"joint_{number}" for number in range(1, 7)]
GOAL = (0.5, 0.3, 0.0, 0.0, 0.0, 0.0)
DEPRECATED = "Using load_yaml() directly is deprecated. Use xacro.load_yaml() instead."
SUCCESS, SUCCEEDED = 1, 4


def test_xacro_gives_9_links_and_warns_of_load_yaml(stage: Stage) -> None:
    expanded = stage.run("xacro ws/src/fanuc_moveit_config/config/fanuc.urdf.xacro")
    assert expanded.code == 0, expanded.output
    assert DEPRECATED in expanded.output
    assert DEPRECATED not in expanded.stdout
    parts = robot_parts(expanded.stdout)
    assert len(parts.links) == 9
    assert parts.kinds["revolute"] == 6
    assert set(ARM) <= set(parts.joints)
    assert parts.root == "base_link"


def test_a_plan_from_all_zeros_is_found_and_executed(stage: Stage) -> None:
    with stage.launch(DEMO) as demo:
        demo.says(r"Using load_yaml\(\) directly is deprecated")
        at = demo.topic("/joint_states").wait_for(lambda one: {*ARM} <= {*one.name})
        assert list(at.position) == pytest.approx([0.0] * 6, abs=1e-6)
        assert demo.tf("world", "base_link").position_m == (0.0, 0.0, 0.0)
        demo.says("You can start planning now!")

        status = demo.topic("/fanuc_controller/follow_joint_trajectory/_action/status")
        targets = [
            {"joint_name": name, "position": to, "tolerance_above": 1e-3, "tolerance_below": 1e-3,
             "weight": 1.0}
            for name, to in zip(ARM, GOAL, strict=True)
        ]  # fmt: skip
        request = {
            "group_name": "manipulator", "allowed_planning_time": 5.0, "num_planning_attempts": 1,
            "goal_constraints": [{"joint_constraints": targets}],
        }  # fmt: skip
        moved = demo.reach_goal("/move_action", "moveit_msgs/MoveGroup", request=request)
        assert moved.result.error_code.val == SUCCESS
        status.wait_for(lambda one: one.status_list and one.status_list[-1].status == SUCCEEDED)
        at = demo.joints()
        assert [at[name] for name in ARM] == pytest.approx(GOAL, abs=0.01)
        # The group ends in tool0: it moved with the arm.
        tool = demo.tf("base_link", "tool0").position_m
        assert abs(tool[1]) > 0.1

        listed = stage.run("ros2 control list_controllers").stdout
        rows = {line.split()[0]: line.split()[-1] for line in listed.splitlines() if line.strip()}
        assert rows == {"fanuc_controller": "active", "joint_state_broadcaster": "active"}, listed
