"""``tricycle_steering_controller/TricycleSteeringController`` of ROS 2."""

from __future__ import annotations

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import ControllerContext
from gazelle.control.controllers.drive_controller_base import Drive, DriveController
from gazelle.control.controllers.steering_controllers_library import (
    LIBRARY_BEHAVIOUR,
    SteeringDrive,
    SteeringKind,
    library_rows,
    library_topics,
)
from gazelle.parameters import Parameter, ParameterTable

__all__ = ["TricycleSteeringController"]


class TricycleSteeringController(DriveController):
    """Two driven wheels and one steered wheel."""

    TABLE = ControllerTable(
        ParameterTable(
            "tricycle_steering",
            "Drives a base with two driven wheels and one steered wheel, and publishes odometry.",
            ("tricycle_steering_controller/TricycleSteeringController",),
            (
                *library_rows("traction_wheels_radius"),
                Parameter(
                    "traction_track_width",
                    "number",
                    None,
                    "distance of the driven wheels",
                    unit="m",
                    aliases=("wheel_track",),
                ),
            ),
        ),
        interfaces="claims velocity of the driven and position of the steered joint; reads"
        " velocity and position",
        topics=library_topics(),
        behaviour=LIBRARY_BEHAVIOUR,
    )

    def _make(self, context: ControllerContext) -> Drive:
        return SteeringDrive(context, SteeringKind.TRICYCLE)
