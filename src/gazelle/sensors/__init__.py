"""Pure sensors: what a snapshot of the world gives a laser, a camera or an IMU to measure.

Lasers need Embree; cameras also compiled kernels, which `warm_up` loads ahead of time. Nothing
here knows topics, rates or plug-ins.
"""

from __future__ import annotations

from gazelle.sensors.bands import default_threads
from gazelle.sensors.camera import CameraRecord, render
from gazelle.sensors.depth import POINT_DTYPE, depth_image, point_cloud
from gazelle.sensors.distortion import distort, is_distorting
from gazelle.sensors.embree import EmbreeError
from gazelle.sensors.imu import ImuNoise, ImuRecord, LinkMotion, imu_reading
from gazelle.sensors.intrinsics import Intrinsics, camera_intrinsics
from gazelle.sensors.lidar import LidarRecord, ScanAngles, scan, scan_angles, scene_kind
from gazelle.sensors.noise import NoiseSource
from gazelle.sensors.ray_scene import RayScene
from gazelle.sensors.sonar import sonar_range
from gazelle.sensors.surroundings import (
    GeodeticPosition,
    air_pressure_pa,
    altitude_change_m,
    enu_vector,
    geodetic_position,
    magnetic_field,
)
from gazelle.sensors.warming import warm_up

__all__ = [
    "POINT_DTYPE",
    "CameraRecord",
    "EmbreeError",
    "GeodeticPosition",
    "ImuNoise",
    "ImuRecord",
    "Intrinsics",
    "LidarRecord",
    "LinkMotion",
    "NoiseSource",
    "RayScene",
    "ScanAngles",
    "air_pressure_pa",
    "altitude_change_m",
    "camera_intrinsics",
    "default_threads",
    "depth_image",
    "distort",
    "enu_vector",
    "geodetic_position",
    "imu_reading",
    "is_distorting",
    "magnetic_field",
    "point_cloud",
    "render",
    "scan",
    "scan_angles",
    "scene_kind",
    "sonar_range",
    "warm_up",
]
