"""SDF ``<sensor>``: every kind of 1.4 to 1.12."""

from __future__ import annotations

from collections.abc import Callable

from gazelle.description.model import (
    AltimeterSpec,
    ContactSpec,
    ForceTorqueSpec,
    GpsSpec,
    ImuSpec,
    LogicalCameraSpec,
    MagnetometerSpec,
    Noise,
    OtherSensorSpec,
    PressureSpec,
    Sensor,
    SensorSpec,
    SonarSpec,
)
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.cameras import read_camera, read_multicamera
from gazelle.description.sdf_reader.child_values import (
    child_bool,
    child_float,
    child_vector3,
    name_of,
)
from gazelle.description.sdf_reader.lidars import read_lidar
from gazelle.description.sdf_reader.noise import read_axis_noises, read_noise, read_noise_of
from gazelle.description.sdf_reader.plugins import read_plugins
from gazelle.description.sdf_reader.poses import pose_of
from gazelle.description.xml import Tag
from gazelle.diagnostics import did_you_mean
from gazelle.geometry import IDENTITY_POSE, Pose

__all__ = ["SENSOR_TYPES", "read_sensor"]

_ReadSpec = Callable[[Tag, ReadContext], SensorSpec]


def read_sensor(
    tag: Tag, context: ReadContext, *, T_link_sensor: Pose = IDENTITY_POSE
) -> Sensor | None:
    """Return the sensor of a ``<sensor>`` element.

    Args:
        tag: the element.
        context: where problems are reported.
        T_link_sensor: frame that the sensor's ``<pose>`` starts from: the link's own for SDF,
            a lumped or referenced frame for URDF.

    Returns:
        The sensor; None (with a reported reason) when its name or type is missing or unknown.
    """
    name = name_of(tag, context)
    kind = tag.attributes.get("type", "").strip()
    read_spec = _READERS.get(kind)
    if not name or read_spec is None:
        _report_type(tag, kind, context)
        return None
    return Sensor(
        name=name,
        type=kind,
        spec=read_spec(tag, context),
        T_link_sensor=T_link_sensor @ pose_of(tag, context),
        update_rate_hz=max(0.0, child_float(tag, "update_rate", 0.0, context)),
        always_on=child_bool(tag, "always_on", False, context),
        visualize=child_bool(tag, "visualize", False, context),
        topic=_topic(tag),
        frame_id=tag.text_of("gz_frame_id") or tag.text_of("ignition_frame_id"),
        plugins=read_plugins(tag, reference=name),
        span=tag.span,
    )


def _report_type(tag: Tag, kind: str, context: ReadContext) -> None:
    if kind in _READERS:
        return
    name = tag.attributes.get("name", "")
    if not kind:
        message = f"<sensor name='{name}'> has no type; it is left out"
        context.diagnostics.report("xml.missing-attribute", message, tag.span)
        return
    message = f"sensor type '{kind}' is not known; sensor '{name}' is left out"
    fix = did_you_mean(kind, SENSOR_TYPES) or "write one of: " + ", ".join(SENSOR_TYPES)
    context.diagnostics.report("sdf.unknown-sensor-type", message, tag.span, fix=fix)


def _topic(tag: Tag) -> str:
    """Return the topic; ``__default__`` is Gazebo's word for none."""
    topic = tag.text_of("topic") or tag.text_of("imu", "topic") or tag.text_of("gps", "topic")
    return "" if topic == "__default__" else topic


def _ray(tag: Tag, context: ReadContext) -> SensorSpec:
    return read_lidar(tag.find("ray") or tag.find("lidar"), context, on_collisions=True)


def _gpu_ray(tag: Tag, context: ReadContext) -> SensorSpec:
    return read_lidar(tag.find("ray") or tag.find("lidar"), context, on_collisions=False)


def _camera(kind: str) -> _ReadSpec:
    return lambda tag, context: read_camera(tag.find("camera"), kind, context)


def _imu(tag: Tag, context: ReadContext) -> SensorSpec:
    imu = tag.find("imu")
    if imu is None:
        return ImuSpec()
    old = imu.find("noise")
    reference = imu.find("orientation_reference_frame") or imu
    angular = read_axis_noises(imu.find("angular_velocity"), context)
    linear = read_axis_noises(imu.find("linear_acceleration"), context)
    if old is not None:
        angular = _old_imu_noise(old, "rate", context)
        linear = _old_imu_noise(old, "accel", context)
    return ImuSpec(
        angular_velocity_noise=angular,
        linear_acceleration_noise=linear,
        localization=reference.text_of("localization"),
        custom_rpy_rad=child_vector3(reference, "custom_rpy", (0.0, 0.0, 0.0), context),
        enable_orientation=child_bool(imu, "enable_orientation", True, context),
    )


