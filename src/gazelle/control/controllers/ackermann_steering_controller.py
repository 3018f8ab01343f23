"""``ackermann_steering_controller/AckermannSteeringController`` of ROS 1 and ROS 2.

The name is the same, the controllers are not: ROS 1's drives a bicycle (one rear wheel, one front
steering joint), ROS 2's the four joints of a car.
"""

from __future__ import annotations

from gazelle.control.controllers.ackermann_drive_ros1 import ROS1_ROWS, Ros1AckermannDrive
from gazelle.control.controllers.controller import ControllerContext
from gazelle.control.controllers.drive_controller import Drive, DriveController
from gazelle.control.controllers.steering_controllers_library import (
    LIBRARY_BEHAVIOUR,
    SteeringDrive,
    SteeringKind,
    library_rows,
    library_topics,
)
from gazelle.control.table import ControllerTable
from gazelle.control.wheels.drive_parameters import limit_rows
from gazelle.parameters import Parameter, ParameterTable, Topic

__all__ = ["AckermannSteeringController"]


def _track(key: str, meaning: str) -> Parameter:
    return Parameter(key, "number", None, meaning, unit="m", ros_versions=(2,))


_TRACKS = (
    _track("traction_track_width", "distance of the driven wheels"),
    _track("steering_track_width", "distance of the steered wheels; of the driven when absent"),
    _track("rear_wheel_track", "up to Humble, with front_steering: true; both axles get it"),
    _track("front_wheel_track", "up to Humble, with front_steering: false; both axles get it"),
)
_ROS1_TOPICS = (
    Topic("~/cmd_vel", "geometry_msgs/Twist", "listens", ros_versions=(1,)),
    Topic(
        "~/odom", "nav_msgs/Odometry", rate="publish_rate", frame="odom_frame_id", ros_versions=(1,)
    ),
    Topic(
        "/tf", "tf2_msgs/TFMessage", rate="publish_rate", frame="odom_frame_id", ros_versions=(1,)
    ),
)


class AckermannSteeringController(DriveController):
    """ROS 2: two driven and two steered wheels; ROS 1: one of each."""

    TABLE = ControllerTable(
        ParameterTable(
            "ackermann_steering",
            "Drives a base with car-like steering and publishes odometry. ROS 2's takes two"
            " driven and two steered joints, ROS 1's one of each.",
            ("ackermann_steering_controller/AckermannSteeringController",),
            (
                *ROS1_ROWS,
                *library_rows("traction_wheels_radius"),
                *_TRACKS,
                *limit_rows("linear.x", "angular.z"),
            ),
        ),
        interfaces="claims velocity of the driven and position of the steered joints; reads"
        " velocity (ROS 1: position) and position",
        topics=(*_ROS1_TOPICS, *library_topics()),
        behaviour=(
            "ROS 1: angular.z of the command is the steering angle in rad, not a yaw rate, and"
            " angular.z limits bound that angle (AckermannSteeringController::update).",
            "ROS 2: joints are given right first, then left; the outer wheel runs faster and is"
            " steered less, so that all axes meet in one point. ROS 2's has no limits.",
            *LIBRARY_BEHAVIOUR,
        ),
    )

    def _make(self, context: ControllerContext) -> Drive:
        if context.ros_version == 1:
            return Ros1AckermannDrive(context)
        return SteeringDrive(context, SteeringKind.ACKERMANN)
