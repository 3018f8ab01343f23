"""What the documentation says about ROS 2's trajectory controller."""

from __future__ import annotations

from gazelle.control.pid.reading import gain_rows
from gazelle.control.table import ControllerTable
from gazelle.parameters import Parameter, ParameterKind, ParameterTable, Topic

__all__ = ["ROS2_TABLE"]

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
