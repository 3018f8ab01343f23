"""Names, keys and topics of the differential drives."""

from __future__ import annotations

from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.drive_rows import (
    ALWAYS_ON,
    COMMAND_TOPIC,
    DEBUG_LEVEL,
    GZ_COMMANDS,
    GZ_NO_JERK,
    GZ_ODOMETRY,
    GZ_RATE,
    GZ_SEPARATION,
    GZ_SIDES,
    GZ_TOPICS,
    GZ_WHEEL_RADIUS,
    UPDATE_RATE,
    WHEEL_TF,
    covariances,
    frames,
    odometry_topics,
    topics,
)
from gazelle.simulator.plugins.table import PluginTable

__all__ = ["GZ_TABLE", "TABLE"]

TABLE = PluginTable(
    ParameterTable(
        "diff_drive",
        "Drives two wheels from velocity commands and publishes odometry.",
        ("gazebo_ros_diff_drive",),
        (
            *topics(has_aliases=True),
            *frames("base_footprint"),
            Parameter(
                "leftJoint", "text", "left_joint", "left wheel's joint", "", aliases=("left_joint",)
            ),
            Parameter(
                "rightJoint",
                "text",
                "right_joint",
                "right wheel's joint",
                "",
                aliases=("right_joint",),
            ),
            Parameter(
                "wheelSeparation",
                "number",
                0.34,
                "distance of the wheels",
                "m",
                aliases=("wheel_separation",),
            ),
            Parameter(
                "wheelDiameter",
                "number",
                0.15,
                "diameter of the wheels",
                "m",
                aliases=("wheel_diameter",),
            ),
            Parameter(
                "wheelTorque",
                "number",
                5.0,
                "largest motor torque",
                "N·m",
                aliases=("torque", "max_wheel_torque"),
            ),
            Parameter(
                "wheelAcceleration",
                "number",
                0.0,
                "rim acceleration, 0 for unlimited",
                "m/s²",
                aliases=("max_wheel_acceleration",),
            ),
            UPDATE_RATE,
            Parameter(
                "odometrySource",
                "text",
                "world",
                "where odometry comes from",
                "",
                aliases=("odometry_source",),
            ),
            Parameter(
                "publishTf",
                "flag",
                True,
                "publish odometry at all",
                "",
                aliases=("publish_odom",),
                ros2_default=False,
            ),
            Parameter(
                "publishOdomTF",
                "flag",
                True,
                "publish odom → base",
                "",
                aliases=("publish_odom_tf",),
                ros2_default=False,
            ),
            WHEEL_TF,
            Parameter(
                "publishWheelJointState",
                "flag",
                False,
                "publish wheel joint states",
                generations=(1,),
            ),
            Parameter("legacyMode", "flag", True, "exchange the wheels", generations=(1,)),
            *covariances(1e-5, 1e-3, "pose covariance {}"),
            Parameter(
                "num_wheel_pairs", "number", 1.0, "pairs of wheels (ROS 2)", generations=(2,)
            ),
            DEBUG_LEVEL,
            ALWAYS_ON,
            Parameter("broadcastTF", "refused", "", "no release of the plug-in reads it"),
        ),
    ),
    topics=(
        COMMAND_TOPIC,
        *odometry_topics("updateRate", tf_frame="`odometryFrame`, wheel parents"),
        Topic(
            "joint_states",
            "sensor_msgs/msg/JointState",
            rate="`updateRate`",
            frame="none",
            generations=(1,),
        ),
    ),
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
)

GZ_TABLE = PluginTable(
    ParameterTable(
        "gz-sim diff_drive",
        "The gz-sim system of the same purpose, under its own keys.",
        (
            "gz-sim-diff-drive-system",
            "ignition-gazebo-diff-drive-system",
            "gz::sim::systems::DiffDrive",
            "ignition::gazebo::systems::DiffDrive",
        ),
        (
            Parameter("topic", "text", "/model/{model}/cmd_vel", "commands"),
            *GZ_ODOMETRY,
            *GZ_SIDES,
            GZ_SEPARATION,
            GZ_WHEEL_RADIUS,
            GZ_RATE,
            Parameter(
                "min_velocity",
                "number",
                -1e12,
                "lowest speed",
                "m/s",
                aliases=("min_linear_velocity",),
            ),
            Parameter(
                "max_velocity",
                "number",
                1e12,
                "highest speed",
                "m/s",
                aliases=("max_linear_velocity",),
            ),
            Parameter(
                "min_acceleration",
                "number",
                -1e12,
                "hardest braking",
                "m/s²",
                aliases=("min_linear_acceleration",),
            ),
            Parameter(
                "max_acceleration",
                "number",
                1e12,
                "hardest acceleration",
                "m/s²",
                aliases=("max_linear_acceleration",),
            ),
            Parameter("min_angular_velocity", "number", -1e12, "lowest yaw rate", "rad/s"),
            Parameter("max_angular_velocity", "number", 1e12, "highest yaw rate", "rad/s"),
            Parameter(
                "min_angular_acceleration", "number", -1e12, "hardest turn braking", "rad/s²"
            ),
            Parameter("max_angular_acceleration", "number", 1e12, "hardest turning", "rad/s²"),
            *GZ_NO_JERK,
        ),
    ),
    topics=(
        GZ_COMMANDS,
        *GZ_TOPICS,
    ),
    behaviour=(
        "Topics keep their gz names and carry the ROS types that `ros_gz_bridge` maps them to.",
        "Odometry is dead reckoning from the wheels' angles; speeds and accelerations of the"
        " command are limited.",
    ),
)
