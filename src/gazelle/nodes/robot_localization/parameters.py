"""The parameters of the filters of motion: which are read, and why others have no effect.

robot_localization (its ``ekf_template.yaml`` and documentation), robot_pose_ekf
(wiki.ros.org/robot_pose_ekf).
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from typing import Any

from gazelle.parameters import Parameter, ParameterTable, refused

__all__ = ["EKF", "POSE_EKF", "ekf_inputs", "ekf_table", "threshold_owners"]

_TYPES = {
    "odom": "nav_msgs/Odometry",
    "pose": "geometry_msgs/PoseWithCovarianceStamped",
    "twist": "geometry_msgs/TwistWithCovarianceStamped",
    "imu": "sensor_msgs/Imu",
}
_KINDS = tuple(_TYPES)
_INPUT = re.compile(rf"({'|'.join(_KINDS)})(\d+)")
_SQUARE = "15 × 15 numbers or 15 of the diagonal"
_BEYOND = "messages farther from the state are left out, as a Mahalanobis distance"
_INSIDE = "what the original tells of its inside; its state is on the topic"
_AS_THEY_COME = "messages count when they come, those older than a second do not"
_LATEST = "the latest transform is taken"
_COMMANDS = "commands do not count; odometry and IMU do"
_QUEUES = "as many messages wait as the node needs"
_EKF_ROWS = (
    Parameter("frequency", "number", 30.0, "states a second", "Hz", 0.1),
    Parameter("two_d_mode", "flag", False, "the robot stays in the plane"),
    Parameter("map_frame", "text", "map", "the map's frame"),
    Parameter("odom_frame", "text", "odom", "odometry's frame"),
    Parameter("base_link_frame", "text", "base_link", "the robot's frame"),
    Parameter("world_frame", "text", None, "the state's, `odom_frame` when absent"),
    Parameter("publish_tf", "flag", True, "whether the transform is sent"),
    Parameter("transform_time_offset", "number", 0.0, "transforms are dated so far ahead", "s"),
    Parameter("process_noise_covariance", "any", None, f"growth of the covariance, {_SQUARE}"),
    Parameter("initial_estimate_covariance", "any", None, f"the same at the start, {_SQUARE}"),
    Parameter("initial_state", "numbers", (), "the 15 states at the start, zeros when absent"),
    *refused(_COMMANDS, "use_control", "stamped_control", unless=False),
    *refused(_COMMANDS, "control_timeout", "control_config", "acceleration_limits",
             "deceleration_limits", "acceleration_gains", "deceleration_gains"),
    *refused(_AS_THEY_COME, "smooth_lagged_data", "predict_to_current_time",
             "permit_corrected_publication", unless=False),
    *refused(_AS_THEY_COME, "history_length", "sensor_timeout"),
    *refused("accelerations are not published", "publish_acceleration", unless=False),
    *refused("the process noise is the same at every speed", "dynamic_process_noise_covariance",
             unless=False),
    *refused(_LATEST, "transform_timeout"),
    *refused(_LATEST, "silent_tf_failure", unless=False),
    *refused(_INSIDE, "print_diagnostics", "debug", unless=False),
    *refused(_INSIDE, "debug_out_file"),
    *refused("the filter starts at once", "disabled_at_startup", unless=False),
    *refused("a jump back in time is not followed; set_pose begins anew", "reset_on_time_jump",
             unless=False),
    *refused("gravity is 9.80665 m/s²", "gravitational_acceleration", unless=9.80665),
    *refused("frames have the names that the other parameters give", "tf_prefix",
             "base_link_frame_output"),
)  # fmt: skip

POSE_EKF = ParameterTable(
    "robot_pose_ekf",
    "Fuses wheel odometry, IMU and visual odometry.",
    ("robot_pose_ekf/robot_pose_ekf",),
    (
        Parameter("freq", "number", 30.0, "states a second", "Hz", 0.1),
        Parameter("base_footprint_frame", "text", "base_footprint", "the robot's frame"),
        Parameter("output_frame", "text", "odom_combined", "the frame of the state"),
        Parameter("odom_used", "flag", True, "whether wheel odometry counts"),
        Parameter("imu_used", "flag", True, "whether the IMU counts"),
        Parameter("vo_used", "flag", True, "whether visual odometry counts"),
        *refused(
            "positions of satellites are not fused; robot_localization's pose0 takes them",
            "gps_used",
            unless=False,
        ),
        *refused("an input counts whenever it comes", "sensor_timeout"),
        *refused(_INSIDE, "debug", "self_diagnose", unless=False),
        *refused("frames have the names that the other parameters give", "tf_prefix"),
    ),
)


def ekf_inputs(tree: Mapping[str, Any]) -> list[str]:
    """Return the inputs that a tree has topics for: odometry first, then poses, twists and IMUs."""
    found = [match for key in tree if (match := _INPUT.fullmatch(key))]
    return [one[0] for one in sorted(found, key=lambda one: (_KINDS.index(one[1]), int(one[2])))]


def ekf_table(tree: Mapping[str, Any]) -> ParameterTable:
    """Return `EKF` with rows for the inputs that a tree names instead of the first of each kind."""
    names = {found[0] for key in tree if (found := _INPUT.match(key))}
    return _ekf_table(sorted(names)) if names else EKF


def threshold_owners(name: str) -> dict[str, str]:
    """Return what the rejection thresholds of an input are named after, with the part meant."""
    if name.startswith(("pose", "twist")):
        return {name: name.rstrip("0123456789")}
    return {f"{name}_pose": "pose", f"{name}_twist": "twist"}


def _ekf_table(inputs: Iterable[str]) -> ParameterTable:
    return ParameterTable(
        "robot_localization",
        "Fuses odometry, IMUs, poses and twists with an extended Kalman filter. Inputs are"
        " numbered: there may be odom1, imu2 and so on.",
        ("robot_localization/ekf_localization_node", "robot_localization/ekf_node"),
        (*_EKF_ROWS, *(row for name in inputs for row in _input_rows(name))),
    )


def _input_rows(name: str) -> tuple[Parameter, ...]:
    kind = name.rstrip("0123456789")
    poses = () if kind == "twist" else (
        Parameter(f"{name}_differential", "flag", False, "poses count as velocities between them"),
        Parameter(f"{name}_relative", "flag", False, "poses count from the first one"),
    )  # fmt: skip
    gravity = Parameter(
        f"{name}_remove_gravitational_acceleration", "flag", False, "gravity is no part"
    )
    accelerations = refused(
        "accelerations share the threshold of the twist",
        f"{name}_linear_acceleration_rejection_threshold",
    )
    child_frame = refused("poses are those of the child frame", f"{name}_pose_use_child_frame")
    return (
        Parameter(name, "text", None, f"topic of `{_TYPES[kind]}`"),
        Parameter(f"{name}_config", "any", None, "which of the 15 states count, as truth values"),
        *poses,
        *(
            Parameter(f"{owner}_rejection_threshold", "number", math.inf, _BEYOND)
            for owner in threshold_owners(name)
        ),
        *((gravity, *accelerations) if kind == "imu" else ()),
        *(child_frame if kind in ("odom", "pose") else ()),
        *refused(_QUEUES, f"{name}_queue_size", f"{name}_nodelay"),
    )


EKF = _ekf_table(f"{kind}0" for kind in _KINDS)
