"""SDF ``<sensor>``: every kind of 1.4 to 1.12, with their ``<noise>``."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from gazelle.description.model import (
    AltimeterSpec,
    CameraSpec,
    ContactSpec,
    ForceTorqueSpec,
    GpsSpec,
    ImuSpec,
    LensDistortion,
    LidarSpec,
    LogicalCameraSpec,
    MagnetometerSpec,
    OtherSensorSpec,
    PressureSpec,
    Sensor,
    SensorSpec,
    SonarSpec,
)
from gazelle.description.model.plugin import read_plugins
from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader.child_values import (
    child_bool,
    child_float,
    child_int,
    child_vector3,
    name_of,
    optional_float,
    optional_int,
)
from gazelle.description.sdf_reader.poses import pose_of
from gazelle.description.xml import Tag, floats_from
from gazelle.diagnostics import did_you_mean
from gazelle.geometry import IDENTITY_POSE, Pose
from gazelle.noise import NOISE_TYPES, Noise

__all__ = [
    "SENSOR_TYPES",
    "read_sensor",
]

Noise3 = tuple[Noise, Noise, Noise]
_AXES = ("x", "y", "z")
_DEFAULTS = CameraSpec()
_MIN_FOV_RAD = 0.01
_DEFAULT_SAMPLES = 640
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


def _read_noise(tag: Tag | None, context: ReadContext) -> Noise:
    """Return the noise of a ``<noise>`` element; none when it is absent.

    The type stands in an attribute (1.5 and later) or in a child (cameras, lidars and 1.4).
    """
    if tag is None:
        return Noise()
    kind = (tag.attributes.get("type") or tag.text_of("type", default="none")).strip()
    if kind not in NOISE_TYPES:
        message = f"noise type '{kind}' is not known; there is no noise here"
        fix = did_you_mean(kind, NOISE_TYPES) or "write one of: " + ", ".join(NOISE_TYPES)
        context.diagnostics.report("sdf.bad-value", message, tag.span, fix=fix)
        return Noise(span=tag.span)
    return Noise(
        type=kind,
        mean=child_float(tag, "mean", 0.0, context),
        stddev=_not_negative(tag, "stddev", context),
        bias_mean=child_float(tag, "bias_mean", 0.0, context),
        bias_stddev=_not_negative(tag, "bias_stddev", context),
        dynamic_bias_stddev=_not_negative(tag, "dynamic_bias_stddev", context),
        dynamic_bias_correlation_time_s=_not_negative(
            tag, "dynamic_bias_correlation_time", context
        ),
        precision=child_float(tag, "precision", 0.0, context),
        span=tag.span,
    )


def _read_noise_of(tag: Tag | None, *path: str, context: ReadContext) -> Noise:
    """Return the noise of the ``<noise>`` reached by these child names."""
    return _read_noise(tag.find(*path, "noise") if tag is not None else None, context)


def _read_axis_noises(tag: Tag | None, context: ReadContext) -> Noise3:
    """Return the noises of the x, y and z children, such as those of ``<angular_velocity>``."""
    x, y, z = (_read_noise_of(tag, axis, context=context) for axis in _AXES)
    return x, y, z


def _read_camera(tag: Tag | None, kind: str, context: ReadContext) -> CameraSpec:
    """Return the camera of a ``<camera>`` element; SDF's defaults when it is None.

    Args:
        tag: the ``<camera>`` element.
        kind: ``rgb``, ``depth``, ``rgbd`` or ``wideangle``.
        context: where problems are reported.
    """
    if tag is None:
        return replace(_DEFAULTS, kind=kind)
    image, clip = tag.find("image") or tag, tag.find("clip") or tag
    depth_clip = tag.find("depth_camera", "clip")
    return CameraSpec(
        name=tag.attributes.get("name", _DEFAULTS.name),
        kind=kind,
        T_sensor_camera=pose_of(tag, context),
        horizontal_fov_rad=_horizontal_fov(tag, kind, context),
        width_px=_pixels(image, "width", _DEFAULTS.width_px, context),
        height_px=_pixels(image, "height", _DEFAULTS.height_px, context),
        pixel_format=image.text_of("format", default=_DEFAULTS.pixel_format),
        near_m=child_float(clip, "near", _DEFAULTS.near_m, context),
        far_m=child_float(clip, "far", _DEFAULTS.far_m, context),
        depth_near_m=optional_float(depth_clip, "near", context),
        depth_far_m=optional_float(depth_clip, "far", context),
        noise=_read_noise(tag.find("noise"), context),
        distortion=_distortion(tag.find("distortion"), context),
        intrinsics=_intrinsics(tag.find("lens", "intrinsics"), context),
        optical_frame_id=tag.text_of("optical_frame_id"),
        camera_info_topic=tag.text_of("camera_info_topic"),
        visibility_mask=_mask(tag, context),
    )


def _read_multicamera(tag: Tag, context: ReadContext) -> CameraSpec:
    """Return a multicamera: the first camera with all of them as its members."""
    members = tuple(_read_camera(child, "rgb", context) for child in tag.find_all("camera"))
    first = members[0] if members else _DEFAULTS
    return replace(first, members=members)


def _read_lidar(tag: Tag | None, context: ReadContext, *, on_collisions: bool) -> LidarSpec:
    """Return the lidar of a ``<ray>`` or ``<lidar>`` element.

    Args:
        tag: the element; None means SDF's defaults.
        context: where problems are reported.
        on_collisions: True for ``ray``, which hits collisions; False for kinds that see visuals.
    """
    if tag is None:
        return LidarSpec(on_collisions=on_collisions)
    horizontal = tag.find("scan", "horizontal") or tag
    vertical, reach = tag.find("scan", "vertical"), tag.find("range") or tag
    return LidarSpec(
        samples=_samples(horizontal, _DEFAULT_SAMPLES, context),
        min_angle_rad=child_float(horizontal, "min_angle", 0.0, context),
        max_angle_rad=child_float(horizontal, "max_angle", 0.0, context),
        resolution=child_float(horizontal, "resolution", 1.0, context),
        vertical_samples=_samples(vertical, 1, context) if vertical else 1,
        vertical_min_angle_rad=child_float(vertical, "min_angle", 0.0, context) if vertical else 0,
        vertical_max_angle_rad=child_float(vertical, "max_angle", 0.0, context) if vertical else 0,
        vertical_resolution=child_float(vertical, "resolution", 1.0, context) if vertical else 1,
        range_min_m=child_float(reach, "min", 0.0, context),
        range_max_m=_range_max(reach, context),
        range_resolution_m=child_float(reach, "resolution", 0.0, context),
        noise=_read_noise(tag.find("noise"), context),
        on_collisions=on_collisions,
    )


def _not_negative(tag: Tag, name: str, context: ReadContext) -> float:
    value = child_float(tag, name, 0.0, context)
    if value < 0.0:
        found = tag.find(name) or tag
        message = f"<{name}> is negative ({value:g}); {-value:g} is used"
        context.diagnostics.report("sdf.bad-value", message, found.span, fix="write it without -")
        return -value
    return value


def _mask(tag: Tag, context: ReadContext) -> int:
    mask = optional_int(tag, "visibility_mask", context)
    return _DEFAULTS.visibility_mask if mask is None else mask & _DEFAULTS.visibility_mask


def _pixels(image: Tag, name: str, default: int, context: ReadContext) -> int:
    value = child_int(image, name, default, context)
    if value >= 1:
        return value
    found = image.find(name) or image
    message = f"<{name}> is {value}; an image needs at least 1 pixel, {default} are used"
    context.diagnostics.report("sdf.bad-value", message, found.span)
    return default


def _horizontal_fov(tag: Tag, kind: str, context: ReadContext) -> float:
    """Return the angle, which is at most π (2π for wide-angle lenses)."""
    value = child_float(tag, "horizontal_fov", _DEFAULTS.horizontal_fov_rad, context)
    most = 2 * math.pi if kind == "wideangle" else math.radians(179.9)
    kept = min(max(value, _MIN_FOV_RAD), most)
    if kept != value:
        found = tag.find("horizontal_fov") or tag
        message = f"<horizontal_fov> is {value:g} rad; {kept:g} rad is used"
        context.diagnostics.report(
            "sdf.bad-value", message, found.span, fix="write an angle in radians, such as 1.047"
        )
    return kept


def _distortion(tag: Tag | None, context: ReadContext) -> LensDistortion | None:
    if tag is None:
        return None
    values = {name: child_float(tag, name, 0.0, context) for name in ("k1", "k2", "k3", "p1", "p2")}
    return LensDistortion(**values, center=_center(tag.find("center"), context))


def _center(tag: Tag | None, context: ReadContext) -> tuple[float, float]:
    middle = (0.5, 0.5)
    if tag is None or not tag.text:
        return middle
    x, y = floats_from(
        tag.text, 2, middle, what="<center>", span=tag.span, diagnostics=context.diagnostics
    )
    return x, y


def _intrinsics(
    tag: Tag | None, context: ReadContext
) -> tuple[float, float, float, float, float] | None:
    """Return fx, fy, cx, cy, s with the defaults of SDF 1.6 and later."""
    if tag is None:
        return None
    return (
        child_float(tag, "fx", 277.0, context),
        child_float(tag, "fy", 277.0, context),
        child_float(tag, "cx", 160.0, context),
        child_float(tag, "cy", 120.0, context),
        child_float(tag, "s", 0.0, context),
    )


def _samples(tag: Tag, default: int, context: ReadContext) -> int:
    value = child_int(tag, "samples", default, context)
    if value >= 1:
        return value
    found = tag.find("samples") or tag
    context.diagnostics.report(
        "sdf.bad-value", f"<samples> is {value}; a scan needs at least 1, 1 is used", found.span
    )
    return 1


def _range_max(tag: Tag, context: ReadContext) -> float:
    """Return the range; ``inf``, which SDF 1.6 and later allow, is no mistake."""
    found = tag.find("max")
    if found is not None and found.text.strip().lower() in ("inf", "+inf"):
        return float("inf")
    return child_float(tag, "max", 0.0, context)


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
    return _read_lidar(tag.find("ray") or tag.find("lidar"), context, on_collisions=True)


def _gpu_ray(tag: Tag, context: ReadContext) -> SensorSpec:
    return _read_lidar(tag.find("ray") or tag.find("lidar"), context, on_collisions=False)


def _camera(kind: str) -> _ReadSpec:
    return lambda tag, context: _read_camera(tag.find("camera"), kind, context)


def _imu(tag: Tag, context: ReadContext) -> SensorSpec:
    imu = tag.find("imu")
    if imu is None:
        return ImuSpec()
    old = imu.find("noise")
    reference = imu.find("orientation_reference_frame") or imu
    angular = _read_axis_noises(imu.find("angular_velocity"), context)
    linear = _read_axis_noises(imu.find("linear_acceleration"), context)
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
    noise = _read_noise(with_type, context)
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
        force_noise=_read_axis_noises(force_torque.find("force"), context),
        torque_noise=_read_axis_noises(force_torque.find("torque"), context),
    )


def _gps(tag: Tag, context: ReadContext) -> SensorSpec:
    gps = tag.find("gps") or tag.find("navsat")

    def noise(quantity: str, direction: str) -> Noise:
        return _read_noise_of(gps, quantity, direction, context=context)

    return GpsSpec(
        noise("position_sensing", "horizontal"),
        noise("position_sensing", "vertical"),
        noise("velocity_sensing", "horizontal"),
        noise("velocity_sensing", "vertical"),
    )


def _magnetometer(tag: Tag, context: ReadContext) -> SensorSpec:
    return MagnetometerSpec(_read_axis_noises(tag.find("magnetometer"), context))


def _altimeter(tag: Tag, context: ReadContext) -> SensorSpec:
    altimeter = tag.find("altimeter")
    return AltimeterSpec(
        _read_noise_of(altimeter, "vertical_position", context=context),
        _read_noise_of(altimeter, "vertical_velocity", context=context),
    )


def _air_pressure(tag: Tag, context: ReadContext) -> SensorSpec:
    pressure = tag.find("air_pressure")
    if pressure is None:
        return PressureSpec()
    return PressureSpec(
        child_float(pressure, "reference_altitude", 0.0, context),
        _read_noise_of(pressure, "pressure", context=context),
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
    "multicamera": _read_multicamera,
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
