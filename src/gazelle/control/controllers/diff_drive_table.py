"""What the documentation says about diff_drive_controller, and its defaults."""

from __future__ import annotations

from gazelle.control.table import ControllerTable
from gazelle.control.wheels.drive_parameters import command_rows, frame_rows, limit_rows
from gazelle.parameters import Parameter, ParameterTable, Topic

__all__ = ["TABLE"]

_SUMMARY = (
    "Drives a base with one or more wheels a side from a velocity command and publishes odometry."
    " The wheels of a side get the same command; odometry takes their mean."
)

_WHEELS = (
    Parameter(
        "left_wheel_names", "texts", None, "joints of the left wheels", aliases=("left_wheel",)
    ),
    Parameter(
        "right_wheel_names", "texts", None, "joints of the right wheels", aliases=("right_wheel",)
    ),
    Parameter(
        "wheel_separation",
        "number",
        None,
        "distance of left and right wheels; from the URDF when absent",
        unit="m",
    ),
    Parameter(
        "wheel_radius",
        "number",
        None,
        "radius of the wheels; from the first left wheel's collision when absent",
        unit="m",
    ),
    Parameter("wheel_separation_multiplier", "number", 1.0, "corrects the separation", live=True),
    Parameter("wheel_radius_multiplier", "number", None, "corrects both radii", ros_versions=(1,)),
    Parameter("left_wheel_radius_multiplier", "number", 1.0, "corrects the left radius", live=True),
    Parameter(
        "right_wheel_radius_multiplier", "number", 1.0, "corrects the right radius", live=True
    ),
    Parameter(
        "wheels_per_side",
        "refused",
        0,
        "the number of wheels is that of the names, as in the original",
        ros_versions=(2,),
    ),
)

_COMMANDS = (
    Parameter("cmd_vel_timeout", "number", 0.5, "how long a command holds", unit="s", live=True),
    Parameter(
        "allow_multiple_cmd_vel_publishers",
        "refused",
        True,
        "senders are not counted; all of them are heard",
        ros_versions=(1,),
    ),
    Parameter(
        "use_stamped_vel",
        "flag",
        True,
        "whether the stamp of a TwistStamped tells its age; Twist and TwistStamped are both"
        " taken on both topics anyway",
        ros_versions=(2,),
    ),
    Parameter(
        "publish_limited_velocity",
        "flag",
        False,
        "publish the command after the limits",
        aliases=("publish_cmd",),
    ),
    Parameter(
        "publish_wheel_joint_controller_state",
        "flag",
        False,
        "publish desired and actual wheel states",
        ros_versions=(1,),
    ),
    Parameter(
        "position_feedback",
        "flag",
        True,
        "odometry from positions, else from velocities",
        ros_versions=(2,),
    ),
    Parameter("publish_rate", "number", 50.0, "rate of odometry and tf", unit="Hz", live=True),
    Parameter("tf_frame_prefix_enable", "flag", True, "prefix the frames", ros_versions=(2,)),
    Parameter(
        "tf_frame_prefix",
        "text",
        "",
        "prefix of the frames; the namespace when empty, ~ stands for it",
        ros_versions=(2,),
    ),
)

TABLE = ControllerTable(
    ParameterTable(
        "diff_drive",
        _SUMMARY,
        ("diff_drive_controller/DiffDriveController",),
        (
            *_WHEELS,
            *_COMMANDS,
            *command_rows(),
            *frame_rows(diagonals=None),
            *limit_rows("linear.x", "angular.z"),
        ),
    ),
    interfaces="claims velocity of every wheel; reads position (velocity with"
    " position_feedback: false)",
    topics=(
        Topic("~/cmd_vel", "geometry_msgs/Twist", "listens", ros_versions=(1,)),
        Topic("~/cmd_vel", "geometry_msgs/TwistStamped", "listens", ros_versions=(2,)),
        Topic("~/cmd_vel_unstamped", "geometry_msgs/Twist", "listens", ros_versions=(2,)),
        Topic("~/odom", "nav_msgs/Odometry", rate="publish_rate", frame="odom_frame_id"),
        Topic("/tf", "tf2_msgs/TFMessage", rate="publish_rate", frame="odom_frame_id"),
        Topic("~/cmd_vel_out", "geometry_msgs/TwistStamped", rate="every update"),
        Topic(
            "~/wheel_joint_controller_state",
            "control_msgs/JointTrajectoryControllerState",
            rate="every update",
            ros_versions=(1,),
        ),
        Topic("~/set_parameters", "dynamic_reconfigure/Reconfigure", "service", ros_versions=(1,)),
        Topic("~/set_odometry", "control_msgs/SetOdometry", "service", ros_versions=(2,)),
    ),
    behaviour=(
        "A command older than cmd_vel_timeout counts as 0; the limits bound the braking, too."
        " In ROS 2 a timeout of 0 means that a command holds for ever.",
        "Limits act in the order jerk, acceleration, velocity. ROS 1's jerk limit lets"
        " acceleration change by 2·jerk·dt a period, so measured jerk reaches twice the parameter,"
        " and the speed swings about its target (diff_drive_controller::SpeedLimiter;"
        " control_toolbox#240).",
        "Odometry integrates arcs exactly; its velocities are means over"
        " velocity_rolling_window_size updates.",
        "Without wheel_separation or wheel_radius ROS 1 takes them from the URDF; real ROS 2"
        " would refuse to configure.",
    ),
)
