"""The services that put odometry somewhere else."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.control.ports import Ports
from gazelle.control.wheels.odometry import PlanarOdometry, PlanarPose

__all__ = ["offer_reset_odometry", "offer_set_odometry"]


def offer_set_odometry(
    ports: Ports, odometry: PlanarOdometry, is_active: Callable[[], bool]
) -> None:
    """Offer ``~/set_odometry`` of ros2_controllers."""

    def handle(request: Any, response: Any) -> None:
        response.success = is_active()
        if response.success:
            odometry.put(PlanarPose(float(request.x), float(request.y), float(request.yaw)))
            response.message = "Odometry set request accepted"
        else:
            response.message = "Controller is not active"

    ports.service("~/set_odometry", "control_msgs/SetOdometry", handle)


def offer_reset_odometry(ports: Ports, odometry: PlanarOdometry) -> None:
    """Offer ``~/reset_odometry`` of tricycle_controller."""

    def handle(request: Any, response: Any) -> None:
        odometry.put(PlanarPose())

    ports.service("~/reset_odometry", "std_srvs/Empty", handle)
