"""What the documentation says about mecanum_drive_controller, and its defaults."""

from __future__ import annotations

from gazelle.control.table import ControllerTable
from gazelle.control.wheels.drive_parameters import frame_rows, limit_rows
from gazelle.parameters import Parameter, ParameterKind, ParameterTable, Topic

__all__ = ["TABLE", "WHEELS"]

WHEELS = ("front_left", "front_right", "rear_right", "rear_left")
"""The wheels in the original's order."""


def _row(
    key: str,
    kind: ParameterKind,
    default: object,
    meaning: str,
    unit: str = "",
    *,
    live: bool = False,
) -> Parameter:
    return Parameter(key, kind, default, meaning, unit=unit, live=live)


_JOINTS = tuple(
    row
    for wheel in WHEELS
    for row in (
        _row(f"{wheel}_wheel_command_joint_name", "text", None, "joint that is driven"),
        _row(f"{wheel}_wheel_state_joint_name", "text", "", "joint read instead"),
    )
)
_SUM = "kinematics.sum_of_robot_center_projection_on_X_Y_axis"
_OFFSET = "pose of the base frame in the frame of the wheels' centre"
_REST = (
    _row("kinematics.wheels_radius", "number", None, "radius of the wheels", "m"),
    _row(_SUM, "number", None, "half the length plus half the width between the wheels", "m"),
    _row("kinematics.base_frame_offset.x", "number", 0.0, _OFFSET, "m"),
    _row("kinematics.base_frame_offset.y", "number", 0.0, _OFFSET, "m"),
    _row("kinematics.base_frame_offset.theta", "number", 0.0, _OFFSET, "rad"),
    _row(
        "reference_timeout",
        "number",
        0.0,
        "how long a reference holds; with 0 it acts for one update",
        "s",
        live=True,
    ),
    _row(
        "use_stamped_vel",
        "flag",
        True,
        "whether the stamp of a TwistStamped tells its age; both types are taken anyway",
    ),
    _row("tf_frame_prefix_enable", "flag", True, "prefix the frames"),
    _row("tf_frame_prefix", "text", "", "prefix of the frames; the namespace when empty"),
)

TABLE = ControllerTable(
    ParameterTable(
        "mecanum_drive",
        "Drives a base on four mecanum wheels and publishes odometry.",
        ("mecanum_drive_controller/MecanumDriveController",),
        (
            *_JOINTS,
            *_REST,
            *frame_rows(diagonals=(0.1,) * 6),
            *limit_rows("linear.x", "linear.y", "angular.z"),
        ),
    ),
    interfaces="claims and reads velocity of four joints",
    topics=(
        Topic("~/reference", "geometry_msgs/TwistStamped", "listens"),
        Topic("~/reference_unstamped", "geometry_msgs/Twist", "listens"),
        Topic("~/odometry", "nav_msgs/Odometry", rate="every update", frame="odom_frame_id"),
        Topic("~/tf_odometry", "tf2_msgs/TFMessage", rate="every update", frame="odom_frame_id"),
        Topic(
            "~/controller_state", "control_msgs/MecanumDriveControllerState", rate="every update"
        ),
        Topic("~/set_odometry", "control_msgs/SetOdometry", "service"),
    ),
    behaviour=(
        "Without a reference that holds the wheels are commanded 0 at once, without limits.",
        "Odometry integrates arcs exactly; the original takes Euler's first-order step.",
    ),
)
