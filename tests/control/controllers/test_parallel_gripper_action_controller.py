"""ROS 2's parallel gripper on an ideal joint."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pytest
from tests.control.plant import PlantJoint, make_controller, make_robot, run

from gazelle.control.controllers.parallel_gripper_action_controller import (
    ParallelGripperActionController,
)
from gazelle.diagnostics import Diagnostics
from gazelle.interfaces import action_type, message_type

ACTION = "~/gripper_cmd"
LIMITS = {
    "max_effort_interface": "finger/max_effort",
    "max_velocity_interface": "finger/max_velocity",
}


class Bench:
    """A finger with interfaces for its bounds; positions are reached unless it is jammed."""

    def __init__(self, parameters: dict[str, Any] | None = None, *, jammed: bool = False) -> None:
        joint = PlantJoint("finger", commands=("position", "max_velocity", "max_effort"))
        self.robot, self.plant = make_robot([joint], ros_version=2)
        self.diagnostics = Diagnostics()
        self.controller, self.ports = make_controller(
            ParallelGripperActionController,
            self.robot,
            {"joint": "finger"} | (parameters or {}),
            diagnostics=self.diagnostics,
        )
        self.jammed = jammed
        self.time_ns = 0
        self.controller.start(0)

    def run(self, steps: int) -> None:
        for _ in range(steps):
            self.time_ns = run(self.robot, self.controller, 1, time_ns=self.time_ns)
            if self.jammed:
                self.plant.position[:] = self.plant.velocity[:] = 0.0

    def send(
        self,
        position: Sequence[float],
        velocity: Sequence[float] = (),
        effort: Sequence[float] = (),
    ) -> Any:
        command = message_type("sensor_msgs/JointState")(
            position=list(position), velocity=list(velocity), effort=list(effort)
        )
        request = action_type("control_msgs/ParallelGripperCommand").Goal(command=command)
        return self.ports.send_goal(ACTION, request)

    def command(self, name: str) -> float:
        (place,) = self.robot.interface_values.command_indices([f"finger/{name}"])
        return float(self.robot.interface_values.commands[place])


def test_the_position_is_commanded_and_reached() -> None:
    bench = Bench()
    sent = bench.send([0.5])
    bench.run(2)
    assert bench.command("position") == 0.5
    assert sent.state == "succeeded"
    assert sent.result["reached_goal"]
    assert list(sent.result["state"].position) == [0.5]
    assert bench.controller.commands == ("finger/position",)


@pytest.mark.parametrize(
    ("velocity", "effort", "expected"), [((), (), (0.1, 10.0)), ((0.3,), (7.0,), (0.3, 7.0))]
)
def test_bounds_go_to_their_interfaces(
    velocity: tuple[float, ...], effort: tuple[float, ...], expected: tuple[float, float]
) -> None:
    bench = Bench(LIMITS)
    bench.send([0.5], velocity, effort)
    bench.run(1)
    assert (bench.command("max_velocity"), bench.command("max_effort")) == expected


@pytest.mark.parametrize(("allow", "state"), [(False, "aborted"), (True, "succeeded")])
def test_standing_for_stall_timeout_is_stalling(allow: bool, state: str) -> None:
    bench = Bench({"allow_stalling": allow, "stall_timeout": 0.2}, jammed=True)
    sent = bench.send([0.5])
    bench.run(201)
    assert sent.state == "active"
    bench.run(1)
    assert sent.state == state
    assert sent.result["stalled"]
    assert not sent.result["reached_goal"]


def test_goals_have_one_position() -> None:
    sent = Bench().send([0.1, 0.2])
    assert sent.state == "rejected"
    assert "wrong number of position values, expects 1, got 2" in sent.text


def test_cancelling_holds_the_position() -> None:
    bench = Bench(LIMITS, jammed=True)
    sent = bench.send([0.5], [0.7])
    bench.run(10)
    assert bench.ports.cancel(ACTION, sent)
    bench.run(1)
    assert (bench.command("position"), bench.command("max_velocity")) == (0.0, 0.1)


def test_stopping_ends_the_goal() -> None:
    bench = Bench(jammed=True)
    sent = bench.send([0.5])
    bench.controller.stop(0)
    assert sent.state == "aborted"
    assert bench.send([0.5]).state == "rejected"


def test_state_interfaces_change_nothing_and_that_is_said() -> None:
    bench = Bench({"state_interfaces": ["position", "velocity"]})
    assert [found.code for found in bench.diagnostics] == ["parameter.idle"]
