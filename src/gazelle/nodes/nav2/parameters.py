"""The parameters of Nav2's servers."""

from __future__ import annotations

from gazelle.navigation.controllers import CONTROLLERS
from gazelle.navigation.planners import PLANNERS
from gazelle.parameters import Parameter, ParameterTable, refused
from gazelle.parameters.dataclass_tables import table_of

__all__ = [
    "BEHAVIOR_SERVER",
    "BT_NAVIGATOR",
    "CONTROLLER_SERVER",
    "GOAL_CHECKERS",
    "LIFECYCLE_MANAGER",
    "PLANNER_SERVER",
    "PROGRESS_CHECKERS",
    "SMOOTHER",
    "SMOOTHER_SERVER",
    "VELOCITY_SMOOTHER",
    "WAYPOINT_FOLLOWER",
    "controller_table",
    "planner_table",
]

_BOND = refused(
    "nodes that end are seen by the graph itself", "bond_timeout", "bond_heartbeat_period"
)
_SERVICE = refused("services have one queue", "service_introspection_mode",
                   "introspection_mode", "action_server_result_timeout")  # fmt: skip


def planner_table(plugin: str) -> ParameterTable:
    """Return the parameters of a planner."""
    kind = PLANNERS[plugin]
    name = plugin.replace("::", "/").rpartition("/")[2]
    note = f" {kind.note}." if kind.note else ""
    return table_of(kind.options, name, f"Plans over the whole costmap.{note}", (plugin,))


def controller_table(plugin: str) -> ParameterTable:
    """Return the parameters of a controller; those of critics are read by the controller."""
    kind = CONTROLLERS[plugin]
    name = plugin.replace("::", "/").rpartition("/")[2]
    note = f" {kind.note}." if kind.note else ""
    made = table_of(kind.options, name, f"Drives along the path.{note}", (plugin,))
    return made.plus([Parameter("<critic>.<name>", "any", None, "parameter of a critic")])


PLANNER_SERVER = ParameterTable(
    "planner_server",
    "Plans paths over the global costmap.",
    ("nav2_planner/planner_server",),
    (
        Parameter("planner_plugins", "words", ("GridBased",), "names of planners"),
        Parameter("<planner>.plugin", "text", "nav2_navfn_planner::NavfnPlanner",
                  "a planner's type"),
        *refused("a plan over the largest maps takes a fraction of a second",
                 "expected_planner_frequency", "costmap_update_timeout"),
        *_BOND,
        *_SERVICE,
    ),
)  # fmt: skip

CONTROLLER_SERVER = ParameterTable(
    "controller_server",
    "Drives along paths in the local costmap.",
    ("nav2_controller/controller_server",),
    (
        Parameter("controller_plugins", "words", ("FollowPath",), "names of controllers"),
        Parameter("goal_checker_plugins", "words", ("goal_checker",), "names of goal checkers"),
        Parameter("progress_checker_plugins", "words", ("progress_checker",), "names of progress "
            "checkers"),
        Parameter("progress_checker_plugin", "text", "", "name of the progress checker (Galactic)"),
        Parameter("goal_checker_plugin", "text", "", "name of the goal checker (Foxy)"),
        Parameter("controller_frequency", "number", 20.0, "velocity commands a second", "Hz", 0.1,
                  1000),
        Parameter("failure_tolerance", "number", 0.0,
                  "how long there may be no velocity; −1 for ever",
            "s", -1),
        Parameter("min_x_velocity_threshold", "number", 0.0001, "slower odometry is 0", "m/s", 0),
        Parameter("min_y_velocity_threshold", "number", 0.0001, "slower odometry is 0", "m/s", 0),
        Parameter("min_theta_velocity_threshold", "number", 0.0001, "slower odometry is 0",
                  "rad/s", 0),
        Parameter("odom_topic", "text", "odom", "topic of odometry"),
        Parameter("speed_limit_topic", "text", "speed_limit", "topic of nav2_msgs/SpeedLimit"),
        Parameter("publish_zero_velocity", "flag", True, "stop at the end of a path"),
        Parameter("enable_stamped_cmd_vel", "flag", False, "send TwistStamped in place of Twist"),
        *refused("threads have the priority of the process", "use_realtime_priority"),
        *refused("costmaps are updated by a thread of their own", "costmap_update_timeout"),
        *_BOND,
        *_SERVICE,
    ),
)  # fmt: skip

