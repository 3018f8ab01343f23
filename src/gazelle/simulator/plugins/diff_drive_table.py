"""Names, keys and topics of the differential drives."""

from __future__ import annotations

from gazelle.simulator.plugins.table import Parameter, PluginTable, Topic

__all__ = ["GZ_TABLE", "TABLE"]

TABLE = PluginTable(
    family="diff_drive",
    summary="Drives two wheels from velocity commands and publishes odometry.",
    filenames=("gazebo_ros_diff_drive",),
    behaviour=(
        "Updates and publishes at `updateRate`; the wheels are ODE-like motors (`wheelTorque` is"
        " fmax), ramped by `wheelAcceleration` as the plug-in of ROS Kinetic does.",
        "`odometrySource` is `encoder` (or 0) for dead reckoning from the wheels' angles and"
        " `world` (or 1) for the true pose; any other word means `world`, as in Gazebo.",
        "`legacyMode` true exchanges the wheels (ROS Kinetic). Absent, the mode that turns the"
        " robot as REP 103 says is chosen from the geometry.",
        "The command topic takes `geometry_msgs/Twist` and `geometry_msgs/TwistStamped`.",
        "Wheel joint states carry positions only, as the ROS 1 plug-in's.",
    ),
    in_both_ros=True,
    topics=(
        Topic("{commandTopic}", "geometry_msgs/msg/Twist", "", "", publishes=False, ros2="cmd_vel"),
        Topic(
            "{odometryTopic}",
            "nav_msgs/msg/Odometry",
            "`updateRate`",
            "`odometryFrame`",
            ros2="odom",
        ),
        Topic("/tf", "tf2_msgs/msg/TFMessage", "`updateRate`", "`odometryFrame`, wheel parents"),
        Topic("joint_states", "sensor_msgs/msg/JointState", "`updateRate`", "none", ros2="-"),
    ),
    parameters=(
        Parameter("robotNamespace", "text", "", "namespace of all topics", only=1),
        Parameter("commandTopic", "text", "cmd_vel", "commands", "", ("command_topic",), 1),
        Parameter("odometryTopic", "text", "odom", "odometry", "", ("odometry_topic",), 1),
        Parameter("odometryFrame", "text", "odom", "its frame", "", ("odometry_frame",)),
        Parameter(
            "robotBaseFrame", "text", "base_footprint", "child frame", "", ("robot_base_frame",)
        ),
        Parameter("leftJoint", "text", "left_joint", "left wheel's joint", "", ("left_joint",)),
        Parameter("rightJoint", "text", "right_joint", "right wheel's joint", "", ("right_joint",)),
        Parameter(
            "wheelSeparation", "number", 0.34, "distance of the wheels", "m", ("wheel_separation",)
        ),
        Parameter(
            "wheelDiameter", "number", 0.15, "diameter of the wheels", "m", ("wheel_diameter",)
        ),
        Parameter(
            "wheelTorque",
            "number",
            5.0,
            "largest motor torque",
            "N·m",
            ("torque", "max_wheel_torque"),
        ),
        Parameter(
            "wheelAcceleration",
            "number",
            0.0,
            "rim acceleration, 0 for unlimited",
            "m/s²",
            ("max_wheel_acceleration",),
        ),
        Parameter("updateRate", "number", 100.0, "update and publish rate", "Hz", ("update_rate",)),
        Parameter(
            "odometrySource", "text", "world", "where odometry comes from", "", ("odometry_source",)
        ),
        Parameter(
            "publishTf",
            "flag",
            True,
            "publish odometry at all",
            "",
            ("publish_odom",),
            ros2_default=False,
        ),
        Parameter(
            "publishOdomTF",
            "flag",
            True,
            "publish odom → base",
            "",
            ("publish_odom_tf",),
            ros2_default=False,
        ),
        Parameter(
            "publishWheelTF", "flag", False, "publish wheel transforms", "", ("publish_wheel_tf",)
        ),
        Parameter("publishWheelJointState", "flag", False, "publish wheel joint states", only=1),
        Parameter("legacyMode", "flag", True, "exchange the wheels", only=1),
        Parameter("covariance_x", "number", 1e-5, "pose covariance x", "m²"),
        Parameter("covariance_y", "number", 1e-5, "pose covariance y", "m²"),
        Parameter("covariance_yaw", "number", 1e-3, "pose covariance yaw", "rad²"),
        Parameter("num_wheel_pairs", "number", 1.0, "pairs of wheels (ROS 2)", only=2),
        Parameter("rosDebugLevel", "none", "", "Gazebo's logging level"),
        Parameter("alwaysOn", "none", "", "a model plug-in always runs"),
        Parameter("broadcastTF", "none", "", "no release of the plug-in reads it"),
    ),
)

GZ_TABLE = PluginTable(
    family="gz-sim diff_drive",
    summary="The gz-sim system of the same purpose, under its own keys.",
    filenames=(
        "gz-sim-diff-drive-system",
        "ignition-gazebo-diff-drive-system",
        "gz::sim::systems::DiffDrive",
        "ignition::gazebo::systems::DiffDrive",
    ),
    behaviour=(
        "Topics keep their gz names and carry the ROS types that `ros_gz_bridge` maps them to.",
        "Odometry is dead reckoning from the wheels' angles; speeds and accelerations of the"
        " command are limited.",
    ),
    topics=(
        Topic("{topic}", "geometry_msgs/msg/Twist", "", "", publishes=False),
        Topic("{odom_topic}", "nav_msgs/msg/Odometry", "`odom_publish_frequency`", "`frame_id`"),
        Topic("{tf_topic}", "tf2_msgs/msg/TFMessage", "`odom_publish_frequency`", "`frame_id`"),
    ),
    parameters=(
        Parameter("topic", "text", "/model/{model}/cmd_vel", "commands"),
        Parameter("odom_topic", "text", "/model/{model}/odometry", "odometry"),
        Parameter("tf_topic", "text", "/model/{model}/tf", "odom → base"),
        Parameter("frame_id", "text", "{model}/odom", "frame of the odometry"),
        Parameter("child_frame_id", "text", "{model}/{link}", "child frame"),
        Parameter("left_joint", "text", "", "left wheels' joints, repeatable"),
        Parameter("right_joint", "text", "", "right wheels' joints, repeatable"),
        Parameter("wheel_separation", "number", 1.0, "distance of the wheels", "m"),
        Parameter("wheel_radius", "number", 0.2, "radius of the wheels", "m"),
        Parameter("odom_publish_frequency", "number", 50.0, "publish rate", "Hz"),
        Parameter("min_velocity", "number", -1e12, "lowest speed", "m/s", ("min_linear_velocity",)),
        Parameter("max_velocity", "number", 1e12, "highest speed", "m/s", ("max_linear_velocity",)),
        Parameter(
            "min_acceleration",
            "number",
            -1e12,
            "hardest braking",
            "m/s²",
            ("min_linear_acceleration",),
        ),
        Parameter(
            "max_acceleration",
            "number",
            1e12,
            "hardest acceleration",
            "m/s²",
            ("max_linear_acceleration",),
        ),
        Parameter("min_angular_velocity", "number", -1e12, "lowest yaw rate", "rad/s"),
        Parameter("max_angular_velocity", "number", 1e12, "highest yaw rate", "rad/s"),
        Parameter("min_angular_acceleration", "number", -1e12, "hardest turn braking", "rad/s²"),
        Parameter("max_angular_acceleration", "number", 1e12, "hardest turning", "rad/s²"),
        Parameter("min_jerk", "none", "", "jerk is not limited"),
        Parameter("max_jerk", "none", "", "jerk is not limited"),
    ),
)
