"""Laser scanners: Gazebo's ``ray`` and ``gpu_ray`` sensors, without kernels."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import LidarSpec
from gazelle.geometry import Pose
from gazelle.noise import NoiseStream
from gazelle.rich_display import shown_by
from gazelle.sensors.embree import NOTHING, PACKET, PACKET_BYTES, library, packet_buffer
from gazelle.sensors.ray_scene import SHADOW_BIT, RayScene

__all__ = ["LidarRecord", "ScanAngles", "cast", "scan", "scan_angles", "scene_kind"]

_EVERYTHING = 0xFFFFFFFF & ~SHADOW_BIT
_SHORT_SCAN = 64
"""Packets (of 2 µs) below which a scan keeps the interpreter lock."""

_ALL_LANES = np.full(PACKET + 16, -1, np.int32)


@dataclass(frozen=True, slots=True)
class ScanAngles:
    """The angles of a scan, radians.

    Attributes:
        horizontal: (H,) yaw of each column, anticlockwise from the sensor's x axis.
        vertical: (V,) elevation of each row, positive upwards.
        increment: between columns; 0 for a single one.
        vertical_increment: between rows; 0 for a single one.
    """

    horizontal: NDArray[np.float64]
    vertical: NDArray[np.float64]
    increment: float
    vertical_increment: float


@shown_by("scans:lidar_bundle")
@dataclass(frozen=True, slots=True, eq=False)
class LidarRecord:
    """One scan; row 0 is the lowest elevation, column 0 the smallest yaw.

    Attributes:
        ranges_m: (V, H) float32; +inf where nothing is met within the range, −inf for a surface
            at or below the smallest range (REP 117).
        intensities: (V, H) float32, the ``laser_retro`` of what was met, 0 for nothing.
        angles: the scan's angles.
    """

    ranges_m: NDArray[np.float32]
    intensities: NDArray[np.float32]
    angles: ScanAngles


def scene_kind(spec: LidarSpec) -> str:
    """Return which `RayScene` a scanner looks at: ``collisions`` for ``ray``, else ``visuals``."""
    return "collisions" if spec.on_collisions else "visuals"


@lru_cache(maxsize=64)
def scan_angles(spec: LidarSpec) -> ScanAngles:
    """Return the sample angles as Gazebo spaces them (MultiRayShape, RaySensor).

    There are ``samples · resolution`` of them from the smallest to the largest angle, both
    included; a single sample looks straight ahead whatever the limits say.
    """
    horizontal, increment = _spread(
        spec.samples, spec.resolution, spec.min_angle_rad, spec.max_angle_rad
    )
    vertical, vertical_increment = _spread(
        spec.vertical_samples,
        spec.vertical_resolution,
        spec.vertical_min_angle_rad,
        spec.vertical_max_angle_rad,
    )
    return ScanAngles(horizontal, vertical, increment, vertical_increment)


def scan(
    scene: RayScene,
    spec: LidarSpec,
    T_world_sensor: Pose,
    *,
    noise: NoiseStream | None = None,
) -> LidarRecord:
    """Take a scan.

    Rays start at the smallest range, so nearer surfaces (the sensor's own housing) are not seen,
    as in Gazebo; no link is left out. Noise comes after the limits are applied and is clamped to
    them (Gazebo's RaySensor). ``<range><resolution>`` has no effect there either.

    Args:
        scene: updated to the moment of the scan.
        spec: the scanner.
        T_world_sensor: the scanner's frame, x forward, z up.
        noise: None for exact ranges.
    """
    directions, angles = _directions(spec)
    rows, columns = len(angles.vertical), len(angles.horizontal)
    distances, hit = cast(
        scene, T_world_sensor, directions, near_m=spec.range_min_m, far_m=spec.range_max_m
    )
    ranges = np.where(distances >= spec.range_max_m, np.inf, distances)
    ranges[distances <= spec.range_min_m] = -np.inf
    if noise is not None and not noise.is_silent:
        seen = np.isfinite(ranges)
        noisy = np.clip(noise.apply(distances), spec.range_min_m, spec.range_max_m)
        ranges = np.where(seen, noisy, ranges)
    retro = np.append(scene.retro, np.float32(0.0))
    intensities = retro[np.where(hit == NOTHING, len(scene.retro), hit)]
    return LidarRecord(
        ranges.astype(np.float32).reshape(rows, columns),
        intensities.reshape(rows, columns),
        angles,
    )


def cast(
    scene: RayScene,
    T_world_sensor: Pose,
    directions: NDArray[np.float32],
    *,
    near_m: float,
    far_m: float,
) -> tuple[NDArray[np.float64], NDArray[np.uint32]]:
    """Cast rays from one point.

    Args:
        scene: what is looked at.
        T_world_sensor: the rays' origin and frame.
        directions: (N, 3) unit vectors in the sensor's frame.
        near_m: where rays begin.
        far_m: where they end.

    Returns:
        distances in metres, inf for nothing, (N,) float64; number of the instance met, `NOTHING`
        for none, (N,) uint32.
    """
    packets = -(-len(directions) // PACKET)
    rays = packet_buffer(packets)
    words = rays.view(np.uint32)
    rotation = T_world_sensor.matrix()[:3, :3].astype(np.float32)
    spread = np.zeros((packets * PACKET, 3), np.float32)
    np.matmul(directions, rotation.T, out=spread[: len(directions)])
    rays[:, 4:7] = spread.reshape(packets, PACKET, 3).transpose(0, 2, 1)
    rays[:, 0:3] = np.asarray(T_world_sensor.position_m, np.float32)[None, :, None]
    rays[:, 3] = near_m
    rays[:, 8] = far_m if math.isfinite(far_m) else np.float32(3e38)
    words[:, 9] = _EVERYTHING
    words[:, 17:21] = NOTHING
    # Lanes past the last ray end before they begin.
    rays.reshape(packets, -1)[
        -1, 8 * PACKET + len(directions) - (packets - 1) * PACKET : 9 * PACKET
    ] = -1
    _trace(scene, rays)
    hit = words[:, 19].reshape(-1)[: len(directions)]
    distances = rays[:, 8].reshape(-1)[: len(directions)].astype(np.float64)
    distances[hit == NOTHING] = np.inf
    return distances, hit


def _trace(scene: RayScene, rays: NDArray[np.float32]) -> None:
    embree = library()
    is_short = len(rays) <= _SHORT_SCAN
    intersect = (embree.quick if is_short else embree.functions).rtcIntersect16
    lanes = _ALL_LANES[-_ALL_LANES.ctypes.data % 64 // 4 :]
    valid, first = lanes.ctypes.data, rays.ctypes.data
    with scene.lock:
        handle = scene.handle
        for number in range(len(rays)):
            intersect(valid, handle, first + number * PACKET_BYTES, None)


@lru_cache(maxsize=64)
def _directions(spec: LidarSpec) -> tuple[NDArray[np.float32], ScanAngles]:
    angles = scan_angles(spec)
    yaw, pitch = np.meshgrid(angles.horizontal, angles.vertical)
    flat = np.cos(pitch)
    vectors = np.stack([flat * np.cos(yaw), flat * np.sin(yaw), np.sin(pitch)], axis=-1)
    return np.ascontiguousarray(vectors.reshape(-1, 3), np.float32), angles


def _spread(
    samples: int, resolution: float, low: float, high: float
) -> tuple[NDArray[np.float64], float]:
    count = max(1, int(samples * resolution))
    if count == 1:
        return np.zeros(1), 0.0
    increment = (high - low) / (count - 1)
    return low + increment * np.arange(count, dtype=np.float64), increment
