"""The joint_trajectory_controller of ros_controllers, for all hardware interfaces."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from gazelle.control.controller_node_interface import GoalPort
from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.controllers.joint_trajectory_controller.command_outputs import (
    Forwarding,
    PidOutput,
    TrajectoryOutput,
    report_idle_gains,
)
from gazelle.control.controllers.joint_trajectory_controller.ros2_parameters import ROS2_TABLE
from gazelle.control.controllers.joint_trajectory_controller.state_messages import (
    Feedback,
    StateReport,
    point,
    result,
)
from gazelle.control.controllers.joint_trajectory_controller.tracked_joints import (
    TrackedJoints,
    read_tolerances,
)
from gazelle.control.errors import ControllerError
from gazelle.control.interface_values import Array
from gazelle.control.pid.gains import gain_rows
from gazelle.control.trajectory.ros1_trajectory import (
    SegmentTrajectory,
    Splice,
    Track,
    hold,
    ramp_down,
    splice,
)
from gazelle.control.trajectory.tolerances import Tolerances, goal_tolerances, violated
from gazelle.control.trajectory.waypoints import (
    ErrorCode,
    TrajectoryError,
    check_joints,
    read_waypoints,
)
from gazelle.interfaces.stamps import ns_of
from gazelle.parameters import Parameter, ParameterKind, ParameterTable, Topic

__all__ = ["ROS1_TABLE", "Ros1JointTrajectoryController"]


_FAMILIES = ("position", "velocity", "effort", "pos_vel", "pos_vel_acc")

_ROS1 = (1,)


def _row(key: str, kind: ParameterKind, default: object, meaning: str, unit: str = "") -> Parameter:
    return Parameter(key, kind, default, meaning, unit, ros_versions=_ROS1)


ROS1_TABLE = ControllerTable(
    ParameterTable(
        "joint_trajectory_controller (ROS 1)",
        "Follows trajectories of joints: splines through waypoints, watched by tolerances.",
        tuple(f"{family}_controllers/JointTrajectoryController" for family in _FAMILIES),
        (
            _row("joints", "texts", None, "joints, in the order of states; required"),
            _row("allow_partial_joints_goal", "flag", False, "take trajectories of some joints"),
            _row(
                "stop_trajectory_duration",
                "number",
                0.0,
                "time to come to rest in when started, cancelled or told an empty"
                " trajectory; 0: the "
                "measured position is held at once",
                "s",
            ),
            _row("state_publish_rate", "number", 50.0, "rate of `~/state`; 0: never", "Hz"),
            _row("action_monitor_rate", "number", 20.0, "rate of feedback", "Hz"),
            _row(
                "constraints.goal_time",
                "number",
                0.0,
                "how much later than planned the goal may be reached; with 0 it must be on time",
                "s",
            ),
            _row(
                "constraints.stopped_velocity_tolerance",
                "number",
                0.01,
                "largest velocity error at the goal; 0: any",
                "rad/s, m/s",
            ),
            _row(
                "constraints.<joint>.trajectory",
                "number",
                0.0,
                "largest position error on the way; 0: any",
                "rad, m",
            ),
            _row(
                "constraints.<joint>.goal",
                "number",
                0.0,
                "largest position error at the goal; 0: any",
                "rad, m",
            ),
            _row(
                "velocity_ff.<joint>", "number", 0.0, "feed-forward of velocity (velocity, effort)"
            ),
            _row("verbose", "flag", False, "say on the console which tolerance was violated"),
            *gain_rows("gains.<joint>", _ROS1),
        ),
    ),
    interfaces="Claims `<joint>/position`, `/velocity` or `/effort` by its type; pos_vel and "
    "pos_vel_acc claim two and three of position, velocity, acceleration. Reads positions and "
    "velocities.",
    topics=(
        Topic("~/command", "trajectory_msgs/JointTrajectory", "listens", ros_versions=_ROS1),
        Topic(
            "~/state",
            "control_msgs/JointTrajectoryControllerState",
            rate="state_publish_rate",
            ros_versions=_ROS1,
        ),
        Topic("~/query_state", "control_msgs/QueryTrajectoryState", "service", ros_versions=_ROS1),
        Topic(
            "~/follow_joint_trajectory",
            "control_msgs/FollowJointTrajectory",
            "action",
            "feedback at action_monitor_rate",
            ros_versions=_ROS1,
        ),
    ),
    behaviour=(
        "Between waypoints the reference is linear, cubic or quintic, by whether both have "
        "velocities and accelerations (`QuinticSplineSegment`).",
        "A new trajectory replaces the running one from its start on: what comes before is "
        "followed to the end, a segment bridges to its first waypoint; waypoints that lie in the "
        "past are dropped (`initJointTrajectory`). It begins at the next update when its stamp is "
        "0.",
        "Continuous joints take the shorter way to a new trajectory; errors of joints that turn "
        "are at most half a turn (`angles::shortest_angular_distance`); those of prismatic "
        "joints are not wrapped, which ros_controllers does by mistake.",
        "velocity and effort command velocity_ff · desired velocity + PID(position error, velocity "
        "error); the gains can be changed with dynamic_reconfigure at `~/gains/<joint>`. "
        "position, pos_vel and pos_vel_acc hand the reference on: gains have no effect.",
        "A violated tolerance aborts the goal with PATH_TOLERANCE_VIOLATED or "
        "GOAL_TOLERANCE_VIOLATED and `<joint> path error <error>`; the trajectory itself is "
        "followed to its end (ros_controllers#48).",
        "A new goal or a trajectory on `~/command` preempts the running goal; cancelling it and "
        "empty trajectories hold the position.",
        "Goals of other joints are rejected with INVALID_JOINTS, all others that cannot be "
        "followed with INVALID_GOAL and the reason, also those that lie in the past.",
    ),
)

_NANO = 1_000_000_000

_FORWARDED = {
    "position_controllers": ("position",),
    "pos_vel_controllers": ("position", "velocity"),
    "pos_vel_acc_controllers": ("position", "velocity", "acceleration"),
}

_NOT_RUNNING = "Can't accept new action goals. Controller is not running."


class Ros1JointTrajectoryController(Controller):
    """Follows trajectories by the rules of ROS 1."""

    TABLE: ClassVar[ControllerTable] = ROS1_TABLE

    def __init__(self, context: ControllerContext) -> None:
        """Read the parameters and offer topics, service and action."""
        super().__init__(context)
        if context.ros_version == 2:
            text = f"controller '{context.name}': type '{context.type}' is ROS 1's; ROS 2 has "
            text += f"{ROS2_TABLE.parameters.types[0]}, and its 'command_interfaces' say what it"
            text += " commands"
            raise ControllerError(text)
        parameters, ports = context.parameters, context.ports
        self._joints = joints = TrackedJoints.of_ros1(context)
        names = joints.names
        self._constraints = read_tolerances(context, names)
        self._allow_partial = parameters.flag("allow_partial_joints_goal")
        self._stop_ns = round(parameters.number("stop_trajectory_duration") * _NANO)
        self._verbose = parameters.flag("verbose")
        self._output = _output(context, names)
        self.commands = self._output.commands
        self.states = tuple(f"{name}/{word}" for word in ("position", "velocity") for name in names)
        self._indices = context.state_indices(self.states)
        self._time_ns, self._period_ns = 0, 0
        self._is_running = False
        self._goal: GoalPort | None = None
        self._reached = np.zeros(len(names), dtype=np.bool_)
        self._actual: Array = np.zeros((2, len(names)))
        self._actual_flat = self._actual.reshape(-1)
        self._error: Array = np.zeros((3, len(names)))
        self._following: SegmentTrajectory = hold(self._actual[0], 0)
        self._report = StateReport(
            ports, ["~/state"], names, parameters.number("state_publish_rate")
        )
        self._feedback = Feedback(names, parameters.number("action_monitor_rate"))
        ports.subscription("~/command", "trajectory_msgs/JointTrajectory", self._on_command)
        ports.service("~/query_state", "control_msgs/QueryTrajectoryState", self._on_query)
        ports.action_server(
            "~/follow_joint_trajectory",
            "control_msgs/FollowJointTrajectory",
            on_goal=self._on_goal,
            on_cancel=self._on_cancel,
        )

    def start(self, time_ns: int) -> None:
        """Hold the present position, or come to rest within stop_trajectory_duration."""
        # What comes before the first update begins with it.
        self._time_ns, self._period_ns = time_ns, 0
        self._is_running = True
        self._measure()
        self._following.state[:2] = self._actual
        self._hold()
        self._report.start(time_ns)
        self._output.start(self._actual[0])

    def update(self, time_ns: int, period_ns: int) -> None:
        """Sample the trajectory, judge the goal, command the joints."""
        self._time_ns, self._period_ns = time_ns, period_ns
        following, output = self._following, self._output
        moves = following.sample(time_ns)
        is_due = self._report.is_due(time_ns)
        if not (moves or is_due or output.is_closed_loop or self._goal is not None):
            return
        self._measure()
        self._joints.error(following.state[:2], self._actual, self._error[:2])
        if self._goal is not None:
            self._judge(self._goal, time_ns)
        if moves or output.is_closed_loop:
            output.write(following.state, None, self._error, period_ns)
        if self._goal is not None:
            self._feedback.tell(self._goal, time_ns, self._points)
        if is_due:
            self._report.publish(time_ns, *self._points())

    def stop(self, time_ns: int) -> None:
        """End a goal; commands stay as they are."""
        self._is_running = False
        self._preempt()

    def _measure(self) -> None:
        self.robot.interface_values.states.take(self._indices, out=self._actual_flat, mode="clip")

    def _points(self) -> tuple[Any, Any, Any]:
        track, _ = self._following.track_of(0)
        segment = track.segments[track.cursor]
        from_start_ns = round(segment.from_start_s * _NANO)
        now_ns = self._time_ns - segment.start_ns + from_start_ns
        return (
            point(self._following.state, from_start_ns),
            point(self._actual, now_ns),
            point(self._error[:2], from_start_ns - now_ns),
        )

    def _judge(self, goal: GoalPort, time_ns: int) -> None:
        """End a goal that violates a tolerance or is reached."""
        for track in self._following.tracks:
            segment = track.segments[track.cursor]
            if not segment.is_of_goal:
                continue
            if time_ns < segment.end_ns:
                text = self._path_violation(track, segment.tolerances)
                code = ErrorCode.PATH_TOLERANCE_VIOLATED
            elif track.cursor == len(track.segments) - 1:
                text = self._goal_violation(track, segment.tolerances, time_ns - segment.end_ns)
                code = ErrorCode.GOAL_TOLERANCE_VIOLATED
            else:
                continue
            if text:
                if self._verbose:
                    self.context.ports.log("error", f"{code.name}: {text}")
                self._goal = None
                goal.abort(result(code, text), text)
                return
        if self._reached.all():
            self._goal = None
            goal.succeed(result(ErrorCode.SUCCESSFUL))

    def _path_violation(self, track: Track, tolerances: Tolerances | None) -> str:
        if tolerances is None or not tolerances.has_path:
            return ""
        bad = violated(self._errors_of(track), tolerances.path)
        return self._violation(track, int(bad.argmax()), "path") if bad.any() else ""

    def _goal_violation(self, track: Track, tolerances: Tolerances | None, late_ns: int) -> str:
        if tolerances is None:
            self._reached[track.indices] = True
            return ""
        bad = violated(self._errors_of(track), tolerances.goal)
        self._reached[track.indices] |= ~bad
        if not bad.any() or late_ns < tolerances.goal_time_s * _NANO:
            return ""
        return self._violation(track, int(bad.argmax()), "goal")

    def _errors_of(self, track: Track) -> Array:
        is_all = len(track.indices) == len(self._joints.names)
        return self._error if is_all else self._error[:, track.indices]

    def _violation(self, track: Track, column: int, what: str) -> str:
        joint = int(track.indices[column])
        return f"{self._joints.names[joint]} {what} error {self._error[0, joint]:f}"

    def _hold(self, *, is_of_goal: bool = False) -> None:
        now_ns = self._time_ns
        if self._stop_ns == 0:
            self._measure()
            self._replace(hold(self._actual[0], now_ns, is_of_goal=is_of_goal))
            return
        position, velocity = self._following.state[:2].copy()
        ramp = ramp_down(position, velocity, now_ns, self._stop_ns, is_of_goal=is_of_goal)
        self._replace(ramp)

    def _replace(self, following: SegmentTrajectory) -> None:
        # What was commanded last stays the desired state until the next update.
        following.state[:] = self._following.state
        self._following = following

    def _follow(self, message: Any, goal: Any = None) -> None:
        """Take over a trajectory, of a goal's request or of the topic.

        Raises:
            TrajectoryError: it cannot be followed.
        """
        names = self._joints.names
        if not self._is_running:
            raise TrajectoryError(ErrorCode.INVALID_GOAL, _NOT_RUNNING)
        if goal is None and not len(message.points):
            self._hold()
            return
        indices = check_joints(message.joint_names, names, allow_partial=self._allow_partial)
        if not len(message.points):
            self._hold(is_of_goal=True)
            return
        tolerances = None
        if goal is not None:
            tolerances = goal_tolerances(self._constraints, goal, names, strict=False)
        waypoints = read_waypoints(message, indices)
        next_ns = self._time_ns + self._period_ns
        how = Splice(self._following, self._time_ns, next_ns, self._joints.wraps, tolerances)
        following, remark = splice(waypoints, how)
        self._replace(following)
        if remark:
            self.context.ports.log("warn", remark)

    def _preempt(self) -> None:
        goal, self._goal = self._goal, None
        # Its server may have been closed before, and has ended it then.
        if goal is not None and goal.is_active:
            goal.cancel()

    def _on_command(self, message: Any) -> None:
        try:
            self._follow(message)
        except TrajectoryError as error:
            self.context.ports.log("error", str(error))
        else:
            self._preempt()

    def _on_goal(self, goal: GoalPort) -> None:
        try:
            self._follow(goal.request.trajectory, goal.request)
        except TrajectoryError as error:
            self.context.ports.log("error", str(error))
            goal.reject(result(error.code, str(error)), str(error))
            return
        self._preempt()
        self._reached[:] = False
        self._feedback.start(self._time_ns)
        self._goal = goal
        goal.accept()

    def _on_cancel(self, goal: GoalPort) -> bool:
        if goal is not self._goal:
            return False
        self._goal = None
        self._hold()
        goal.cancel()
        return True

    def _on_query(self, request: Any, response: Any) -> None:
        if not self._is_running:
            raise ControllerError("Can't sample trajectory. Controller is not running.")
        time_ns = ns_of(request.time)
        if time_ns < min(self._following.start_ns, self._time_ns):
            raise ControllerError("Requested sample time precedes trajectory start time.")
        state = self._following.state_at(time_ns)
        response.success = True
        response.name = list(self._joints.names)
        response.position, response.velocity = state.position, state.velocity
        response.acceleration = state.acceleration


def _output(context: ControllerContext, names: tuple[str, ...]) -> TrajectoryOutput:
    package = context.type.replace("::", "/").partition("/")[0]
    if package in _FORWARDED:
        report_idle_gains(context)
        return Forwarding(context, names, _FORWARDED[package])
    number = context.parameters.number
    feed_forward = np.array([number(f"velocity_ff.{name}") for name in names])
    interface = package.removesuffix("_controllers")
    return PidOutput(context, names, interface, feed_forward)
