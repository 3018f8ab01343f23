"""ROS 2's gps_sensor_broadcaster."""

from __future__ import annotations

import numpy as np

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.controllers.sensor_messages import sensor_indices
from gazelle.interfaces.stamps import stamped
from gazelle.parameters import Parameter, ParameterTable, Topic

__all__ = ["GpsSensorBroadcaster"]

_AXES = ("latitude", "longitude", "altitude")
_INTERFACES = ("status", "service", *_AXES)
_DIAGONAL_KNOWN, _KNOWN = 2, 3


class GpsSensorBroadcaster(Controller):
    """Publishes one satellite receiver at every update."""

    TABLE = ControllerTable(
        ParameterTable(
            "gps_sensor_broadcaster",
            "Publishes one satellite navigation receiver.",
            ("gps_sensor_broadcaster/GPSSensorBroadcaster",),
            (
                Parameter("sensor_name", "text", None, "the sensor; required"),
                Parameter("frame_id", "text", None, "frame of the message; required"),
                Parameter(
                    "static_position_covariance",
                    "numbers",
                    (0.0,) * 9,
                    "nine values, row by row",
                    "m²",
                ),
                Parameter(
                    "read_covariance_from_interface",
                    "flag",
                    False,
                    "variances are the state interfaces latitude_covariance …",
                ),
            ),
        ),
        interfaces="claims none; reads status, service, latitude, longitude and altitude of"
        " the sensor",
        topics=(
            Topic("~/gps/fix", "sensor_msgs/NavSatFix", rate="every update", frame="frame_id"),
        ),
        behaviour=("The covariance's type is 3 (known), or 2 (diagonal known) when it is read.",),
    )

    def __init__(self, context: ControllerContext) -> None:
        """Look up the sensor."""
        super().__init__(context)
        parameters = context.parameters
        parameters.require("sensor_name")
        parameters.require("frame_id")
        sensor, self._frame_id = parameters.text("sensor_name"), parameters.text("frame_id")
        self._reads_covariance = parameters.flag("read_covariance_from_interface")
        interfaces: tuple[str, ...] = _INTERFACES
        if self._reads_covariance:
            interfaces = (*_INTERFACES, *(f"{axis}_covariance" for axis in _AXES))
        self.states = tuple(f"{sensor}/{word}" for word in interfaces)
        self._indices = sensor_indices(context, sensor, interfaces)
        covariance = np.array(parameters.numbers("static_position_covariance"))
        if len(covariance) != 9:
            text = (
                f"'static_position_covariance' has {len(covariance)} values, not 9; zeros are used"
            )
            parameters.report("parameter.bad-value", text, key="static_position_covariance")
            covariance = np.zeros(9)
        self._covariance = covariance
        self._publisher = context.ports.publisher("~/gps/fix", "sensor_msgs/NavSatFix")

    def update(self, time_ns: int, period_ns: int) -> None:
        """Publish if somebody listens."""
        if not self._publisher.matched:
            return
        values = self.robot.interface_values.states[self._indices]
        message = stamped("sensor_msgs/NavSatFix", time_ns, self._frame_id)
        status, service, *index = values[:5].tolist()
        message.status.status, message.status.service = int(status), int(service)
        message.latitude, message.longitude, message.altitude = index
        covariance = self._covariance.copy()
        if self._reads_covariance:
            covariance = np.diag(values[5:]).ravel()
        message.position_covariance = covariance
        message.position_covariance_type = _DIAGONAL_KNOWN if self._reads_covariance else _KNOWN
        self._publisher.publish(message)
