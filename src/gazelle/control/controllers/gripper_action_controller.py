"""GripperActionController of both generations, over position or effort."""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from typing import Any, ClassVar

from gazelle.control.controller_node_interface import GoalPort
from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.errors import ControllerError
from gazelle.control.pid import Pid, offer_live_gains, read_gains
from gazelle.control.pid.gains import gain_rows
from gazelle.parameters import Parameter, ParameterTable, Topic

__all__ = ["GRIPPER_ROWS", "GripperActionController", "GripperGoal", "Outcome"]


_NANO = 1_000_000_000

GRIPPER_ROWS = (
    Parameter("joint", "text", None, "the joint; required"),
    Parameter("goal_tolerance", "number", 0.01, "how near the goal counts as reached", "rad, m"),
    Parameter(
        "stall_velocity_threshold",
        "number",
        0.001,
        "slower than this counts as standing",
        "rad/s, m/s",
    ),
    Parameter("stall_timeout", "number", 1.0, "standing this long counts as stalled", "s"),
    Parameter(
        "allow_stalling", "flag", False, "stalling is a success; else it aborts", ros_versions=(2,)
    ),
    Parameter("action_monitor_rate", "number", 20.0, "rate of feedback", "Hz"),
)


class Outcome(Enum):
    """How a gripper's motion ended."""

    REACHED = "reached"
    STALLED = "stalled"


class GripperGoal:
    """Watches one goal at a time, and ends it.

    Attributes:
        goal: what is executed, None for nothing.
    """

    def __init__(
        self,
        context: ControllerContext,
        message: Callable[[float, Outcome | None], dict[str, Any]],
    ) -> None:
        """Read the tolerances.

        Args:
            context: of the controller.
            message: makes a result, or feedback, from a position and what was the outcome.
        """
        parameters = context.parameters
        self.goal: GoalPort | None = None
        self._is_ros1 = context.ros_version == 1
        self._tolerance = abs(parameters.number("goal_tolerance"))
        self._slow = parameters.number("stall_velocity_threshold")
        self._timeout_ns = round(parameters.number("stall_timeout") * _NANO)
        self._stalls_well = parameters.flag("allow_stalling") and not self._is_ros1
        rate_hz = parameters.number("action_monitor_rate")
        self._feedback_ns = round(_NANO / rate_hz) if rate_hz > 0.0 else 0
        self._next_ns = 0
        self._moved_ns = 0
        self._message = message

    def begin(self, goal: GoalPort, time_ns: int) -> None:
        """Take a goal over; the one before is replaced."""
        self.end()
        self.goal = goal
        self._moved_ns = time_ns
        self._next_ns = time_ns + self._feedback_ns
        goal.accept()

    def end(self) -> None:
        """End a goal that is not pursued any more."""
        goal, self.goal = self.goal, None
        # Its server may have been closed before, and has ended it then.
        if goal is None or not goal.is_active:
            return
        if self._is_ros1:
            goal.cancel()
        else:
            goal.abort()

    def cancel(self, goal: GoalPort) -> bool:
        """End the goal when it is this one; tells whether it is."""
        if goal is not self.goal:
            return False
        self.goal = None
        goal.cancel()
        return True

    def watch(self, time_ns: int, error: float, position: float, velocity: float) -> None:
        """End the goal when it is reached or the gripper stands still for too long."""
        goal = self.goal
        if goal is None:
            return
        if abs(error) < self._tolerance:
            self._finish(goal, Outcome.REACHED, position, is_good=True)
        elif abs(velocity) > self._slow:
            self._moved_ns = time_ns
        elif time_ns - self._moved_ns > self._timeout_ns:
            self._finish(goal, Outcome.STALLED, position, is_good=self._stalls_well)
        if self.goal is not None and self._feedback_ns and time_ns >= self._next_ns:
            self._next_ns = time_ns + self._feedback_ns
            if goal.is_feedback_wanted:
                goal.publish_feedback(self._message(position, None))

    def _finish(self, goal: GoalPort, outcome: Outcome, position: float, *, is_good: bool) -> None:
        self.goal = None
        result = self._message(position, outcome)
        if is_good:
            goal.succeed(result)
        else:
            goal.abort(result, "the gripper stalled before it reached the goal")


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
        self._command = int(context.command_indices(self.commands)[0])
        self._position, self._velocity = context.state_indices(self.states).tolist()
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
            self.robot.interface_values.commands[self._command] = 0.0

    def update(self, time_ns: int, period_ns: int) -> None:
        """Watch the goal and command the joint."""
        self._time_ns = time_ns
        interface_values = self.robot.interface_values
        position = interface_values.states.item(self._position)
        velocity = interface_values.states.item(self._velocity)
        error = self._target - position
        self._goal.watch(time_ns, error, position, velocity)
        if self._pid is None:
            self._effort = self._max_effort
            interface_values.commands[self._command] = self._target
            return
        effort = self._pid.compute_with_rate(error, -velocity, period_ns * _SECONDS)
        self._effort = min(max(effort, -self._max_effort), self._max_effort)
        interface_values.commands[self._command] = self._effort
        interface_values.answer(self._command, self._pid.gains.p, self._pid.gains.d)

    def stop(self, time_ns: int) -> None:
        """End a goal."""
        self._is_running = False
        self._goal.end()

    def _hold(self) -> None:
        self._target = self.robot.interface_values.states.item(self._position)
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
    gains = read_gains(context.parameters, "gains", name, ros_version=context.ros_version)
    if gains is None:
        where = context.parameters.full_name(f"gains.{name}")
        text = f"controller '{context.name}': No p gain specified for pid. Namespace: {where}"
        raise ControllerError(text)
    pid = Pid(gains)
    offer_live_gains(context, f"gains{'/' if context.ros_version == 1 else '.'}{name}", pid)
    return pid
