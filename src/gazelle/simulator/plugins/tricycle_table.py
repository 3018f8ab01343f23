"""Names, keys and topics of the tricycle drive."""

from __future__ import annotations

from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.drive_rows import (
    ALWAYS_ON,
    COMMAND_TOPIC,
    DEBUG_LEVEL,
    UPDATE_RATE,
    WHEEL_TF,
    frames,
    odometry_topics,
    topics,
)
from gazelle.simulator.plugins.table import PluginTable

__all__ = ["TABLE"]

TABLE = PluginTable(
    ParameterTable(
        "tricycle_drive",
        "Drives and steers one front wheel; two rear wheels measure (ROS 1 and 2).",
        ("gazebo_ros_tricycle_drive",),
        (
            *topics(),
            *frames("base_link"),
            Parameter(
                "steeringJoint",
                "text",
                "front_steering_joint",
                "steers",
                "",
                aliases=("steering_joint",),
            ),
            Parameter(
                "actuatedWheelJoint",
                "text",
                "front_wheel_joint",
                "drives",
                "",
                aliases=("actuated_wheel_joint",),
            ),
            Parameter(
                "encoderWheelLeftJoint",
                "text",
                "left_wheel_joint",
                "measures",
                "",
                aliases=("encoder_wheel_left_joint",),
            ),
            Parameter(
                "encoderWheelRightJoint",
                "text",
                "right_wheel_joint",
                "measures",
                "",
                aliases=("encoder_wheel_right_joint",),
            ),
            Parameter(
                "actuatedWheelDiameter",
                "number",
                0.15,
                "of the driven wheel",
                "m",
                aliases=("actuated_wheel_diameter",),
            ),
            Parameter(
                "encoderWheelDiameter",
                "number",
                0.15,
                "of the measuring wheels",
                "m",
                aliases=("encoder_wheel_diameter",),
            ),
            Parameter(
                "encoderWheelSeparation",
                "number",
                0.5,
                "their distance",
                "m",
                aliases=("wheel_separation",),
            ),
            Parameter(
                "wheelTorque",
                "number",
                5.0,
                "largest torque of both motors; 0.15 in ROS 2",
                "N·m",
                aliases=("max_wheel_torque",),
            ),
            Parameter(
                "wheelAcceleration",
                "number",
                0.0,
                "of the driven wheel, 0 for unlimited",
                "rad/s²",
                aliases=("max_wheel_acceleration",),
            ),
            Parameter(
                "wheelDeceleration",
                "number",
                0.0,
                "by default as the acceleration",
                "rad/s²",
                aliases=("max_wheel_deceleration",),
            ),
            Parameter(
                "wheelSpeedTolerance",
                "number",
                0.01,
                "differences that are left alone",
                "rad/s",
                aliases=("max_wheel_speed_tolerance",),
            ),
            Parameter(
                "steeringSpeed",
                "number",
                0.0,
                "rate of steering, 0 for at once",
                "rad/s",
                aliases=("max_steering_speed",),
            ),
            Parameter(
                "steeringAngleTolerance",
                "number",
                0.01,
                "where steering by rate stops",
                "rad",
                aliases=("max_steering_angle_tolerance",),
            ),
            Parameter(
                "odometrySource",
                "text",
                "world",
                "world (1) or encoder (0)",
                "",
                aliases=("odometry_source",),
            ),
            UPDATE_RATE,
            Parameter(
                "publish_odom",
                "flag",
                False,
                "publish odometry and odom → base (ROS 2)",
                generations=(2,),
            ),
            WHEEL_TF,
            Parameter(
                "publishWheelJointState",
                "flag",
                False,
                "publish joint states",
                "",
                aliases=("publish_wheel_joint_state",),
            ),
            DEBUG_LEVEL,
            ALWAYS_ON,
        ),
    ),
    topics=(
        COMMAND_TOPIC,
        *odometry_topics("updateRate", tf_frame="`odometryFrame`, wheel parents"),
        Topic("joint_states", "sensor_msgs/msg/JointState", rate="`updateRate`", frame="none"),
    ),
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
)
