"""Names, keys and topics of the cars."""

from __future__ import annotations

from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.drive_rows import (
    GZ_COMMANDS,
    GZ_NO_JERK,
    GZ_ODOMETRY,
    GZ_RATE,
    GZ_SEPARATION,
    GZ_SIDES,
    GZ_TOPICS,
    GZ_WHEEL_RADIUS,
    covariances,
)
from gazelle.simulator.plugins.table import PluginTable

__all__ = ["GZ_TABLE", "TABLE"]

_NO_GAIN = (0.0, 0.0, 0.0)

TABLE = PluginTable(
    ParameterTable(
        "ackermann_drive",
        "Steers the front wheels and drives the rear wheels of a car with PIDs (ROS 2).",
        ("gazebo_ros_ackermann_drive",),
        (
            Parameter("front_right_joint", "text", "front_right_joint", "a wheel's joint"),
            Parameter("front_left_joint", "text", "front_left_joint", "a wheel's joint"),
            Parameter("rear_right_joint", "text", "rear_right_joint", "a driven wheel's joint"),
            Parameter("rear_left_joint", "text", "rear_left_joint", "a driven wheel's joint"),
            Parameter(
                "right_steering_joint", "text", "right_steering_joint", "steers the right wheel"
            ),
            Parameter(
                "left_steering_joint", "text", "left_steering_joint", "steers the left wheel"
            ),
            Parameter("steering_wheel_joint", "text", "steering_wheel_joint", "the driver's wheel"),
            Parameter("max_speed", "number", 20.0, "speed limit", "m/s"),
            Parameter("max_steer", "number", 0.6, "limit of the steering angle", "rad"),
            Parameter("max_steering_angle", "number", 7.85, "the driver's wheel at it", "rad"),
            Parameter("right_steering_pid_gain", "vector", _NO_GAIN, "p, i, d"),
            Parameter("right_steering_i_range", "text", "0 0", "bounds of the integral"),
            Parameter("left_steering_pid_gain", "vector", _NO_GAIN, "p, i, d"),
            Parameter("left_steering_i_range", "text", "0 0", "bounds of the integral"),
            Parameter("linear_velocity_pid_gain", "vector", _NO_GAIN, "p, i, d"),
            Parameter("linear_velocity_i_range", "text", "0 0", "bounds of the integral"),
            Parameter("update_rate", "number", 100.0, "update and publish rate", "Hz"),
            Parameter("odometry_frame", "text", "odom", "frame of the odometry"),
            Parameter("robot_base_frame", "text", "base_footprint", "child frame"),
            Parameter("publish_odom", "flag", False, "publish odometry"),
            Parameter("publish_odom_tf", "flag", False, "publish odom → base"),
            Parameter("publish_wheel_tf", "flag", False, "publish base → wheels"),
            Parameter("publish_distance", "flag", False, "publish the distance driven"),
            Parameter("publish_steerangle", "flag", False, "publish the mean steering angle"),
            *covariances(1e-5, 1e-3),
        ),
    ),
    topics=(
        Topic("cmd_vel", "geometry_msgs/msg/Twist", kind="listens"),
        Topic("odom", "nav_msgs/msg/Odometry", rate="`update_rate`", frame="`odometry_frame`"),
        Topic("distance", "std_msgs/msg/Float32", rate="`update_rate`"),
        Topic("steerangle", "std_msgs/msg/Float32", rate="`update_rate`"),
        Topic(
            "/tf",
            "tf2_msgs/msg/TFMessage",
            rate="`update_rate`",
            frame="`odometry_frame`, wheels: the base",
        ),
    ),
    behaviour=(
        "`linear.x` is the speed, `angular.z` the steering angle of the middle front wheel, with"
        " the sign of the speed; the wheels' own angles meet in one turning centre.",
        "Wheel radius, track and wheelbase are measured at the joints and the rear right wheel's"
        " collision.",
        "The PIDs are Gazebo's: their effort acts for one physics step of a period. The engine"
        " applies the same impulse evenly over the period.",
        "Odometry is the true pose and velocity.",
        "A `steering_wheel_joint` that is there turns with the wheels, over the steering ratio.",
    ),
)

GZ_TABLE = PluginTable(
    ParameterTable(
        "gz-sim ackermann steering",
        "The gz-sim car: wheel speeds and steering angles from a Twist or an angle.",
        (
            "gz-sim-ackermann-steering-system",
            "ignition-gazebo-ackermann-steering-system",
            "gz::sim::systems::AckermannSteering",
            "ignition::gazebo::systems::AckermannSteering",
        ),
        (
            Parameter("topic", "text", "", "commands, by default /model/M/cmd_vel"),
            Parameter("sub_topic", "text", "", "the same, below /model/M"),
            *GZ_ODOMETRY,
            *GZ_SIDES,
            Parameter("left_steering_joint", "text", "", "left steering joints, repeatable"),
            Parameter("right_steering_joint", "text", "", "right steering joints, repeatable"),
            GZ_SEPARATION,
            Parameter("kingpin_width", "number", 0.8, "distance of the steering axes", "m"),
            Parameter("wheel_base", "number", 1.0, "distance of the axles", "m"),
            GZ_WHEEL_RADIUS,
            Parameter("steering_limit", "number", 0.5, "largest steering angle", "rad"),
            Parameter("steer_p_gain", "number", 1.0, "steering rate per error", "1/s"),
            Parameter("steering_only", "flag", False, "only steer, from an angle"),
            GZ_RATE,
            Parameter("min_velocity", "number", -1e12, "lowest speed and turn rate", "m/s, rad/s"),
            Parameter("max_velocity", "number", 1e12, "highest speed and turn rate", "m/s, rad/s"),
            Parameter("min_acceleration", "number", -1e12, "hardest braking", "m/s²"),
            Parameter("max_acceleration", "number", 1e12, "hardest acceleration", "m/s²"),
            *GZ_NO_JERK,
            Parameter("use_actuator_msg", "refused", "", "there is no actuators message in ROS"),
            Parameter("actuator_number", "refused", "", "there is no actuators message in ROS"),
        ),
    ),
    topics=(
        GZ_COMMANDS,
        Topic("/model/M/steer_angle", "std_msgs/msg/Float64", kind="listens"),
        *GZ_TOPICS,
    ),
    behaviour=(
        "The turning radius is v/ω, at least `wheel_base`/sin(`steering_limit`); the steering"
        " joints turn with `steer_p_gain` times their error.",
        "Odometry is dead reckoning from wheels and steering.",
        "With `steering_only` the topic carries an angle and wheels are left alone.",
        "Topics keep their gz names and carry the ROS types that `ros_gz_bridge` maps them to.",
    ),
)
