"""Trajectories on controllers: who gets what, how long it may take, what is said when it fails."""

from __future__ import annotations

import threading
from typing import Any

import pytest
from tests.nodes.conftest import Bench
from tests.nodes.move_group.fake_robot import FakeRobot, trajectory
from tests.patience import stretched

from gazelle.description.moveit import ExecutionSettings
from gazelle.graph.actions import ServerGoal
from gazelle.motion.planning.error_codes import ErrorCode
from gazelle.nodes.move_group.planning_scene_monitor import CurrentStateMonitor
from gazelle.nodes.move_group.simple_controller_manager import ControllerKind, ControllerSpec
from gazelle.nodes.move_group.trajectory_execution_manager import (
    ExecutionStatus,
    TrajectoryExecutor,
)

ARM = ControllerSpec("arm", ControllerKind.FOLLOW_JOINT_TRAJECTORY, "arm/follow_joint_trajectory",
                     ("a", "b"), is_default=True)  # fmt: skip
HAND = ControllerSpec("hand", ControllerKind.GRIPPER_COMMAND, "hand/gripper_cmd", ("f", "g"),
                      command_joint="f", max_effort=7.0)  # fmt: skip


class Rig:
    """An executor with a robot."""

    def __init__(
        self, bench: Bench, *specs: ControllerSpec, ros_version: int = 2, **settings: Any
    ) -> None:
        positions = {"a": 0.0, "b": 0.0, "f": 0.0, "g": 0.0}
        self.robot = FakeRobot(bench.node, positions, ros_version)
        self.states = CurrentStateMonitor(bench.node, "/joint_states")
        self.executor = TrajectoryExecutor(
            bench.node, specs or (ARM, HAND), ExecutionSettings(**settings), self.states
        )
        self.robot.publish()
        assert not self.states.wait(["a", "b", "f", "g"], 0, 5.0)


@pytest.mark.parametrize("ros_version", [1, 2])
def test_every_controller_gets_its_own_joints(bench: Bench, ros_version: int) -> None:
    rig = Rig(bench, ros_version=ros_version)
    rig.robot.follow("arm")
    rig.robot.gripper("hand", lambda goal: goal.succeed())
    path = trajectory(["b", "f", "a"], [0.0, 0.0, 0.0], [0.2, 0.03, 0.1])
    assert rig.executor.execute(path).status is ExecutionStatus.SUCCEEDED
    sent = rig.robot.goals["arm"][0].trajectory
    assert sent.joint_names == ["b", "a"]
    assert list(sent.points[1].positions) == [0.2, 0.1]
    command = rig.robot.goals["hand"][0].command
    assert (command.position, command.max_effort) == (0.03, 7.0)
    assert rig.robot.positions["a"] == 0.1


def test_a_start_that_is_not_where_the_robot_is_is_refused(bench: Bench) -> None:
    rig = Rig(bench)
    rig.robot.follow("arm")
    outcome = rig.executor.execute(trajectory(["a", "b"], [0.0, 0.2], [0.1, 0.1]))
    assert outcome.status is ExecutionStatus.ABORTED
    assert outcome.status.code is ErrorCode.CONTROL_FAILED
    assert "start point deviates from current robot state more than 0.01" in outcome.why
    assert "joint 'b': expected: 0.2, current: 0" in outcome.why
    assert not rig.robot.goals
    rig.executor.settings = ExecutionSettings(
        allowed_start_tolerance=0.0, wait_for_completion=False
    )
    outcome = rig.executor.execute(trajectory(["a", "b"], [0.0, 0.2], [0.1, 0.1]))
    assert outcome.status is ExecutionStatus.SUCCEEDED


def test_whole_turns_of_a_continuous_joint_are_no_deviation(bench: Bench) -> None:
    rig = Rig(bench, ARM)
    rig.robot.follow("arm")
    executor = TrajectoryExecutor(
        bench.node,
        [ARM],
        ExecutionSettings(wait_for_completion=False),
        rig.states,
        endless_joints=["a"],
    )
    path = trajectory(["a", "b"], [6.2831853, 0.0], [6.3, 0.0])
    assert executor.execute(path).status is ExecutionStatus.SUCCEEDED


