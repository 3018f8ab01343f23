"""The parameters of ROS 2's trajectory controller: their table, what they say, its interfaces."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import ControllerContext
from gazelle.control.controllers.joint_trajectory_controller.command_outputs import (
    Forwarding,
    PidOutput,
    TrajectoryOutput,
    report_idle_gains,
)
from gazelle.control.controllers.joint_trajectory_controller.state_messages import point
from gazelle.control.controllers.joint_trajectory_controller.tracked_joints import (
    TrackedJoints,
    joint_names,
)
from gazelle.control.errors import ControllerError
from gazelle.control.interface_values import Array, Indices
from gazelle.control.pid import AntiWindup
from gazelle.control.pid.gains import gain_rows
from gazelle.control.trajectory.ros2_trajectory import Interpolation
from gazelle.control.trajectory.splines import JointState
from gazelle.parameters import Parameter, ParameterKind, ParameterTable, Topic

__all__ = [
    "INTERFACES",
    "ROS2_TABLE",
    "Ros2Setup",
    "check_interfaces",
    "columns_of",
    "command_joints",
    "live_problem",
    "read_interfaces",
]


_ROS2 = (2,)

_OLD_FF = ("ff_velocity_scale.<joint>",)


def _row(
    key: str, kind: ParameterKind, default: object, meaning: str, unit: str = "", live: bool = False
) -> Parameter:
    return Parameter(key, kind, default, meaning, unit, live=live, ros_versions=_ROS2)


_PARAMETERS = (
    _row("joints", "texts", None, "joints, in the order of states; required"),
    _row("command_joints", "texts", (), "joints to command when they differ from `joints`"),
    _row(
        "command_interfaces",
        "texts",
        None,
        "required: position, [velocity, [acceleration]]; velocity; effort; position and effort",
    ),
    _row("state_interfaces", "texts", None, "required: position, [velocity, [acceleration]]"),
    _row("allow_partial_joints_goal", "flag", False, "take trajectories of some joints", live=True),
    _row(
        "allow_integration_in_goal_trajectories",
        "flag",
        False,
        "take waypoints without positions; they are integrated from velocities or accelerations",
        live=True,
    ),
    _row(
        "allow_nonzero_velocity_at_trajectory_end",
        "flag",
        True,
        "take trajectories that end in motion; false from Jazzy on",
        live=True,
    ),
    _row(
        "open_loop_control",
        "flag",
        False,
        "begin trajectories at what was commanded last, not at what is measured; with velocity no "
        "PID is computed",
    ),
    _row(
        "interpolate_from_desired_state",
        "flag",
        False,
        "begin trajectories at what was commanded last (Jazzy)",
    ),
    _row(
        "set_last_command_interface_value_as_state_on_activation",
        "flag",
        True,
        "hold the last command when it starts, not the measured position",
    ),
    _row("interpolation_method", "text", "splines", "splines, or none to jump to waypoints"),
    _row(
        "speed_scaling.initial_scaling_factor",
        "number",
        1.0,
        "how fast trajectories run before `~/speed_scaling_input` says it (positions, Jazzy)",
    ),
    _row(
        "speed_scaling.state_interface",
        "refused",
        None,
        "no simulated hardware has an interface for it",
    ),
    _row(
        "speed_scaling.command_interface",
        "refused",
        None,
        "no simulated hardware has an interface for it",
    ),
    _row("action_monitor_rate", "number", 20.0, "rate of feedback", "Hz"),
    _row(
        "state_publish_rate",
        "number",
        50.0,
        "rate of states, 0: never (Jazzy publishes at every update)",
        "Hz",
    ),
    _row(
        "cmd_timeout",
        "number",
        0.0,
        "how long after its end a trajectory may wait for its tolerances, when longer than "
        "constraints.goal_time; 0: for ever",
        "s",
    ),
    _row(
        "constraints.goal_time",
        "number",
        0.0,
        "how much later than planned the goal may be reached; 0: any time later",
        "s",
        live=True,
    ),
    _row(
        "constraints.stopped_velocity_tolerance",
        "number",
        0.01,
        "largest velocity error at the goal, where velocity or effort is commanded; 0: any",
        "rad/s, m/s",
        live=True,
    ),
    _row(
        "constraints.decelerate_on_cancel",
        "flag",
        False,
        "stop with max_deceleration_on_cancel instead of holding at once (Jazzy)",
    ),
    _row(
        "constraints.<joint>.trajectory",
        "number",
        0.0,
        "largest position error on the way; 0: any",
        "rad, m",
        live=True,
    ),
    _row(
        "constraints.<joint>.goal",
        "number",
        0.0,
        "largest position error at the goal; 0: any",
        "rad, m",
        live=True,
    ),
    _row(
        "constraints.<joint>.max_deceleration_on_cancel",
        "number",
        0.0,
        "deceleration of decelerate_on_cancel",
        "rad/s², m/s²",
    ),
    Parameter(
        "gains.<joint>.ff_velocity_scale",
        "number",
        0.0,
        "feed-forward of velocity (velocity, effort)",
        aliases=_OLD_FF,
        live=True,
        ros_versions=_ROS2,
    ),
    _row(
        "gains.<joint>.angle_wraparound",
        "flag",
        False,
        "errors and new trajectories take the shorter way round; continuous joints do anyway",
    ),
    _row("gains.<joint>.normalize_error", "flag", False, "old name of angle_wraparound"),
    *gain_rows("gains.<joint>", _ROS2),
)

_STATE = "control_msgs/JointTrajectoryControllerState"

ROS2_TABLE = ControllerTable(
    ParameterTable(
        "joint_trajectory_controller (ROS 2)",
        "Follows trajectories of joints: splines through waypoints, watched by tolerances.",
        ("joint_trajectory_controller/JointTrajectoryController",),
        _PARAMETERS,
    ),
    interfaces="Claims `<joint>/<interface>` for each of `command_interfaces`, reads those of "
    "`state_interfaces`.",
    topics=(
        Topic(
            "~/joint_trajectory", "trajectory_msgs/JointTrajectory", "listens", ros_versions=_ROS2
        ),
        Topic(
            "~/speed_scaling_input",
            "control_msgs/SpeedScalingFactor",
            "listens",
            ros_versions=_ROS2,
        ),
        Topic("~/controller_state", _STATE, rate="state_publish_rate", ros_versions=_ROS2),
        Topic("~/state", _STATE, rate="state_publish_rate (Foxy to Humble)", ros_versions=_ROS2),
        Topic("~/query_state", "control_msgs/QueryTrajectoryState", "service", ros_versions=_ROS2),
        Topic(
            "~/follow_joint_trajectory",
            "control_msgs/FollowJointTrajectory",
            "action",
            "feedback at action_monitor_rate",
            ros_versions=_ROS2,
        ),
    ),
    behaviour=(
        "Between waypoints the reference is linear, cubic or quintic, by whether both have "
        "velocities and accelerations (`Trajectory::interpolate_between_points`); it is commanded "
        "at the update it belongs to, as up to Iron (Jazzy looks one period ahead).",
        "Waypoints with accelerations but no velocities are joined by lines; ros2_controllers "
        "would jump to 0.",
        "A new trajectory replaces the running one as a whole, at once: from the measured state, "
        "or from the last command with open_loop_control, a spline leads to its first waypoint.",
        "With velocity or effort alone the command is ff_velocity_scale · velocity + PID(position "
        "error, velocity error), with effort the waypoints' efforts are added. In all other cases "
        "the reference is handed on and `gains` have no effect, which is said.",
        "A violated tolerance aborts the goal with PATH_TOLERANCE_VIOLATED or "
        "GOAL_TOLERANCE_VIOLATED and holds the measured position, as cancelling does.",
        "A new goal aborts the running one (INVALID_GOAL, 'preempted by new incoming action'). A "
        "trajectory on `~/joint_trajectory` replaces what is followed; a running goal goes on and "
        "is judged by it.",
        "ROS 2 rejects goals without a result; programs in this process see INVALID_JOINTS, "
        "INVALID_GOAL or OLD_HEADER_TIMESTAMP and the reason.",
        "Goal tolerances: 0 leaves the controller's, -1 takes it away, other negative values are "
        "errors and the controller's are used.",
    ),
)

INTERFACES = ("position", "velocity", "acceleration", "effort")


def read_interfaces(context: ControllerContext, key: str) -> tuple[str, ...]:
    """Return ``command_interfaces`` or ``state_interfaces``, in the order of `INTERFACES`.

    Raises:
        ControllerError: the list is missing or empty, or has a word that is no interface.
    """
    context.parameters.require(key)
    names = context.parameters.texts(key)
    where = f"controller '{context.name}': '{context.parameters.full_name(key)}'"
    if not names:
        raise ControllerError(f"{where} parameter is empty")
    known = INTERFACES if key == "command_interfaces" else INTERFACES[:3]
    for name in names:
        if name not in known:
            raise ControllerError(f"{where} has '{name}', it may have {', '.join(known)}")
    return tuple(name for name in INTERFACES if name in names)


def check_interfaces(
    context: ControllerContext, commands: tuple[str, ...], states: tuple[str, ...]
) -> None:
    """Insist on the combinations that ros2_controllers takes.

    Raises:
        ControllerError: it would not take these.
    """
    needs_states = commands in {("velocity",), ("effort",), ("position", "effort")}
    rules = (
        (
            "velocity" in commands and len(commands) > 1 and "position" not in commands,
            "'velocity' command interface can be used either alone or 'position' command "
            "interface has to be present",
        ),
        (
            "acceleration" in commands and not {"velocity", "position"} <= set(commands),
            "'acceleration' command interface can only be used if 'velocity' and 'position' "
            "command interfaces are present",
        ),
        (
            "effort" in commands and commands not in {("effort",), ("position", "effort")},
            "'effort' command interface has to be used alone or with a 'position' interface",
        ),
        (
            "position" not in states,
            "'velocity' state interface cannot be used if 'position' interface is missing.",
        ),
        (
            "acceleration" in states and "velocity" not in states,
            "'acceleration' state interface cannot be used if 'position' and 'velocity' "
            "interfaces are not present.",
        ),
        (
            needs_states and "velocity" not in states,
            f"'{commands[-1]}' command interface can only be used alone if 'velocity' and "
            "'position' state interfaces are present",
        ),
    )
    for is_broken, text in rules:
        if is_broken:
            raise ControllerError(f"controller '{context.name}': {text}")


def command_joints(context: ControllerContext, names: tuple[str, ...]) -> tuple[str, ...]:
    """Return ``command_joints``, the joints themselves when there are none.

    Raises:
        ControllerError: there are more of them than joints.
    """
    if not context.parameters.texts("command_joints"):
        return names
    commanded = joint_names(context, "command_joints")
    if len(commanded) <= len(names):
        return commanded
    text = "The 'command_joints' parameter must not exceed the size of the 'joints' parameter."
    raise ControllerError(f"controller '{context.name}': {text}")


def columns_of(
    context: ControllerContext, commanded: tuple[str, ...], names: tuple[str, ...]
) -> Indices | None:
    """Return which of the joints are commanded, (M,), None when all are.

    Raises:
        ControllerError: fewer are commanded, and they are not among the joints.
    """
    if len(commanded) == len(names):
        return None
    if not set(commanded) <= set(names):
        text = "'command_joints' parameter must be a subset of 'joints' parameter, if their size "
        raise ControllerError(f"controller '{context.name}': {text}is not equal.")
    return np.array([names.index(name) for name in commanded], dtype=np.intp)


_FLAGS = (
    "allow_partial_joints_goal",
    "allow_integration_in_goal_trajectories",
    "allow_nonzero_velocity_at_trajectory_end",
)

# Gains that can be set live beside those that `offer_live_gains` offers.
_GAINS = ("i_clamp", "antiwindup_strategy", "tracking_time_constant", "error_deadband")


class Ros2Setup:
    """Interfaces and rules of a ROS 2 trajectory controller.

    Attributes:
        joints: what is followed.
        output: what writes commands.
        states: state interfaces it reads.
        interpolation: between waypoints.
        is_open_loop: trajectories begin where the joints were told to be, not where they are.
        has_effort: waypoints may have efforts.
        rows_without_error: which rows of errors (3, N) are not computed.
        may_scale: whether trajectories may run slower or faster than planned.
        scaling: how fast they run at first, 1 for as planned.
        deceleration: (N,) for stopping, None to hold at once.
        allow_partial_joints_goal: take trajectories of some joints.
        allow_integration_in_goal_trajectories: take waypoints without positions.
        allow_nonzero_velocity_at_trajectory_end: take trajectories that end in motion.
    """

    allow_partial_joints_goal: bool
    allow_integration_in_goal_trajectories: bool
    allow_nonzero_velocity_at_trajectory_end: bool

    def __init__(self, context: ControllerContext) -> None:
        """Read the parameters.

        Raises:
            ControllerError: they do not fit together.
        """
        parameters = context.parameters
        self._context = context
        self.joints = TrackedJoints.of_ros2(context)
        names = self.joints.names
        commands = read_interfaces(context, "command_interfaces")
        states = read_interfaces(context, "state_interfaces")
        check_interfaces(context, commands, states)
        closes = commands == ("effort",) or (
            commands == ("velocity",) and not parameters.flag("open_loop_control")
        )
        self.has_effort = "effort" in commands
        self.is_open_loop = parameters.flag("open_loop_control") or parameters.flag(
            "interpolate_from_desired_state"
        )
        self._commanded = command_joints(context, names)
        self._columns = columns_of(context, self._commanded, names)
        self.output = self._make_output(commands, closes)
        self._rows = tuple(row for row, word in enumerate(INTERFACES[:3]) if word in states)
        self.states = tuple(f"{name}/{INTERFACES[row]}" for row in self._rows for name in names)
        self._indices = context.state_indices(self.states)
        has_rate_error = 1 in self._rows and ("velocity" in commands or self.has_effort)
        has_bend_error = 2 in self._rows and "acceleration" in commands
        self.rows_without_error = (
            *(() if has_rate_error else (1,)),
            *(() if has_bend_error else (2,)),
        )
        self.interpolation = _interpolation(context)
        self.deceleration = _deceleration(context, names, 1 in self._rows)
        self.may_scale = commands == ("position",)
        self.scaling = _scaling(context, self.may_scale)
        self._read_flags()

    def read(self, actual: Array) -> None:
        """Put what is measured into rows of positions, velocities, accelerations (3, N)."""
        states = self._context.robot.interface_values.states
        states.take(self._indices, out=actual.reshape(-1)[: len(self._indices)], mode="clip")

    def state_of(self, actual: Array) -> JointState:
        """Return what is measured, of rows (3, N), without what is not."""
        rows = [actual[row].copy() if row in self._rows else None for row in (1, 2)]
        return JointState(actual[0].copy(), *rows)

    def state_at_start(self, actual: Array) -> JointState:
        """Return where to begin: the last commands where there are any, else what is measured.

        Args:
            actual: measured positions, velocities, accelerations (3, N), rad or m.
        """
        state = self.state_of(actual)
        key = "set_last_command_interface_value_as_state_on_activation"
        if self._columns is not None or not self._context.parameters.flag(key):
            return state
        found = {
            word: values
            for word, values in self.output.commanded().items()
            if np.isfinite(values).all()
        }
        return JointState(
            found.get("position", state.position),
            found.get("velocity", state.velocity),
            found.get("acceleration", state.acceleration),
            found.get("effort"),
        )

    def measured(self, rows: Array) -> list[Array | None]:
        """Return the rows (N,) of (3, N) that have a state interface, None for the others."""
        return [rows[row] if row in self._rows else None for row in range(3)]

    def output_point(self) -> Any:
        """Return a JointTrajectoryPoint of the present commands."""
        now = self.output.commanded()
        return point([now.get(word) for word in INTERFACES[:3]], 0, now.get("effort"))

    def timeout_s(self, goal_time_s: float) -> float:
        """Return ``cmd_timeout``, 0 when it is not longer than the goal's time."""
        parameters = self._context.parameters
        timeout_s = parameters.number("cmd_timeout")
        if timeout_s <= 0.0 or timeout_s > goal_time_s:
            return max(timeout_s, 0.0)
        text = f"Command timeout must be higher than goal_time tolerance ({timeout_s:f} vs. "
        self._context.ports.log("warn", f"{text}{goal_time_s:f}); it is switched off")
        return 0.0

    def take(self, values: Mapping[str, Any]) -> None:
        """Take over parameters that were checked with `live_problem`."""
        for key, value in values.items():
            *path, last = key.split(".")
            branch = self._context.parameters.tree
            for word in path:
                branch = branch.setdefault(word, {})
            branch[last] = value
        self._read_flags()
        gains = [key for key in values if key.startswith("gains.")]
        if isinstance(self.output, PidOutput):
            self.output.set_feed_forward(self._feed_forward())
            for key in gains:
                name, word = key.removeprefix("gains.").rsplit(".", 1)
                if word in _GAINS:
                    self.output.set_gain(name, word, values[key])
        elif gains:
            text = f"'{gains[0]}' has no effect: positions are commanded as they are, without a PID"
            self._context.ports.log("warn", text)

    def _read_flags(self) -> None:
        for name in _FLAGS:
            setattr(self, name, self._context.parameters.flag(name))

    def _make_output(self, commands: Sequence[str], closes: bool) -> TrajectoryOutput:
        context = self._context
        if closes:
            forward = self._feed_forward()
            return PidOutput(context, self._commanded, commands[0], forward, self._columns)
        report_idle_gains(context)
        return Forwarding(context, self._commanded, commands, self._columns)

    def _feed_forward(self) -> Array:
        parameters = self._context.parameters
        return np.array(
            [
                parameters.number(f"gains.{name}.ff_velocity_scale", 0.0)
                or parameters.number(f"ff_velocity_scale.{name}", 0.0)
                for name in self._commanded
            ]
        )


