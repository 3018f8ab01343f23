"""Sensors of gz-sim worlds that need no rays, as the ROS types that ros_gz_bridge maps to."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

from gazelle.description.model import (
    AltimeterSpec,
    ContactSpec,
    ForceTorqueSpec,
    GpsSpec,
    MagnetometerSpec,
    PressureSpec,
)
from gazelle.simulator.messages import header, message_class, vector_message
from gazelle.simulator.plugins.bumper import gz_contacts_message
from gazelle.simulator.plugins.context import PluginContext, SensorPlace, join_names
from gazelle.simulator.plugins.ft_sensor import wrench_message
from gazelle.simulator.plugins.gps import fix_message
from gazelle.simulator.plugins.stream import publish_at, sensor_period

__all__ = ["publish_measurement"]

_EVERY_STEP = Fraction(1)


def publish_measurement(
    context: PluginContext, place: SensorPlace, topic: Callable[[str], str]
) -> None:
    """Publish a sensor; `topic` gives its topic by the ending of gz's default name."""
    spec, measurements = place.sensor.spec, context.host.sensors.measurements
    frame = place.sensor.frame_id or place.name.replace("::", "/")
    if isinstance(spec, ContactSpec):
        # gz's Contact system knows its own <topic> only, and publishes in every step.
        name = join_names("/", spec.topic) if spec.topic else topic("contact")
        publish_at(
            context,
            name,
            "ros_gz_interfaces/Contacts",
            _EVERY_STEP,
            lambda time_ns: gz_contacts_message(context, place, time_ns),
        )
        return
    builders: dict[type, tuple[str, str, Callable[[int], Any]]] = {
        ForceTorqueSpec: (
            "forcetorque",
            "geometry_msgs/WrenchStamped",
            lambda time_ns: wrench_message(time_ns, frame, *measurements.force_torque(place)),
        ),
        GpsSpec: (
            "navsat",
            "sensor_msgs/NavSatFix",
            lambda time_ns: fix_message(time_ns, frame, measurements.gps(place).position, None),
        ),
        MagnetometerSpec: (
            "magnetometer",
            "sensor_msgs/MagneticField",
            lambda time_ns: _field_message(
                time_ns, frame, measurements.magnetometer(place).field_t
            ),
        ),
        AltimeterSpec: (
            "altimeter",
            "ros_gz_interfaces/Altimeter",
            lambda time_ns: _altimeter_message(time_ns, frame, *measurements.altimeter(place)),
        ),
        PressureSpec: (
            "air_pressure",
            "sensor_msgs/FluidPressure",
            lambda time_ns: _pressure_message(
                time_ns, frame, measurements.pressure(place).pressure_pa, spec
            ),
        ),
    }
    found = builders.get(type(spec))
    if found is not None:
        ending, type_name, build = found
        publish_at(context, topic(ending), type_name, sensor_period(context, place), build)


def _field_message(time_ns: int, frame: str, field_t: Any) -> Any:
    return message_class("sensor_msgs/MagneticField")(
        header=header(time_ns, frame), magnetic_field=vector_message(field_t)
    )


def _altimeter_message(
    time_ns: int, frame: str, height_m: float, speed_m_s: float, reference_m: float
) -> Any:
    return message_class("ros_gz_interfaces/Altimeter")(
        header=header(time_ns, frame),
        vertical_position=height_m,
        vertical_velocity=speed_m_s,
        vertical_reference=reference_m,
    )


def _pressure_message(time_ns: int, frame: str, pressure_pa: float, spec: Any) -> Any:
    return message_class("sensor_msgs/FluidPressure")(
        header=header(time_ns, frame),
        fluid_pressure=pressure_pa,
        variance=spec.noise.stddev**2,
    )
