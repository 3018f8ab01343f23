"""moveit_py as its tutorial uses it."""

from __future__ import annotations

import sys
import threading
from collections.abc import Iterator
from typing import Any

import pytest
from tests.nodes.conftest import (
    Bench,
    bench,  # noqa: F401 - a fixture
)
from tests.nodes.move_group.conftest import JOINTS, READY, box_object, parameters, pose
from tests.nodes.move_group.fake_robot import FakeRobot
from tests.patience import eventually

from gazelle.compat.moveit.py import planning
from gazelle.compat.moveit.py.kinematic_constraints import construct_joint_constraint
from gazelle.compat.moveit.py.robot import RobotState
from gazelle.compat.moveit.py.scene import PlanningScene
from gazelle.interfaces import fill, message_type, service_type
from gazelle.nodes.move_group.trajectory_execution_manager import ExecutionStatus


@pytest.fixture
def moveit(
    bench: Bench,  # noqa: F811 - the fixture
    monkeypatch: pytest.MonkeyPatch,
) -> Iterator[planning.MoveItPy]:
    robot = FakeRobot(bench.node, dict(zip([*JOINTS, "finger_joint"], [*READY, 0.04], strict=True)))
    robot.follow("arm_controller")
    stop = threading.Event()

    def publish() -> None:
        while not stop.wait(0.02):
            robot.publish()

    thread = threading.Thread(target=publish, daemon=True)
    thread.start()
    monkeypatch.setattr(sys, "argv", ["program"])
    monkeypatch.setattr(planning.Graph, "open", lambda: bench.graph)
    yield planning.MoveItPy("moveit_py", config_dict=parameters())
    stop.set()
    thread.join()


def test_tutorial_of_moveit_py(moveit: planning.MoveItPy) -> None:
    arm = moveit.get_planning_component("arm")
    model = moveit.get_robot_model()
    assert arm.named_target_states == ["up", "ready"]

    arm.set_start_state_to_current_state()
    arm.set_goal_state(configuration_name="up")
    plan = arm.plan()
    assert plan and plan.trajectory is not None and plan.trajectory.duration > 1.0
    assert moveit.execute(plan.trajectory) is ExecutionStatus.SUCCEEDED
    part = plan.trajectory.get_robot_trajectory_msg([JOINTS[2], JOINTS[0]]).joint_trajectory
    whole = plan.trajectory.get_robot_trajectory_msg().joint_trajectory
    assert part.joint_names == [JOINTS[0], JOINTS[2]]
    assert list(part.points[5].positions) == [whole.points[5].positions[i] for i in (0, 2)]

    state = RobotState(model)
    state.set_to_default_values("arm", "ready")
    group = model.get_joint_model_group("arm")
    arm.set_start_state_to_current_state()
    arm.set_goal_state(motion_plan_constraints=[construct_joint_constraint(state, group)])
    assert arm.plan()

    stamped: Any = message_type("geometry_msgs/msg/PoseStamped")()
    fill(stamped, {"header": {"frame_id": "world"}, "pose": pose(0.36, 0.18, 0.3, (0, 1, 0, 0))})
    arm.set_goal_state(pose_stamped_msg=stamped, pose_link="tool_link")
    assert arm.plan(planning.PlanRequestParameters(planning_attempts=2))


def test_scene_and_states(moveit: planning.MoveItPy) -> None:
    monitor, arm = moveit.get_planning_scene_monitor(), moveit.get_planning_component("arm")
    box: Any = message_type("moveit_msgs/msg/CollisionObject")()
    fill(box, box_object("crate", [0.2, 0.2, 0.2], [0.178, 0.0, 0.32]))
    with monitor.read_only() as scene:
        assert not scene.is_state_colliding(joint_model_group_name="arm")
    color: Any = message_type("moveit_msgs/msg/ObjectColor")(id="crate")
    color.color.g = 1.0
    with monitor.read_write() as scene:
        scene.apply_collision_object(box, color)
        (shown,) = scene.planning_scene_message.object_colors
        assert (shown.id, shown.color.g) == ("crate", 1.0)
    with monitor.read_only() as scene:
        assert scene.is_state_colliding(joint_model_group_name="arm")
    arm.set_goal_state(configuration_name="up")
    failed = arm.plan()
    assert not failed and failed.error_code.val == -10
    assert "object 'crate'" in failed.error_code.message
    with monitor.read_write() as scene:
        scene.remove_all_collision_objects()
    assert arm.plan()


