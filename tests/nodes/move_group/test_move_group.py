"""move_group as clients see it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from tests.nodes.move_group.conftest import (
    JOINTS,
    READY,
    ArmBench,
    joint_goal,
    pose_goal,
)

UP = [0.0] * 6


@pytest.mark.parametrize("ros_version", [1, 2])
def test_a_joint_goal_is_planned_and_executed(
    make_arm: Callable[..., ArmBench], ros_version: int
) -> None:
    arm = make_arm(ros_version)
    result = arm.move(goal_constraints=joint_goal(UP))
    assert result.error_code.val == 1, result.error_code
    points = result.planned_trajectory.joint_trajectory.points
    assert list(points[0].positions) == pytest.approx(READY, abs=1e-6)
    assert list(points[-1].positions) == pytest.approx(UP, abs=1e-3)
    assert [arm.robot.positions[f"joint_{i}"] for i in range(1, 7)] == pytest.approx(UP, abs=1e-3)
    # Views listen below the node's name in ROS 1.
    for name in ("display_planned_path", "monitored_planning_scene"):
        assert arm.bench.graph.publisher_count(f"/{name}") == 1
        assert arm.bench.graph.publisher_count(f"/move_group/{name}") == (ros_version == 1)


def test_goal_pose_obstacle_and_attached_object_in_one_scene(arm: ArmBench) -> None:
    result = arm.move(goal_constraints=pose_goal(0.36, 0.18, 0.3))
    assert result.error_code.val == 1, result.error_code
    arm.add_box("wall", [0.3, 0.02, 0.4], [0.4, 0.0, 0.2])
    result = arm.move(goal_constraints=pose_goal(0.36, -0.18, 0.3), plan_only=True)
    assert result.error_code.val == 1, result.error_code
    rows = [list(p.positions) for p in result.planned_trajectory.joint_trajectory.points]
    heights = [_tool(arm, row)[2] for row in rows if abs(_tool(arm, row)[1]) < 0.03]
    assert (heights and min(heights) > 0.4) or min(_tool(arm, row)[0] for row in rows) < 0.25


def test_goals_that_collide_name_the_pair_and_the_code(arm: ArmBench) -> None:
    arm.add_box("wall", [0.3, 0.4, 0.4], [0.4, 0.0, 0.2])
    result = arm.move(goal_constraints=pose_goal(0.36, 0.0, 0.2))
    assert result.error_code.val == -12
    assert "object 'wall' collides with link '" in _either_order(result.error_code.message)


def test_goals_out_of_reach_and_beyond_limits(arm: ArmBench) -> None:
    result = arm.move(goal_constraints=pose_goal(1.5, 0.0, 0.3))
    assert result.error_code.val == -31
    assert "inverse kinematics finds no configuration with link 'tool_link' at (1.500, 0.000, " in (
        result.error_code.message
    )
    result = arm.move(goal_constraints=joint_goal([0.0, 2.5, 0.0, 0.0, 0.0, 0.0]))
    assert result.error_code.val == -16
    assert "joint 'joint_2' is at 2.5, outside [-1.9, 1.9]" in result.error_code.message


def test_a_start_in_collision_says_so(arm: ArmBench) -> None:
    arm.add_box("crate", [0.2, 0.2, 0.2], [0.178, 0.0, 0.32])
    result = arm.move(goal_constraints=joint_goal([0.0] * 6))
    assert result.error_code.val == -10
    assert "start: " in result.error_code.message
    assert "'crate'" in result.error_code.message


@pytest.mark.parametrize(
    ("request_", "code", "text"),
    [
        ({"group_name": "arms"}, -15, "there is no planning group 'arms' (there are: arm, hand)"),
        ({"goal_constraints": []}, -16, "No goal constraints specified"),
        ({"goal_constraints": pose_goal(0.3, 0.0, 0.3, link="tool")}, -18, "no link 'tool'"),
        ({"goal_constraints": pose_goal(0.3, 0.0, 0.3, frame="map")}, -21, "frame 'map'"),
        ({"goal_constraints": joint_goal([0.0] * 6), "pipeline_id": "chomp"}, 99999,
         "No planning pipeline available for name 'chomp'"),
    ],
)  # fmt: skip
def test_requests_that_make_no_sense(
    arm: ArmBench, request_: dict[str, Any], code: int, text: str
) -> None:
    result = arm.move(**{"goal_constraints": joint_goal([0.0] * 6), **request_})
    assert result.error_code.val == code
    assert text in result.error_code.message


def _tool(arm: ArmBench, row: list[float]) -> list[float]:
    answer = arm.call(
        "compute_fk",
        "GetPositionFK",
        fk_link_names=["tool_link"],
        robot_state={"joint_state": {"name": JOINTS, "position": row}},
    )
    place = answer.pose_stamped[0].pose.position
    return [place.x, place.y, place.z]


def _either_order(text: str) -> str:
    """The text with pairs in both orders."""
    first, _, second = text.removeprefix("goal: ").partition(" collides with ")
    return f"{text} | {second.partition(' (')[0]} collides with {first}"