def live_problem(values: Mapping[str, Any]) -> str:
    """Return why live values cannot be taken, empty when they can."""
    for key, value in values.items():
        if key.endswith(".antiwindup_strategy"):
            known = [strategy.value for strategy in AntiWindup]
            if value not in known:
                return f"'{key}' is {value!r}, it may be {', '.join(known)}"
        elif key in _FLAGS or key.endswith(".antiwindup"):
            if not isinstance(value, bool):
                return f"'{key}' is {value!r}, not true or false"
        elif isinstance(value, bool) or not isinstance(value, int | float):
            return f"'{key}' is {value!r}, not a number"
        elif key.startswith("constraints.") and value < 0.0:
            return f"'{key}' is {value}, but must not be negative"
    return ""


def _interpolation(context: ControllerContext) -> Interpolation:
    word = context.parameters.text("interpolation_method")
    try:
        return Interpolation(word)
    except ValueError:
        known = ", ".join(one.value for one in Interpolation)
        text = f"'interpolation_method' is '{word}', it may be {known}"
        raise ControllerError(f"controller '{context.name}': {text}") from None


def _scaling(context: ControllerContext, may_scale: bool) -> float:
    parameters, key = context.parameters, "speed_scaling.initial_scaling_factor"
    factor = parameters.number(key)
    if factor == 1.0 or (may_scale and factor >= 0.0):
        return factor
    text = f"'{key}' {factor:g} has no effect: "
    text += "it must not be negative" if may_scale else "only positions may be commanded with it"
    parameters.report("parameter.bad-value", text, key=key)
    return 1.0


def _deceleration(
    context: ControllerContext, names: Sequence[str], has_velocity: bool
) -> Array | None:
    parameters = context.parameters
    if not parameters.flag("constraints.decelerate_on_cancel"):
        return None
    rates = [parameters.number(f"constraints.{n}.max_deceleration_on_cancel") for n in names]
    slow = next((name for name, rate in zip(names, rates, strict=True) if rate <= 0.0), None)
    unlimited = next((n for n in names if not context.joint(n).limits.max_velocity), None)
    if slow is not None:
        text = f"joint '{slow}' has no max_deceleration_on_cancel above 0"
    elif unlimited is not None:
        text = f"joint '{unlimited}' has no velocity limit in the URDF"
    elif not has_velocity:
        text = "'velocity' is not among state_interfaces"
    else:
        return np.array(rates)
    text = f"constraints.decelerate_on_cancel has no effect, {text}; "
    text += "the position is held at once instead"
    parameters.report("control.no-deceleration", text, key="constraints.decelerate_on_cancel")
    return None
