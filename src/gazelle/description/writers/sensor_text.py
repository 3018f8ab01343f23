"""Sensors in SDF's words, from what the readers made of them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import Any

from gazelle.description.model import (
    AltimeterSpec,
    CameraSpec,
    ContactSpec,
    ForceTorqueSpec,
    GpsSpec,
    ImuSpec,
    LidarSpec,
    LogicalCameraSpec,
    MagnetometerSpec,
    Noise,
    OtherSensorSpec,
    PressureSpec,
    Sensor,
    SonarSpec,
)
from gazelle.description.writers.xml_markup import Markup, from_tag, number, numbers, xyz_rpy
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose

__all__ = ["add_pose", "add_sensor"]

_ALL_VISIBLE = 0xFFFFFFFF
_NOISE_WORDS = (
    "mean",
    "stddev",
    "bias_mean",
    "bias_stddev",
    "dynamic_bias_stddev",
    "dynamic_bias_correlation_time",
    "precision",
)


def add_pose(owner: Markup, pose: Pose) -> None:
    """Append a ``<pose>``; nothing for the identity."""
    xyz, rpy = xyz_rpy(pose)
    if (xyz, rpy) != ("0 0 0", "0 0 0"):
        owner.add("pose", f"{xyz} {rpy}")


def add_sensor(
    owner: Markup, sensor: Sensor, T_link_sensor: Pose, diagnostics: Diagnostics
) -> None:
    """Append a ``<sensor>``.

    Args:
        owner: the ``<link>``, ``<joint>`` or ``<gazebo>``.
        sensor: what to write.
        T_link_sensor: its place in the frame the link has in the new file.
        diagnostics: receives ``convert.left-out`` for kinds that are known by name only.
    """
    item = owner.add("sensor", name=sensor.name, type=sensor.type)
    add_pose(item, T_link_sensor)
    item.add("always_on", _flag(sensor.always_on))
    item.add("visualize", _flag(sensor.visualize))
    item.add("update_rate", number(sensor.update_rate_hz))
    if sensor.topic:
        item.add("topic", sensor.topic)
    if sensor.frame_id:
        item.add("ignition_frame_id", sensor.frame_id)
    if isinstance(sensor.spec, OtherSensorSpec):
        message = f"sensor '{sensor.name}' of type {sensor.type} is written without its parameters"
        diagnostics.report("convert.left-out", message, sensor.span)
    else:
        _WRITERS[type(sensor.spec)](item, sensor)
    for plugin in sensor.plugins:
        item.children.append(from_tag(plugin.parameters))


def _flag(value: bool) -> str:
    return str(value).lower()


def _add_noise(owner: Markup, noise: Noise) -> None:
    if noise.type == "none":
        return
    item = owner.add("noise", type=noise.type)
    # Cameras and lidars of SDF 1.4 and of Gazebo's examples have the type as a child.
    if owner.name in ("camera", "ray"):
        item.attributes.clear()
        item.add("type", noise.type)
    for word in _NOISE_WORDS:
        value = getattr(noise, f"{word}_s" if word.endswith("_time") else word)
        if value or word in ("mean", "stddev"):
            item.add(word, number(value))


def _add_noises(owner: Markup, name: str, noises: Iterable[tuple[str, Noise]]) -> None:
    """Append an element with a noise for each of its children that has one."""
    loud = [(word, noise) for word, noise in noises if noise.type != "none"]
    if loud:
        item = owner.add(name)
        for word, noise in loud:
            _add_noise(item.add(word), noise)


def _lidar(item: Markup, sensor: Sensor) -> None:
    spec: Any = sensor.spec
    ray = item.add("lidar" if "lidar" in sensor.type else "ray")
    scan = ray.add("scan")
    _line(scan, "horizontal", spec.samples, spec.resolution, spec.min_angle_rad, spec.max_angle_rad)
    if spec.vertical_samples != 1 or spec.vertical_min_angle_rad or spec.vertical_max_angle_rad:
        _line(
            scan,
            "vertical",
            spec.vertical_samples,
            spec.vertical_resolution,
            spec.vertical_min_angle_rad,
            spec.vertical_max_angle_rad,
        )
    reach = ray.add("range")
    reach.add("min", number(spec.range_min_m))
    reach.add("max", "inf" if math.isinf(spec.range_max_m) else number(spec.range_max_m))
    reach.add("resolution", number(spec.range_resolution_m))
    _add_noise(ray, spec.noise)


def _line(
    scan: Markup, name: str, samples: int, resolution: float, low: float, high: float
) -> None:
    line = scan.add(name)
    line.add("samples", number(samples))
    line.add("resolution", number(resolution))
    line.add("min_angle", number(low))
    line.add("max_angle", number(high))


def _camera(item: Markup, sensor: Sensor) -> None:
    spec: Any = sensor.spec
    for camera in spec.members or (spec,):
        _one_camera(item, camera)


def _one_camera(item: Markup, spec: CameraSpec) -> None:
    camera = item.add("camera", name=spec.name)
    add_pose(camera, spec.T_sensor_camera)
    if spec.camera_info_topic:
        camera.add("camera_info_topic", spec.camera_info_topic)
    camera.add("horizontal_fov", number(spec.horizontal_fov_rad))
    image = camera.add("image")
    image.add("width", number(spec.width_px))
    image.add("height", number(spec.height_px))
    image.add("format", spec.pixel_format)
    _clip(camera, spec.near_m, spec.far_m)
    if spec.depth_near_m is not None or spec.depth_far_m is not None:
        near, far = spec.depth_near_m, spec.depth_far_m
        _clip(camera.add("depth_camera"), near, far)
    _add_noise(camera, spec.noise)
    if spec.distortion is not None:
        lens = camera.add("distortion")
        for word in ("k1", "k2", "k3", "p1", "p2"):
            lens.add(word, number(getattr(spec.distortion, word)))
        lens.add("center", numbers(spec.distortion.center))
    if spec.intrinsics is not None:
        intrinsics = camera.add("lens").add("intrinsics")
        for word, value in zip(("fx", "fy", "cx", "cy", "s"), spec.intrinsics, strict=True):
            intrinsics.add(word, number(value))
    if spec.visibility_mask != _ALL_VISIBLE:
        camera.add("visibility_mask", number(spec.visibility_mask))
    if spec.optical_frame_id:
        camera.add("optical_frame_id", spec.optical_frame_id)


def _clip(owner: Markup, near_m: float | None, far_m: float | None) -> None:
    clip = owner.add("clip")
    for word, value in (("near", near_m), ("far", far_m)):
        if value is not None:
            clip.add(word, number(value))


def _imu(item: Markup, sensor: Sensor) -> None:
    spec: Any = sensor.spec
    imu = Markup("imu")
    _add_noises(imu, "angular_velocity", zip("xyz", spec.angular_velocity_noise, strict=True))
    _add_noises(imu, "linear_acceleration", zip("xyz", spec.linear_acceleration_noise, strict=True))
    if spec.localization or any(spec.custom_rpy_rad):
        frame = imu.add("orientation_reference_frame")
        frame.add("localization", spec.localization or "CUSTOM")
        frame.add("custom_rpy", numbers(spec.custom_rpy_rad))
    if not spec.enable_orientation:
        imu.add("enable_orientation", "false")
    item.children += [imu] if imu.children else []


def _contact(item: Markup, sensor: Sensor) -> None:
    spec: Any = sensor.spec
    contact = item.add("contact")
    for name in spec.collisions:
        contact.add("collision", name)
    if spec.topic:
        contact.add("topic", spec.topic)


def _force_torque(item: Markup, sensor: Sensor) -> None:
    spec: Any = sensor.spec
    part = item.add("force_torque")
    part.add("frame", spec.frame)
    part.add("measure_direction", spec.measure_direction)
    _add_noises(part, "force", zip("xyz", spec.force_noise, strict=True))
    _add_noises(part, "torque", zip("xyz", spec.torque_noise, strict=True))


def _gps(item: Markup, sensor: Sensor) -> None:
    spec: Any = sensor.spec
    gps = Markup("navsat" if sensor.type == "navsat" else "gps")
    for word in ("position", "velocity"):
        noises = [(way, getattr(spec, f"{way}_{word}_noise")) for way in ("horizontal", "vertical")]
        _add_noises(gps, f"{word}_sensing", noises)
    item.children += [gps] if gps.children else []


def _magnetometer(item: Markup, sensor: Sensor) -> None:
    spec: Any = sensor.spec
    _add_noises(item, "magnetometer", zip("xyz", spec.noise, strict=True))


def _altimeter(item: Markup, sensor: Sensor) -> None:
    spec: Any = sensor.spec
    noises = (
        ("vertical_position", spec.position_noise),
        ("vertical_velocity", spec.velocity_noise),
    )
    _add_noises(item, "altimeter", noises)


def _pressure(item: Markup, sensor: Sensor) -> None:
    spec: Any = sensor.spec
    pressure = item.add("air_pressure")
    pressure.add("reference_altitude", number(spec.reference_altitude_m))
    if spec.noise.type != "none":
        _add_noise(pressure.add("pressure"), spec.noise)


def _sonar(item: Markup, sensor: Sensor) -> None:
    spec: Any = sensor.spec
    sonar = item.add("sonar")
    sonar.add("geometry", spec.geometry)
    sonar.add("min", number(spec.min_m))
    sonar.add("max", number(spec.max_m))
    sonar.add("radius", number(spec.radius_m))


def _logical_camera(item: Markup, sensor: Sensor) -> None:
    spec: Any = sensor.spec
    camera = item.add("logical_camera")
    camera.add("near", number(spec.near_m))
    camera.add("far", number(spec.far_m))
    camera.add("horizontal_fov", number(spec.horizontal_fov_rad))
    camera.add("aspect_ratio", number(spec.aspect_ratio))


_WRITERS: dict[type[Any], Callable[[Markup, Sensor], None]] = {
    AltimeterSpec: _altimeter,
    CameraSpec: _camera,
    ContactSpec: _contact,
    ForceTorqueSpec: _force_torque,
    GpsSpec: _gps,
    ImuSpec: _imu,
    LidarSpec: _lidar,
    LogicalCameraSpec: _logical_camera,
    MagnetometerSpec: _magnetometer,
    PressureSpec: _pressure,
    SonarSpec: _sonar,
}
