"""ROS 2's range_sensor_broadcaster."""

from __future__ import annotations

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.controllers.sensor_messages import sensor_indices
from gazelle.interfaces.stamps import stamped
from gazelle.parameters import Parameter, ParameterTable, Topic

__all__ = ["RangeSensorBroadcaster"]


class RangeSensorBroadcaster(Controller):
    """Publishes one range sensor at every update."""

    TABLE = ControllerTable(
        ParameterTable(
            "range_sensor_broadcaster",
            "Publishes one range sensor.",
            ("range_sensor_broadcaster/RangeSensorBroadcaster",),
            (
                Parameter("sensor_name", "text", None, "the sensor; required"),
                Parameter("frame_id", "text", None, "frame of the message; required"),
                Parameter("radiation_type", "integer", 0, "0 ultrasound, 1 infrared"),
                Parameter("field_of_view", "number", 0.52, "published as it stands", "rad"),
                Parameter("min_range", "number", 0.52, "published as it stands", "m"),
                Parameter("max_range", "number", 4.0, "published as it stands", "m"),
                Parameter("variance", "number", 0.0, "published as it stands", "m²"),
            ),
        ),
        interfaces="claims none; reads the sensor's range",
        topics=(Topic("~/range", "sensor_msgs/Range", rate="every update", frame="frame_id"),),
    )

    def __init__(self, context: ControllerContext) -> None:
        """Look up the sensor."""
        super().__init__(context)
        parameters = context.parameters
        parameters.require("sensor_name")
        parameters.require("frame_id")
        sensor, self._frame_id = parameters.text("sensor_name"), parameters.text("frame_id")
        self.states = (f"{sensor}/range",)
        self._index = int(sensor_indices(context, sensor, ("range",))[0])
        keys = ("field_of_view", "min_range", "max_range", "variance")
        self._facts = {word: parameters.number(word) for word in keys}
        self._radiation_type = parameters.integer("radiation_type")
        self._publisher = context.ports.publisher("~/range", "sensor_msgs/Range")

    def update(self, time_ns: int, period_ns: int) -> None:
        """Publish if somebody listens."""
        if not self._publisher.matched:
            return
        message = stamped("sensor_msgs/Range", time_ns, self._frame_id)
        message.radiation_type = self._radiation_type
        for word, value in self._facts.items():
            setattr(message, word, value)
        message.range = self.robot.interface_values.states.item(self._index)
        self._publisher.publish(message)
