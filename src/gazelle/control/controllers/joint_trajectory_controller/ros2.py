"""The joint_trajectory_controller of ros2_controllers."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from gazelle.control.controller_node_interface import GoalPort
from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.controllers.joint_trajectory_controller.ros1 import ROS1_TABLE
from gazelle.control.controllers.joint_trajectory_controller.ros2_parameters import (
    ROS2_TABLE,
    Ros2Setup,
    live_problem,
)
from gazelle.control.controllers.joint_trajectory_controller.state_messages import (
    Feedback,
    StateReport,
    point,
    result,
    violation,
)
from gazelle.control.controllers.joint_trajectory_controller.tracked_joints import read_tolerances
from gazelle.control.errors import ControllerError
from gazelle.control.interface_values import Array
from gazelle.control.trajectory.ros2_trajectory import PointTrajectory, decelerating, holding
from gazelle.control.trajectory.splines import JointState
from gazelle.control.trajectory.tolerances import (
    ToleranceError,
    Tolerances,
    goal_tolerances,
    violated,
)
from gazelle.control.trajectory.waypoints import (
    ErrorCode,
    TrajectoryError,
    Waypoints,
    check_joints,
    read_waypoints,
)
from gazelle.interfaces.stamps import ns_of

__all__ = ["Ros2JointTrajectoryController", "accepted"]


_SECONDS = 1e-9

_EPSILON = float(np.finfo(np.float32).eps)


def accepted(message: Any, setup: Ros2Setup, now_ns: int, position: Array) -> Waypoints:
    """Read a trajectory; joints it does not have stay where they are told to be.

    Args:
        message: trajectory_msgs/JointTrajectory.
        setup: of the controller.
        now_ns: time of the last update.
        position: (N,) measured, for joints that are not commanded.

    Raises:
        TrajectoryError: it cannot be followed.
    """
    names = setup.joints.names
    indices = check_joints(
        message.joint_names, names, allow_partial=setup.allow_partial_joints_goal
    )
    if not len(message.points):
        raise TrajectoryError(ErrorCode.INVALID_GOAL, "Empty trajectory received.")
    waypoints = read_waypoints(message, indices)
    _check_end(waypoints, setup, now_ns)
    for number, state in enumerate(waypoints.states):
        _check_fields(state, number, setup)
    if len(indices) == len(names):
        return waypoints
    return _completed(waypoints, len(names), _staying(setup, position))


def _check_end(waypoints: Waypoints, setup: Ros2Setup, now_ns: int) -> None:
    last = waypoints.states[-1].velocity
    if last is not None and not setup.allow_nonzero_velocity_at_trajectory_end:
        moving = np.flatnonzero(np.abs(last) > _EPSILON)
        if len(moving):
            name = setup.joints.names[int(waypoints.indices[moving[0]])]
            text = f"Velocity of last trajectory point of joint {name} is not zero: "
            raise TrajectoryError(ErrorCode.INVALID_GOAL, f"{text}{last[moving[0]]:.15f}")
    end_ns = waypoints.stamp_ns + waypoints.times_ns[-1]
    if waypoints.stamp_ns and end_ns < now_ns:
        text = f"Received trajectory with non-zero start time ({waypoints.stamp_ns * _SECONDS:f}) "
        text += f"that ends in the past ({end_ns * _SECONDS:f}); it is {now_ns * _SECONDS:f} now"
        raise TrajectoryError(ErrorCode.OLD_HEADER_TIMESTAMP, text)


def _check_fields(state: JointState, number: int, setup: Ros2Setup) -> None:
    text = ""
    if state.effort is not None and not setup.has_effort:
        text = "Trajectories with effort fields are only supported for controllers using the "
        text += "'effort' command interface."
    elif not len(state.position):
        if not setup.allow_integration_in_goal_trajectories:
            text = f"point #{number} has no positions (allow_integration_in_goal_trajectories is "
            text += "false)"
        elif state.velocity is None and state.acceleration is None:
            text = "The given trajectory has no position, velocity, or acceleration points."
    if text:
        raise TrajectoryError(ErrorCode.INVALID_GOAL, text)


def _staying(setup: Ros2Setup, position: Array) -> Array:
    """Return where joints are told to be, or are when they are told nothing."""
    commanded = setup.output.commanded().get("position")
    if commanded is None or len(commanded) != len(position):
        return position
    return np.where(np.isfinite(commanded), commanded, position)


def _completed(waypoints: Waypoints, n_joints: int, staying: Array) -> Waypoints:
    def filled(values: Array | None, rest: Array) -> Array | None:
        if values is None or not len(values):
            return values
        result = rest.copy()
        result[waypoints.indices] = values
        return result

    zero = np.zeros(n_joints)
    states = []
    for state in waypoints.states:
        position = filled(state.position, staying)
        states.append(
            JointState(
                state.position if position is None else position,
                filled(state.velocity, zero),
                filled(state.acceleration, zero),
                filled(state.effort, zero),
            )
        )
    indices = np.arange(n_joints, dtype=np.intp)
    return Waypoints(indices, waypoints.times_ns, tuple(states), waypoints.stamp_ns)


_PREEMPTED = "Current goal preempted by new incoming action."

_DEACTIVATED = "Current goal cancelled during deactivate transition."

_TIMEOUT = "Aborted due to command timeout"

_NOT_RUNNING = "Can't accept new action goals. Controller is not running."


class Ros2JointTrajectoryController(Controller):
    """Follows trajectories by the rules of ROS 2."""

    TABLE: ClassVar[ControllerTable] = ROS2_TABLE

    def __init__(self, context: ControllerContext) -> None:
        """Read the parameters and offer topics, service and action."""
        super().__init__(context)
        if context.ros_version == 1:
            text = f"controller '{context.name}': type '{context.type}' is ROS 2's; ROS 1 has "
            raise ControllerError(f"{text}{', '.join(ROS1_TABLE.parameters.types)}")
        self._setup = setup = Ros2Setup(context)
        names, ports, parameters = setup.joints.names, context.ports, context.parameters
        self.commands = setup.output.commands
        self.states = setup.states
        self._constraints = self._tolerances = read_tolerances(context, names)
        n = len(names)
        self._actual: Array = np.zeros((3, n))
        self._error: Array = np.zeros((3, n))
        self._last = JointState(np.zeros(n))
        self._timeout_s = 0.0
        self._time_ns, self._period_ns = 0, round(1e9 / context.update_rate_hz)
        self._is_active = False
        self._is_holding = True
        self._scaling = setup.scaling
        self._delay_ns = 0
        self._goal: GoalPort | None = None
        self._following = PointTrajectory(holding(JointState(np.zeros(n))))
        topics = ["~/controller_state", "~/state"]
        self._report = StateReport(ports, topics, names, parameters.number("state_publish_rate"))
        self._feedback = Feedback(names, parameters.number("action_monitor_rate"))
        ports.subscription(
            "~/joint_trajectory", "trajectory_msgs/JointTrajectory", self._on_trajectory
        )
        if setup.may_scale:
            scaling = "control_msgs/SpeedScalingFactor"
            ports.subscription("~/speed_scaling_input", scaling, self._on_scaling)
        ports.service("~/query_state", "control_msgs/QueryTrajectoryState", self._on_query)
        ports.action_server(
            "~/follow_joint_trajectory",
            "control_msgs/FollowJointTrajectory",
            on_goal=self._on_goal,
            on_cancel=self._on_cancel,
        )

    def start(self, time_ns: int) -> None:
        """Hold the last command, or the present position when there is none."""
        self._time_ns, self._is_active = time_ns, True
        self._measure()
        self._last = self._setup.state_at_start(self._actual)
        self._timeout_s = self._setup.timeout_s(self._constraints.goal_time_s)
        self._setup.output.start(self._last.position)
        self._stay(JointState(self._last.position))
        self._report.start(time_ns)

    def update(self, time_ns: int, period_ns: int) -> None:
        """Sample the trajectory, judge it, command the joints."""
        self._time_ns, self._period_ns = time_ns, period_ns
        following, output = self._following, self._setup.output
        is_first = not following.is_begun
        if is_first:
            self._begin(following, time_ns)
        elif self._scaling != 1.0:
            self._delay_ns += round(period_ns * (1.0 - self._scaling))
        trajectory_ns = time_ns - self._delay_ns
        moves = following.sample(trajectory_ns)
        is_due = self._report.is_due(time_ns)
        if not (moves or is_due or output.is_closed_loop or not self._is_holding):
            return
        self._measure()
        self._compare(following)
        is_followed = self._is_holding or self._judge(following, trajectory_ns, is_first)
        if is_followed and (moves or output.is_closed_loop):
            output.write(following.state, self._effort(following), self._error, period_ns)
        if self._goal is not None:
            self._feedback.tell(self._goal, time_ns, lambda: self._points(following))
        if is_due:
            now = self._points(following)
            commanded = self._setup.output_point()
            self._report.publish(time_ns, *now, commanded, scaling=self._scaling)

    def stop(self, time_ns: int) -> None:
        """Abort a goal; positions stay commanded, the rest becomes 0."""
        self._is_active = False
        self._abort(ErrorCode.INVALID_GOAL, _DEACTIVATED)
        self._setup.output.stop()

    def changed(self, values: dict[str, Any]) -> str:
        """Take over tolerances, flags and feed-forward; goals that run keep their tolerances."""
        problem = live_problem(values)
        if problem:
            return problem
        self._setup.take(values)
        is_default = self._tolerances is self._constraints
        self._constraints = read_tolerances(self.context, self._setup.joints.names)
        if is_default:
            self._tolerances = self._constraints
        return ""

    def _begin(self, following: PointTrajectory, time_ns: int) -> None:
        self._measure()
        before = self._setup.state_of(self._actual)
        if self._setup.is_open_loop:
            before = self._last
        self._delay_ns = 0
        following.begin(time_ns, before, self._setup.joints.wraps)

    def _measure(self) -> None:
        self._setup.read(self._actual)

    def _compare(self, following: PointTrajectory) -> None:
        self._setup.joints.error(following.state, self._actual, self._error)
        for row in self._setup.rows_without_error:
            self._error[row] = 0.0

    def _effort(self, following: PointTrajectory) -> Array | None:
        # Added to a PID's command only when a waypoint has some; commanded alone in any case.
        needs = following.has_effort or not self._setup.output.is_closed_loop
        return following.effort if needs and self._setup.has_effort else None

    def _judge(self, following: PointTrajectory, time_ns: int, is_first: bool) -> bool:
        """End what violates a tolerance or is reached; False when nothing may be commanded."""
        tolerances = self._tolerances
        is_before_end = time_ns < following.end_ns
        if (is_before_end or is_first) and tolerances.has_path:
            bad = violated(self._error, tolerances.path)
            if bad.any():
                self._tell_violation("State", int(bad.argmax()))
                self._abort(
                    ErrorCode.PATH_TOLERANCE_VIOLATED, "Aborted due to path tolerance violation"
                )
                self._stop_moving()
                return False
        if is_before_end:
            return True
        late_s = (time_ns - following.end_ns) * _SECONDS
        bad = violated(self._error, tolerances.goal)
        if bad.any() and 0.0 < tolerances.goal_time_s < late_s:
            self._tell_violation("Goal", int(bad.argmax()))
            text = f"Aborted due to goal_time_tolerance exceeding by {late_s:f} seconds"
            self._abort(ErrorCode.GOAL_TOLERANCE_VIOLATED, text)
            self._stop_moving()
            return False
        if self._goal is not None and not bad.any():
            goal, self._goal = self._goal, None
            goal.succeed(result(ErrorCode.SUCCESSFUL, "Goal successfully reached!"))
            # Its last waypoint is repeated, with its velocities.
            self._stay(following.last_point)
        elif 0.0 < self._timeout_s < late_s:
            self.context.ports.log("warn", _TIMEOUT)
            self._abort(ErrorCode.GOAL_TOLERANCE_VIOLATED, _TIMEOUT)
            self._stop_moving()
        return True

    def _tell_violation(self, what: str, joint: int) -> None:
        tolerances = self._tolerances
        limits = tolerances.path if what == "State" else tolerances.goal
        text = violation(self._error[:, joint], limits[:, joint])
        name = self._setup.joints.names[joint]
        text = f"{what} tolerances failed for joint {joint} ('{name}'): {text}"
        self.context.ports.log("error", text)

    def _stay(self, state: JointState) -> None:
        self._replace(holding(state), is_holding=True)

    def _stop_moving(self) -> None:
        """Hold the present position, or slow down to a stop."""
        deceleration = self._setup.deceleration
        if deceleration is None:
            self._stay(JointState(self._actual[0].copy()))
            return
        position, velocity = self._actual[:2].copy()
        way = decelerating(position, velocity, deceleration, self._period_ns)
        self._replace(way, is_holding=True)

    def _replace(self, waypoints: Waypoints, *, is_holding: bool) -> None:
        old, new = self._following, PointTrajectory(waypoints, self._setup.interpolation)
        if old.is_begun:
            state = old.state.copy()
            self._last = JointState(state[0], state[1], state[2], old.effort.copy())
        self._following, self._is_holding = new, is_holding

    def _abort(self, code: ErrorCode, text: str) -> None:
        goal, self._goal = self._goal, None
        # Its server may have been closed before, and has ended it then.
        if goal is not None and goal.is_active:
            goal.abort(result(code, text), text)

    def _points(self, following: PointTrajectory) -> tuple[Any, Any, Any]:
        since_ns = self._time_ns - following.start_ns
        setup = self._setup
        return (
            point(following.state, since_ns - self._delay_ns),
            point(setup.measured(self._actual), since_ns),
            point(setup.measured(self._error), 0),
        )

    def _on_scaling(self, message: Any) -> None:
        if message.factor >= 0.0:
            self._scaling = float(message.factor)
            return
        text = "Scaling factor has to be greater or equal to 0.0 - Ignoring input!"
        self.context.ports.log("warn", text)

    def _on_trajectory(self, message: Any) -> None:
        if not self._is_active:
            return
        try:
            waypoints = accepted(message, self._setup, self._time_ns, self._actual[0])
        except TrajectoryError as error:
            self.context.ports.log("error", str(error))
            return
        self._replace(waypoints, is_holding=False)

    def _on_goal(self, goal: GoalPort) -> None:
        try:
            if not self._is_active:
                raise TrajectoryError(ErrorCode.INVALID_GOAL, _NOT_RUNNING)
            message = goal.request.trajectory
            waypoints = accepted(message, self._setup, self._time_ns, self._actual[0])
        except TrajectoryError as error:
            self.context.ports.log("error", str(error))
            goal.reject(result(error.code, str(error)), str(error))
            return
        self._abort(ErrorCode.INVALID_GOAL, _PREEMPTED)
        self._replace(waypoints, is_holding=False)
        self._tolerances = self._goal_tolerances(goal.request)
        self._feedback.start(self._time_ns)
        self._goal = goal
        goal.accept()

    def _goal_tolerances(self, request: Any) -> Tolerances:
        try:
            return goal_tolerances(
                self._constraints, request, self._setup.joints.names, strict=True
            )
        except ToleranceError as error:
            self.context.ports.log("error", str(error))
            return self._constraints

    def _on_cancel(self, goal: GoalPort) -> bool:
        if goal is self._goal:
            self._goal = None
            self._measure()
            self._stop_moving()
            goal.cancel()
        return True

    def _on_query(self, request: Any, response: Any) -> None:
        if not self._is_active:
            response.success = False
            response.message = "Can't sample trajectory. Controller is not active."
            return
        time_ns = ns_of(request.time)
        state = self._following.state_at(time_ns)
        response.name = list(self._setup.joints.names)
        response.success = state is not None
        if state is None:
            is_late = self._following.is_begun and time_ns >= self._following.end_ns
            response.message = (
                "Requested sample time precedes the current trajectory end time."
                if is_late
                else "Requested sample time is earlier than the current trajectory start time."
            )
            position, velocity, acceleration = self._following.state.copy()
            state = JointState(position, velocity, acceleration)
        response.position, response.velocity = state.position, state.velocity
        response.acceleration = state.acceleration
