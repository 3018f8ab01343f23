"""Rows of what MoveIt's configuration has below a group, a joint, a controller or a pipeline."""

from __future__ import annotations

from gazelle.parameters import Parameter, refused

__all__ = [
    "CARTESIAN_LIMITS",
    "CONTROLLER",
    "EXECUTION",
    "JOINT_LIMIT",
    "KINEMATICS",
    "PIPELINE",
    "keys_of",
]

KINEMATICS = (
    Parameter("kinematics_solver", "text", None, "its plug-in; Gazelle's own solver does the work"),
    Parameter("kinematics_solver_timeout", "number", 0.05, "how long a request may take", "s"),
    Parameter("kinematics_solver_ik_links", "words", (), "tips of a group that has several"),
    Parameter("position_only_ik", "flag", False, "the orientation of the tip does not matter"),
    Parameter(
        "orientation_vs_position",
        "number",
        1.0,
        "weight of an error of orientation against one of position",
        "m/rad",
    ),
    Parameter("epsilon", "number", 1e-5, "largest error of a solution", "m and rad"),
    Parameter("max_solver_iterations", "integer", 500, "steps from one seed"),
    # The Setup Assistant writes 3 and 0.005 into every file.
    *refused("there are a hundred within the time", "kinematics_solver_attempts", unless=3),
    *refused(
        "redundant joints are solved with the others",
        "kinematics_solver_search_resolution",
        unless=0.005,
    ),
    *refused(
        "redundant joints are solved with the others",
        "joints",
        "keep_constant",
        "mode",
    ),
    *refused("the solution nearest to the seed is taken", "solve_type"),
)
"""Of inverse kinematics of a group."""

JOINT_LIMIT = (
    Parameter("min_position", "number", None, "in place of the URDF's", "rad or m"),
    Parameter("max_position", "number", None, "in place of the URDF's", "rad or m"),
    *(
        row
        for quantity, unit in (("velocity", "s"), ("acceleration", "s²"), ("jerk", "s³"))
        for row in (
            Parameter(
                f"has_{quantity}_limits", "flag", None, "false: no limit, not the URDF's either"
            ),
            Parameter(
                f"max_{quantity}",
                "number",
                None,
                f"counts where `has_{quantity}_limits` is true",
                f"rad or m/{unit}",
            ),
        )
    ),
    Parameter("has_deceleration_limits", "flag", None, "Pilz' planner brakes PTP by it"),
    Parameter(
        "max_deceleration",
        "number",
        None,
        "below 0; counts where `has_deceleration_limits` is true",
        "rad or m/s²",
    ),
    *refused("`min_position` and `max_position` count without it", "has_position_limits"),
    *refused("the URDF says whether a joint turns without end", "angle_wraparound"),
    *refused("efforts have no part in planning", "has_effort_limits", "max_effort"),
)
"""Of one joint, or of one variable of a planar or floating one."""

CARTESIAN_LIMITS = (
    Parameter("max_trans_vel", "number", 1.0, "speed of the tip, of Pilz' planner", "m/s"),
    Parameter("max_trans_acc", "number", 2.25, "its acceleration", "m/s²"),
    Parameter("max_trans_dec", "number", -5.0, "its deceleration, below 0", "m/s²"),
    Parameter("max_rot_vel", "number", 1.57, "how fast it turns", "rad/s"),
)
"""Of the tip."""

EXECUTION = (
    Parameter(
        "allowed_execution_duration_scaling",
        "number",
        1.1,
        "a trajectory may take so many times its length",
    ),
    Parameter("allowed_goal_duration_margin", "number", 0.5, "and so much longer", "s"),
    Parameter(
        "allowed_start_tolerance",
        "number",
        0.01,
        "how far the robot may be from the start; 0 for any",
        "rad or m",
    ),
    Parameter(
        "allowed_start_tolerance_joints", "group", None, "the same of single joints, by name"
    ),
    Parameter(
        "execution_duration_monitoring", "flag", True, "stop a trajectory that takes too long"
    ),
    Parameter(
        "wait_for_trajectory_completion",
        "flag",
        True,
        "execution ends only when the robot stands still",
    ),
    *refused(
        "trajectories are sent as they were planned", "execution_velocity_scaling", unless=1.0
    ),
    *refused("bases are not driven", "control_multi_dof_joint_variables"),
)
"""Of the execution of trajectories."""

CONTROLLER = (
    Parameter("type", "text", "FollowJointTrajectory", "or GripperCommand"),
    Parameter("action_ns", "text", None, "its action is `<controller>/<action_ns>`"),
    Parameter("joints", "words", (), "what it moves"),
    Parameter("default", "flag", False, "preferred to others of the same joints"),
    Parameter("command_joint", "text", None, "of a gripper, the joint whose position is sent"),
    Parameter("max_effort", "number", 0.0, "of a gripper; at 0 the trajectory's", "N or N·m"),
    Parameter("parallel", "flag", False, "a gripper's positions are summed up"),
    Parameter("allow_failure", "flag", False, "an aborted goal counts as done"),
    Parameter(
        "allowed_execution_duration_scaling", "number", None, "of this one in place of the general"
    ),
    Parameter(
        "allowed_goal_duration_margin", "number", None, "of this one in place of the general", "s"
    ),
)
"""Of one controller; in ``controller_list`` a row of it has a ``name``, too."""

_SAFE = "nothing looks around while the robot moves"
_OFFERED = "what there is of them is always offered"
_SEQUENCE = "pilz_industrial_motion_planner/MoveGroupSequence"
_START = "starts outside of the limits by 0.1 rad or m are moved to them, others are refused"

PIPELINE = (
    Parameter("planning_plugins", "words", (), "OMPL's or Pilz', or one of a pip package"),
    Parameter("planning_plugin", "text", None, "the same as ROS 1 writes it"),
    Parameter("default_planner_config", "text", None, "the planner when nobody names one"),
    Parameter("planner_configs", "group", None, "planners with their `type` and parameters"),
    Parameter("request_adapters", "words", (), "they say how trajectories get their times"),
    Parameter("response_adapters", "words", (), "the same"),
    Parameter("resample_dt", "number", 0.1, "time between points of a trajectory", "s"),
    Parameter("path_tolerance", "number", 0.1, "how far corners may be rounded", "rad or m"),
    *refused(_OFFERED, "capabilities", unless=f"{_SEQUENCE}Action {_SEQUENCE}Service"),
    *refused(_OFFERED, "disable_capabilities", unless=""),
    *refused(_START, "start_state_max_bounds_error", unless=0.1),
    *refused(_START, "jiggle_fraction", "max_sampling_attempts", "start_state_max_dt"),
    *refused(_SAFE, "max_safe_path_cost"),
    *refused(
        "`resample_dt` says how close points are",
        "max_solution_segment_length",
        "min_angle_change",
        "sample_duration",
    ),
)
"""Of one planning pipeline; planning groups have a branch each beside them."""


def keys_of(rows: tuple[Parameter, ...]) -> tuple[str, ...]:
    """Return all names, also of what has no effect."""
    return tuple(row.key for row in rows)