def test_scene_of_ones_own_knows_frames_paths_and_limits(moveit: planning.MoveItPy) -> None:
    model = moveit.get_robot_model()
    scene = PlanningScene(model)
    state = RobotState(model)
    state.joint_positions = {**dict(zip(JOINTS, READY, strict=True)), "finger_joint": 0.04}
    scene.current_state = state
    assert scene.is_state_valid(state, "arm")
    box: Any = message_type("moveit_msgs/msg/CollisionObject")()
    fill(box, box_object("crate", [0.2, 0.2, 0.2], [0.178, 0.0, 0.32]))
    scene.apply_collision_object(box)
    assert scene.knows_frame_transform("crate") and not scene.knows_frame_transform("crat")
    assert scene.get_frame_transform("crate")[:3, 3] == pytest.approx([0.178, 0.0, 0.32])
    assert scene.is_state_colliding("arm") and not scene.is_state_valid(state, "arm")
    other = RobotState(model)
    assert not scene.is_path_valid([other, state], "arm")
    names = [one.id for one in scene.planning_scene_message.world.collision_objects]
    assert names == ["crate"]
    scene.remove_all_collision_objects()
    assert scene.is_path_valid([other, state], "arm")
    other.joint_positions = {"joint_2": 3.0}
    assert not scene.is_state_valid(other, "arm")


def test_trajectories_are_executed_in_every_way_of_calling(moveit: planning.MoveItPy) -> None:
    arm = moveit.get_planning_component("arm")
    for number, call in enumerate((
        lambda plan: moveit.execute(plan, []),
        lambda plan: moveit.execute(plan, controllers=[]),
        lambda plan: moveit.execute("arm", plan, True),
        lambda plan: moveit.execute(plan, blocking=True, controllers=["arm_controller"]),
    )):  # fmt: skip
        arm.set_start_state_to_current_state()
        arm.set_goal_state(configuration_name=("up", "ready")[number % 2])
        assert call(arm.plan().trajectory) is ExecutionStatus.SUCCEEDED
    arm.set_goal_state(configuration_name="up")
    assert moveit.execute(arm.plan().trajectory, blocking=False) is None
    # What it says at its end would be another test's output.
    eventually(lambda: not any("_execute" in one.name for one in threading.enumerate()))


def test_states_solve_kinematics(moveit: planning.MoveItPy) -> None:
    state = RobotState(moveit.get_robot_model())
    state.set_to_default_values("arm", "ready")
    target: Any = state.get_pose("tool_link")
    target.position.z += 0.05
    assert state.set_from_ik("arm", target, "tool_link", 1.0)
    assert state.get_pose("tool_link").position.z == pytest.approx(target.position.z, abs=1e-4)
    target.position.x = 3.0
    assert not state.set_from_ik("arm", target, "tool_link", 0.1)
    assert state.get_jacobian("arm").shape == (6, 6)


def test_mistakes_are_told(moveit: planning.MoveItPy) -> None:
    with pytest.raises(RuntimeError, match="no planning group 'arms'"):
        moveit.get_planning_component("arms")
    arm = moveit.get_planning_component("arm")
    with pytest.raises(ValueError, match="exactly one kind of goal"):
        arm.set_goal_state()
    with pytest.raises(Exception, match=r"has no state 'redy'.*ready"):
        arm.set_goal_state(configuration_name="redy")
    with pytest.raises(RuntimeError, match="there is no parameter 'robot_description'"):
        planning.MoveItPy("other", config_dict={"robot_description_semantic": "<robot/>"})


def test_scene_is_told_by_the_service_of_its_node(moveit: planning.MoveItPy, bench: Bench) -> None:  # noqa: F811
    kind = service_type("moveit_msgs/GetPlanningScene")
    client = bench.node.create_client("/get_planning_scene", kind)
    request = kind.Request()
    request.components.components = 1
    answer = client.call(request, timeout_s=20.0)
    assert answer.scene.robot_model_name == moveit.get_robot_model().name
