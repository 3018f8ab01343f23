"""ROS 2's trajectory controller on ideal joints."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from tests.control.controllers.joint_trajectory_controller.arm_bench import (
    ACTION,
    JOINTS,
    ROS2,
    Bench,
)
from tests.control.plant import PlantJoint
from tests.control.trajectory_messages import goal, point, trajectory

from gazelle.control.errors import ControllerError
from gazelle.control.resource_manager import JointLimits
from gazelle.control.trajectory.waypoints import ErrorCode
from gazelle.interfaces import message_type

TOPIC = "~/joint_trajectory"
SLOW = {"gains": {name: {"p": 20.0} for name in JOINTS}}
STIFF = {"gains": {name: {"p": 400.0, "d": 40.0} for name in JOINTS}}


def commands(*words: str) -> dict[str, Any]:
    return {"command_interfaces": list(words)}


def to(time_s: float, *positions: float, names: tuple[str, ...] = JOINTS, **more: Any) -> Any:
    """A trajectory to a place, at rest there."""
    n = len(positions)
    return trajectory(names, point(time_s, positions, [0.0] * n, [0.0] * n), **more)


def smooth(x: np.ndarray | float) -> np.ndarray:
    """The quintic from rest to rest."""
    x = np.asarray(x)
    return 10 * x**3 - 15 * x**4 + 6 * x**5


def test_it_holds_where_it_started() -> None:
    bench = Bench(ROS2, joints=[PlantJoint("shoulder", position=0.3), PlantJoint("elbow")])
    bench.run(20)
    np.testing.assert_array_equal(bench.commanded(), np.tile([0.3, 0.0], (20, 1)))


@pytest.mark.parametrize("uses_last", [True, False])
def test_it_holds_the_last_command_when_told_so(uses_last: bool) -> None:
    key = "set_last_command_interface_value_as_state_on_activation"
    bench = Bench(ROS2, {key: uses_last}, start=False)
    bench.robot.interface_values.commands[
        bench.robot.interface_values.command_indices(bench.controller.commands)
    ] = 0.5
    bench.start()
    bench.run(1)
    assert bench.commanded()[0].tolist() == [0.5 * uses_last] * 2


def test_commands_equal_the_spline() -> None:
    bench = Bench(ROS2)
    bench.run(10)
    sent = bench.send(goal(to(1.0, 0.5, -1.0)))
    bench.run(1100)
    x = np.clip(np.arange(1100) / 1000, 0.0, 1.0)[:, None]
    np.testing.assert_allclose(bench.commanded()[10:], smooth(x) * [0.5, -1.0], atol=1e-9)
    assert sent.state == "succeeded"
    assert sent.result == {"error_code": 0, "error_string": "Goal successfully reached!"}


@pytest.mark.parametrize(
    "words", [("position", "velocity"), ("position", "velocity", "acceleration")]
)
def test_several_interfaces_get_the_reference(words: tuple[str, ...]) -> None:
    joints = [
        PlantJoint(name, commands=("position", "velocity", "acceleration")) for name in JOINTS
    ]
    bench = Bench(ROS2, commands(*words), joints=joints)
    assert set(bench.controller.commands) == {f"{j}/{w}" for j in JOINTS for w in words}
    bench.ports.send(TOPIC, to(1.0, 1.0, 2.0))
    bench.run(501)
    x = 0.5
    wanted = (smooth(x), 30 * x**2 - 60 * x**3 + 30 * x**4, 60 * x - 180 * x**2 + 120 * x**3)
    # The plant runs ahead with the velocities, which the reference does not look at.
    for word, value in zip(words, wanted, strict=False):
        expected = np.array([1.0, 2.0]) * float(value)
        np.testing.assert_allclose(bench.commanded(word)[500], expected, atol=1e-9)


def test_effort_is_the_pids_on_the_errors_with_feed_forward() -> None:
    gains = {name: {"p": 400.0, "d": 40.0, "ff_velocity_scale": 3.0} for name in JOINTS}
    bench = Bench(ROS2, commands("effort") | {"gains": gains})
    bench.ports.send(
        TOPIC,
        trajectory(JOINTS, point(1.0, [1.0] * 2, [0.0] * 2, [0.0] * 2, [8.0] * 2)),
    )
    seen: list[float] = []

    def law(time_ns: int) -> None:
        x = (time_ns - 1_000_000) / 1e9
        speed = 30 * x**2 - 60 * x**3 + 30 * x**4
        effort = 400 * (float(smooth(x)) - q[0]) + 40 * (speed - v[0])
        seen.append(effort + 3.0 * speed + 8.0 * x)
        q[0], v[0] = bench.plant.position[0], bench.plant.velocity[0]

    q, v = [0.0], [0.0]
    bench.run(500, law)
    np.testing.assert_allclose(bench.commanded("effort")[:, 0], seen, atol=1e-9)


def test_position_and_effort_get_the_waypoints_efforts() -> None:
    bench = Bench(ROS2, commands("position", "effort"))
    bench.ports.send(TOPIC, trajectory(JOINTS, point(1.0, [1, 1], [], [], [4.0, 8.0])))
    bench.run(501)
    assert bench.commanded("effort")[500].tolist() == pytest.approx([2.0, 4.0])


def test_velocity_alone_is_a_loop_unless_it_is_open() -> None:
    for is_open in (False, True):
        bench = Bench(ROS2, commands("velocity") | SLOW | {"open_loop_control": is_open})
        bench.ports.send(TOPIC, to(1.0, 1.0, 1.0))
        bench.run(501)
        speed, error = 1.875, 0.5 - bench.commanded("velocity")[:500, 0].sum() / 1000
        expected = speed if is_open else 20.0 * error
        assert bench.commanded("velocity")[500, 0] == pytest.approx(expected, rel=1e-6)


def test_effort_tracks_under_load() -> None:
    gain = {"p": 400.0, "i": 800.0, "d": 40.0, "i_clamp": 20.0}
    bench = Bench(
        ROS2,
        commands("effort") | {"gains": dict.fromkeys(JOINTS, gain)},
        joints=[PlantJoint(name, load=-5.0) for name in JOINTS],
    )
    bench.ports.send(TOPIC, to(2.0, 1.0, 1.0))
    errors: list[float] = []

    def keep(time_ns: int) -> None:
        wanted = float(smooth(min(time_ns / 2e9, 1.0)))
        errors.append(abs(wanted - bench.plant.position[0]))

    bench.run(4000, keep)
    assert max(errors) < 0.05
    assert errors[-1] < 1e-3


def test_gains_of_positions_are_reported() -> None:
    bench = Bench(ROS2, STIFF)
    (found,) = bench.diagnostics
    assert found.code == "control.idle-gains"
    assert "no PID is computed" in found.message


def test_wrapping_is_no_idle_gain() -> None:
    assert not list(Bench(ROS2, {"gains": {"elbow": {"angle_wraparound": True}}}).diagnostics)


def test_gains_and_feed_forward_change_live() -> None:
    bench = Bench(ROS2, commands("effort") | STIFF)
    bench.run(1)
    bench.plant.position[:] = -0.1
    bench.ports.set_live("gains.elbow", p=1000.0)
    bench.run(1)
    assert bench.commanded("effort")[-1].tolist() == pytest.approx([40.0, 100.0])
    bench.plant.position[:] = bench.plant.velocity[:] = 0.0
    assert bench.controller.changed({"gains.elbow.ff_velocity_scale": 2.0}) == ""
    bench.ports.send(TOPIC, trajectory(JOINTS, point(1.0, [1.0, 1.0])))
    bench.run(1)
    slope = np.array([1.0, 1.0])
    expected = 40 * slope + [0.0, 2.0]
    assert bench.commanded("effort")[-1] == pytest.approx(expected)


def test_the_clamp_of_the_integral_changes_live() -> None:
    gains = {name: {"p": 0.0, "i": 100.0, "i_clamp": 1.0} for name in JOINTS}
    bench = Bench(ROS2, commands("effort") | {"gains": gains})
    bench.plant.position[:] = -1.0
    bench.start()
    bench.ports.send(TOPIC, to(0.001, 0.0, 0.0))
    bench.run(200)
    assert bench.commanded("effort")[-1].tolist() == pytest.approx([1.0, 1.0])
    assert bench.controller.changed({"gains.elbow.i_clamp": 3.0}) == ""
    bench.run(1)
    assert bench.commanded("effort")[-1].tolist() == pytest.approx([1.0, 3.0])
    assert bench.ports.live["gains.elbow"].values["i_clamp_max"] == 3.0


def test_live_gains_without_a_loop_are_remarked_on() -> None:
    bench = Bench(ROS2)
    assert bench.controller.changed({"gains.elbow.p": 3.0}) == ""
    assert any("'gains.elbow.p' has no effect" in text for _, text in bench.ports.lines)


# Goals that end badly -------------------------------------------------------------------------


def test_leaving_the_path_aborts_and_holds() -> None:
    bench = Bench(
        ROS2, commands("velocity") | SLOW | {"constraints": {"elbow": {"trajectory": 0.1}}}
    )
    sent = bench.send(goal(to(1.0, 0.2, 0.2)))
    bench.run(100)
    assert sent.state == "active"
    bench.plant.position[1] += 0.5
    bench.run(1)
    assert sent.state == "aborted"
    assert sent.result == {
        "error_code": ErrorCode.PATH_TOLERANCE_VIOLATED,
        "error_string": "Aborted due to path tolerance violation",
    }
    assert any("State tolerances failed for joint 1 ('elbow')" in t for _, t in bench.ports.lines)
    held = bench.plant.position.copy()
    bench.run(1000)
    np.testing.assert_allclose(bench.plant.position, held, atol=5e-3)


def test_a_topics_trajectory_is_held_to_the_tolerances_too() -> None:
    bench = Bench(
        ROS2, commands("velocity") | SLOW | {"constraints": {"elbow": {"trajectory": 0.1}}}
    )
    bench.ports.send(TOPIC, to(1.0, 0.2, 0.2))
    bench.run(100)
    bench.plant.position[1] += 0.5
    bench.run(1000)
    assert bench.plant.position[1] > 0.45


def test_missing_the_goal_aborts_after_goal_time() -> None:
    bench = Bench(ROS2, commands("effort"))
    sent = bench.send(goal(to(0.1, 1.0, 1.0), end={"elbow": (0.1,)}, goal_time_s=0.2))
    bench.run(301)
    assert sent.state == "active"
    bench.run(1)
    assert sent.state == "aborted"
    assert sent.result == {
        "error_code": ErrorCode.GOAL_TOLERANCE_VIOLATED,
        "error_string": "Aborted due to goal_time_tolerance exceeding by 0.201000 seconds",
    }


def test_without_goal_time_it_waits_for_ever_or_until_cmd_timeout() -> None:
    for timeout_s, state in ((0.0, "active"), (1.0, "aborted")):
        bench = Bench(ROS2, commands("effort") | {"cmd_timeout": timeout_s})
        sent = bench.send(goal(to(0.1, 1.0, 1.0), end={"elbow": (0.1,)}))
        bench.run(1102 + 1)
        assert sent.state == state
    assert sent.result["error_string"] == "Aborted due to command timeout"


def test_a_cmd_timeout_within_goal_time_is_switched_off() -> None:
    bench = Bench(ROS2, {"cmd_timeout": 1.0, "constraints": {"goal_time": 2.0}})
    assert any("Command timeout must be higher than goal_time" in t for _, t in bench.ports.lines)


def test_constraints_change_live_for_the_next_goal() -> None:
    bench = Bench(ROS2, commands("velocity") | SLOW)
    assert bench.controller.changed({"constraints.elbow.trajectory": 0.1}) == ""
    sent = bench.send(goal(to(1.0, 0.2, 0.2)))
    bench.run(100)
    bench.plant.position[1] += 0.5
    bench.run(1)
    assert sent.state == "aborted"


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"constraints.goal_time": -1.0}, "must not be negative"),
        ({"constraints.elbow.goal": "far"}, "not a number"),
        ({"allow_partial_joints_goal": 1.0}, "not true or false"),
        ({"gains.elbow.antiwindup_strategy": "best"}, "it may be legacy, none, back_calculation"),
    ],
)
def test_bad_live_values_are_refused(values: dict[str, Any], text: str) -> None:
    assert text in Bench(ROS2).controller.changed(values)


@pytest.mark.parametrize(
    ("request_", "code", "text"),
    [
        (to(1, 0, names=("shoulder",)), ErrorCode.INVALID_JOINTS, "'elbow' is missing"),
        (to(1, 0, 0, names=("shoulder", "wrist")), ErrorCode.INVALID_JOINTS, "'wrist'"),
        (trajectory(JOINTS), ErrorCode.INVALID_GOAL, "Empty trajectory received."),
        (trajectory(JOINTS, point(1, [0])), ErrorCode.INVALID_GOAL, "positions (1) at point #0"),
        (trajectory(JOINTS, point(1, [], [0, 0])), ErrorCode.INVALID_GOAL, "has no positions"),
        (
            trajectory(JOINTS, point(1, [0, 0]), point(1, [0, 0])),
            ErrorCode.INVALID_GOAL,
            "Time between points 0 and 1 is not strictly increasing",
        ),
        (
            trajectory(JOINTS, point(1, [0, 0], [], [], [1, 1])),
            ErrorCode.INVALID_GOAL,
            "Trajectories with effort fields are only supported",
        ),
        (to(0.5, 0, 0, stamp_s=0.1), ErrorCode.OLD_HEADER_TIMESTAMP, "ends in the past (0.600000)"),
    ],
)
def test_what_cannot_be_followed_is_rejected(request_: Any, code: ErrorCode, text: str) -> None:
    bench = Bench(ROS2)
    bench.run(1000)
    running = bench.send(goal(to(1, 1, 1)))
    sent = bench.send(goal(request_))
    assert sent.state == "rejected"
    assert sent.result["error_code"] == code
    assert text in sent.result["error_string"]
    bench.ports.send(TOPIC, request_)
    assert [text in line for level, line in bench.ports.lines if level == "error"] == [True, True]
    assert running.state == "active"


def test_trajectories_that_end_in_motion_are_rejected_when_told_so() -> None:
    moving = trajectory(JOINTS, point(1.0, [1, 1], [0.0, 0.5]))
    bench = Bench(ROS2)
    assert bench.send(goal(moving)).state == "active"
    assert bench.controller.changed({"allow_nonzero_velocity_at_trajectory_end": False}) == ""
    sent = bench.send(goal(moving))
    assert "Velocity of last trajectory point of joint elbow is not zero" in sent.text


def test_waypoints_may_lack_positions_when_told_so() -> None:
    bench = Bench(ROS2, {"allow_integration_in_goal_trajectories": True})
    sent = bench.send(goal(trajectory(JOINTS, point(1.0, [], [1, 2]), point(2.0, [], [0, 0]))))
    bench.run(2100)
    assert sent.state == "succeeded"
    assert bench.commanded()[-1].tolist() == pytest.approx([1.0, 2.0])
    assert bench.send(goal(trajectory(JOINTS, point(1.0)))).state == "rejected"


def test_goals_are_rejected_while_it_is_not_active() -> None:
    bench = Bench(ROS2, start=False)
    sent = bench.send(goal(to(1, 1, 1)))
    assert "Controller is not running." in sent.result["error_string"]
    bench.ports.send(TOPIC, to(1, 1, 1))
    answer = bench.query(0.0)
    assert not answer.success
    assert answer.message == "Can't sample trajectory. Controller is not active."


def test_illegal_tolerances_leave_the_controllers() -> None:
    bench = Bench(ROS2)
    assert bench.send(goal(to(1, 1, 1), path={"wrist": (1.0,)})).state == "active"
    assert any("'wrist' specified in goal.path_tolerance" in t for _, t in bench.ports.lines)


# Replacing ------------------------------------------------------------------------------------


@pytest.mark.parametrize("is_open", [False, True])
def test_a_new_goal_aborts_the_running_one_without_a_jump(is_open: bool) -> None:
    bench = Bench(ROS2, {"open_loop_control": is_open})
    first = bench.send(goal(to(1.0, 1.0, 1.0)), "first")
    bench.run(500)
    second = bench.send(goal(to(1.0, 0.0, 0.0)), "second")
    assert (first.state, second.state) == ("aborted", "active")
    assert first.result == {
        "error_code": ErrorCode.INVALID_GOAL,
        "error_string": "Current goal preempted by new incoming action.",
    }
    bench.run(1100)
    assert second.state == "succeeded"
    assert np.abs(np.diff(bench.commanded(), axis=0)).max() < 2.5e-3


def test_open_loop_goes_on_from_the_last_command_not_from_the_state() -> None:
    for is_open, begin in ((False, 0.0), (True, 0.5)):
        bench = Bench(ROS2, {"open_loop_control": is_open})
        bench.ports.send(TOPIC, to(1.0, 1.0, 1.0))
        bench.run(501)
        bench.plant.position[:] = bench.plant.velocity[:] = 0.0
        bench.ports.send(TOPIC, trajectory(JOINTS, point(1.0, [1.0, 1.0])))
        bench.run(1)
        assert bench.commanded()[-1].tolist() == pytest.approx([begin, begin])


def test_a_topics_trajectory_takes_a_goals_place_and_the_goal_goes_on() -> None:
    bench = Bench(ROS2)
    sent = bench.send(goal(to(1.0, 1.0, 1.0)))
    bench.run(100)
    bench.ports.send(TOPIC, to(0.5, 0.1, 0.1))
    assert sent.state == "active"
    bench.run(502)
    assert sent.state == "succeeded"
    assert bench.commanded()[-1].tolist() == pytest.approx([0.1, 0.1])


def test_cancelling_holds_the_measured_position() -> None:
    bench = Bench(ROS2)
    sent = bench.send(goal(to(1.0, 1.0, 1.0)))
    bench.run(500)
    assert bench.ports.cancel(ACTION, sent)
    assert sent.state == "canceled"
    bench.run(100)
    assert np.ptp(bench.commanded()[500:], axis=0).tolist() == [0.0, 0.0]


def test_cancelling_decelerates_when_told_so() -> None:
    slow = {name: {"max_deceleration_on_cancel": 5.0} for name in JOINTS}
    limits = JointLimits(max_velocity=3.0)
    bench = Bench(
        ROS2,
        {"constraints": {"decelerate_on_cancel": True, **slow}},
        joints=[PlantJoint(name, limits=limits) for name in JOINTS],
    )
    sent = bench.send(goal(to(1.0, 1.0, 1.0)))
    bench.run(501)
    bench.ports.cancel(ACTION, sent)
    bench.run(600)
    speed = np.diff(bench.commanded()[:, 0]) * 1000
    v = bench.plant.velocity[0]
    assert v == 0.0
    assert np.diff(speed[505:850]) == pytest.approx(np.full(344, -5.0e-3), abs=1e-5)
    travelled = bench.commanded()[-1, 0] - bench.commanded()[500, 0]
    assert travelled == pytest.approx(1.875**2 / 10.0, abs=2e-3)


@pytest.mark.parametrize(
    ("parameters", "max_velocity", "text"),
    [
        ({}, 3.0, "joint 'shoulder' has no max_deceleration_on_cancel above 0"),
        ({"shoulder": 1.0, "elbow": 1.0}, None, "joint 'shoulder' has no velocity limit"),
    ],
)
def test_what_decelerating_needs_is_said(
    parameters: dict[str, float], max_velocity: float | None, text: str
) -> None:
    slow = {name: {"max_deceleration_on_cancel": value} for name, value in parameters.items()}
    bench = Bench(
        ROS2,
        {"constraints": {"decelerate_on_cancel": True, **slow}},
        joints=[PlantJoint(n, limits=JointLimits(max_velocity=max_velocity)) for n in JOINTS],
    )
    (found,) = bench.diagnostics
    assert found.code == "control.no-deceleration"
    assert text in found.message


def test_stopping_aborts_the_goal_and_commands_no_velocity() -> None:
    bench = Bench(ROS2, commands("velocity") | SLOW)
    sent = bench.send(goal(to(1.0, 1.0, 1.0)))
    bench.run(500)
    bench.controller.stop(bench.time_ns)
    assert sent.state == "aborted"
    assert sent.result["error_string"] == "Current goal cancelled during deactivate transition."
    places = bench.robot.interface_values.command_indices([f"{name}/velocity" for name in JOINTS])
    assert bench.robot.interface_values.commands[places].tolist() == [0.0, 0.0]


def test_some_joints_may_move_alone_while_the_others_stay() -> None:
    bench = Bench(ROS2, {"allow_partial_joints_goal": True})
    bench.ports.send(TOPIC, to(1.0, 1.0, 1.0))
    bench.run(500)
    sent = bench.send(goal(to(0.2, 0.0, names=("elbow",))))
    bench.run(300)
    assert sent.state == "succeeded"
    stay = bench.commanded()[499, 0]
    assert bench.commanded()[-1].tolist() == pytest.approx([stay, 0.0])


def test_joints_may_come_in_any_order() -> None:
    bench = Bench(ROS2)
    bench.ports.send(TOPIC, to(0.1, 1.0, 2.0, names=("elbow", "shoulder")))
    bench.run(200)
    assert bench.commanded()[-1].tolist() == pytest.approx([2.0, 1.0])


@pytest.mark.parametrize("how", ["continuous", "angle_wraparound", "normalize_error"])
def test_joints_that_wrap_take_the_shorter_way(how: str) -> None:
    joints = [
        PlantJoint("shoulder", position=3.0, is_continuous=how == "continuous"),
        PlantJoint("elbow"),
    ]
    gains = {} if how == "continuous" else {"gains": {"shoulder": {how: True}}}
    bench = Bench(ROS2, gains, joints=joints)
    sent = bench.send(goal(to(1.0, -3.0, 0.0), end={"shoulder": (0.01,)}))
    bench.run(1100)
    assert sent.state == "succeeded"
    shoulder = bench.commanded()[:, 0]
    assert (shoulder[0], shoulder[-1]) == pytest.approx((3.0 - 2 * math.pi, -3.0))


def test_without_interpolation_waypoints_are_commanded_as_they_come() -> None:
    bench = Bench(ROS2, {"interpolation_method": "none"})
    bench.ports.send(TOPIC, trajectory(JOINTS, point(0.1, [1, 1]), point(0.2, [2, 2])))
    bench.run(300)
    assert bench.commanded()[[99, 100, 199, 200, 299], 0].tolist() == [0, 2, 2, 2, 2]


def test_passive_joints_may_be_followed_without_a_command() -> None:
    bench = Bench(ROS2, {"command_joints": ["elbow"]})
    assert bench.controller.commands == ("elbow/position",)
    bench.ports.send(TOPIC, to(0.1, 1.0, 2.0))
    bench.run(200)
    assert bench.commanded()[-1, 1] == pytest.approx(2.0)
    assert bench.plant.position.tolist() == pytest.approx([0.0, 2.0])


def test_trajectories_may_run_slower_than_planned() -> None:
    bench = Bench(ROS2, {"speed_scaling": {"initial_scaling_factor": 0.5}})
    factor = message_type("control_msgs/SpeedScalingFactor")
    sent = bench.send(goal(to(1.0, 1.0, 1.0)))
    bench.run(1001)
    assert bench.commanded()[1000, 0] == pytest.approx(0.5)
    bench.ports.send("~/speed_scaling_input", factor(factor=-1.0))
    bench.ports.send("~/speed_scaling_input", factor(factor=0.0))
    bench.run(500)
    assert bench.commanded()[-1, 0] == pytest.approx(0.5)
    assert bench.ports.publishers["~/controller_state"].last.speed_scaling_factor == 0.0
    bench.ports.send("~/speed_scaling_input", factor(factor=1.0))
    bench.run(502)
    assert sent.state == "succeeded"
    assert any("Scaling factor has to be greater" in text for _, text in bench.ports.lines)


def test_only_positions_may_be_scaled() -> None:
    scaling = {"speed_scaling": {"initial_scaling_factor": 0.5}}
    bench = Bench(ROS2, commands("velocity") | SLOW | scaling)
    assert [found.code for found in bench.diagnostics] == ["parameter.bad-value"]
    assert "~/speed_scaling_input" not in bench.ports.subscriptions


# What is published ----------------------------------------------------------------------------


def test_the_state_is_published_on_both_topics_at_its_rate() -> None:
    bench = Bench(ROS2, {"state_publish_rate": 100.0})
    bench.ports.send(TOPIC, to(1.0, 1.0, 0.0))
    bench.run(501)
    for topic in ("~/controller_state", "~/state"):
        messages = bench.ports.publishers[topic].messages
        assert len(messages) == 50
        last = messages[-1]
        assert last.header.stamp.nanosec == 500_000_000
        assert last.reference.positions[0] == pytest.approx(0.5)
        assert last.reference.time_from_start.nanosec == 500_000_000
        assert last.feedback.velocities[0] == pytest.approx(1.875, abs=0.01)
        assert last.output.positions[0] == pytest.approx(0.5)
        assert len(last.feedback.accelerations) == 0
        assert last.error.positions[0] == pytest.approx(0.5 - last.feedback.positions[0])


def test_feedback_comes_at_its_rate() -> None:
    bench = Bench(ROS2)
    sent = bench.send(goal(to(1.0, 1.0, 0.0)))
    bench.run(951)
    assert len(sent.feedback) == 19
    assert sent.feedback[-1].desired.positions[0] == pytest.approx(float(smooth(0.95)), abs=1e-9)


def test_the_state_at_a_time_can_be_asked_for() -> None:
    bench = Bench(ROS2)
    bench.ports.send(TOPIC, to(1.0, 1.0, 2.0))
    bench.run(100)
    answer = bench.query(0.5)
    assert answer.success
    assert answer.position == pytest.approx([0.5, 1.0])
    for time_s, text in ((2.0, "precedes the current trajectory end time"), (0.0, "")):
        answer = bench.query(time_s)
        assert answer.success == (not text)
        assert text in answer.message


# Parameters -----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("parameters", "text"),
    [
        (commands(), "'/controller/command_interfaces' parameter is empty"),
        (commands("torque"), "has 'torque', it may have position, velocity, acceleration, effort"),
        (commands("velocity", "effort"), "'velocity' command interface can be used either alone"),
        (commands("position", "acceleration"), "'acceleration' command interface can only be used"),
        (commands("position", "velocity", "effort"), "'effort' command interface has to be used"),
        ({"state_interfaces": ["velocity"]}, "'velocity' state interface cannot be used"),
        (
            {"state_interfaces": ["position", "acceleration"]},
            "'acceleration' state interface cannot be used",
        ),
        (
            commands("effort") | {"state_interfaces": ["position"]},
            "'effort' command interface can only be used alone if",
        ),
        ({"interpolation_method": "cubic"}, "it may be none, splines"),
        ({"command_joints": ["shoulder", "elbow", "shoulder"]}, "joint 'shoulder' is twice"),
        ({"joints": ["shoulder"], "command_joints": ["elbow"]}, ""),
        ({"joints": ["shoulder"], "command_joints": ["elbow", "shoulder"]}, "must not exceed"),
    ],
)
def test_parameters_that_do_not_fit_are_named(parameters: dict[str, Any], text: str) -> None:
    if not text:
        # As many command joints as joints may have other names (chains of controllers).
        assert Bench(ROS2, parameters).controller.commands == ("elbow/position",)
        return
    with pytest.raises(ControllerError) as caught:
        Bench(ROS2, parameters)
    assert text in str(caught.value)


def test_ros1_robots_are_told_their_types() -> None:
    with pytest.raises(ControllerError, match="ROS 1 has position_controllers/JointTrajectory"):
        Bench(ROS2, ros_version=1)
