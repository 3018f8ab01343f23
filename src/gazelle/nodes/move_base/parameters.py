"""The parameters of ``move_base`` itself and of its recovery behaviours."""

from __future__ import annotations

from gazelle.parameters import Parameter, ParameterTable, refused

__all__ = ["CLEAR", "MOVE_BASE", "ROTATE", "SLOW"]

MOVE_BASE = ParameterTable(
    "move_base",
    "Drives to goals. Plans, controls and recovers as ROS 1's node of this name.",
    ("move_base/move_base",),
    (
        Parameter(
            "base_global_planner",
            "text",
            "navfn/NavfnROS",
            "global planner, see below",
        ),
        Parameter(
            "base_local_planner",
            "text",
            "base_local_planner/TrajectoryPlannerROS",
            "local planner, see below",
        ),
        Parameter(
            "recovery_behaviors",
            "any",
            None,
            "list of {name, type}; without it conservative reset, rotate, aggressive reset, rotate",
        ),
        Parameter(
            "planner_frequency",
            "number",
            0.0,
            "how often plans are made anew while driving; 0 for only when need be",
            "Hz",
            0,
            100,
            live=True,
        ),
        Parameter(
            "controller_frequency",
            "number",
            20.0,
            "velocity commands a second",
            "Hz",
            0.1,
            1000,
            live=True,
        ),
        Parameter(
            "planner_patience",
            "number",
            5.0,
            "how long without a plan before recovering",
            "s",
            0,
            None,
            live=True,
        ),
        Parameter(
            "controller_patience",
            "number",
            15.0,
            "how long without a valid velocity before recovering",
            "s",
            0,
            None,
            live=True,
        ),
        Parameter(
            "max_planning_retries",
            "integer",
            -1,
            "how many plans may fail before recovering; −1 for no limit",
            "",
            -1,
            None,
            live=True,
        ),
        Parameter(
            "conservative_reset_dist",
            "number",
            3.0,
            "what is farther from the robot is cleared by the first recovery behaviour",
            "m",
            0,
            None,
            live=True,
        ),
        Parameter(
            "recovery_behavior_enabled",
            "flag",
            True,
            "whether anything is tried before a goal is given up",
            live=True,
        ),
        Parameter(
            "clearing_rotation_allowed",
            "flag",
            True,
            "whether the default behaviours turn on the spot",
            live=True,
        ),
        Parameter(
            "shutdown_costmaps", "flag", False, "costmaps rest while there is no goal", live=True
        ),
        Parameter(
            "oscillation_timeout",
            "number",
            0.0,
            "how long the robot may stay within oscillation_distance before recovering; 0 for ever",
            "s",
            0,
            None,
            live=True,
        ),
        Parameter(
            "oscillation_distance",
            "number",
            0.5,
            "see oscillation_timeout",
            "m",
            0,
            None,
            live=True,
        ),
        Parameter(
            "make_plan_clear_costmap",
            "flag",
            True,
            "the service make_plan clears around the start first",
            live=True,
        ),
        Parameter(
            "make_plan_add_unreachable_goal",
            "flag",
            True,
            "make_plan appends the goal asked for to a plan that ends near it",
            live=True,
        ),
        Parameter(
            "restore_defaults",
            "flag",
            False,
            "set live: go back to what the parameters were at the start",
            live=True,
        ),
        Parameter(
            "clearing_radius",
            "number",
            None,
            "radius that make_plan clears around the start; the circumscribed radius by default",
            "m",
        ),
        *refused(
            "move_base reads the frames of its costmaps from global_costmap",
            "robot_base_frame",
            "global_frame",
        ),
    ),
)

CLEAR = ParameterTable(
    "clear_costmap_recovery",
    "Forgets what the obstacle layers saw, farther than a distance from the robot.",
    ("clear_costmap_recovery/ClearCostmapRecovery",),
    (
        Parameter(
            "reset_distance",
            "number",
            3.0,
            "side of the square around the robot that is kept",
            "m",
            0,
            None,
        ),
        Parameter("invert_area_to_clear", "flag", False, "clear inside of the square instead"),
        Parameter("force_updating", "flag", False, "update the costmaps at once"),
        Parameter("affected_maps", "text", "both", "local, global or both"),
        Parameter("layer_names", "any", None, "layers that are cleared, obstacle_layer by default"),
    ),
)

ROTATE = ParameterTable(
    "rotate_recovery",
    "Turns once around on the spot.",
    ("rotate_recovery/RotateRecovery",),
    (
        Parameter(
            "sim_granularity", "number", 0.017, "step of the check for collisions", "rad", 1e-3
        ),
        Parameter("frequency", "number", 20.0, "velocity commands a second", "Hz", 0.1),
        Parameter(
            "yaw_goal_tolerance",
            "number",
            0.10,
            "of the end; read from the local planner's namespace TrajectoryPlannerROS",
            "rad",
            1e-3,
        ),
        Parameter(
            "acc_lim_th",
            "number",
            3.2,
            "angular acceleration; see yaw_goal_tolerance",
            "rad/s²",
            1e-3,
        ),
        Parameter(
            "max_rotational_vel", "number", 1.0, "fastest; see yaw_goal_tolerance", "rad/s", 1e-3
        ),
        Parameter(
            "min_in_place_rotational_vel",
            "number",
            0.4,
            "slowest; see yaw_goal_tolerance",
            "rad/s",
            1e-3,
        ),
    ),
)

SLOW = ParameterTable(
    "move_slow_and_clear",
    "Clears around the robot and limits the local planner's speed until the robot has gone on.",
    ("move_slow_and_clear/MoveSlowAndClear",),
    (
        Parameter("clearing_distance", "number", 0.5, "radius that is cleared", "m", 0, None),
        Parameter("limited_trans_speed", "number", 0.25, "speed from then on", "m/s", 0, None),
        Parameter("limited_distance", "number", 0.3, "how far the robot goes slowly", "m", 0, None),
        *refused(
            "the speed is limited in the local planner directly, whichever it is",
            "planner_namespace",
            "max_trans_param_name",
            "max_rot_param_name",
        ),
        *refused("turns keep their speed", "limited_rot_speed"),
    ),
)
