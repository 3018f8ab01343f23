"""moveit_commander as its tutorial uses it, against a running move_group."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from tests.nodes.conftest import bench  # noqa: F401 - a fixture
from tests.nodes.move_group.conftest import READY, ArmBench, make_arm  # noqa: F401 - a fixture

from gazelle.compat.moveit import commander
from gazelle.compat.moveit.commander import roscpp_initializer
from gazelle.interfaces import ros1_message_type

UP = [0.0] * 6


@pytest.fixture
def arm(
    make_arm: Callable[..., ArmBench],  # noqa: F811 - the fixture
    monkeypatch: pytest.MonkeyPatch,
) -> Iterator[ArmBench]:
    made = make_arm(1)
    monkeypatch.setattr(roscpp_initializer, "node", lambda: made.bench.node)
    yield made
    roscpp_initializer.client_of.cache_clear()
    roscpp_initializer.robot_of.cache_clear()


def _stamped(x: float, y: float, z: float) -> Any:
    pose: Any = ros1_message_type("geometry_msgs/PoseStamped")()
    pose.header.frame_id = "world"
    pose.pose.position.x, pose.pose.position.y, pose.pose.position.z = x, y, z
    pose.pose.orientation.w = 1.0
    return pose


def test_tutorial_of_moveit_commander(arm: ArmBench) -> None:
    robot, scene = commander.RobotCommander(), commander.PlanningSceneInterface()
    group = commander.MoveGroupCommander("arm")
    assert robot.get_group_names() == ["arm", "hand"]
    assert (group.get_planning_frame(), group.get_end_effector_link()) == ("world", "tool_link")
    assert group.get_current_joint_values() == pytest.approx(READY, abs=1e-6)
    assert robot.get_current_state().joint_state.position[1] == pytest.approx(-0.3)

    assert group.go(UP, wait=True)
    group.stop()
    assert group.get_current_joint_values() == pytest.approx(UP, abs=1e-3)

    pose = group.get_current_pose().pose
    pose.position.x, pose.position.y, pose.position.z = 0.36, 0.18, 0.3
    pose.orientation.x, pose.orientation.y = 0.0, 1.0
    pose.orientation.z = pose.orientation.w = 0.0
    group.set_pose_target(pose)
    success, plan, seconds, code = group.plan()
    assert success and code.val == 1 and seconds > 0
    assert group.execute(plan, wait=True)
    group.clear_pose_targets()
    there = group.get_current_pose().pose.position
    assert (there.x, there.y, there.z) == pytest.approx((0.36, 0.18, 0.3), abs=2e-3)

    pose.position.z = 0.25
    path, fraction = group.compute_cartesian_path([pose], 0.01, 0.0)
    assert fraction == 1.0
    assert group.execute(path)
    assert group.get_current_pose().pose.position.z == pytest.approx(0.25, abs=1e-3)

    scene.add_box("box", _stamped(0.36, 0.18, 0.15), size=(0.04, 0.04, 0.04))
    assert scene.get_known_object_names() == ["box"]
    assert group.attach_object("box", touch_links=["hand_link"])
    assert list(scene.get_attached_objects()) == ["box"]
    assert scene.get_known_object_names() == []
    assert group.detach_object("box")
    scene.remove_world_object("box")
    assert scene.get_known_object_names() == []


def test_limits_without_default_scaling_are_taken(arm: ArmBench) -> None:
    limits = {"joint_limits": {"joint_1": {"has_velocity_limits": True}}}
    arm.bench.node.parameters.set("/robot_description_planning", limits)
    assert commander.MoveGroupCommander("arm").get_name() == "arm"


def test_plan_is_a_trajectory_too_as_in_kinetic(arm: ArmBench) -> None:
    group = commander.MoveGroupCommander("arm")
    group.set_named_target("up")
    plan = group.plan()
    assert list(plan.joint_trajectory.points[-1].positions) == pytest.approx(UP, abs=1e-3)
    assert group.execute(plan)


def test_mistakes_are_told_in_moveits_words(arm: ArmBench, capfd: Any) -> None:
    with pytest.raises(RuntimeError, match="Group 'arms' was not found"):
        commander.MoveGroupCommander("arms")
    group = commander.MoveGroupCommander("arm")
    error = commander.MoveItCommanderException
    with pytest.raises(error, match=r"no state of this name; .*'up'"):
        group.set_named_target("ups")
    with pytest.raises(error, match=r"5 values for 6 joints \(joint_1, "):
        group.set_joint_value_target([0.0] * 5)
    with pytest.raises(error, match=r"joint 'joint_2' is at 3, outside \[-1.9, 1.9\]"):
        group.set_joint_value_target("joint_2", 3.0)
    with pytest.raises(error, match="Expected value in the range from 0 to 1"):
        group.set_max_velocity_scaling_factor(1.5)
    with pytest.raises(error, match="Expected either 6 or 7 elements"):
        group.set_pose_target([1.0, 2.0])
    with pytest.raises(error, match="There is no joint named elbow"):
        commander.RobotCommander().get_joint("elbow")
    for refused in (group.pick, group.place, group.set_support_surface_name):
        with pytest.raises(error, match=r"no actions 'pickup' and 'place' here.*attach_object\(\)"):
            refused("cube")
    group.set_position_target([2.0, 0.0, 0.3])
    assert not group.go()
    assert "Fail: ABORTED: inverse kinematics finds no" in capfd.readouterr().err


def test_joints_links_and_targets(arm: ArmBench) -> None:
    robot = commander.RobotCommander()
    assert robot.joint_2.bounds() == [-1.9, 1.9]
    assert robot.joint_2.value() == pytest.approx(-0.3)
    assert robot.tool_link.pose().header.frame_id == "world"
    assert robot.get_default_owner_group("finger_joint") == "hand"
    group = robot.arm
    group.set_rpy_target([0.0, math.pi, 0.0])
    group.shift_pose_target(2, 0.05)
    (goal,) = group.construct_motion_plan_request().goal_constraints
    place = goal.position_constraints[0].constraint_region.primitive_poses[0].position
    assert place.z == pytest.approx(group.get_current_pose().pose.position.z + 0.05)
    assert group.get_jacobian_matrix(UP).shape == (6, 6)
    group.remember_joint_values("here")
    assert "here" in group.get_named_targets()
    assert group.get_goal_tolerance() == (1e-4, 1e-4, 1e-3)
