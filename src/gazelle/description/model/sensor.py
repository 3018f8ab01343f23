"""Sensors as the files describe them, one spec per kind."""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle.description.model.plugin import PluginTag
from gazelle.diagnostics import SourceSpan
from gazelle.geometry import IDENTITY_POSE, Pose
from gazelle.noise import NO_NOISE, Noise

__all__ = [
    "AltimeterSpec",
    "CameraSpec",
    "ContactSpec",
    "ForceTorqueSpec",
    "GpsSpec",
    "ImuSpec",
    "LensDistortion",
    "LidarSpec",
    "LogicalCameraSpec",
    "MagnetometerSpec",
    "OtherSensorSpec",
    "PressureSpec",
    "Sensor",
    "SensorSpec",
    "SonarSpec",
]

Noise3 = tuple[Noise, Noise, Noise]
_NO_NOISE3: Noise3 = (NO_NOISE, NO_NOISE, NO_NOISE)


@dataclass(frozen=True, slots=True)
class LidarSpec:
    """``ray``, ``gpu_ray``, ``lidar``, ``gpu_lidar``: angles in radians, ranges in metres.

    `on_collisions` is True for ``ray`` (it hits collisions), False for the GPU kinds (visuals).
    """

    samples: int = 640
    min_angle_rad: float = 0.0
    max_angle_rad: float = 0.0
    resolution: float = 1.0
    vertical_samples: int = 1
    vertical_min_angle_rad: float = 0.0
    vertical_max_angle_rad: float = 0.0
    vertical_resolution: float = 1.0
    range_min_m: float = 0.0
    range_max_m: float = 0.0
    range_resolution_m: float = 0.0
    noise: Noise = NO_NOISE
    on_collisions: bool = True


@dataclass(frozen=True, slots=True)
class LensDistortion:
    """Brown's plumb-bob coefficients as SDF names them; `center` in fractions of the image."""

    k1: float = 0.0
    k2: float = 0.0
    k3: float = 0.0
    p1: float = 0.0
    p2: float = 0.0
    center: tuple[float, float] = (0.5, 0.5)


@dataclass(frozen=True, slots=True)
class CameraSpec:
    """``camera``, ``depth``, ``rgbd_camera``, ``multicamera``'s members and their kin.

    Attributes:
        kind: ``rgb``, ``depth``, ``rgbd`` or ``wideangle``.
        T_sensor_camera: pose of the camera in the sensor's frame (x forward, z up).
        horizontal_fov_rad: full horizontal angle of view.
        pixel_format: SDF's word, such as ``R8G8B8`` or ``L8``.
        near_m, far_m: clip distances.
        depth_near_m, depth_far_m: the depth camera's own clip, None for the common one.
        intrinsics: fx, fy, cx, cy, s when ``<lens><intrinsics>`` gives them.
    """

    name: str = "camera"
    kind: str = "rgb"
    T_sensor_camera: Pose = IDENTITY_POSE
    horizontal_fov_rad: float = 1.047
    width_px: int = 320
    height_px: int = 240
    pixel_format: str = "R8G8B8"
    near_m: float = 0.1
    far_m: float = 100.0
    depth_near_m: float | None = None
    depth_far_m: float | None = None
    noise: Noise = NO_NOISE
    distortion: LensDistortion | None = None
    intrinsics: tuple[float, float, float, float, float] | None = None
    optical_frame_id: str = ""
    camera_info_topic: str = ""
    visibility_mask: int = 0xFFFFFFFF
    members: tuple[CameraSpec, ...] = ()


@dataclass(frozen=True, slots=True)
class ImuSpec:
    """``imu``: noise per axis for angular velocity (rad/s) and acceleration (m/s²)."""

    angular_velocity_noise: Noise3 = _NO_NOISE3
    linear_acceleration_noise: Noise3 = _NO_NOISE3
    localization: str = ""
    custom_rpy_rad: tuple[float, float, float] = (0.0, 0.0, 0.0)
    enable_orientation: bool = True


@dataclass(frozen=True, slots=True)
class ContactSpec:
    """``contact``: names of the collisions watched."""

    collisions: tuple[str, ...] = ()
    topic: str = ""


@dataclass(frozen=True, slots=True)
class ForceTorqueSpec:
    """``force_torque``: measured in `frame` (child, parent or sensor)."""

    frame: str = "child"
    measure_direction: str = "child_to_parent"
    force_noise: Noise3 = _NO_NOISE3
    torque_noise: Noise3 = _NO_NOISE3


@dataclass(frozen=True, slots=True)
class GpsSpec:
    """``gps`` and ``navsat``."""

    horizontal_position_noise: Noise = NO_NOISE
    vertical_position_noise: Noise = NO_NOISE
    horizontal_velocity_noise: Noise = NO_NOISE
    vertical_velocity_noise: Noise = NO_NOISE


@dataclass(frozen=True, slots=True)
class MagnetometerSpec:
    """``magnetometer``: noise per axis, tesla."""

    noise: Noise3 = _NO_NOISE3


@dataclass(frozen=True, slots=True)
class AltimeterSpec:
    """``altimeter``."""

    position_noise: Noise = NO_NOISE
    velocity_noise: Noise = NO_NOISE


@dataclass(frozen=True, slots=True)
class PressureSpec:
    """``air_pressure``."""

    reference_altitude_m: float = 0.0
    noise: Noise = NO_NOISE


@dataclass(frozen=True, slots=True)
class SonarSpec:
    """``sonar``: a cone or sphere of the given radius at `max_m`."""

    geometry: str = "cone"
    min_m: float = 0.0
    max_m: float = 1.0
    radius_m: float = 0.5


@dataclass(frozen=True, slots=True)
class LogicalCameraSpec:
    """``logical_camera``: models inside the frustum."""

    near_m: float = 0.0
    far_m: float = 1.0
    horizontal_fov_rad: float = 1.0
    aspect_ratio: float = 1.0


@dataclass(frozen=True, slots=True)
class OtherSensorSpec:
    """A kind that is known by name only; reported, not simulated."""

    type: str


SensorSpec = (
    LidarSpec
    | CameraSpec
    | ImuSpec
    | ContactSpec
    | ForceTorqueSpec
    | GpsSpec
    | MagnetometerSpec
    | AltimeterSpec
    | PressureSpec
    | SonarSpec
    | LogicalCameraSpec
    | OtherSensorSpec
)


@dataclass(frozen=True, slots=True)
class Sensor:
    """A sensor on a link (or a force-torque sensor on a joint).

    Attributes:
        name: name within the link.
        type: SDF's word, such as ``ray`` or ``depth``.
        T_link_sensor: pose in the link's frame.
        update_rate_hz: 0 means every step.
        topic: Gazebo or gz topic named in the file, may be empty.
        frame_id: ``<gz_frame_id>`` or ``<ignition_frame_id>``, may be empty.
    """

    name: str
    type: str
    spec: SensorSpec
    T_link_sensor: Pose = IDENTITY_POSE
    update_rate_hz: float = 0.0
    always_on: bool = False
    visualize: bool = False
    topic: str = ""
    frame_id: str = ""
    plugins: tuple[PluginTag, ...] = field(default=())
    span: SourceSpan | None = None
