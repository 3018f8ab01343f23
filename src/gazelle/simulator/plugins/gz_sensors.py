"""Sensors of gz-sim worlds, which publish by themselves: no plug-in stands in them."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from typing import Any, NamedTuple

from gazelle.description.model import (
    AltimeterSpec,
    CameraSpec,
    ContactSpec,
    ForceTorqueSpec,
    GpsSpec,
    ImuSpec,
    LidarSpec,
    MagnetometerSpec,
    PressureSpec,
)
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import vector_message
from gazelle.interfaces.stamps import header
from gazelle.simulator.plugins.bumper import gz_contacts_message
from gazelle.simulator.plugins.camera_info import Calibration
from gazelle.simulator.plugins.camera_stream import CameraStream
from gazelle.simulator.plugins.context import PluginContext, SensorPlace, join_names
from gazelle.simulator.plugins.depth_camera import DepthLimits, add_colour, add_depth
from gazelle.simulator.plugins.ft_sensor import wrench_message
from gazelle.simulator.plugins.gps import fix_message
from gazelle.simulator.plugins.imu import publish_readings
from gazelle.simulator.plugins.laser import cloud_builder, scan_builder, start_scans
from gazelle.simulator.plugins.sensor_publisher import publish_at, sensor_period
from gazelle.simulator.sensor_readings import Measurements

__all__ = ["publish_measurement", "publish_sensor"]


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


def publish_sensor(context: PluginContext) -> None:
    """Publish a sensor on its ``<topic>``, as ROS types under gz names.

    The types are those that ros_gz_bridge maps to, the names gz-sensors': scans at the topic and
    ``…/points``, pictures at the topic with ``camera_info`` beside it, RGB-D at ``…/image``,
    ``…/depth_image`` and ``…/points``.
    """
    assert context.place is not None
    place = replace(context.place, is_gz=True)
    spec = place.sensor.spec
    if isinstance(spec, LidarSpec):
        topic, frame = _topic(context, place, "scan"), _frame(place)
        start_scans(context, place, topic, "sensor_msgs/LaserScan", scan_builder(place, frame))
        points = join_names(topic, "points")
        build = cloud_builder(frame, -math.inf)
        start_scans(context, place, points, "sensor_msgs/PointCloud2", build)
    elif isinstance(spec, ImuSpec):
        period = place.period_in_steps(context.host.engine.step_ns)
        sensors, topic = context.host.sensors, _topic(context, place, "imu")
        publish_readings(context, topic, _frame(place), period, lambda: sensors.imu(place))
    elif isinstance(spec, CameraSpec):
        _publish_camera(context, place, spec)
    else:
        publish_measurement(context, place, lambda ending: _topic(context, place, ending))


def _publish_camera(context: PluginContext, place: SensorPlace, spec: CameraSpec) -> None:
    from gazelle.sensors import camera_intrinsics

    lens = camera_intrinsics(spec, convention="camera_info")
    calibration = Calibration(
        spec.optical_frame_id or _frame(place),
        spec.width_px,
        spec.height_px,
        lens.fx,
        lens.cx,
        lens.cy,
        0.0,
        (0.0, 0.0, 0.0, 0.0, 0.0),
    )
    topic = _topic(context, place, "image" if spec.kind == "rgb" else "camera")
    stream = CameraStream(context, place, calibration, topic)
    near = spec.near_m if spec.depth_near_m is None else spec.depth_near_m
    far = spec.far_m if spec.depth_far_m is None else spec.depth_far_m
    limits, points = DepthLimits(near, far), join_names(topic, "points")
    beside = join_names(topic.rsplit("/", 1)[0] or "/", "camera_info")
    if spec.kind == "rgbd":
        add_colour(stream, join_names(topic, "image"), spec)
        add_depth(stream, join_names(topic, "depth_image"), points, limits, place)
        beside = join_names(topic, "camera_info")
    elif spec.kind == "depth":
        add_depth(stream, topic, points, limits, place)
    else:
        add_colour(stream, topic, spec)
    stream.add_info(spec.camera_info_topic or beside)


def _topic(context: PluginContext, place: SensorPlace, ending: str) -> str:
    if place.sensor.topic:
        return join_names("/", place.sensor.topic)
    holder = place.joint_name or place.link_name
    kind, (model, name) = "joint" if place.joint_name else "link", holder.split("::", 1)
    world = context.host.engine.world.name
    path = f"/world/{world}/model/{model}/{kind}/{name}/sensor/{place.sensor.name}/{ending}"
    return join_names(path)


def _frame(place: SensorPlace) -> str:
    return place.sensor.frame_id or place.name.replace("::", "/")
