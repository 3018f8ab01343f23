"""The demo of the Panda with MoveIt 2: mock hardware, a plan and its execution (Humble)."""

from __future__ import annotations

import pytest
from stage import Stage, robot_parts

DEMO = "ros2 launch moveit_resources_panda_moveit_config demo.launch.py"
READY = (0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785)
EXTENDED = (0.0, 0.0, 0.0, 0.0, 0.0, 1.571, 0.785)
ARM = [f"panda_joint{number}" for number in range(1, 8)]
FINGERS = ["panda_finger_joint1", "panda_finger_joint2"]
SUCCESS, SUCCEEDED = 1, 4


def test_xacro_gives_12_links_without_mass(stage: Stage) -> None:
    file = "ws/src/panda_moveit_config/config/panda.urdf.xacro"
    expanded = stage.run(f"xacro {file} ros2_control_hardware_type:=mock_components")
    parts = robot_parts(expanded.stdout)
    assert len(parts.links) == 12
    assert parts.mass_kg == 0.0


def test_a_plan_is_found_and_executed_and_the_fingers_follow(stage: Stage) -> None:
    with stage.launch(DEMO) as demo:
        # Controllers are spawned side by side; only what all of them show tells that all are there.
        joints = demo.topic("/joint_states").wait_for(lambda one: {*ARM, *FINGERS} <= {*one.name})
        at = dict(zip(joints.name, joints.position, strict=True))
        assert [at[name] for name in ARM] == pytest.approx(READY, abs=1e-6)
        assert [at[name] for name in FINGERS] == [0.0, 0.0]
        demo.has_rate("/joint_states", 100.0)
        demo.says("You can start planning now!")

        status = demo.topic("/panda_arm_controller/follow_joint_trajectory/_action/status")
        targets = [
            {"joint_name": name, "position": to, "tolerance_above": 1e-3, "tolerance_below": 1e-3,
             "weight": 1.0}
            for name, to in zip(ARM, EXTENDED, strict=True)
        ]  # fmt: skip
        request = {
            "group_name": "panda_arm", "pipeline_id": "ompl", "allowed_planning_time": 5.0,
            "num_planning_attempts": 1, "max_velocity_scaling_factor": 1.0,
            "max_acceleration_scaling_factor": 1.0,
            "goal_constraints": [{"joint_constraints": targets}],
        }  # fmt: skip
        moved = demo.reach_goal("/move_action", "moveit_msgs/MoveGroup", request=request)
        assert moved.result.error_code.val == SUCCESS
        assert moved.result.planning_time < 5.0
        assert moved.result.planned_trajectory.joint_trajectory.joint_names == ARM
        status.wait_for(lambda one: one.status_list and one.status_list[-1].status == SUCCEEDED)
        at = demo.joints()
        assert [at[name] for name in ARM] == pytest.approx(EXTENDED, abs=0.01)

        demo.reach_goal(
            "/panda_hand_controller/gripper_cmd", "control_msgs/GripperCommand",
            command={"position": 0.03, "max_effort": 10.0},
        )  # fmt: skip
        demo.joint_reaches(FINGERS[0], 0.03, 1e-3)
        assert demo.joints()[FINGERS[1]] == pytest.approx(0.03, abs=1e-3)

        listed = stage.run("ros2 control list_controllers").stdout
        rows = {line.split()[0]: line.split()[1:] for line in listed.splitlines() if line.strip()}
        kinds = {
            "joint_state_broadcaster": "joint_state_broadcaster/JointStateBroadcaster",
            "panda_arm_controller": "joint_trajectory_controller/JointTrajectoryController",
            "panda_hand_controller": "position_controllers/GripperActionController",
        }
        assert {name: row[0] for name, row in rows.items()} == {
            # The command writes the type in brackets.
            name: f"[{kind}]"
            for name, kind in kinds.items()
        } or {name: row[0] for name, row in rows.items()} == kinds, listed
        assert all(row[-1] == "active" for row in rows.values()), listed


def test_each_start_brings_all_three_controllers(stage: Stage) -> None:
    for _ in range(3):
        with stage.launch(DEMO) as demo:
            demo.topic("/joint_states").wait_for(lambda one: {*ARM, *FINGERS} <= {*one.name})
            demo.wait_for_topics("/panda_arm_controller/joint_trajectory")
            for name in (
                "joint_state_broadcaster",
                "panda_arm_controller",
                "panda_hand_controller",
            ):
                demo.says(f"Configured and activated {name}")
