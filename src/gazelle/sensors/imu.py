"""Inertial measurement units."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import ImuSpec
from gazelle.geometry import IDENTITY_POSE, Pose, Vector3, cross, quat_xyzw_from_rpy
from gazelle.sensors.noise_streams import VectorNoise

__all__ = ["ImuRecord", "LinkMotion", "imu_noise", "imu_reading"]

QuatXyzw = tuple[float, float, float, float]

_ENU: QuatXyzw = (0.0, 0.0, 0.0, 1.0)
_NED_RPY = (np.pi, 0.0, np.pi / 2)
_AXES = [f"{part}/{axis}" for part in ("angular_velocity", "linear_acceleration") for axis in "xyz"]
_NWU_RPY = (0.0, 0.0, np.pi / 2)


@dataclass(frozen=True, slots=True, eq=False)
class LinkMotion:
    """How a link moves; vectors are (3,) float64 in world coordinates.

    Attributes:
        T_world_link: pose of the link's frame.
        angular_velocity_rad_s: of the link.
        linear_acceleration_m_s2: of the link's origin: 0 at rest, g in free fall.
        angular_acceleration_rad_s2: of the link.
    """

    T_world_link: Pose
    angular_velocity_rad_s: NDArray[np.float64]
    linear_acceleration_m_s2: NDArray[np.float64]
    angular_acceleration_rad_s2: NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class ImuRecord:
    """One reading, in the sensor's frame.

    Attributes:
        orientation_xyzw: of the sensor in the reference frame.
        angular_velocity_rad_s: (3,) float64.
        linear_acceleration_m_s2: (3,) float64, specific force: +g upwards at rest.
    """

    orientation_xyzw: QuatXyzw
    angular_velocity_rad_s: NDArray[np.float64]
    linear_acceleration_m_s2: NDArray[np.float64]


def imu_noise(spec: ImuSpec, seed: int, name: str) -> VectorNoise:
    """Return the six noises of an IMU: angular velocity, then linear acceleration."""
    noises = (*spec.angular_velocity_noise, *spec.linear_acceleration_noise)
    return VectorNoise(noises, seed, name, axes=_AXES)


def imu_reading(
    motion: LinkMotion,
    spec: ImuSpec,
    gravity_m_s2: Vector3,
    *,
    T_link_sensor: Pose = IDENTITY_POSE,
    noise: VectorNoise | None = None,
    dt_s: float = 0.0,
    initial_xyzw: QuatXyzw = _ENU,
) -> ImuRecord:
    """Read an IMU.

    The sensor's own acceleration is ``a + α × r + ω × (ω × r)`` with r from the link's origin to
    the sensor; what it feels is that less gravity, turned into its frame (Gazebo's ImuSensor
    takes the same from differences of velocity).

    Args:
        motion: of the link that carries it.
        spec: the IMU; says what its orientation refers to.
        gravity_m_s2: the world's.
        T_link_sensor: its frame on the link.
        noise: from `imu_noise`, None for a clean reading.
        dt_s: simulated time since the last reading, for walking biases.
        initial_xyzw: what the orientation refers to when the spec does not say; Gazebo's sensor
            takes its own orientation at the start, gazebo_ros_imu the world (the default).
    """
    T_world_sensor = motion.T_world_link @ T_link_sensor
    arm = np.array(motion.T_world_link.rotate(T_link_sensor.position_m))
    omega = motion.angular_velocity_rad_s
    acceleration = (
        motion.linear_acceleration_m_s2
        + cross(motion.angular_acceleration_rad_s2, arm)
        + cross(omega, cross(omega, arm))
    )
    to_sensor = T_world_sensor.matrix()[:3, :3].T
    rate = to_sensor @ omega
    force = to_sensor @ (acceleration - np.array(gravity_m_s2))
    if noise is not None:
        rate, force = np.split(noise.apply(np.concatenate((rate, force)), dt_s=dt_s), 2)
    reference = Pose(quat_xyzw=_reference(spec, initial_xyzw)).inverse()
    return ImuRecord((reference @ T_world_sensor).quat_xyzw, rate, force)


def _reference(spec: ImuSpec, initial_xyzw: QuatXyzw) -> QuatXyzw:
    """Return the reference frame's orientation in the world, which is ENU (REP-103).

    ``<orientation_reference_frame><localization>``: NED and NWU are turned frames, CUSTOM is
    ``<custom_rpy>``.
    """
    match spec.localization:
        case "ENU":
            return _ENU
        case "NED":
            return quat_xyzw_from_rpy(_NED_RPY)
        case "NWU":
            return quat_xyzw_from_rpy(_NWU_RPY)
        case "CUSTOM":
            return quat_xyzw_from_rpy(spec.custom_rpy_rad)
        case _:
            return initial_xyzw
