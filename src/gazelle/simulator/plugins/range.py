"""One distance: ``libgazebo_ros_range`` and ``libhector_gazebo_ros_sonar``."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from gazelle.description.model import LidarSpec, SonarSpec
from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import header
from gazelle.parameters import Parameter, ParameterTable, Topic
from gazelle.simulator.plugins.context import PluginContext, SensorPlace
from gazelle.simulator.plugins.hector_noise import ErrorSource, error_parameters, read_model
from gazelle.simulator.plugins.plugin_parameters import PluginTable
from gazelle.simulator.plugins.sensor_publisher import (
    gaussian,
    prefixed_frame,
    publish_at,
    sensor_place,
    throttled_period,
)
from gazelle.simulator.scheduler import period_in_steps

__all__ = ["HECTOR_TABLE", "TABLE", "load", "load_hector"]

_ULTRASOUND, _INFRARED = 0, 1
_NEAREST = "The range is that of the nearest beam; nothing in sight is the largest range."
_SONAR = "It may stand in a `sonar` sensor too, whose cone is searched for the nearest surface."

TABLE = PluginTable(
    ParameterTable(
        "range",
        "Publishes the nearest distance that the ray sensor around it sees.",
        ("gazebo_ros_range",),
        (
            Parameter("robotNamespace", "text", "", "namespace of the topic"),
            Parameter("topicName", "text", "/range", "topic"),
            Parameter("frameName", "text", "/world", "frame of the data"),
            Parameter("radiation", "text", "ultrasound", "`ultrasound`; anything else is infrared"),
            Parameter("fov", "number", 0.05, "`field_of_view`", "rad"),
            Parameter("gaussianNoise", "number", 0.0, "sigma of the range", "m"),
            Parameter(
                "updateRate", "number", 0.0, "largest publish rate, 0 for the sensor's", "Hz"
            ),
            Parameter("alwaysOn", "refused", "", "scans are computed while somebody subscribes"),
            Parameter("visualize", "refused", "", "belongs to the sensor"),
        ),
    ),
    topics=(
        Topic(
            "{topicName}",
            "sensor_msgs/msg/Range",
            rate="sensor's, at most `updateRate`",
            frame="`frameName`",
        ),
    ),
    behaviour=(_NEAREST, _SONAR, "A range with noise stays below the largest range."),
)

HECTOR_TABLE = PluginTable(
    ParameterTable(
        "hector sonar",
        "The ultrasonic ranger of hector_gazebo_plugins, in a ray sensor.",
        ("hector_gazebo_ros_sonar",),
        (
            Parameter("robotNamespace", "text", "", "namespace of the topic"),
            Parameter("topicName", "text", "sonar", "topic"),
            Parameter(
                "frameId", "text", "/sonar_link", "frame of the data", "", aliases=("frameName",)
            ),
            Parameter("updateRate", "number", 10.0, "publish rate", "Hz"),
            *error_parameters("m", axes=1),
        ),
    ),
    topics=(Topic("{topicName}", "sensor_msgs/msg/Range", rate="`updateRate`", frame="`frameId`"),),
    behaviour=(_NEAREST, _SONAR, "dynamic_reconfigure is not offered."),
)


@dataclass(frozen=True, slots=True)
class _Ranger:
    """A sensor that gives one distance."""

    place: SensorPlace
    min_m: float
    max_m: float
    fov_rad: float
    read_m: Callable[[], float]


def load(context: PluginContext) -> None:
    """Start publishing the ranges of the sensor the plug-in stands in."""
    parameters = context.reader(TABLE)
    ranger = _ranger(context)
    if ranger is not None:
        noise = gaussian(context, parameters.number("gaussianNoise"))

        def noisy(range_m: float) -> float:
            return min(range_m + float(noise(1)[0]), ranger.max_m)

        topic = context.topic(parameters, parameters.text("topicName"))
        frame = prefixed_frame(context, parameters, "frameName")
        fov_rad = parameters.number("fov")
        radiation = _ULTRASOUND if parameters.text("radiation") == "ultrasound" else _INFRARED
        rate_hz = parameters.number("updateRate")
        period = throttled_period(context, ranger.place, rate_hz)
        _start(context, ranger, topic, period, _Message(frame, radiation, fov_rad), noisy)
    parameters.report_unread()


def load_hector(context: PluginContext) -> None:
    """Start hector's plug-in in the sensor it stands in."""
    parameters = context.reader(HECTOR_TABLE)
    ranger = _ranger(context)
    if ranger is not None:
        source = ErrorSource(context, read_model(parameters, axes=1), "range")

        def noisy(range_m: float) -> float:
            value = float(source.apply(np.array([range_m]))[0])
            return min(max(value, ranger.min_m), ranger.max_m)

        topic = context.topic(parameters, parameters.text("topicName"))
        period = period_in_steps(parameters.number("updateRate"), context.host.engine.step_ns)
        message = _Message(parameters.text("frameId"), _ULTRASOUND, ranger.fov_rad)
        _start(context, ranger, topic, period, message, noisy)
    parameters.report_unread()


@dataclass(frozen=True, slots=True)
class _Message:
    """What all messages of a ranger have in common."""

    frame: str
    radiation: int
    fov_rad: float


def _start(
    context: PluginContext,
    ranger: _Ranger,
    topic: str,
    period: Fraction,
    common: _Message,
    noisy: Callable[[float], float],
) -> None:
    def build(time_ns: int) -> Any:
        range_m = min(ranger.read_m(), ranger.max_m)
        # Both plug-ins leave a reading without an echo as it is.
        return message_type("sensor_msgs/Range")(
            header=header(time_ns, common.frame),
            radiation_type=common.radiation,
            field_of_view=common.fov_rad,
            min_range=ranger.min_m,
            max_range=ranger.max_m,
            range=noisy(range_m) if range_m < ranger.max_m else ranger.max_m,
        )

    publish_at(context, topic, "sensor_msgs/Range", period, build)


def _ranger(context: PluginContext) -> _Ranger | None:
    place = sensor_place(context, (LidarSpec, SonarSpec), "a ray or sonar sensor")
    if place is None:
        return None
    sensors, spec = context.host.sensors, place.sensor.spec
    if isinstance(spec, SonarSpec):
        fov_rad = 2 * math.atan2(spec.radius_m, spec.max_m)
        return _Ranger(place, spec.min_m, spec.max_m, fov_rad, lambda: sensors.sonar(place).range_m)
    assert isinstance(spec, LidarSpec)
    fov_rad = min(
        abs(spec.max_angle_rad - spec.min_angle_rad),
        abs(spec.vertical_max_angle_rad - spec.vertical_min_angle_rad),
    )

    def nearest_m() -> float:
        # What lies before the smallest range reads -inf in scans; the beam begins there.
        return max(float(sensors.scan(place).ranges_m.min()), spec.range_min_m)

    return _Ranger(place, spec.range_min_m, spec.range_max_m, fov_rad, nearest_m)
