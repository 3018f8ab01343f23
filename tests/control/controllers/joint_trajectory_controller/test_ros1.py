"""ROS 1's trajectory controllers on ideal joints."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from tests.control.controllers.joint_trajectory_controller.arm_bench import ACTION, JOINTS, Bench
from tests.control.plant import PlantJoint
from tests.control.trajectory_messages import goal, point, trajectory

from gazelle.control.errors import ControllerError
from gazelle.control.trajectory.waypoints import ErrorCode
from gazelle.description.model import Joint, JointType, Model

POSITION = "position_controllers/JointTrajectoryController"
EFFORT = "effort_controllers/JointTrajectoryController"
VELOCITY = "velocity_controllers/JointTrajectoryController"
SLOW = {"gains": {name: {"p": 20.0} for name in JOINTS}}
GAINS = {"gains": {name: {"p": 400.0, "d": 40.0} for name in JOINTS}}
ZERO = [0.0, 0.0]


def to(time_s: float, *positions: float, names: tuple[str, ...] = JOINTS, **more: Any) -> Any:
    """A trajectory to a place, at rest there."""
    n = len(positions)
    return trajectory(names, point(time_s, positions, [0.0] * n, [0.0] * n), **more)


def smooth(x: np.ndarray) -> np.ndarray:
    """The quintic from rest to rest."""
    return 10 * x**3 - 15 * x**4 + 6 * x**5


def test_it_holds_where_it_started() -> None:
    bench = Bench(POSITION, joints=[PlantJoint("shoulder", position=0.3), PlantJoint("elbow")])
    bench.run(20)
    np.testing.assert_array_equal(bench.commanded(), np.tile([0.3, 0.0], (20, 1)))


def test_commands_equal_the_spline() -> None:
    bench = Bench(POSITION)
    bench.run(10)
    sent = bench.send(goal(to(1.0, 0.5, -1.0)))
    bench.run(1100)
    # It begins at the update after the last one: at 10 ms.
    x = np.clip(np.arange(1100) / 1000, 0.0, 1.0)[:, None]
    np.testing.assert_allclose(bench.commanded()[10:], smooth(x) * [0.5, -1.0], atol=1e-9)
    assert sent.state == "succeeded"
    assert sent.result == {"error_code": 0, "error_string": ""}


@pytest.mark.parametrize(
    ("type_name", "rows"),
    [("pos_vel_controllers", 2), ("pos_vel_acc_controllers", 3)],
)
def test_several_interfaces_get_the_reference(type_name: str, rows: int) -> None:
    words = ("position", "velocity", "acceleration")
    bench = Bench(
        f"{type_name}/JointTrajectoryController",
        joints=[PlantJoint(name, commands=words) for name in JOINTS],
    )
    assert set(bench.controller.commands) == {f"{j}/{w}" for j in JOINTS for w in words[:rows]}
    bench.ports.send("~/command", to(1.0, 1.0, 2.0))
    bench.run(501)
    x = 0.5
    wanted = (
        smooth(np.array(x)),
        30 * x**2 - 60 * x**3 + 30 * x**4,
        60 * x - 180 * x**2 + 120 * x**3,
    )
    for word, value in zip(words[:rows], wanted, strict=False):
        expected = np.array([1.0, 2.0]) * float(value)
        np.testing.assert_allclose(bench.commanded(word)[500], expected, atol=1e-9)


def test_effort_is_the_pids_on_the_errors() -> None:
    bench = Bench(EFFORT, GAINS | {"velocity_ff": {"shoulder": 3.0}})
    bench.ports.send("~/command", to(1.0, 1.0, 1.0))
    seen: list[float] = []

    def law(time_ns: int) -> None:
        x = (time_ns - 1_000_000) / 1e9
        wanted = float(smooth(np.array(x)))
        speed = 30 * x**2 - 60 * x**3 + 30 * x**4
        seen.append(400 * (wanted - q[0]) + 40 * (speed - v[0]) + 3.0 * speed)
        q[0], v[0] = bench.plant.position[0], bench.plant.velocity[0]

    q, v = [0.0], [0.0]
    bench.run(500, law)
    np.testing.assert_allclose(bench.commanded("effort")[:, 0], seen, atol=1e-9)


def test_velocity_tracks_within_the_loops_bound() -> None:
    bench = Bench(VELOCITY, SLOW | {"velocity_ff": dict.fromkeys(JOINTS, 1.0)})
    bench.ports.send("~/command", to(1.0, 1.0, -1.0))
    errors: list[float] = []
    bench.run(
        1200,
        lambda time_ns: errors.append(
            abs(float(smooth(np.array(min(time_ns / 1e9, 1.0)))) - bench.plant.position[0])
        ),
    )
    assert max(errors) < 2e-3
    assert bench.plant.position == pytest.approx([1.0, -1.0], abs=1e-3)


def test_effort_tracks_under_load() -> None:
    gains = {
        "gains": {name: {"p": 400.0, "i": 800.0, "d": 40.0, "i_clamp": 20.0} for name in JOINTS}
    }
    bench = Bench(EFFORT, gains, joints=[PlantJoint(name, load=-5.0) for name in JOINTS])
    bench.ports.send("~/command", to(2.0, 1.0, 1.0))
    errors: list[float] = []

    def keep(time_ns: int) -> None:
        wanted = float(smooth(np.array(min(time_ns / 2e9, 1.0))))
        errors.append(abs(wanted - bench.plant.position[0]))

    bench.run(4000, keep)
    assert max(errors) < 0.05
    assert errors[-1] < 1e-3


def test_gains_change_live() -> None:
    bench = Bench(EFFORT, GAINS)
    bench.run(1)
    bench.plant.position[:] = -0.1
    bench.ports.set_live("gains/elbow", p=1000.0)
    bench.run(1)
    assert bench.commanded("effort")[-1].tolist() == pytest.approx([40.0, 100.0])


def test_gains_of_positions_are_reported() -> None:
    bench = Bench(POSITION, GAINS)
    (found,) = bench.diagnostics
    assert found.code == "control.idle-gains"
    assert "'/controller/gains' has no effect" in found.message


def test_effort_needs_gains() -> None:
    with pytest.raises(
        ControllerError, match=r"No p gain specified for pid. Namespace: /controller/"
    ):
        Bench(EFFORT)


def test_feedback_comes_at_its_rate() -> None:
    bench = Bench(POSITION, {"action_monitor_rate": 10.0})
    sent = bench.send(goal(to(1.0, 1.0, 0.0)))
    bench.run(951)
    assert len(sent.feedback) == 9
    last = sent.feedback[-1]
    assert list(last.joint_names) == list(JOINTS)
    assert last.header.stamp.nanosec == 900_000_000
    assert last.desired.positions[0] == pytest.approx(float(smooth(np.array(0.9))), abs=1e-9)
    difference = last.desired.positions[0] - last.actual.positions[0]
    assert last.error.positions[0] == pytest.approx(difference)


def test_nobody_listening_costs_no_feedback() -> None:
    bench = Bench(POSITION, subscribed=False)
    sent = bench.send(goal(to(1.0, 1.0, 0.0)))
    sent.is_feedback_wanted = False
    bench.run(500)
    assert sent.feedback == []


def test_the_state_is_published_at_its_rate() -> None:
    bench = Bench(POSITION, {"state_publish_rate": 100.0})
    bench.ports.send("~/command", to(1.0, 1.0, 0.0))
    bench.run(501)
    messages = bench.ports.publishers["~/state"].messages
    assert len(messages) == 50
    last = messages[-1]
    assert (last.header.stamp.sec, last.header.stamp.nanosec) == (0, 500_000_000)
    assert last.reference.positions[0] == pytest.approx(0.5)
    assert last.reference.velocities[0] == pytest.approx(1.875)
    assert last.feedback.positions[0] == pytest.approx(bench.commanded()[499, 0])
    assert last.error.positions[0] == pytest.approx(0.5 - last.feedback.positions[0])


# Goals that end badly -------------------------------------------------------------------------


def test_leaving_the_path_aborts_and_the_trajectory_goes_on() -> None:
    bench = Bench(VELOCITY, SLOW | {"constraints": {"elbow": {"trajectory": 0.05}}})
    sent = bench.send(goal(to(1.0, 0.2, 0.2)))
    bench.run(100)
    assert sent.state == "active"
    bench.plant.position[1] += 0.5
    bench.run(2)
    assert sent.state == "aborted"
    assert sent.result["error_code"] == ErrorCode.PATH_TOLERANCE_VIOLATED
    assert sent.result["error_string"].startswith("elbow path error -0.")
    bench.run(2000)
    assert bench.plant.position == pytest.approx([0.2, 0.2], abs=1e-3)


def test_tolerances_of_the_goal_come_first() -> None:
    bench = Bench(VELOCITY, SLOW | {"constraints": {"elbow": {"trajectory": 0.05}}})
    sent = bench.send(goal(to(1.0, 0.2, 0.2), path={"elbow": (-1.0,)}))
    bench.run(100)
    bench.plant.position[1] += 0.5
    bench.run(2)
    assert sent.state == "active"


def test_missing_the_goal_aborts() -> None:
    bench = Bench(EFFORT, {"gains": {name: {"p": 0.0} for name in JOINTS}})
    sent = bench.send(goal(to(0.1, 1.0, 1.0), end={"elbow": (0.1,)}, goal_time_s=0.2))
    bench.run(300)
    assert sent.state == "active"
    bench.run(2)
    assert sent.state == "aborted"
    assert sent.result == {
        "error_code": ErrorCode.GOAL_TOLERANCE_VIOLATED,
        "error_string": "elbow goal error 1.000000",
    }


def test_without_goal_time_the_goal_must_be_reached_on_time() -> None:
    bench = Bench(EFFORT, {"gains": {name: {"p": 0.0} for name in JOINTS}})
    sent = bench.send(goal(to(0.1, 1.0, 1.0), end={"elbow": (0.1,)}))
    bench.run(101)
    assert sent.state == "aborted"


def test_moving_too_fast_at_the_goal_violates_the_velocity_tolerance() -> None:
    bench = Bench(EFFORT, {"gains": {name: {"p": 0.0} for name in JOINTS}})
    sent = bench.send(goal(to(0.1, 0.0, 0.0)))
    bench.plant.velocity[0] = 0.02
    bench.run(102)
    assert sent.result["error_code"] == ErrorCode.GOAL_TOLERANCE_VIOLATED


@pytest.mark.parametrize(
    ("request_", "code", "text"),
    [
        (goal(to(1, 0, names=("shoulder",))), ErrorCode.INVALID_JOINTS, "'elbow' is missing"),
        (goal(to(1, 0, 0, names=("shoulder", "wrist"))), ErrorCode.INVALID_JOINTS, "'wrist'"),
        (goal(trajectory(JOINTS, point(1, [0]))), ErrorCode.INVALID_GOAL, "Size mismatch"),
        (
            goal(trajectory(JOINTS, point(1, [], ZERO))),
            ErrorCode.INVALID_GOAL,
            "Endpoint positions",
        ),
        (
            goal(trajectory(JOINTS, point(1, ZERO), point(1, ZERO))),
            ErrorCode.INVALID_GOAL,
            "not strictly increasing in time",
        ),
        (goal(to(0.5, 0, 0, stamp_s=0.1)), ErrorCode.INVALID_GOAL, "occur before the current time"),
    ],
)
def test_what_cannot_be_followed_is_rejected(request_: Any, code: ErrorCode, text: str) -> None:
    bench = Bench(POSITION)
    bench.run(1000)
    running = bench.send(goal(to(1, 1, 1)))
    sent = bench.send(request_)
    assert sent.state == "rejected"
    assert sent.result["error_code"] == code
    assert text in sent.result["error_string"]
    assert running.state == "active"
    assert any(text in line for level, line in bench.ports.lines if level == "error")


def test_goals_are_rejected_while_it_does_not_run() -> None:
    bench = Bench(POSITION, start=False)
    sent = bench.send(goal(to(1, 1, 1)))
    assert sent.state == "rejected"
    assert "Controller is not running." in sent.result["error_string"]
    with pytest.raises(ControllerError, match="Can't sample trajectory"):
        bench.query(0.0)


# Replacing ------------------------------------------------------------------------------------


def test_a_new_goal_preempts_without_a_jump() -> None:
    bench = Bench(POSITION)
    first = bench.send(goal(to(1.0, 1.0, 1.0)), "first")
    bench.run(500)
    second = bench.send(goal(to(1.0, 0.0, 0.0)), "second")
    assert (first.state, second.state) == ("canceled", "active")
    bench.run(1100)
    assert second.state == "succeeded"
    commands = bench.commanded()
    assert np.abs(np.diff(commands, axis=0)).max() < 2.5e-3
    assert np.abs(np.diff(commands, n=3, axis=0)).max() < 1e-6


def test_a_topics_trajectory_preempts() -> None:
    bench = Bench(POSITION)
    sent = bench.send(goal(to(1.0, 1.0, 1.0)))
    bench.run(100)
    bench.ports.send("~/command", to(0.5, 0.1, 0.1))
    assert sent.state == "canceled"
    bench.run(600)
    assert bench.commanded()[-1].tolist() == pytest.approx([0.1, 0.1])


def test_a_topics_bad_trajectory_preempts_nothing() -> None:
    bench = Bench(POSITION)
    sent = bench.send(goal(to(1.0, 1.0, 1.0)))
    bench.ports.send("~/command", to(0.5, 0.1, names=("wrist",)))
    assert sent.state == "active"


def test_an_empty_trajectory_holds() -> None:
    bench = Bench(POSITION)
    sent = bench.send(goal(to(1.0, 1.0, 1.0)))
    bench.run(500)
    bench.ports.send("~/command", trajectory(()))
    bench.run(100)
    assert sent.state == "canceled"
    # What is held was measured before the last command took effect.
    held = bench.commanded()[498]
    np.testing.assert_allclose(bench.commanded()[500:], np.tile(held, (100, 1)))


def test_an_empty_goal_succeeds_at_once() -> None:
    bench = Bench(POSITION)
    sent = bench.send(goal(trajectory(JOINTS)))
    bench.run(1)
    assert sent.state == "succeeded"


def test_cancelling_holds_the_position() -> None:
    bench = Bench(POSITION)
    sent = bench.send(goal(to(1.0, 1.0, 1.0)))
    bench.run(500)
    assert bench.ports.cancel(ACTION, sent)
    assert sent.state == "canceled"
    bench.run(100)
    assert np.ptp(bench.commanded()[500:], axis=0).tolist() == [0.0, 0.0]


def test_cancelling_comes_to_rest_within_stop_trajectory_duration() -> None:
    bench = Bench(POSITION, {"stop_trajectory_duration": 0.2})
    sent = bench.send(goal(to(1.0, 1.0, 1.0)))
    bench.run(501)
    bench.ports.cancel(ACTION, sent)
    bench.run(300)
    commands = bench.commanded()
    speed = np.diff(commands[:, 0]) * 1000
    assert np.abs(np.diff(speed)).max() < 0.05
    assert speed[500] == pytest.approx(1.875, abs=0.01)
    assert commands[-1, 0] == pytest.approx(0.5 + 1.875 * 0.2 * 5 / 8, abs=1e-9)
    assert speed[-50:] == pytest.approx(np.zeros(50), abs=1e-9)


def test_stopping_ends_the_goal_and_leaves_the_command() -> None:
    bench = Bench(POSITION)
    sent = bench.send(goal(to(1.0, 1.0, 1.0)))
    bench.run(500)
    before = bench.robot.interface_values.commands.copy()
    bench.controller.stop(bench.time_ns)
    assert sent.state == "canceled"
    np.testing.assert_array_equal(bench.robot.interface_values.commands, before)


def test_some_joints_may_move_alone() -> None:
    bench = Bench(POSITION, {"allow_partial_joints_goal": True})
    first = bench.send(goal(to(1.0, 1.0, 1.0)), "first")
    bench.run(500)
    second = bench.send(goal(to(0.2, 0.0, names=("elbow",))), "second")
    assert first.state == "canceled"
    bench.run(800)
    assert second.state == "succeeded"
    commands = bench.commanded()
    x = np.clip(np.arange(1300) / 1000, 0.0, 1.0)
    np.testing.assert_allclose(commands[:, 0], smooth(x), atol=1e-9)
    assert commands[-1].tolist() == pytest.approx([1.0, 0.0])


def test_joints_may_come_in_any_order() -> None:
    bench = Bench(POSITION)
    bench.ports.send("~/command", to(0.1, 1.0, 2.0, names=("elbow", "shoulder")))
    bench.run(200)
    assert bench.commanded()[-1].tolist() == pytest.approx([2.0, 1.0])


def test_continuous_joints_take_the_shorter_way() -> None:
    joints = [PlantJoint("shoulder", position=3.0, is_continuous=True), PlantJoint("elbow")]
    bench = Bench(POSITION, joints=joints)
    sent = bench.send(goal(to(1.0, -3.0, 0.0), end={"shoulder": (0.01,)}))
    bench.run(1100)
    assert sent.state == "succeeded"
    assert bench.commanded()[-1, 0] == pytest.approx(2 * math.pi - 3.0)
    assert bench.commanded()[:, 0].min() == 3.0


def test_errors_of_prismatic_joints_are_not_wrapped() -> None:
    bench = Bench(EFFORT, GAINS, start=False)
    prismatic = Model(
        "arm",
        joints=(Joint("elbow", JointType.PRISMATIC, "a", "b"),),
    )
    robot = replace(bench.robot, model=prismatic)
    context = replace(bench.controller.context, robot=robot)
    controller = type(bench.controller)(context)
    controller.start(0)
    bench.plant.position[:] = -4.0
    robot.read(0, 0)
    controller.update(1_000_000, 1_000_000)
    commands = robot.interface_values.commands[
        robot.interface_values.command_indices([f"{n}/effort" for n in JOINTS])
    ]
    assert commands.tolist() == pytest.approx([400 * (4.0 - 2 * math.pi), 1600.0])


def test_the_state_at_a_time_can_be_asked_for() -> None:
    bench = Bench(POSITION)
    bench.run(10)
    bench.ports.send("~/command", to(1.0, 1.0, 2.0))
    answer = bench.query(0.51)
    assert list(answer.name) == list(JOINTS)
    assert answer.position == pytest.approx([0.5, 1.0])
    assert answer.velocity == pytest.approx([1.875, 3.75])
    assert answer.success
    bench.run(100)
    with pytest.raises(ControllerError, match="precedes trajectory start time"):
        bench.query(0.005)


@pytest.mark.parametrize(
    ("parameters", "text"),
    [
        ({"joints": []}, "'/controller/joints' is empty"),
        ({"joints": ["elbow", "elbow"]}, "joint 'elbow' is twice"),
        ({"joints": ["elbo"]}, "did you mean 'elbow'"),
    ],
)
def test_wrong_joints_are_named(parameters: dict[str, Any], text: str) -> None:
    with pytest.raises(ControllerError) as caught:
        Bench(POSITION, parameters)
    assert text in str(caught.value)


def test_ros2_robots_are_told_their_type() -> None:
    with pytest.raises(ControllerError, match="ROS 2 has joint_trajectory_controller/Joint"):
        Bench(POSITION, ros_version=2)
