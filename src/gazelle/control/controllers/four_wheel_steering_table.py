"""What the documentation says about four_wheel_steering_controller, and its defaults."""

from __future__ import annotations

from gazelle.control.table import ControllerTable
from gazelle.control.wheels.drive_parameters import frame_rows, limit_rows
from gazelle.parameters import Parameter, ParameterKind, ParameterTable, Topic, TopicKind

__all__ = ["TABLE"]


def _row(key: str, kind: ParameterKind, default: object, meaning: str, unit: str = "") -> Parameter:
    return Parameter(key, kind, default, meaning, unit=unit, ros_versions=(1,))


def _topic(name: str, type_name: str, kind: TopicKind = "publishes", frame: str = "") -> Topic:
    rate = "publish_rate" if kind == "publishes" else ""
    return Topic(name, type_name, kind, rate=rate, frame=frame, ros_versions=(1,))


_PARAMETERS = (
    _row("front_wheel", "texts", None, "driven front joints, left and right"),
    _row("rear_wheel", "texts", None, "driven rear joints, left and right"),
    _row("front_steering", "texts", None, "front steering joints, left and right"),
    _row("rear_steering", "texts", None, "rear steering joints, left and right"),
    _row("track", "number", None, "distance of left and right wheels; from the URDF", "m"),
    _row("wheel_base", "number", None, "distance of front and rear wheels; from the URDF", "m"),
    _row("wheel_radius", "number", None, "radius of the wheels; from the URDF", "m"),
    _row(
        "wheel_steering_y_offset",
        "refused",
        None,
        "the distance of steering joint and wheel joint in the URDF counts, as in the original",
    ),
    _row("publish_rate", "number", 50.0, "rate of odometry and tf", "Hz"),
    _row("open_loop", "refused", False, "read by the original and never used"),
    _row("cmd_vel_timeout", "number", 0.5, "how long a command holds", "s"),
    _row(
        "velocity_rolling_window_size",
        "integer",
        10,
        "number of updates that acceleration, jerk and steering rates are means of",
    ),
)

TABLE = ControllerTable(
    ParameterTable(
        "four_wheel_steering",
        "Drives a base that steers front and rear wheels and publishes odometry.",
        ("four_wheel_steering_controller/FourWheelSteeringController",),
        (
            *_PARAMETERS,
            *frame_rows(diagonals=None),
            *limit_rows("linear.x", "angular.z"),
        ),
    ),
    interfaces="claims and reads velocity of four driven and position of four steering joints",
    topics=(
        _topic("~/cmd_vel", "geometry_msgs/Twist", "listens"),
        _topic(
            "~/cmd_four_wheel_steering", "four_wheel_steering_msgs/FourWheelSteering", "listens"
        ),
        _topic("~/odom", "nav_msgs/Odometry", frame="odom_frame_id"),
        _topic("~/odom_steer", "four_wheel_steering_msgs/FourWheelSteeringStamped"),
        _topic("/tf", "tf2_msgs/TFMessage", frame="odom_frame_id"),
    ),
    behaviour=(
        "The newer of the two commands counts; a twist steers the rear wheels against the front"
        " ones by the same angles.",
        "Below 1 mm/s no wheel is driven.",
        "The wheels' offset from their steering axes is taken off on both sides alike; the"
        " original takes it off with one sign, so its odometry of such robots differs in curves.",
        "Accelerations and steering rates in odom_steer are positive while the value grows; the"
        " original's have the other sign.",
    ),
)
