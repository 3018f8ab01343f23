"""move_group's services, topics and sequences."""

from __future__ import annotations

from typing import Any

import pytest
from tests.nodes.move_group.conftest import (
    JOINTS,
    READY,
    ArmBench,
    box_object,
    joint_goal,
    pose,
    pose_goal,
)
from tests.nodes.move_group.fake_robot import trajectory
from tests.patience import stretched

from gazelle.graph.actions import ActionClient
from gazelle.interfaces import action_type, fill, message_type

DOWN = (0.0, 1.0, 0.0, 0.0)


def _ik(arm: ArmBench, *at: float, **more: Any) -> Any:
    stamped = {"header": {"frame_id": "world"}, "pose": pose(*at, quat=DOWN)}
    ask = {"group_name": "arm", "pose_stamped": stamped, "timeout": {"sec": 1, "nanosec": 0}}
    return arm.call("compute_ik", "GetPositionIK", ik_request={**ask, **more})


def _fk(arm: ArmBench, state: Any, frame: str = "") -> list[float]:
    answer = arm.call(
        "compute_fk",
        "GetPositionFK",
        header={"frame_id": frame},
        fk_link_names=["tool_link"],
        robot_state={"joint_state": state},
    )
    assert answer.error_code.val == 1, answer.error_code
    place = answer.pose_stamped[0].pose.position
    return [place.x, place.y, place.z]


def test_ik_and_fk_are_inverse_and_say_what_is_wrong(arm: ArmBench) -> None:
    answer = _ik(arm, 0.36, 0.1, 0.3)
    assert answer.error_code.val == 1, answer.error_code
    found = answer.solution.joint_state
    state = {"name": list(found.name), "position": list(found.position)}
    assert _fk(arm, state) == pytest.approx([0.36, 0.1, 0.3], abs=1e-4)
    assert _fk(arm, state, "base_link") == pytest.approx([0.36, 0.1, 0.3], abs=1e-4)

    far = _ik(arm, 2.0, 0.0, 0.3)
    assert far.error_code.val == -31
    assert "nothing that brings 'tool_link' to (2.000, 0.000, 0.300) m" in far.error_code.message
    assert _ik(arm, 0.36, 0.1, 0.3, ik_link_name="tool").error_code.val == -18
    arm.add_box("block", [0.1, 0.1, 0.1], [0.36, 0.1, 0.3])
    hit = _ik(arm, 0.36, 0.1, 0.3, avoid_collisions=True)
    assert hit.error_code.val == -31
    assert "finds only configurations that are no good: " in hit.error_code.message
    assert "'block'" in hit.error_code.message
    missing = arm.call("compute_fk", "GetPositionFK", fk_link_names=["elbow"])
    assert missing.error_code.val == -18


def test_straight_paths_end_where_something_is(arm: ArmBench) -> None:
    fields: dict[str, Any] = {
        "group_name": "arm", "header": {"frame_id": "world"}, "max_step": 0.01,
        "avoid_collisions": True,
    }  # fmt: skip
    start = _fk(arm, {"name": JOINTS, "position": READY})
    end = [start[0] + 0.1, start[1], start[2]]
    fields["waypoints"] = [pose(*end, quat=DOWN)]
    answer = arm.call("compute_cartesian_path", "GetCartesianPath", **fields)
    assert (answer.error_code.val, answer.fraction) == (1, 1.0)
    for point in answer.solution.joint_trajectory.points:
        place = _fk(arm, {"name": JOINTS, "position": list(point.positions)})
        assert place[1:] == pytest.approx(start[1:], abs=2e-3)
    arm.add_box("post", [0.02, 0.4, 0.5], [start[0] + 0.12, 0.0, 0.25])
    answer = arm.call("compute_cartesian_path", "GetCartesianPath", **fields)
    assert 0.0 < answer.fraction < 1.0
    assert "collides with" in answer.error_code.message
    fields["max_step"] = 0.0
    answer = arm.call("compute_cartesian_path", "GetCartesianPath", **fields)
    assert (answer.error_code.val, "needs to be > 0" in answer.error_code.message) == (99999, True)


def test_scene_of_topics_is_answered_and_attached_objects_move_along(arm: ArmBench) -> None:
    def scene() -> Any:
        return arm.call("get_planning_scene", "GetPlanningScene").scene

    item: Any = message_type("moveit_msgs/msg/CollisionObject")()
    fill(
        item, {**box_object("cube", [0.04] * 3, [0.178, 0.0, 0.3]), "header": {"frame_id": "world"}}
    )
    arm.bench.node.create_publisher(
        "/collision_object", "moveit_msgs/msg/CollisionObject", latch=True
    ).publish(item)
    arm.bench.eventually(lambda: [one.id for one in scene().world.collision_objects] == ["cube"])
    (cube,) = scene().world.collision_objects
    assert (cube.header.frame_id, cube.pose.position.z) == ("world", pytest.approx(0.3))

    hold: Any = message_type("moveit_msgs/msg/AttachedCollisionObject")(link_name="tool_link")
    hold.object.id = "cube"
    hold.touch_links = ["hand_link", "left_finger_link", "right_finger_link"]
    arm.bench.node.create_publisher(
        "/attached_collision_object", "moveit_msgs/msg/AttachedCollisionObject", latch=True
    ).publish(hold)
    arm.bench.eventually(lambda: scene().robot_state.attached_collision_objects)
    assert not scene().world.collision_objects
    assert arm.move(goal_constraints=joint_goal([0.0] * 6)).error_code.val == 1
    # What is carried collides too.
    up = _fk(arm, {"name": JOINTS, "position": [0.0] * 6})
    arm.add_box("lamp", [0.1, 0.1, 0.01], [up[0], up[1], up[2] + 0.03])
    seen = arm.call("check_state_validity", "GetStateValidity", group_name="arm")
    assert not seen.valid
    assert {"cube", "lamp"} in [{c.contact_body_1, c.contact_body_2} for c in seen.contacts]


