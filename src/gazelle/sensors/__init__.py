"""Pure sensors: what a snapshot of the world gives a laser, a camera or an IMU to measure.

Lasers need Embree; cameras also compiled kernels, which `warm_up` loads ahead of time. Nothing
here knows topics, rates or plug-ins.
"""

from __future__ import annotations

from gazelle.noise import (
    NOISE_MODELS,
    DriftModel,
    DriftNoise,
    NoiseModel,
    NoiseStream,
    PictureNoise,
)
from gazelle.sensors.camera import CameraRecord, render
from gazelle.sensors.contact import ContactRecord, link_wrenches, watched_contacts
from gazelle.sensors.depth import POINT_DTYPE, depth_image, point_cloud
from gazelle.sensors.distortion import distort, is_distorting
from gazelle.sensors.embree import EmbreeError
from gazelle.sensors.force_torque import JointLoad, WrenchRecord, force_torque_reading
from gazelle.sensors.geodesy import (
    GeodeticPosition,
    classic_origin,
    enu_vector,
    geodetic_position,
    local_position,
)
from gazelle.sensors.gps import (
    GpsRecord,
    flat_earth_position,
    gps_noise,
    gps_reading,
    north_west_up,
)
from gazelle.sensors.imu import ImuRecord, LinkMotion, imu_noise, imu_reading
from gazelle.sensors.intrinsics import Intrinsics, camera_intrinsics
from gazelle.sensors.kernel_warm_up import warm_up
from gazelle.sensors.lidar import LidarRecord, ScanAngles, scan, scan_angles, scene_kind
from gazelle.sensors.magnetometer_altimeter_barometer import (
    AltimeterRecord,
    MagnetometerRecord,
    PressureRecord,
    air_pressure_pa,
    altitude_change_m,
    magnetic_field,
)
from gazelle.sensors.noise_streams import VectorNoise, noise_stream, picture_noise
from gazelle.sensors.ray_scene import RayScene
from gazelle.sensors.row_threads import default_threads
from gazelle.sensors.sonar import SonarRecord, sonar_range

__all__ = [
    "NOISE_MODELS",
    "POINT_DTYPE",
    "AltimeterRecord",
    "CameraRecord",
    "ContactRecord",
    "DriftModel",
    "DriftNoise",
    "EmbreeError",
    "GeodeticPosition",
    "GpsRecord",
    "ImuRecord",
    "Intrinsics",
    "JointLoad",
    "LidarRecord",
    "LinkMotion",
    "MagnetometerRecord",
    "NoiseModel",
    "NoiseStream",
    "PictureNoise",
    "PressureRecord",
    "RayScene",
    "ScanAngles",
    "SonarRecord",
    "VectorNoise",
    "WrenchRecord",
    "air_pressure_pa",
    "altitude_change_m",
    "camera_intrinsics",
    "classic_origin",
    "default_threads",
    "depth_image",
    "distort",
    "enu_vector",
    "flat_earth_position",
    "force_torque_reading",
    "geodetic_position",
    "gps_noise",
    "gps_reading",
    "imu_noise",
    "imu_reading",
    "is_distorting",
    "link_wrenches",
    "local_position",
    "magnetic_field",
    "noise_stream",
    "north_west_up",
    "picture_noise",
    "point_cloud",
    "render",
    "scan",
    "scan_angles",
    "scene_kind",
    "sonar_range",
    "warm_up",
    "watched_contacts",
]
