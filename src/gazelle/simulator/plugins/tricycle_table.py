"""Names, keys and topics of the tricycle drive."""

from __future__ import annotations

from gazelle.simulator.plugins.table import Parameter, PluginTable, Topic

__all__ = ["TABLE"]

TABLE = PluginTable(
    family="tricycle_drive",
    summary="Drives and steers one front wheel; two rear wheels measure (ROS 1 and 2).",
    filenames=("gazebo_ros_tricycle_drive",),
    behaviour=(
        "`linear.x` is the speed of the driven wheel's rim, `angular.z` the steering angle, at"
        " most ±90°.",
        "Without `steeringSpeed` the steering joint is held at its angle (`SetPosition`); with it"
        " the joint turns at that rate until it is within `steeringAngleTolerance`.",
        "With `wheelAcceleration` the wheel's rate changes from the measured one by at most that"
        " much.",
        "`odometrySource` encoder counts left minus right, as both originals do.",
        "odom → base is sent with the odometry; ROS 2 sends neither unless `publish_odom`.",
    ),
    in_both_ros=True,
    topics=(
        Topic(
            "{commandTopic}", "geometry_msgs/msg/Twist", "", "", publishes=False, ros2="cmd_vel"
        ),
        Topic(
            "{odometryTopic}", "nav_msgs/msg/Odometry", "`updateRate`", "`odometryFrame`",
            ros2="odom",
        ),
        Topic("/tf", "tf2_msgs/msg/TFMessage", "`updateRate`", "`odometryFrame`, wheel parents"),
        Topic("joint_states", "sensor_msgs/msg/JointState", "`updateRate`", "none"),
    ),
    parameters=(
        Parameter("robotNamespace", "text", "", "namespace of all topics", only=1),
        Parameter("commandTopic", "text", "cmd_vel", "commands", only=1),
        Parameter("odometryTopic", "text", "odom", "odometry", only=1),
        Parameter("odometryFrame", "text", "odom", "its frame", "", ("odometry_frame",)),
        Parameter("robotBaseFrame", "text", "base_link", "child frame", "", ("robot_base_frame",)),
        Parameter(
            "steeringJoint", "text", "front_steering_joint", "steers", "", ("steering_joint",)
        ),
        Parameter(
            "actuatedWheelJoint", "text", "front_wheel_joint", "drives", "",
            ("actuated_wheel_joint",),
        ),
        Parameter(
            "encoderWheelLeftJoint", "text", "left_wheel_joint", "measures", "",
            ("encoder_wheel_left_joint",),
        ),
        Parameter(
            "encoderWheelRightJoint", "text", "right_wheel_joint", "measures", "",
            ("encoder_wheel_right_joint",),
        ),
        Parameter(
            "actuatedWheelDiameter", "number", 0.15, "of the driven wheel", "m",
            ("actuated_wheel_diameter",),
        ),
        Parameter(
            "encoderWheelDiameter", "number", 0.15, "of the measuring wheels", "m",
            ("encoder_wheel_diameter",),
        ),
        Parameter(
            "encoderWheelSeparation", "number", 0.5, "their distance", "m", ("wheel_separation",)
        ),
        Parameter(
            "wheelTorque", "number", 5.0, "largest torque of both motors; 0.15 in ROS 2", "N·m",
            ("max_wheel_torque",),
        ),
        Parameter(
            "wheelAcceleration", "number", 0.0, "of the driven wheel, 0 for unlimited", "rad/s²",
            ("max_wheel_acceleration",),
        ),
        Parameter(
            "wheelDeceleration", "number", 0.0, "by default as the acceleration", "rad/s²",
            ("max_wheel_deceleration",),
        ),
        Parameter(
            "wheelSpeedTolerance", "number", 0.01, "differences that are left alone", "rad/s",
            ("max_wheel_speed_tolerance",),
        ),
        Parameter(
            "steeringSpeed", "number", 0.0, "rate of steering, 0 for at once", "rad/s",
            ("max_steering_speed",),
        ),
        Parameter(
            "steeringAngleTolerance", "number", 0.01, "where steering by rate stops", "rad",
            ("max_steering_angle_tolerance",),
        ),
        Parameter("odometrySource", "text", "world", "world (1) or encoder (0)", "",
                  ("odometry_source",)),
        Parameter("updateRate", "number", 100.0, "update and publish rate", "Hz", ("update_rate",)),
        Parameter("publish_odom", "flag", False, "publish odometry and odom → base (ROS 2)",
                  only=2),
        Parameter("publishWheelTF", "flag", False, "publish wheel transforms", "",
                  ("publish_wheel_tf",)),
        Parameter("publishWheelJointState", "flag", False, "publish joint states", "",
                  ("publish_wheel_joint_state",)),
        Parameter("rosDebugLevel", "none", "", "Gazebo's logging level"),
        Parameter("alwaysOn", "none", "", "a model plug-in always runs"),
    ),
)  # fmt: skip