_TOLERANCES = (
    Parameter("xy_goal_tolerance", "number", 0.25, "how near the goal is near enough", "m", 0),
    Parameter("yaw_goal_tolerance", "number", 0.25, "how well the direction has to fit", "rad", 0),
    Parameter("stateful", "flag", True, "once in the goal only the direction counts"),
    *refused("the path's end is the goal", "path_length_tolerance"),
)
GOAL_CHECKERS = {
    "nav2_controller::SimpleGoalChecker": ParameterTable(
        "SimpleGoalChecker", "The goal is reached in place and direction.",
        ("nav2_controller::SimpleGoalChecker",), _TOLERANCES,
    ),
    "nav2_controller::StoppedGoalChecker": ParameterTable(
        "StoppedGoalChecker", "The same, and the robot stands.",
        ("nav2_controller::StoppedGoalChecker",),
        (*_TOLERANCES,
         Parameter("trans_stopped_velocity", "number", 0.25, "below it the robot stands", "m/s", 0),
         Parameter("rot_stopped_velocity", "number", 0.25, "below it it does not turn", "rad/s",
                   0)),
    ),
}  # fmt: skip

_MOVED = (
    Parameter("required_movement_radius", "number", 0.5, "how far the robot has to get", "m", 0),
    Parameter("movement_time_allowance", "number", 10.0, "within this time", "s", 0),
)
PROGRESS_CHECKERS = {
    "nav2_controller::SimpleProgressChecker": ParameterTable(
        "SimpleProgressChecker", "The robot gets on.",
        ("nav2_controller::SimpleProgressChecker",), _MOVED,
    ),
    "nav2_controller::PoseProgressChecker": ParameterTable(
        "PoseProgressChecker", "The robot gets on, or turns.",
        ("nav2_controller::PoseProgressChecker",),
        (*_MOVED, Parameter("required_movement_angle", "number", 0.5, "or how far it has to turn",
                            "rad",
                      0)),
    ),
}  # fmt: skip

BEHAVIOR_SERVER = ParameterTable(
    "behavior_server",
    "Spin, back up, drive on, wait, assisted teleoperation; recoveries_server before Humble.",
    ("nav2_behaviors/behavior_server", "nav2_recoveries/recoveries_server"),
    (
        Parameter("local_costmap_topic", "text", "local_costmap/costmap_raw",
                  "costs to check against"),
        Parameter("costmap_topic", "text", "", "the same (before Iron)"),
        Parameter("local_footprint_topic", "text", "local_costmap/published_footprint",
                  "the outline"),
        Parameter("footprint_topic", "text", "", "the same (before Iron)"),
        Parameter("cycle_frequency", "number", 10.0, "velocity commands a second", "Hz", 0.1),
        Parameter("behavior_plugins", "words", ("spin", "backup", "drive_on_heading", "wait"),
                  "names"),
        Parameter("recovery_plugins", "words", (), "the same (before Humble)"),
        Parameter("<behavior>.plugin", "text", "", "a behaviour's type"),
        Parameter("local_frame", "text", "odom", "frame in which motions are measured"),
        Parameter("global_frame", "text", "map", "the same for behaviours that need the map"),
        Parameter("robot_base_frame", "text", "base_link", "frame of the robot"),
        Parameter("simulate_ahead_time", "number", 2.0, "how far ahead collisions are looked for",
                  "s",
            0),
        Parameter("max_rotational_vel", "number", 1.0, "fastest turn", "rad/s", 0),
        Parameter("min_rotational_vel", "number", 0.4, "slowest turn", "rad/s", 0),
        Parameter("rotational_acc_lim", "number", 3.2, "angular acceleration", "rad/s²", 0),
        Parameter("transform_tolerance", "number", 0.1, "older poses are told, and used", "s", 0),
        Parameter("enable_stamped_cmd_vel", "flag", False, "send TwistStamped in place of Twist"),
        *refused("the newest transform counts", "transform_timeout"),
        *refused("collisions are looked for in the local costmap", "global_costmap_topic",
                 "global_footprint_topic"),
        *refused("it is not there: teleoperate in place of it", "cmd_vel_teleop",
                 "projection_time", "assisted_teleop"),
        *_BOND,
        *_SERVICE,
    ),
)  # fmt: skip

