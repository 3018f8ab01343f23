"""What the documentation says about ROS 1's trajectory controllers."""

from __future__ import annotations

from gazelle.control.pid.reading import gain_rows
from gazelle.control.table import ControllerTable
from gazelle.parameters import Parameter, ParameterKind, ParameterTable, Topic

__all__ = ["ROS1_TABLE"]

_FAMILIES = ("position", "velocity", "effort", "pos_vel", "pos_vel_acc")
_ROS1 = (1,)


def _row(key: str, kind: ParameterKind, default: object, meaning: str, unit: str = "") -> Parameter:
    return Parameter(key, kind, default, meaning, unit, generations=_ROS1)


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
        Topic("~/command", "trajectory_msgs/JointTrajectory", "listens", generations=_ROS1),
        Topic(
            "~/state",
            "control_msgs/JointTrajectoryControllerState",
            rate="state_publish_rate",
            generations=_ROS1,
        ),
        Topic("~/query_state", "control_msgs/QueryTrajectoryState", "service", generations=_ROS1),
        Topic(
            "~/follow_joint_trajectory",
            "control_msgs/FollowJointTrajectory",
            "action",
            "feedback at action_monitor_rate",
            generations=_ROS1,
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
