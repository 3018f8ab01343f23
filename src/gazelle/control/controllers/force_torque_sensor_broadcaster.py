"""ROS 2's force_torque_sensor_broadcaster."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.control.controller_parameters import ControllerTable
from gazelle.control.controllers.controller import Controller, ControllerContext
from gazelle.control.controllers.sensor_messages import WRENCH_INTERFACES, fill_wrench
from gazelle.control.errors import ControllerError
from gazelle.control.interface_values import Array, Indices
from gazelle.interfaces.stamps import stamped
from gazelle.parameters import Parameter, ParameterKind, ParameterTable, Topic

__all__ = ["ForceTorqueSensorBroadcaster"]


def _rows(
    prefix: str, kind: ParameterKind, default: object, meaning: str, live: bool
) -> tuple[Parameter, ...]:
    return tuple(
        Parameter(f"{prefix}.{word}", kind, default, meaning, live=live)
        for word in WRENCH_INTERFACES
    )


class ForceTorqueSensorBroadcaster(Controller):
    """Publishes one force-torque sensor at every update."""

    TABLE = ControllerTable(
        ParameterTable(
            "force_torque_sensor_broadcaster",
            "Publishes one force-torque sensor.",
            ("force_torque_sensor_broadcaster/ForceTorqueSensorBroadcaster",),
            (
                Parameter("frame_id", "text", None, "frame of the message; required"),
                Parameter("sensor_name", "text", "", "the sensor; or interface_names"),
                *_rows(
                    "interface_names",
                    "text",
                    "",
                    "a state interface, in place of the sensor",
                    False,
                ),
                *_rows("offset", "number", 0.0, "added to what is measured", True),
                *_rows("multiplier", "number", 1.0, "times what is measured and the offset", True),
                Parameter("sensor_filter_chain", "group", None, "filters of ~/wrench_filtered"),
            ),
        ),
        interfaces="claims none; reads forces and torques of the sensor, or the interfaces"
        " it is told",
        topics=(
            Topic("~/wrench", "geometry_msgs/WrenchStamped", rate="every update", frame="frame_id"),
        ),
        behaviour=(
            "Interfaces that are not given are published as NaN "
            "(force_torque_sensor_broadcaster.cpp).",
            "Filters are C++ plug-ins: sensor_filter_chain is reported, and ~/wrench_filtered is "
            "not offered.",
        ),
    )

    def __init__(self, context: ControllerContext) -> None:
        """Look up the sensor."""
        super().__init__(context)
        parameters = context.parameters
        parameters.require("frame_id")
        self._frame_id = parameters.text("frame_id")
        names = self._names()
        self.states = tuple(name for name in names if name)
        self._given = np.array([k for k, name in enumerate(names) if name], dtype=np.intp)
        self._indices: Indices = context.state_indices(self.states)
        self._offset = self._factors("offset")
        self._multiplier = self._factors("multiplier")
        self._publisher = context.ports.publisher("~/wrench", "geometry_msgs/WrenchStamped")
        if parameters.group("sensor_filter_chain"):
            text = "'sensor_filter_chain' names filters, which are C++ plug-ins: ~/wrench_filtered "
            text += "is not offered; ~/wrench has the unfiltered values"
            parameters.report("parameter.idle", text, key="sensor_filter_chain")

    def update(self, time_ns: int, period_ns: int) -> None:
        """Publish if somebody listens."""
        if not self._publisher.matched:
            return
        values = np.full(len(WRENCH_INTERFACES), np.nan)
        values[self._given] = self.robot.interface_values.states[self._indices]
        message = stamped("geometry_msgs/WrenchStamped", time_ns, self._frame_id)
        fill_wrench(message, (values + self._offset) * self._multiplier)
        self._publisher.publish(message)

    def changed(self, values: dict[str, Any]) -> str:
        """Take over offsets and multipliers."""
        for key, value in values.items():
            group, _, word = key.partition(".")
            factors = {"offset": self._offset, "multiplier": self._multiplier}.get(group)
            if factors is not None and word in WRENCH_INTERFACES:
                factors[WRENCH_INTERFACES.index(word)] = float(value)
        return ""

    def _factors(self, group: str) -> Array:
        number = self.context.parameters.number
        return np.array([number(f"{group}.{word}") for word in WRENCH_INTERFACES])

    def _names(self) -> list[str]:
        parameters = self.context.parameters
        sensor = parameters.text("sensor_name")
        names = [parameters.text(f"interface_names.{word}") for word in WRENCH_INTERFACES]
        key = "'interface_names.[force|torque].[x|y|z]'"
        if sensor and any(names):
            text = f"both 'sensor_name' and {key} parameters can not be specified together."
            raise ControllerError(f"{self.context.name}: {text}")
        if not sensor and not any(names):
            text = f"'sensor_name' or at least one {key} parameter has to be specified."
            raise ControllerError(f"{self.context.name}: {text}")
        return [f"{sensor}/{word}" for word in WRENCH_INTERFACES] if sensor else names
