"""States of sensors among those of the joints."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple, Protocol

from gazelle.control.hardware.ros2_tags import InterfaceTag, PartTag
from gazelle.control.interface_values import InterfaceValues
from gazelle.diagnostics import Diagnostics, SourceSpan, did_you_mean

__all__ = [
    "FORCE_TORQUE_STATES",
    "IMU_STATES",
    "SensorReadout",
    "SensorSource",
    "SensorStates",
    "sensor_parts",
]

_NOWHERE = SourceSpan("<sensor>")

IMU_STATES = (
    "orientation.x",
    "orientation.y",
    "orientation.z",
    "orientation.w",
    "angular_velocity.x",
    "angular_velocity.y",
    "angular_velocity.z",
    "linear_acceleration.x",
    "linear_acceleration.y",
    "linear_acceleration.z",
)
"""State interfaces of an IMU in the order of its values."""

FORCE_TORQUE_STATES = ("force.x", "force.y", "force.z", "torque.x", "torque.y", "torque.z")
"""State interfaces of a force-torque sensor in the order of its values."""


class SensorReadout(NamedTuple):
    """A sensor of the simulated model.

    Attributes:
        interfaces: names of its values.
        frame_id: frame of the values.
        read: returns them.
    """

    interfaces: tuple[str, ...]
    frame_id: str
    read: Callable[[], Sequence[float]]


class SensorSource(Protocol):
    """Sensors of the simulated model."""

    @property
    def names(self) -> tuple[str, ...]:
        """Names of those that hardware can offer."""
        ...

    def find(self, name: str) -> SensorReadout | None:
        """Return a sensor by its name in the model, None when there is none."""
        ...


def sensor_parts(source: SensorSource) -> tuple[PartTag, ...]:
    """Return parts with everything that a model's sensors measure, for robots without blocks."""
    found = []
    for name in source.names:
        readout = source.find(name)
        if readout is not None:
            states = tuple(InterfaceTag(word) for word in readout.interfaces)
            found.append(PartTag("sensor", name, (), states, {}, _NOWHERE))
    return tuple(found)


class SensorStates:
    """Sensors of one piece of hardware; those whose states nobody reads are not computed.

    Attributes:
        interfaces: full names of the states by sensor.
        frames: ``frame_id`` by sensor.
    """

    def __init__(
        self,
        parts: Sequence[PartTag],
        interface_values: InterfaceValues,
        source: SensorSource | None,
        diagnostics: Diagnostics,
    ) -> None:
        self.interfaces: dict[str, tuple[str, ...]] = {}
        self.frames: dict[str, str] = {}
        self._interface_values = interface_values
        self._rows: list[tuple[Mapping[int, int], Callable[[], Sequence[float]]]] = []
        for part in parts:
            readout = source.find(part.name) if source is not None else None
            if readout is None:
                names = source.names if source is not None else ()
                text = f"sensor '{part.name}' is not an IMU or force-torque sensor of the simulated"
                text += " model; it is left out (Skipping sensor in the URDF named"
                text += f" '{part.name}' which is not in the gazebo model.)"
                hint = did_you_mean(part.name, names)
                diagnostics.report("control.ros2-control-sensor", text, part.span, fix=hint)
                continue
            self._add(part, readout, diagnostics)

    def read(self) -> None:
        """Measure what is read."""
        looked_up = self._interface_values.looked_up
        for indices, read in self._rows:
            if looked_up.isdisjoint(indices):
                continue
            values = read()
            for index, number in indices.items():
                self._interface_values.states[index] = values[number]

    def _add(self, part: PartTag, readout: SensorReadout, diagnostics: Diagnostics) -> None:
        indices: dict[int, int] = {}
        names = []
        for item in part.states:
            if item.name not in readout.interfaces:
                text = f"sensor '{part.name}' has no state '{item.name}'; it has"
                text += f" {', '.join(readout.interfaces)}"
                hint = did_you_mean(item.name, readout.interfaces)
                span = item.span or part.span
                diagnostics.report("control.ros2-control-interface", text, span, fix=hint)
                continue
            name = f"{part.name}/{item.name}"
            indices[self._interface_values.add_state(name)] = readout.interfaces.index(item.name)
            names.append(name)
        self.interfaces[part.name] = tuple(names)
        self.frames[part.name] = part.parameters.get("frame_id", readout.frame_id)
        self._rows.append((indices, readout.read))