def test_a_joint_that_nobody_tells_of_is_named(bench: Bench) -> None:
    spec = ControllerSpec("x", ControllerKind.FOLLOW_JOINT_TRAJECTORY, "x/f", ("q",))
    rig = Rig(bench, spec)
    outcome = rig.executor.execute(trajectory(["q"], [0.0], [1.0]))
    assert "couldn't receive full current joint state within 1s" in outcome.why
    assert outcome.why.endswith("nothing on /joint_states tells of q")


def test_a_controller_that_takes_too_long_is_stopped(bench: Bench) -> None:
    rig = Rig(bench, ARM, allowed_duration_scaling=1.0, allowed_duration_margin_s=0.05)
    ended: list[ServerGoal] = []
    rig.robot.follow("arm", lambda goal: (goal.ended.wait(stretched(10.0)), ended.append(goal)))
    path = trajectory(["a", "b"], [0.0, 0.0], [0.1, 0.1], seconds=0.1)
    outcome = rig.executor.execute(path)
    assert outcome.status is ExecutionStatus.TIMED_OUT
    assert "upper bound for the trajectory execution was 0.150000 seconds" in outcome.why
    assert bench.eventually(lambda: ended)[0].status.name == "CANCELED"


def test_without_monitoring_a_slow_controller_may_be_slow(bench: Bench) -> None:
    rig = Rig(bench, ARM, duration_monitoring=False, wait_for_completion=False)
    pause = threading.Event()

    def end(goal: ServerGoal) -> None:
        pause.wait(0.4)
        goal.succeed()

    rig.robot.follow("arm", end)
    path = trajectory(["a", "b"], [0.0, 0.0], [0.1, 0.1], seconds=0.01)
    assert rig.executor.execute(path).status is ExecutionStatus.SUCCEEDED


def test_a_request_to_stop_cancels_the_goals(bench: Bench) -> None:
    rig = Rig(bench, ARM)
    rig.robot.follow("arm", lambda goal: rig.executor.stop("the user"))
    path = trajectory(["a", "b"], [0.0, 0.0], [0.1, 0.1], seconds=5.0)
    assert rig.executor.execute(path) == (ExecutionStatus.PREEMPTED, "stopped by the user")


def test_what_a_controller_says_of_its_failure_is_passed_on(bench: Bench) -> None:
    rig = Rig(bench, ARM)
    result = {"error_code": -4, "error_string": "joint a hit something"}
    rig.robot.follow("arm", lambda goal: goal.abort(result))
    outcome = rig.executor.execute(trajectory(["a", "b"], [0.0, 0.0], [0.1, 0.1]))
    assert outcome == (
        ExecutionStatus.ABORTED,
        "controller 'arm' failed with error PATH_TOLERANCE_VIOLATED: joint a hit something",
    )


@pytest.mark.parametrize("allow", [False, True])
def test_a_stalled_gripper_is_a_failure_unless_that_is_allowed(bench: Bench, allow: bool) -> None:
    spec = ControllerSpec(
        "hand", HAND.kind, HAND.action, HAND.joints, command_joint="f", allow_failure=allow
    )
    rig = Rig(bench, spec, wait_for_completion=False)
    rig.robot.gripper("hand", lambda goal: goal.abort({"position": 0.02, "stalled": True}))
    outcome = rig.executor.execute(trajectory(["f"], [0.0], [0.0]))
    if allow:
        assert outcome.status is ExecutionStatus.SUCCEEDED
    else:
        assert outcome.status is ExecutionStatus.ABORTED
        assert outcome.why.startswith("controller 'hand' stalled at 0.02; allow_failure: true")


def test_a_parallel_gripper_gets_the_sum_of_its_fingers(bench: Bench) -> None:
    spec = ControllerSpec("hand", HAND.kind, HAND.action, HAND.joints, is_parallel=True)
    rig = Rig(bench, spec, wait_for_completion=False)
    rig.robot.gripper("hand", lambda goal: goal.succeed())
    rig.executor.execute(trajectory(["f", "g"], [0.0, 0.0], [0.02, 0.03]))
    assert rig.robot.goals["hand"][0].command.position == pytest.approx(0.05)
