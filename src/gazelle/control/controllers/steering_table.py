"""Rows that the controllers of steering_controllers_library share."""

from __future__ import annotations

from gazelle.control.wheels.base_parameters import command_rows, frame_rows
from gazelle.parameters import Parameter, Topic

__all__ = ["LIBRARY_BEHAVIOUR", "LIBRARY_DIAGONAL", "library_rows", "library_topics"]

LIBRARY_DIAGONAL = (0.0, 7.0, 14.0, 21.0, 28.0, 35.0)
"""The original's default, which looks like places in the matrix rather than variances."""

LIBRARY_BEHAVIOUR = (
    "A reference older than reference_timeout stops the driven wheels and leaves the steering;"
    " with a timeout of 0 a reference acts for one update (steering_controllers_library).",
    "The speeds of two driven wheels fit the steering angle that is measured, or the commanded one"
    " with open_loop.",
)


def library_rows(radius_key: str) -> tuple[Parameter, ...]:
    """Return the rows of the library; `radius_key` is ``traction_wheels_radius`` or singular."""
    return (
        *_joint_rows(),
        *_radius_rows(radius_key),
        *_behaviour_rows(),
        *command_rows(),
        *frame_rows(diagonals=None),
    )


def library_topics() -> tuple[Topic, ...]:
    """Return what the library listens to and publishes."""
    stamped, plain = "geometry_msgs/TwistStamped", "geometry_msgs/Twist"
    frame, rate = "odom_frame_id", "every update"
    return (
        Topic("~/reference", stamped, "listens", generations=(2,)),
        Topic("~/reference_unstamped", plain, "listens", generations=(2,)),
        Topic("~/odometry", "nav_msgs/Odometry", rate=rate, frame=frame, generations=(2,)),
        Topic("~/tf_odometry", "tf2_msgs/TFMessage", rate=rate, frame=frame, generations=(2,)),
        Topic(
            "~/controller_state",
            "control_msgs/SteeringControllerStatus",
            rate=rate,
            generations=(2,),
        ),
        Topic("~/set_odometry", "control_msgs/SetOdometry", "service", generations=(2,)),
    )


def _row(key: str, kind: str, default: object, meaning: str, **more: object) -> Parameter:
    return Parameter(key, kind, default, meaning, generations=(2,), **more)  # type: ignore[arg-type]


def _joint_rows() -> tuple[Parameter, ...]:
    old = "up to Humble: driven with front_steering: {}, else steered"
    return (
        _row("traction_joints_names", "texts", None, "driven joints, right first"),
        _row("steering_joints_names", "texts", None, "steered joints, right first"),
        _row("traction_joints_state_names", "texts", (), "joints read instead of the driven ones"),
        _row("steering_joints_state_names", "texts", (), "joints read instead of the steered ones"),
        _row("front_steering", "flag", True, "what the names with front and rear mean"),
        _row("rear_wheels_names", "texts", None, old.format("true")),
        _row("front_wheels_names", "texts", None, old.format("false")),
        _row("rear_wheels_state_names", "texts", (), "joints read instead of the rear ones"),
        _row("front_wheels_state_names", "texts", (), "joints read instead of the front ones"),
    )


def _radius_rows(radius_key: str) -> tuple[Parameter, ...]:
    word = radius_key.removeprefix("traction_")
    return (
        _row("wheelbase", "number", None, "distance of the axles", unit="m"),
        _row(radius_key, "number", None, "radius of the driven wheels", unit="m"),
        _row(f"rear_{word}", "number", None, "up to Humble, with front_steering: true", unit="m"),
        _row(f"front_{word}", "number", None, "up to Humble, with front_steering: false", unit="m"),
    )


def _behaviour_rows() -> tuple[Parameter, ...]:
    return (
        _row("reference_timeout", "number", 1.0, "how long a reference holds", unit="s", live=True),
        _row(
            "reduce_wheel_speed_until_steering_reached",
            "flag",
            False,
            "drive slower while the steering is more than 30° from its target",
            live=True,
        ),
        _row("position_feedback", "flag", False, "odometry from positions of the driven joints"),
        _row(
            "use_stamped_vel",
            "flag",
            True,
            "whether the stamp of a TwistStamped tells its age; both types are taken anyway",
        ),
        _row("tf_frame_prefix", "text", "", "prefix of the frames, ~ stands for the namespace"),
    )
