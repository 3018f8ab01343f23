"""GripperActionController of both generations, over position or effort."""

from __future__ import annotations

from typing import Any, ClassVar

from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.controllers.gripper_action_goal import GRIPPER_ROWS, GripperGoal, Outcome
from gazelle.control.errors import ControllerError
from gazelle.control.pid import Pid, offer_live_gains, read_gains
from gazelle.control.pid.reading import gain_rows
from gazelle.control.ports import GoalPort
from gazelle.control.table import ControllerTable
from gazelle.parameters import Parameter, ParameterTable, Topic

__all__ = ["GripperActionController"]

_SECONDS = 1e-9


class GripperActionController(Controller):
    """Moves a gripper's joint to a goal, with at most some effort."""

    TABLE: ClassVar[ControllerTable] = ControllerTable(
        ParameterTable(
            "gripper_action_controller",
            "Moves one joint to the goal of an action and tells when it is there or stalls.",
            (
                "position_controllers/GripperActionController",
                "effort_controllers/GripperActionController",
            ),
            (
                *GRIPPER_ROWS,
                Parameter(
                    "max_effort",
                    "number",
                    0.0,
                    "bound of the effort while there is no goal",
                    "N·m, N",
                ),
                *gain_rows("gains.<joint>"),
            ),
        ),
        interfaces="Claims `<joint>/position` or `<joint>/effort` by its type, reads position and "
        "velocity.",
        topics=(
            Topic(
                "~/gripper_cmd",
                "control_msgs/GripperCommand",
                "action",
                "feedback at action_monitor_rate",
            ),
        ),
        behaviour=(
            "position: the goal is commanded as it is, max_effort is only told in the result. "
            "effort: a PID with `gains.<joint>`, bounded by the goal's max_effort; 0 means none, "
            "so nothing moves.",
            "A goal nearer than goal_tolerance succeeds; standing for stall_timeout aborts it, or "
            "with allow_stalling succeeds (ROS 2).",
            "Cancelling holds the present position, bounded by `max_effort`.",
        ),
    )

    def __init__(self, context: ControllerContext) -> None:
        """Read the parameters and offer the action."""
        super().__init__(context)
        parameters = context.parameters
        parameters.require("joint")
        name = parameters.text("joint")
        context.joint(name)
        interface = context.type.replace("::", "/").partition("_controllers/")[0]
        self.commands = (f"{name}/{interface}",)
        self.states = (f"{name}/position", f"{name}/velocity")
        self._command = int(context.command_places(self.commands)[0])
        self._position, self._velocity = context.state_places(self.states).tolist()
        self._pid = _pid(context, name) if interface == "effort" else None
        self._default_effort = abs(parameters.number("max_effort"))
        self._effort = 0.0
        self._target, self._max_effort = 0.0, self._default_effort
        self._time_ns = 0
        self._is_running = False
        self._goal = GripperGoal(context, self._message)
        context.ports.action_server(
            "~/gripper_cmd",
            "control_msgs/GripperCommand",
            on_goal=self._on_goal,
            on_cancel=self._on_cancel,
        )

    def start(self, time_ns: int) -> None:
        """Hold the present position."""
        self._time_ns, self._is_running = time_ns, True
        self._hold()
        self._effort = 0.0
        if self._pid is not None:
            self._pid.reset()
            self.robot.bank.commands[self._command] = 0.0

    def update(self, time_ns: int, period_ns: int) -> None:
        """Watch the goal and command the joint."""
        self._time_ns = time_ns
        bank = self.robot.bank
        position = bank.states.item(self._position)
        velocity = bank.states.item(self._velocity)
        error = self._target - position
        self._goal.watch(time_ns, error, position, velocity)
        if self._pid is None:
            self._effort = self._max_effort
            bank.commands[self._command] = self._target
            return
        effort = self._pid.compute_with_rate(error, -velocity, period_ns * _SECONDS)
        self._effort = min(max(effort, -self._max_effort), self._max_effort)
        bank.commands[self._command] = self._effort
        bank.answer(self._command, self._pid.gains.p, self._pid.gains.d)

    def stop(self, time_ns: int) -> None:
        """End a goal."""
        self._is_running = False
        self._goal.end()

    def _hold(self) -> None:
        self._target = self.robot.bank.states.item(self._position)
        self._max_effort = self._default_effort

    def _message(self, position: float, outcome: Outcome | None) -> dict[str, Any]:
        return {
            "position": position,
            "effort": self._effort,
            "stalled": outcome is Outcome.STALLED,
            "reached_goal": outcome is Outcome.REACHED,
        }

    def _on_goal(self, goal: GoalPort) -> None:
        if not self._is_running:
            text = "Can't accept new action goals. Controller is not running."
            self.context.ports.log("error", text)
            goal.reject(None, text)
            return
        command = goal.request.command
        self._target, self._max_effort = float(command.position), abs(float(command.max_effort))
        self._goal.begin(goal, self._time_ns)

    def _on_cancel(self, goal: GoalPort) -> bool:
        if self._goal.goal is goal:
            self._hold()
        return self._goal.cancel(goal)


def _pid(context: ControllerContext, name: str) -> Pid:
    gains = read_gains(context.parameters, "gains", name, generation=context.generation)
    if gains is None:
        where = context.parameters.full_name(f"gains.{name}")
        text = f"controller '{context.name}': No p gain specified for pid. Namespace: {where}"
        raise ControllerError(text)
    pid = Pid(gains)
    offer_live_gains(context, f"gains{'/' if context.generation == 1 else '.'}{name}", pid)
    return pid