def test_pilz_sequence_is_blended_and_executed(arm: ArmBench) -> None:
    item = {
        "group_name": "arm", "pipeline_id": "pilz_industrial_motion_planner", "planner_id": "PTP",
        "max_velocity_scaling_factor": 0.2, "max_acceleration_scaling_factor": 0.1,
        "allowed_planning_time": 5.0,
    }  # fmt: skip
    goals = [joint_goal([0.3, *READY[1:]]), joint_goal([0.0, 0.0, *READY[2:]])]
    rows: list[dict[str, Any]] = [
        {"req": {**item, "goal_constraints": goal}, "blend_radius": radius}
        for goal, radius in zip(goals, (0.02, 0.0), strict=True)
    ]
    answer = arm.call("plan_sequence_path", "GetMotionSequence", request={"items": rows})
    assert answer.response.error_code.val == 1, answer.response.error_code
    assert len(answer.response.planned_trajectories) == 1
    kind = action_type("moveit_msgs/MoveGroupSequence")
    client = ActionClient(arm.bench.node, "/sequence_move_group", kind)
    assert client.wait_for_server(stretched())
    goal: Any = kind.Goal()
    fill(goal.request, {"items": rows})
    sent = client.send_goal(goal)
    assert sent.wait(stretched())
    assert sent.result.response.error_code.val == 1
    assert arm.robot.positions["joint_2"] == pytest.approx(0.0, abs=1e-3)
    rows[1]["blend_radius"] = 0.1
    answer = arm.call("plan_sequence_path", "GetMotionSequence", request={"items": rows})
    assert "the last blend radius must be zero" in answer.response.error_code.message


def test_lin_moves_the_tool_straight(arm: ArmBench) -> None:
    result = arm.move(
        plan_only=True,
        pipeline_id="pilz_industrial_motion_planner",
        planner_id="LIN",
        max_velocity_scaling_factor=0.2,
        max_acceleration_scaling_factor=0.2,
        goal_constraints=pose_goal(0.3, 0.0, 0.32),
    )
    assert result.error_code.val == 1, result.error_code
    for point in result.planned_trajectory.joint_trajectory.points:
        place = _fk(arm, {"name": JOINTS, "position": list(point.positions)})
        assert place[1:] == pytest.approx([0.0, 0.32], abs=2e-3)


def test_known_trajectories_are_executed_and_bad_starts_refused(arm: ArmBench) -> None:
    kind = action_type("moveit_msgs/ExecuteTrajectory")
    client = ActionClient(arm.bench.node, "/execute_trajectory", kind)
    assert client.wait_for_server(stretched())
    goal: Any = kind.Goal()
    goal.trajectory.joint_trajectory = trajectory(JOINTS, [0.5] * 6, [0.6] * 6)
    sent = client.send_goal(goal)
    assert sent.wait(stretched())
    assert sent.result.error_code.val == -4
    assert "deviates from current robot state" in sent.result.error_code.message
    goal.trajectory.joint_trajectory = trajectory(JOINTS, READY, [0.1, *READY[1:]])
    sent = client.send_goal(goal)
    assert sent.wait(stretched())
    assert sent.result.error_code.val == 1
    assert arm.robot.positions["joint_1"] == 0.1


def test_planners_are_listed_and_take_parameters(arm: ArmBench) -> None:
    found = arm.call("query_planner_interface", "QueryPlannerInterfaces").planner_interfaces
    assert [one.pipeline_id for one in found] == ["ompl", "pilz_industrial_motion_planner"]
    assert {"RRTConnect", "PRM"} <= set(found[0].planner_ids)
    assert found[1].planner_ids == ["CIRC", "LIN", "PTP"]
    params = {"keys": ["range"], "values": ["0.4"]}
    arm.call("set_planner_params", "SetPlannerParams", planner_config="RRTConnect", group="arm",
             params=params, replace=True)  # fmt: skip
    told = arm.call(
        "get_planner_params", "GetPlannerParams", planner_config="RRTConnect", group="arm"
    )
    assert (told.params.keys, told.params.values) == (["range"], ["0.4"])
    assert arm.move(plan_only=True, goal_constraints=joint_goal([0.0] * 6)).error_code.val == 1


@pytest.mark.parametrize(
    ("name", "plugin"),
    [("chomp", "chomp_interface/CHOMPPlanner"), ("stomp", "stomp_moveit/StompPlanner")],
)
def test_pipelines_of_other_planners_say_who_plans(
    make_arm: Any, capsys: pytest.CaptureFixture[str], name: str, plugin: str
) -> None:
    arm = make_arm(planning_pipelines=["ompl", name], **{name: {"planning_plugin": plugin}})
    result = arm.move(
        plan_only=True, pipeline_id=name, planner_id="CHOMP", goal_constraints=joint_goal([0.0] * 6)
    )
    assert result.error_code.val == 1, result.error_code
    text = f"the planning plug-in '{plugin}' of pipeline '{name}' is not here; RRTConnect plans"
    assert text in capsys.readouterr().err


def test_a_cancelled_goal_stops_the_controllers(arm: ArmBench) -> None:
    arm.robot.servers[0].close()
    arm.robot.follow("arm_controller", lambda goal: goal.ended.wait(stretched()))
    goal = arm.send(goal_constraints=joint_goal([0.0] * 6), max_velocity_scaling_factor=0.1)
    arm.bench.eventually(lambda: arm.robot.goals.get("arm_controller"))
    goal.cancel()
    assert goal.wait(stretched())
    assert goal.status.name == "CANCELED"
    assert goal.result.error_code.val == -7
