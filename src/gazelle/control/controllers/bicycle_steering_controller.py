"""``bicycle_steering_controller/BicycleSteeringController`` of ROS 2."""

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
from gazelle.parameters import ParameterTable

__all__ = ["BicycleSteeringController"]


class BicycleSteeringController(DriveController):
    """One driven and one steered wheel."""

    TABLE = ControllerTable(
        ParameterTable(
            "bicycle_steering",
            "Drives a base with one driven and one steered wheel and publishes odometry.",
            ("bicycle_steering_controller/BicycleSteeringController",),
            library_rows("traction_wheel_radius"),
        ),
        interfaces="claims velocity of the driven and position of the steered joint; reads"
        " velocity and position",
        topics=library_topics(),
        behaviour=LIBRARY_BEHAVIOUR,
    )

    def _make(self, context: ControllerContext) -> Drive:
        return SteeringDrive(context, SteeringKind.BICYCLE)