BT_NAVIGATOR = ParameterTable(
    "bt_navigator",
    "Runs behaviour trees that drive to a pose or through poses.",
    ("nav2_bt_navigator/bt_navigator",),
    (
        Parameter("global_frame", "text", "map", "frame of goals"),
        Parameter("robot_base_frame", "text", "base_link", "frame of the robot"),
        Parameter("odom_topic", "text", "odom", "topic of odometry"),
        Parameter("default_nav_to_pose_bt_xml", "text", "",
                  "tree for NavigateToPose; Gazelle's own when "
            "empty"),
        Parameter("default_nav_through_poses_bt_xml", "text", "", "tree for NavigateThroughPoses"),
        Parameter("default_bt_xml_filename", "text", "", "tree for NavigateToPose (before Humble)"),
        Parameter("bt_loop_duration", "number", 10.0, "time between two ticks, wall time", "ms", 1),
        Parameter("transform_tolerance", "number", 0.1, "older poses are told, and used", "s", 0),
        Parameter("goal_reached_tol", "number", 0.25, "of the condition GoalReached", "m", 0),
        Parameter("default_server_timeout", "number", 20.0, "how long an action server may take to "
            "answer", "ms", 0),
        Parameter("wait_for_service_timeout", "number", 1000.0, "how long a server is waited for",
                  "ms",
            0),
        Parameter("navigators", "words", ("navigate_to_pose", "navigate_through_poses"), "what is "
            "offered"),
        Parameter("<navigator>.plugin", "text", "", "both are there"),
        *refused("every node of BehaviorTree.CPP and Nav2 is there", "plugin_lib_names"),
        *refused("other names than goal, goals and path are set by the trees",
                 "goal_blackboard_id", "goals_blackboard_id", "path_blackboard_id"),
        *refused("trees are shown by the log of behaviour trees", "enable_groot_monitoring",
                 "groot_zmq_publisher_port", "groot_zmq_server_port", "enable_groot_monitor"),
        *refused("codes are in the results of actions", "error_code_names",
                 "error_code_name_prefixes"),
        *refused("odometry is taken as it comes", "filter_duration"),
        *refused("there is one tree at a time", "always_reload_bt_xml",
                 "bt_search_directories"),
        *_BOND,
        *_SERVICE,
    ),
)  # fmt: skip

WAYPOINT_FOLLOWER = ParameterTable(
    "waypoint_follower",
    "Drives to one pose after another.",
    ("nav2_waypoint_follower/waypoint_follower",),
    (
        Parameter("stop_on_failure", "flag", True, "end with the first pose that is not reached"),
        Parameter("loop_rate", "number", 20.0, "how often the present goal is looked at", "Hz",
                  0.1),
        Parameter("waypoint_task_executor_plugin", "text", "wait_at_waypoint",
                  "name of what is done at "
            "each pose"),
        Parameter("<task>.plugin", "text", "nav2_waypoint_follower::WaitAtWaypoint", "its type"),
        Parameter("<task>.enabled", "flag", True, "whether it is done"),
        Parameter("<task>.waypoint_pause_duration", "number", 0.0, "how long the robot waits",
                  "ms", 0),
        *refused("goals of GPS are not there", "global_frame_id"),
        *_BOND,
        *_SERVICE,
    ),
)  # fmt: skip

