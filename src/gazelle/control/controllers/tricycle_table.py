"""What the documentation says about tricycle_controller, its defaults and its limits."""

from __future__ import annotations

import math

from gazelle.control.errors import ControllerError
from gazelle.control.table import ControllerTable
from gazelle.control.wheels.drive_parameters import command_rows, frame_rows
from gazelle.control.wheels.speed_limiter import TractionLimits
from gazelle.parameters import Parameter, ParameterKind, ParameterTable, Topic
from gazelle.parameters.reader import ParameterReader

__all__ = ["TABLE", "read_steering_limits", "read_traction_limits"]

# The original's bound where only the lower one is given.
_MAX = 1000.0


def _row(key: str, kind: ParameterKind, default: object, meaning: str, unit: str = "") -> Parameter:
    return Parameter(key, kind, default, meaning, unit=unit, ros_versions=(2,))


def _bounds(group: str, units: dict[str, str]) -> tuple[Parameter, ...]:
    meaning = "limit of the magnitude, in both directions; none when absent or NaN"
    return tuple(
        _row(f"{group}.{side}_{word}", "number", None, meaning, unit)
        for word, unit in units.items()
        for side in ("max", "min")
    )


_PARAMETERS = (
    _row("traction_joint_name", "text", None, "joint that drives"),
    _row("steering_joint_name", "text", None, "joint that steers"),
    _row("wheelbase", "number", None, "distance of the wheel from the rear axle", "m"),
    _row("wheel_radius", "number", None, "radius of the wheel", "m"),
    _row("odom_only_twist", "flag", False, "leave the pose in odometry at its default"),
    _row("cmd_vel_timeout", "integer", 500, "how long a command holds", "ms"),
    _row("publish_ackermann_command", "flag", False, "publish the wheel's command"),
    _row(
        "use_stamped_vel",
        "flag",
        True,
        "whether ~/cmd_vel is announced as TwistStamped, not Twist, and a stamp tells the age;"
        " both types are taken anyway",
    ),
    _row("tf_frame_prefix", "text", "", "prefix of the frames, ~ stands for the namespace"),
)
_TRACTION_UNITS = {
    "velocity": "rad/s",
    "acceleration": "rad/s²",
    "deceleration": "rad/s²",
    "jerk": "rad/s³",
}
_STEERING_UNITS = {"position": "rad", "velocity": "rad/s", "acceleration": "rad/s²"}

TABLE = ControllerTable(
    ParameterTable(
        "tricycle",
        "Drives a base with one wheel that is driven and steered, and publishes odometry.",
        ("tricycle_controller/TricycleController",),
        (
            *_PARAMETERS,
            *command_rows(),
            *frame_rows(diagonals=(0.0,) * 6, enable_tf=False),
            *_bounds("traction", _TRACTION_UNITS),
            *_bounds("steering", _STEERING_UNITS),
        ),
    ),
    interfaces="claims and reads velocity of the driven and position of the steered joint",
    topics=(
        Topic("~/cmd_vel", "geometry_msgs/TwistStamped", "listens", ros_versions=(2,)),
        Topic("~/odom", "nav_msgs/Odometry", rate="every update", frame="odom_frame_id"),
        Topic("/tf", "tf2_msgs/TFMessage", rate="every update", frame="odom_frame_id"),
        Topic("~/cmd_ackermann", "ackermann_msgs/AckermannDrive", rate="every update"),
        Topic("~/reset_odometry", "std_srvs/Empty", "service"),
    ),
    behaviour=(
        "A command without linear.x steers to ±90° and turns about the middle of the rear axle.",
        "While the steering is more than 30° from its target the wheel gets the cosine of the"
        " error of its speed, and a hundredth beyond 90° (TricycleController::update).",
        "Jerk and steering acceleration may reach twice their limits, as the original's"
        " 2·limit·dt² allows.",
    ),
)


def read_traction_limits(parameters: ParameterReader) -> TractionLimits:
    """Read the limits of the driven joint.

    Raises:
        ControllerError: a limit is negative or a lower one above its upper one.
    """
    words = ("velocity", "acceleration", "deceleration", "jerk")
    velocity, increase, decrease, bend = (_read(parameters, f"traction.{w}") for w in words)
    # The original does not limit braking unless acceleration is limited.
    if increase is None:
        return TractionLimits(velocity, None, None, bend)
    return TractionLimits(velocity, increase, decrease, bend)


def read_steering_limits(parameters: ParameterReader) -> TractionLimits:
    """Read the limits of the steered joint.

    Raises:
        ControllerError: a limit is negative or a lower one above its upper one.
    """
    lowest, highest = _ends(parameters, "steering.position")
    between = None
    if not (math.isnan(lowest) and math.isnan(highest)):
        lowest = -highest if math.isnan(lowest) else lowest
        between = (lowest, -lowest if math.isnan(highest) else highest)
    rate, bend = (_read(parameters, f"steering.{word}") for word in ("velocity", "acceleration"))
    return TractionLimits(increase=rate, decrease=rate, bend=bend, between=between)


def _ends(parameters: ParameterReader, name: str) -> tuple[float, float]:
    group, _, word = name.partition(".")
    return (
        parameters.number(f"{group}.min_{word}", math.nan),
        parameters.number(f"{group}.max_{word}", math.nan),
    )


def _read(parameters: ParameterReader, name: str) -> tuple[float, float] | None:
    lowest, highest = _ends(parameters, name)
    if math.isnan(lowest) and math.isnan(highest):
        return None
    lowest = 0.0 if math.isnan(lowest) else lowest
    highest = _MAX if math.isnan(highest) else highest
    if lowest < 0 or highest < 0 or lowest > highest:
        text = f"controller '{parameters.name}': limits of {name} are {lowest:g} and {highest:g};"
        text += " they bound a magnitude in both directions, so 0 ≤ min ≤ max"
        raise ControllerError(
            text + " (Setting different limits for positive and negative"
            " directions is not supported)"
        )
    return lowest, highest
