"""Elements below ``<sensor>``; the form is described in `gazelle.description.sdf.tables`."""

from __future__ import annotations

__all__ = ["SENSOR_ROWS"]

_XYZ = "x=axis_noise y=axis_noise z=axis_noise"

SENSOR_ROWS: dict[str, tuple[str, str]] = {
    "sensor": (
        "name type",
        "pose update_rate always_on visualize topic gz_frame_id ignition_frame_id "
        "enable_metrics! plugin camera ray lidar=ray imu contact=sensor/contact force_torque gps "
        "navsat=gps magnetometer altimeter air_pressure air_speed! sonar logical_camera "
        "rfid! rfidtag! transceiver!",
    ),
    "camera": (
        "name",
        "pose horizontal_fov image=camera/image clip noise distortion lens depth_camera "
        "optical_frame_id camera_info_topic visibility_mask trigger_topic! save! triggered! "
        "segmentation_type! box_type! anti_aliasing!",
    ),
    "camera/image": ("", "width height format anti_aliasing!"),
    "clip": ("", "near far"),
    "depth_camera": ("", "clip output!"),
    "distortion": ("", "k1 k2 k3 p1 p2 center"),
    "lens": (
        "",
        "intrinsics projection! type! scale_to_hfov! custom_function! cutoff_angle! "
        "env_texture_size!",
    ),
    "intrinsics": ("", "fx fy cx cy s"),
    "noise": (
        "type",
        "type mean stddev bias_mean bias_stddev dynamic_bias_stddev dynamic_bias_correlation_time "
        "precision",
    ),
    "axis_noise": ("", "noise"),
    "ray": ("", "scan range noise visibility_mask!"),
    "scan": ("", "horizontal=scan/line vertical=scan/line"),
    "scan/line": ("", "samples resolution min_angle max_angle"),
    "range": ("", "min max resolution"),
    "imu": (
        "",
        "topic angular_velocity linear_acceleration orientation_reference_frame "
        "enable_orientation noise=imu/noise",
    ),
    "imu/noise": ("", "type rate=noise accel=noise"),
    "angular_velocity": ("", _XYZ),
    "linear_acceleration": ("", _XYZ),
    "orientation_reference_frame": ("", "localization custom_rpy grav_dir_x!"),
    "sensor/contact": ("", "collision=value topic"),
    "force_torque": ("", "frame=value measure_direction force torque"),
    "value": ("", ""),
    "force": ("", _XYZ),
    "torque": ("", _XYZ),
    "gps": ("", "position_sensing velocity_sensing topic"),
    "position_sensing": ("", "horizontal=axis_noise vertical=axis_noise"),
    "velocity_sensing": ("", "horizontal=axis_noise vertical=axis_noise"),
    "magnetometer": ("", _XYZ),
    "altimeter": ("", "vertical_position=axis_noise vertical_velocity=axis_noise"),
    "air_pressure": ("", "reference_altitude pressure=axis_noise"),
    "sonar": ("", "geometry=value min max radius"),
    "logical_camera": ("", "near far horizontal_fov aspect_ratio"),
}
