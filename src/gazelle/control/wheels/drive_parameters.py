"""Rows of parameters that the controllers of wheeled bases share."""

from __future__ import annotations

from gazelle.parameters import Parameter

__all__ = ["command_rows", "frame_rows", "limit_rows"]

_UNITS = {"linear": ("m/s", "m/s²", "m/s³"), "angular": ("rad/s", "rad/s²", "rad/s³")}


def frame_rows(
    *, diagonals: tuple[float, ...] | None, enable_tf: bool = True
) -> tuple[Parameter, ...]:
    """Return the rows of frames and covariances; `diagonals` are the covariances' default."""
    meaning = "variances of x, y, z, roll, pitch, yaw"
    return (
        Parameter("base_frame_id", "text", "base_link", "frame that moves"),
        Parameter("odom_frame_id", "text", "odom", "frame that odometry begins in"),
        Parameter("enable_odom_tf", "flag", enable_tf, "send odom → base to tf", live=True),
        Parameter("pose_covariance_diagonal", "numbers", diagonals, f"{meaning} of the pose"),
        Parameter("twist_covariance_diagonal", "numbers", diagonals, f"{meaning} of the twist"),
    )


def command_rows() -> tuple[Parameter, ...]:
    """Return the rows of how long a command holds and where velocities are averaged."""
    return (
        Parameter("open_loop", "flag", False, "odometry from commands, not from the wheels"),
        Parameter(
            "velocity_rolling_window_size",
            "integer",
            10,
            "number of updates that odometry's velocity is the mean of",
        ),
    )


def limit_rows(*axes: str) -> tuple[Parameter, ...]:
    """Return the rows of the limits of ``linear.x``, ``linear.y`` or ``angular.z``."""
    return tuple(row for axis in axes for row in _axis_rows(axis))


def _axis_rows(axis: str) -> tuple[Parameter, ...]:
    speed, acceleration, jerk = _UNITS[axis.partition(".")[0]]
    flag = "whether they act; ROS 1: false when absent, ROS 2: true when they are given"

    def row(key: str, meaning: str, unit: str, ros_versions: tuple[int, ...] = (1, 2)) -> Parameter:
        return Parameter(
            f"{axis}.{key}", "number", None, meaning, unit=unit, ros_versions=ros_versions
        )

    return (
        Parameter(f"{axis}.has_velocity_limits", "flag", None, flag),
        Parameter(f"{axis}.has_acceleration_limits", "flag", None, flag),
        Parameter(f"{axis}.has_jerk_limits", "flag", None, flag),
        row("max_velocity", "highest speed", speed),
        row("min_velocity", "lowest speed; −max_velocity when absent", speed),
        row("max_acceleration", "highest acceleration", acceleration),
        row("min_acceleration", "lowest; −max_acceleration when absent", acceleration),
        row("max_deceleration", "forward braking, ≤ 0", acceleration, (2,)),
        row("max_acceleration_reverse", "backward acceleration, ≤ 0", acceleration, (2,)),
        row("max_deceleration_reverse", "backward braking, ≥ 0", acceleration, (2,)),
        row("max_jerk", "highest jerk", jerk),
        row("min_jerk", "lowest jerk; −max_jerk when absent", jerk),
    )
