"""Sensors of gz-sim worlds that need no rays, as the ROS types that ros_gz_bridge maps to."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any, NamedTuple

from gazelle.description.model import (
    AltimeterSpec,
    ContactSpec,
    ForceTorqueSpec,
    GpsSpec,
    MagnetometerSpec,
    PressureSpec,
)
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import vector_message
from gazelle.interfaces.stamps import header
from gazelle.simulator.measurements import Measurements
from gazelle.simulator.plugins.bumper import gz_contacts_message
from gazelle.simulator.plugins.context import PluginContext, SensorPlace, join_names
from gazelle.simulator.plugins.ft_sensor import wrench_message
from gazelle.simulator.plugins.gps import fix_message
from gazelle.simulator.plugins.sensor_publisher import publish_at, sensor_period

__all__ = ["publish_measurement"]

_EVERY_STEP = Fraction(1)


class _Kind(NamedTuple):
    """The ending of gz's default topic, the ROS type, and what builds a message of it."""

    ending: str
    type_name: str
    build: Callable[[Measurements, SensorPlace, int, str], Any]


def publish_measurement(
    context: PluginContext, place: SensorPlace, topic: Callable[[str], str]
) -> None:
    """Publish a sensor; `topic` gives its topic by the ending of gz's default name."""
    spec, measurements = place.sensor.spec, context.host.sensors.measurements
    frame = place.sensor.frame_id or place.name.replace("::", "/")
    kind = _KINDS.get(type(spec))
    if isinstance(spec, ContactSpec):
        # gz's Contact system knows its own <topic> only, and publishes in every step.
        name = join_names("/", spec.topic) if spec.topic else topic("contact")

        def contacts(time_ns: int) -> Any:
            return gz_contacts_message(context, place, time_ns)

        publish_at(context, name, "ros_gz_interfaces/Contacts", _EVERY_STEP, contacts)
    elif kind is not None:
        publish_at(
            context,
            topic(kind.ending),
            kind.type_name,
            sensor_period(context, place),
            lambda time_ns: kind.build(measurements, place, time_ns, frame),
        )


def _wrench(measurements: Measurements, place: SensorPlace, time_ns: int, frame: str) -> Any:
    return wrench_message(time_ns, frame, *measurements.force_torque(place))


def _fix(measurements: Measurements, place: SensorPlace, time_ns: int, frame: str) -> Any:
    return fix_message(time_ns, frame, measurements.gps(place).position, None)


def _field(measurements: Measurements, place: SensorPlace, time_ns: int, frame: str) -> Any:
    return message_type("sensor_msgs/MagneticField")(
        header=header(time_ns, frame),
        magnetic_field=vector_message(measurements.magnetometer(place).field_t),
    )


def _altitude(measurements: Measurements, place: SensorPlace, time_ns: int, frame: str) -> Any:
    record = measurements.altimeter(place)
    return message_type("ros_gz_interfaces/Altimeter")(
        header=header(time_ns, frame),
        vertical_position=record.vertical_position_m,
        vertical_velocity=record.vertical_velocity_m_s,
        vertical_reference=record.vertical_reference_m,
    )


def _pressure(measurements: Measurements, place: SensorPlace, time_ns: int, frame: str) -> Any:
    spec = place.sensor.spec
    assert isinstance(spec, PressureSpec)
    return message_type("sensor_msgs/FluidPressure")(
        header=header(time_ns, frame),
        fluid_pressure=measurements.pressure(place).pressure_pa,
        variance=spec.noise.stddev**2,
    )


_KINDS: dict[type, _Kind] = {
    ForceTorqueSpec: _Kind("forcetorque", "geometry_msgs/WrenchStamped", _wrench),
    GpsSpec: _Kind("navsat", "sensor_msgs/NavSatFix", _fix),
    MagnetometerSpec: _Kind("magnetometer", "sensor_msgs/MagneticField", _field),
    AltimeterSpec: _Kind("altimeter", "ros_gz_interfaces/Altimeter", _altitude),
    PressureSpec: _Kind("air_pressure", "sensor_msgs/FluidPressure", _pressure),
}
