"""Sensors, surfaces, materials and lights as elements of SDF, from what the readers made of them.

URDF's ``<gazebo>`` tags use them too.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import Any

from gazelle.description.materials import gazebo_material
from gazelle.description.model import (
    AltimeterSpec,
    CameraSpec,
    ContactSpec,
    ForceTorqueSpec,
    GpsSpec,
    ImuSpec,
    LidarSpec,
    Light,
    LightType,
    LogicalCameraSpec,
    MagnetometerSpec,
    Material,
    Noise,
    OtherSensorSpec,
    PressureSpec,
    Sensor,
    SonarSpec,
    Surface,
)
from gazelle.description.writers.output_files import OutputFiles
from gazelle.description.writers.xml_markup import Markup, from_tag, number, numbers, xyz_rpy
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose

__all__ = ["add_light", "add_material", "add_pose", "add_sensor", "add_surface", "is_script"]

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
_GAZEBO_SCRIPTS = "file://media/materials/scripts/gazebo.material"


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


def add_surface(owner: Markup, surface: Surface) -> None:
    """Append a ``<surface>`` with the words that are given; nothing when none is."""
    item = Markup("surface")
    _add_values(item, "bounce", _bounce(surface))
    friction = Markup("friction")
    _add_values(friction, "ode", _friction(surface))
    if surface.rolling_mu is not None:
        friction.add("bullet").add("rolling_friction", number(surface.rolling_mu))
    if surface.torsional_mu is not None:
        torsional = friction.add("torsional")
        torsional.add("coefficient", number(surface.torsional_mu))
        if surface.torsional_patch_radius_m is not None:
            torsional.add("use_patch_radius", "true")
            torsional.add("patch_radius", number(surface.torsional_patch_radius_m))
    item.children += [friction] if friction.children else []
    contact = Markup("contact")
    if surface.collide_without_contact:
        contact.add("collide_without_contact", "true")
    if surface.collide_bitmask is not None:
        contact.add("collide_bitmask", number(surface.collide_bitmask))
    _add_values(contact, "ode", _surface_contact(surface))
    item.children += [contact] if contact.children else []
    owner.children += [item] if item.children else []


def is_script(material: Material) -> bool:
    """Tell whether a look is one of Gazebo's named ones, unchanged."""
    return bool(material.name) and gazebo_material(material.name) == material


def add_material(owner: Markup, material: Material, output_files: OutputFiles) -> None:
    """Append a ``<material>``: one of Gazebo's scripts by name, else its colours."""
    item = owner.add("material")
    if is_script(material):
        script = item.add("script")
        script.add("uri", _GAZEBO_SCRIPTS)
        script.add("name", material.name)
        return
    for word in ("ambient", "diffuse", "specular", "emissive"):
        item.add(word, numbers(getattr(material, word)))
    if material.shininess:
        item.add("shininess", number(material.shininess))
    if not material.lighting:
        item.add("lighting", "false")
    if material.texture is not None:
        metal = item.add("pbr").add("metal")
        metal.add("albedo_map", output_files.address(material.texture))


def add_light(owner: Markup, light: Light, T_parent_light: Pose) -> None:
    """Append a ``<light>``."""
    item = owner.add("light", name=light.name, type=light.type.value)
    add_pose(item, T_parent_light)
    item.add("cast_shadows", str(light.cast_shadows).lower())
    item.add("intensity", number(light.intensity))
    item.add("diffuse", numbers(light.diffuse))
    item.add("specular", numbers(light.specular))
    item.add("direction", numbers(light.direction))
    attenuation = item.add("attenuation")
    attenuation.add("range", number(light.range_m))
    attenuation.add("constant", number(light.attenuation_constant))
    attenuation.add("linear", number(light.attenuation_linear))
    attenuation.add("quadratic", number(light.attenuation_quadratic))
    if light.type is LightType.SPOT:
        spot = item.add("spot")
        spot.add("inner_angle", number(light.spot_inner_angle_rad))
        spot.add("outer_angle", number(light.spot_outer_angle_rad))
        spot.add("falloff", number(light.spot_falloff))


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


def _bounce(surface: Surface) -> dict[str, str]:
    return _given(
        restitution_coefficient=surface.restitution, threshold=surface.bounce_threshold_m_s
    )


def _friction(surface: Surface) -> dict[str, str]:
    found = _given(mu=surface.mu1, mu2=surface.mu2)
    if surface.fdir1 is not None:
        found["fdir1"] = numbers(surface.fdir1)
    return {**found, **_given(slip1=surface.slip1, slip2=surface.slip2)}


def _surface_contact(surface: Surface) -> dict[str, str]:
    return _given(
        soft_cfm=surface.soft_cfm,
        soft_erp=surface.soft_erp,
        kp=surface.kp,
        kd=surface.kd,
        max_vel=surface.max_vel_m_s,
        min_depth=surface.min_depth_m,
    )


def _given(**values: float | None) -> dict[str, str]:
    return {name: number(value) for name, value in values.items() if value is not None}


def _add_values(owner: Markup, name: str, values: dict[str, str]) -> None:
    if values:
        item = owner.add(name)
        for word, text in values.items():
            item.add(word, text)


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