SMOOTHER_SERVER = ParameterTable(
    "smoother_server",
    "Smooths paths.",
    ("nav2_smoother/smoother_server",),
    (
        Parameter("smoother_plugins", "words", ("simple_smoother",), "names of smoothers"),
        Parameter("<smoother>.plugin", "text", "nav2_smoother::SimpleSmoother",
                  "a smoother's type"),
        Parameter("costmap_topic", "text", "global_costmap/costmap_raw", "costs to check against"),
        *refused("the path's own frame counts", "robot_base_frame", "transform_tolerance",
                 "footprint_topic"),
        *_BOND,
        *_SERVICE,
    ),
)  # fmt: skip

SMOOTHER = ParameterTable(
    "SimpleSmoother",
    "Draws the points of a path to each other and to where they were.",
    ("nav2_smoother::SimpleSmoother",),
    (
        Parameter("tolerance", "number", 1e-10, "it ends when points move less", "m", 0),
        Parameter("max_its", "integer", 1000, "most rounds", "", 1),
        Parameter("w_data", "number", 0.2, "weight of the given path", "", 0),
        Parameter("w_smooth", "number", 0.3, "weight of smoothness", "", 0),
        Parameter("do_refinement", "flag", True, "smooth the result again"),
        Parameter("refinement_num", "integer", 2, "how often", "", 0),
        *refused("paths that reverse are smoothed as a whole", "enforce_path_inversion"),
    ),
)  # fmt: skip

VELOCITY_SMOOTHER = ParameterTable(
    "velocity_smoother",
    "Limits accelerations of velocity commands.",
    ("nav2_velocity_smoother/velocity_smoother",),
    (
        Parameter("smoothing_frequency", "number", 20.0, "commands a second", "Hz", 0.1),
        Parameter("scale_velocities", "flag", False, "keep the proportion of velocities"),
        Parameter("feedback", "text", "OPEN_LOOP",
                  "OPEN_LOOP: from the last command; CLOSED_LOOP: from "
            "odometry"),
        Parameter("max_velocity", "numbers", (0.5, 0.0, 2.5), "x, y, turn", "m/s, rad/s"),
        Parameter("min_velocity", "numbers", (-0.5, 0.0, -2.5), "x, y, turn", "m/s, rad/s"),
        Parameter("max_accel", "numbers", (2.5, 0.0, 3.2), "x, y, turn", "m/s², rad/s²"),
        Parameter("max_decel", "numbers", (-2.5, 0.0, -3.2), "x, y, turn", "m/s², rad/s²"),
        Parameter("deadband_velocity", "numbers", (0.0, 0.0, 0.0), "slower is 0", "m/s, rad/s"),
        Parameter("velocity_timeout", "number", 1.0,
                  "without a command for so long the robot stops",
            "s", 0),
        Parameter("odom_topic", "text", "odom", "topic of odometry"),
        Parameter("enable_stamped_cmd_vel", "flag", False, "TwistStamped in place of Twist"),
        *refused("the last message counts", "odom_duration"),
        *refused("stamps are the time of sending", "stamp_smoothed_velocity_with_smoothing_time"),
        *refused("threads have the priority of the process", "use_realtime_priority"),
        *_BOND,
        *_SERVICE,
    ),
)  # fmt: skip

LIFECYCLE_MANAGER = ParameterTable(
    "lifecycle_manager",
    "Brings managed nodes up, in order, and down again.",
    ("nav2_lifecycle_manager/lifecycle_manager",),
    (
        Parameter("node_names", "words", (), "nodes, in the order in which they come up"),
        Parameter("autostart", "flag", False, "bring them up at once"),
        Parameter("attempt_respawn_reconnection", "flag", True,
                  "bring nodes up again that come back"),
        Parameter("bond_timeout", "number", 4.0,
                  "how long a node may be away, wall time; 0 for ever",
            "s", 0),
        Parameter("bond_respawn_max_duration", "number", 10.0, "how long one is waited for", "s",
                  0),
        *refused("nodes that end are seen by the graph itself", "bond_heartbeat_period"),
        *refused("a service that does not answer is told", "service_timeout"),
        *refused("diagnostics are in the log", "diagnostics_updater"),
    ),
)  # fmt: skip
