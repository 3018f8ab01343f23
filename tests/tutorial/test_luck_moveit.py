"""LUCK plans and moves: document LUCK's launch file, then what its person does in RViz (L6)."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gazelle.graph.actions import ActionClient
from gazelle.interfaces import action_type, fill, service_type

pytestmark = [pytest.mark.tutorial, pytest.mark.slow]

_JOINTS = [f"joint_{number}" for number in range(1, 7)]
_HOME = [0.0] * 6
_READY = [0.0, 0.5, -0.6, 0.0, 0.4, 0.0]
_PATIENCE_S = 120.0
_KIND = action_type("moveit_msgs/MoveGroup")


class _Arm:
    """The launched arm with a client of move_group."""

    def __init__(self, launched: Any) -> None:
        self.launched = launched
        launched.wait_for_line("You can start planning now!", _PATIENCE_S)
        self.client = ActionClient(launched.node, "/move_action", _KIND)
        assert self.client.wait_for_server(_PATIENCE_S)

    def go(self, positions: list[float], *, plan_only: bool = False) -> Any:
        """Plan to positions of the joints, execute, and return the result."""
        goal: Any = _KIND.Goal()
        rows = [
            {"joint_name": name, "position": value, "tolerance_above": 1e-4,
             "tolerance_below": 1e-4, "weight": 1.0}
            for name, value in zip(_JOINTS, positions, strict=True)
        ]  # fmt: skip
        fill(goal.request, {
            "group_name": "test_group", "num_planning_attempts": 1, "allowed_planning_time": 10.0,
            "max_velocity_scaling_factor": 1.0, "max_acceleration_scaling_factor": 1.0,
            "goal_constraints": [{"joint_constraints": rows}],
        })  # fmt: skip
        goal.planning_options.plan_only = plan_only
        sent = self.client.send_goal(goal)
        assert sent.wait(_PATIENCE_S), self.launched.text
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
        assert client.wait_for_service(_PATIENCE_S)
        return client.call(request, timeout_s=_PATIENCE_S)

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


def test_arm_goes_to_ready_around_an_obstacle_and_says_why_it_cannot(
    gazelle: Callable[..., Any], workspaces_dir: Path
) -> None:
    launched = gazelle(
        "ros2", "launch", "luck_gazebo", "gazebo_moveit.launch.py", cwd=workspaces_dir / "ros2_ws"
    )
    arm = _Arm(launched)

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

    # What cannot be is told with MoveIt's code and with what is in the way.
    at_ready = arm.tip(_READY)
    scene = {"is_diff": True, "world": {"collision_objects": [_box("safe", at_ready, 0.1)]}}
    assert arm.call("/apply_planning_scene", "ApplyPlanningScene", scene=scene).success
    result = arm.go(_READY)
    assert result.error_code.val == -12
    assert "object 'safe'" in result.error_code.message
    assert "link 'link_" in result.error_code.message
    launched.wait_for_line("GOAL_IN_COLLISION: goal: .* collides with ")
    assert arm.positions() == pytest.approx(_HOME, abs=0.01)
    assert launched.stop() == 0