def _old_imu_noise(tag: Tag, name: str, context: ReadContext) -> tuple[Noise, Noise, Noise]:
    """SDF 1.4: one ``<type>`` for the whole, ``<rate>`` and ``<accel>`` for all axes alike."""
    part = tag.find(name)
    if part is None:
        return (Noise(), Noise(), Noise())
    with_type = Tag(
        part.name,
        part.span,
        {"type": tag.text_of("type", default="none")},
        part.children,
    )
    noise = read_noise(with_type, context)
    return (noise, noise, noise)


def _contact(tag: Tag, _context: ReadContext) -> SensorSpec:
    contact = tag.find("contact")
    if contact is None:
        return ContactSpec()
    topic = contact.text_of("topic")
    names = tuple(child.text for child in contact.find_all("collision") if child.text)
    return ContactSpec(names, "" if topic == "__default_topic__" else topic)


def _force_torque(tag: Tag, context: ReadContext) -> SensorSpec:
    force_torque = tag.find("force_torque")
    if force_torque is None:
        return ForceTorqueSpec()
    return ForceTorqueSpec(
        frame=force_torque.text_of("frame", default="child"),
        measure_direction=force_torque.text_of("measure_direction", default="child_to_parent"),
        force_noise=read_axis_noises(force_torque.find("force"), context),
        torque_noise=read_axis_noises(force_torque.find("torque"), context),
    )


def _gps(tag: Tag, context: ReadContext) -> SensorSpec:
    gps = tag.find("gps") or tag.find("navsat")

    def noise(quantity: str, direction: str) -> Noise:
        return read_noise_of(gps, quantity, direction, context=context)

    return GpsSpec(
        noise("position_sensing", "horizontal"),
        noise("position_sensing", "vertical"),
        noise("velocity_sensing", "horizontal"),
        noise("velocity_sensing", "vertical"),
    )


def _magnetometer(tag: Tag, context: ReadContext) -> SensorSpec:
    return MagnetometerSpec(read_axis_noises(tag.find("magnetometer"), context))


def _altimeter(tag: Tag, context: ReadContext) -> SensorSpec:
    altimeter = tag.find("altimeter")
    return AltimeterSpec(
        read_noise_of(altimeter, "vertical_position", context=context),
        read_noise_of(altimeter, "vertical_velocity", context=context),
    )


def _air_pressure(tag: Tag, context: ReadContext) -> SensorSpec:
    pressure = tag.find("air_pressure")
    if pressure is None:
        return PressureSpec()
    return PressureSpec(
        child_float(pressure, "reference_altitude", 0.0, context),
        read_noise_of(pressure, "pressure", context=context),
    )


def _sonar(tag: Tag, context: ReadContext) -> SensorSpec:
    sonar = tag.find("sonar")
    if sonar is None:
        return SonarSpec()
    return SonarSpec(
        sonar.text_of("geometry", default="cone"),
        child_float(sonar, "min", 0.0, context),
        child_float(sonar, "max", 1.0, context),
        child_float(sonar, "radius", 0.5, context),
    )


def _logical_camera(tag: Tag, context: ReadContext) -> SensorSpec:
    camera = tag.find("logical_camera")
    if camera is None:
        return LogicalCameraSpec()
    return LogicalCameraSpec(
        child_float(camera, "near", 0.0, context),
        child_float(camera, "far", 1.0, context),
        child_float(camera, "horizontal_fov", 1.0, context),
        child_float(camera, "aspect_ratio", 1.0, context),
    )


def _other(tag: Tag, context: ReadContext) -> SensorSpec:
    kind = tag.attributes["type"].strip()
    message = f"sensors of type '{kind}' are known by name only; this one gives no data"
    context.diagnostics.report("sdf.sensor-not-simulated", message, tag.span)
    return OtherSensorSpec(kind)


_READERS: dict[str, _ReadSpec] = {
    "air_pressure": _air_pressure,
    "air_speed": _other,
    "altimeter": _altimeter,
    "boundingbox_camera": _other,
    "camera": _camera("rgb"),
    "contact": _contact,
    "custom": _other,
    "depth": _camera("depth"),
    "depth_camera": _camera("depth"),
    "force_torque": _force_torque,
    "gps": _gps,
    "gpu_lidar": _gpu_ray,
    "gpu_ray": _gpu_ray,
    "imu": _imu,
    "lidar": _ray,
    "logical_camera": _logical_camera,
    "magnetometer": _magnetometer,
    "multicamera": read_multicamera,
    "navsat": _gps,
    "ray": _ray,
    "rfid": _other,
    "rfidtag": _other,
    "rgbd": _camera("rgbd"),
    "rgbd_camera": _camera("rgbd"),
    "segmentation": _other,
    "segmentation_camera": _other,
    "sonar": _sonar,
    "thermal": _other,
    "thermal_camera": _other,
    "wideanglecamera": _camera("wideangle"),
    "wireless_receiver": _other,
    "wireless_transmitter": _other,
    "transceiver": _other,
}
SENSOR_TYPES = tuple(sorted(_READERS))
