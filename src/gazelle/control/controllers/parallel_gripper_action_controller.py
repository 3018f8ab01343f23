"""ROS 2's parallel_gripper_action_controller: a position with bounds on speed and effort."""

from __future__ import annotations

from typing import Any, ClassVar

from gazelle.control.controller_node_interface import GoalPort
from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.controllers.gripper_action_controller import GRIPPER_ROWS, GripperGoal, Outcome
from gazelle.interfaces.stamps import stamped
from gazelle.parameters import Parameter, ParameterKind, ParameterTable, Topic

__all__ = ["ParallelGripperActionController"]

_ROS2 = (2,)


def _row(key: str, kind: ParameterKind, default: object, meaning: str, unit: str = "") -> Parameter:
    return Parameter(key, kind, default, meaning, unit, ros_versions=_ROS2)


class ParallelGripperActionController(Controller):
    """Moves a parallel gripper's joint to a goal."""

    TABLE: ClassVar[ControllerTable] = ControllerTable(
        ParameterTable(
            "parallel_gripper_action_controller",
            "Moves one joint to the goal of an action and tells when it is there or stalls.",
            ("parallel_gripper_action_controller/GripperActionController",),
            (
                *GRIPPER_ROWS,
                _row("max_effort", "number", 10.0, "effort when a goal has none", "N·m, N"),
                _row("max_velocity", "number", 0.1, "speed when a goal has none", "rad/s, m/s"),
                _row("max_effort_interface", "text", "", "command interface `<joint>/<name>`"),
                _row("max_velocity_interface", "text", "", "command interface `<joint>/<name>`"),
                _row(
                    "state_interfaces",
                    "refused",
                    None,
                    "position and velocity are read, more would change nothing",
                ),
            ),
        ),
        interfaces="Claims `<joint>/position`, and max_effort_interface and max_velocity_interface "
        "when they are given; reads position and velocity.",
        topics=(
            Topic(
                "~/gripper_cmd",
                "control_msgs/ParallelGripperCommand",
                "action",
                "feedback at action_monitor_rate",
                ros_versions=_ROS2,
            ),
        ),
        behaviour=(
            "The goal is a sensor_msgs/JointState with one position; speed and effort are handed "
            "to the interfaces named, else they change nothing.",
            "A goal nearer than goal_tolerance succeeds; standing for stall_timeout aborts it, or "
            "with allow_stalling succeeds.",
        ),
    )

    def __init__(self, context: ControllerContext) -> None:
        """Read the parameters and offer the action."""
        super().__init__(context)
        parameters = context.parameters
        parameters.require("joint")
        self._name = name = parameters.text("joint")
        context.joint(name)
        keys = ("max_velocity_interface", "max_effort_interface")
        given = [parameters.text(key) for key in keys]
        self.commands = (f"{name}/position", *(interface for interface in given if interface))
        self.states = (f"{name}/position", f"{name}/velocity")
        indices = iter(context.command_indices(self.commands).tolist())
        self._command = next(indices)
        self._limits = [next(indices) if interface else None for interface in given]
        self._position, self._velocity = context.state_indices(self.states).tolist()
        self._defaults = (parameters.number("max_velocity"), parameters.number("max_effort"))
        self._bounds = self._defaults
        self._target = 0.0
        self._time_ns = 0
        self._is_running = False
        self._goal = GripperGoal(context, self._message)
        context.ports.action_server(
            "~/gripper_cmd",
            "control_msgs/ParallelGripperCommand",
            on_goal=self._on_goal,
            on_cancel=self._on_cancel,
        )

    def start(self, time_ns: int) -> None:
        """Hold the present position."""
        self._time_ns, self._is_running = time_ns, True
        self._hold()

    def update(self, time_ns: int, period_ns: int) -> None:
        """Watch the goal and command the joint."""
        self._time_ns = time_ns
        interface_values = self.robot.interface_values
        position = interface_values.states.item(self._position)
        velocity = interface_values.states.item(self._velocity)
        self._goal.watch(time_ns, self._target - position, position, velocity)
        interface_values.commands[self._command] = self._target
        for index, value in zip(self._limits, self._bounds, strict=True):
            if index is not None:
                interface_values.commands[index] = value

    def stop(self, time_ns: int) -> None:
        """End a goal."""
        self._is_running = False
        self._goal.end()

    def _hold(self) -> None:
        self._target = self.robot.interface_values.states.item(self._position)
        self._bounds = self._defaults

    def _message(self, position: float, outcome: Outcome | None) -> dict[str, Any]:
        state = stamped("sensor_msgs/JointState", self._time_ns)
        state.name, state.position, state.effort = [self._name], [position], [self._bounds[1]]
        if outcome is None:
            return {"state": state}
        return {
            "state": state,
            "stalled": outcome is Outcome.STALLED,
            "reached_goal": outcome is Outcome.REACHED,
        }

    def _on_goal(self, goal: GoalPort) -> None:
        command = goal.request.command
        text = ""
        if not self._is_running:
            text = "Can't accept new action goals. Controller is not running."
        elif len(command.position) != 1:
            text = "Received action goal with wrong number of position values, expects 1, got "
            text += f"{len(command.position)}"
        if text:
            self.context.ports.log("error", text)
            goal.reject(None, text)
            return
        self._target = float(command.position[0])
        wanted = (command.velocity, command.effort)
        self._bounds = (
            float(wanted[0][0]) if len(wanted[0]) else self._defaults[0],
            float(wanted[1][0]) if len(wanted[1]) else self._defaults[1],
        )
        self._goal.begin(goal, self._time_ns)

    def _on_cancel(self, goal: GoalPort) -> bool:
        if self._goal.goal is goal:
            self._hold()
        return self._goal.cancel(goal)
