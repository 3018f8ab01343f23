"""The parameters of the filters of motion: which are read, and why others have no effect.

robot_localization (its ``ekf_template.yaml`` and documentation), robot_pose_ekf
(wiki.ros.org/robot_pose_ekf).
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from gazelle.diagnostics import Diagnostics
from gazelle.nodes.parameter_reading import node_reader
from gazelle.parameters import Parameter, ParameterTable, refused

__all__ = ["POSE_EKF", "SWITCHES", "ekf_table", "report_ekf", "report_pose_ekf", "threshold_owners"]

_INPUT = re.compile(r"(odom|pose|twist|imu)\d+")
_INSIDE = "what the original tells of its inside; its state is on the topic"
_AS_THEY_COME = "messages count when they come, those older than a second do not"
_LATEST = "the latest transform is taken"
_COMMANDS = "commands do not count; odometry and IMU do"
_QUEUES = "as many messages wait as the node needs"
# They ask for nothing while they are false.
SWITCHES = frozenset(
    {
        "debug", "disabled_at_startup", "dynamic_process_noise_covariance", "gps_used",
        "permit_corrected_publication", "predict_to_current_time", "print_diagnostics",
        "publish_acceleration", "reset_on_time_jump", "self_diagnose", "silent_tf_failure",
        "smooth_lagged_data", "stamped_control", "use_control",
    }
)  # fmt: skip
_EKF_ROWS = (
    Parameter("frequency", "number", 30.0, "states a second", "Hz"),
    Parameter("two_d_mode", "flag", False, "the robot stays in the plane"),
    Parameter("map_frame", "text", "map", "the map's frame"),
    Parameter("odom_frame", "text", "odom", "odometry's frame"),
    Parameter("base_link_frame", "text", "base_link", "the robot's frame"),
    Parameter("world_frame", "text", "odom", "the frame of the state: odometry's or the map's"),
    Parameter("publish_tf", "flag", True, "whether the transform is sent"),
    Parameter("transform_time_offset", "number", 0.0, "transforms are dated so far ahead", "s"),
    Parameter("process_noise_covariance", "any", None, "growth of the state's covariance"),
    Parameter("initial_estimate_covariance", "any", None, "the state's covariance at the start"),
    Parameter("initial_state", "any", None, "the state at the start"),
    *refused(_COMMANDS, "use_control", "stamped_control", "control_timeout", "control_config",
             "acceleration_limits", "deceleration_limits", "acceleration_gains",
             "deceleration_gains"),
    *refused(_AS_THEY_COME, "smooth_lagged_data", "history_length", "predict_to_current_time",
             "sensor_timeout", "permit_corrected_publication"),
    *refused("accelerations are not published", "publish_acceleration"),
    *refused("the process noise is the same at every speed", "dynamic_process_noise_covariance"),
    *refused(_LATEST, "transform_timeout", "silent_tf_failure"),
    *refused(_INSIDE, "print_diagnostics", "debug", "debug_out_file"),
    *refused("the filter starts at once", "disabled_at_startup"),
    *refused("a jump back in time is not followed; set_pose begins anew", "reset_on_time_jump"),
    *refused("gravity is 9.80665 m/s²", "gravitational_acceleration"),
    *refused("frames have the names that the other parameters give", "tf_prefix",
             "base_link_frame_output"),
)  # fmt: skip

POSE_EKF = ParameterTable(
    "robot_pose_ekf",
    "Fuses wheel odometry, IMU and visual odometry.",
    ("robot_pose_ekf/robot_pose_ekf",),
    (
        Parameter("freq", "number", 30.0, "states a second", "Hz"),
        Parameter("base_footprint_frame", "text", "base_footprint", "the robot's frame"),
        Parameter("output_frame", "text", "odom_combined", "the frame of the state"),
        Parameter("odom_used", "flag", True, "whether wheel odometry counts"),
        Parameter("imu_used", "flag", True, "whether the IMU counts"),
        Parameter("vo_used", "flag", True, "whether visual odometry counts"),
        *refused(
            "positions of satellites are not fused; robot_localization's pose0 takes them",
            "gps_used",
        ),
        *refused("an input counts whenever it comes", "sensor_timeout"),
        *refused(_INSIDE, "debug", "self_diagnose"),
        *refused("frames have the names that the other parameters give", "tf_prefix"),
    ),
)


def ekf_table(tree: Mapping[str, Any]) -> ParameterTable:
    """Return the parameters of ``ekf_localization_node`` with the inputs that a tree gives."""
    names = sorted({found[0] for key in tree if (found := _INPUT.match(key))})
    rows = [row for name in names or ("odom0",) for row in _input_rows(name)]
    return ParameterTable(
        "robot_localization",
        "Fuses odometry, IMU and poses.",
        ("robot_localization/ekf_localization_node", "robot_localization/ekf_node"),
        (*_EKF_ROWS, *rows),
    )


def report_ekf(tree: Mapping[str, Any], name: str, diagnostics: Diagnostics) -> None:
    """Report parameters of ``ekf_localization_node`` that are unknown or have no effect."""
    _report(ekf_table(tree), tree, name, diagnostics)


def report_pose_ekf(tree: Mapping[str, Any], name: str, diagnostics: Diagnostics) -> None:
    """Report parameters of ``robot_pose_ekf`` that are unknown or have no effect."""
    _report(POSE_EKF, tree, name, diagnostics)


def threshold_owners(name: str) -> dict[str, str]:
    """Return what the rejection thresholds of an input are named after, with the part meant."""
    if name.startswith(("pose", "twist")):
        return {name: name.rstrip("0123456789")}
    return {f"{name}_pose": "pose", f"{name}_twist": "twist"}


def _report(
    table: ParameterTable, tree: Mapping[str, Any], name: str, diagnostics: Diagnostics
) -> None:
    asked = {key: value for key, value in tree.items() if value or key not in SWITCHES}
    node_reader(table, asked, name, diagnostics).report_unknown()


def _input_rows(name: str) -> tuple[Parameter, ...]:
    kind = name.rstrip("0123456789")
    poses = () if kind == "twist" else (
        Parameter(f"{name}_differential", "flag", False, "poses count as velocities between them"),
        Parameter(f"{name}_relative", "flag", False, "poses count from the first one"),
    )  # fmt: skip
    gravity = Parameter(
        f"{name}_remove_gravitational_acceleration", "flag", False, "gravity is no part"
    )
    return (
        Parameter(name, "text", None, "topic of the input"),
        Parameter(f"{name}_config", "any", None, "which of the 15 states count"),
        *poses,
        *(
            Parameter(
                f"{owner}_rejection_threshold", "number", None, "beyond it messages are left out"
            )
            for owner in threshold_owners(name)
        ),
        *((gravity,) if kind == "imu" else ()),
        *refused(
            "accelerations share the threshold of the pose",
            f"{name}_linear_acceleration_rejection_threshold",
        ),
        *refused(_QUEUES, f"{name}_queue_size", f"{name}_nodelay"),
        *refused("poses are those of the child frame", f"{name}_pose_use_child_frame"),
    )
