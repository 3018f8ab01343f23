"""GripperActionController of both generations, on ideal joints."""

from __future__ import annotations

from typing import Any

import pytest
from tests.control.plant import PlantJoint, make_controller, make_robot, run
from tests.control.recording_ports import RecordingPorts

from gazelle.control.controllers.gripper_action_controller import GripperActionController
from gazelle.control.errors import ControllerError
from gazelle.interfaces import message_type

ACTION = "~/gripper_cmd"
GAINS = {"gains": {"finger": {"p": 400.0, "d": 40.0}}}


class Bench:
    """A finger under the controller, started."""

    def __init__(
        self,
        interface: str,
        parameters: dict[str, Any] | None = None,
        *,
        ros_version: int = 1,
        start: bool = True,
        **joint: Any,
    ) -> None:
        self.robot, self.plant = make_robot(
            [PlantJoint("finger", **joint)], ros_version=ros_version
        )
        self.controller, self.ports = make_controller(
            GripperActionController,
            self.robot,
            {"joint": "finger"} | (parameters or {}),
            type_name=f"{interface}_controllers/GripperActionController",
            ports=RecordingPorts(),
        )
        self.time_ns = 0
        if start:
            self.controller.start(0)

    def run(self, steps: int) -> None:
        self.time_ns = run(self.robot, self.controller, steps, time_ns=self.time_ns)

    def send(self, position: float, max_effort: float = 10.0) -> Any:
        command = message_type("control_msgs/GripperCommand")(
            position=position, max_effort=max_effort
        )
        request = message_type("control_msgs/GripperCommandGoal")(command=command)
        return self.ports.send_goal(ACTION, request)

    @property
    def command(self) -> float:
        (place,) = self.robot.interface_values.command_indices(self.controller.commands)
        return float(self.robot.interface_values.commands[place])


@pytest.mark.parametrize("ros_version", [1, 2])
def test_positions_are_commanded_and_reached(ros_version: int) -> None:
    bench = Bench("position", ros_version=ros_version, position=0.2)
    bench.run(5)
    assert bench.command == 0.2
    sent = bench.send(0.5)
    assert sent.state == "active"
    bench.run(2)
    assert bench.command == 0.5
    assert sent.state == "succeeded"
    expected = {"position": 0.5, "effort": 10.0, "stalled": False, "reached_goal": True}
    assert sent.result == expected


@pytest.mark.parametrize("ros_version", [1, 2])
def test_effort_is_the_pids_within_the_goals_bound(ros_version: int) -> None:
    bench = Bench("effort", GAINS, ros_version=ros_version)
    bench.send(0.01, max_effort=100.0)
    bench.run(1)
    assert bench.command == pytest.approx(400 * 0.01)
    bench.send(-1.0, max_effort=3.0)
    bench.run(1)
    assert bench.command == -3.0


def test_effort_reaches_the_goal() -> None:
    bench = Bench("effort", GAINS)
    sent = bench.send(0.3)
    bench.run(600)
    assert sent.state == "succeeded"
    assert sent.result["position"] == pytest.approx(0.3, abs=0.01)


@pytest.mark.parametrize(
    ("ros_version", "allow", "state"),
    [(1, False, "aborted"), (1, True, "aborted"), (2, False, "aborted"), (2, True, "succeeded")],
)
def test_standing_for_stall_timeout_is_stalling(ros_version: int, allow: bool, state: str) -> None:
    parameters = GAINS | {"allow_stalling": allow, "stall_timeout": 0.5}
    bench = Bench("effort", parameters, ros_version=ros_version, inertia=1e9)
    sent = bench.send(1.0)
    bench.run(501)
    assert sent.state == "active"
    bench.run(1)
    assert sent.state == state
    expected = {"position": 0.0, "effort": 10.0, "stalled": True, "reached_goal": False}
    assert sent.result == pytest.approx(expected, abs=1e-6)


def test_moving_is_no_stalling() -> None:
    bench = Bench("effort", GAINS | {"stall_timeout": 0.1}, velocity=0.002, inertia=1e9)
    sent = bench.send(1.0)
    bench.run(1000)
    assert sent.state == "active"


def test_cancelling_holds_with_the_default_effort() -> None:
    bench = Bench("effort", GAINS | {"max_effort": -2.0})
    sent = bench.send(1.0)
    bench.run(100)
    assert bench.ports.cancel(ACTION, sent)
    assert sent.state == "canceled"
    held = bench.plant.position[0]
    bench.run(1)
    assert bench.command == -2.0
    bench.run(3000)
    assert bench.plant.position[0] == pytest.approx(held, abs=0.01)


@pytest.mark.parametrize(("ros_version", "state"), [(1, "canceled"), (2, "aborted")])
def test_a_new_goal_replaces_the_running_one(ros_version: int, state: str) -> None:
    bench = Bench("effort", GAINS, ros_version=ros_version)
    first = bench.send(1.0)
    bench.run(10)
    second = bench.send(0.5)
    assert (first.state, second.state) == (state, "active")
    assert not bench.ports.cancel(ACTION, first)


def test_stopping_ends_the_goal() -> None:
    bench = Bench("position")
    sent = bench.send(1.0)
    bench.controller.stop(0)
    assert sent.state == "canceled"
    assert bench.send(1.0).text == "Can't accept new action goals. Controller is not running."


def test_feedback_comes_at_its_rate() -> None:
    bench = Bench("effort", GAINS | {"action_monitor_rate": 100.0}, inertia=50.0)
    sent = bench.send(1.0)
    bench.run(101)
    assert len(sent.feedback) == 10
    assert sent.feedback[-1]["effort"] == pytest.approx(10.0)
    assert not sent.feedback[-1]["reached_goal"]


def test_gains_change_live() -> None:
    bench = Bench("effort", GAINS)
    bench.send(0.02)
    bench.ports.set_live("gains/finger", p=100.0)
    bench.run(1)
    assert bench.command == pytest.approx(2.0)


def test_effort_needs_gains_and_a_joint() -> None:
    with pytest.raises(ControllerError, match="No p gain specified for pid"):
        Bench("effort")
    with pytest.raises(ControllerError, match="did you mean 'finger'"):
        Bench("position", {"joint": "fingr"})
