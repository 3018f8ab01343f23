"""Names of built-in nodes of maps, localisation and scans."""

from __future__ import annotations

from typing import NamedTuple

__all__ = ["LOCALISATION", "LocalisationNode"]


class LocalisationNode(NamedTuple):
    """A row; see `gazelle.nodes.registry.BuiltinNode`. The target lies in ``gazelle.nodes``."""

    package: str
    type: str
    target: str
    light: bool
    help: str
    name: str = ""


LOCALISATION = (
    LocalisationNode(
        "map_server", "map_server", "map_server.server:run", False, "publishes a map from a file"
    ),
    LocalisationNode(
        "map_server", "map_saver", "map_server.saver:run", False, "writes the map that is published"
    ),
    LocalisationNode(
        "nav2_map_server",
        "map_server",
        "map_server.server_ros2:run",
        False,
        "publishes a map from a file, ROS 2's package",
    ),
    LocalisationNode(
        "nav2_map_server",
        "map_saver_cli",
        "map_server.saver:run_cli",
        False,
        "writes the map that is published, ROS 2's package",
    ),
    LocalisationNode(
        "nav2_map_server",
        "map_saver_server",
        "map_server.saver:run_server",
        False,
        "writes maps on request",
        "map_saver",
    ),
    LocalisationNode("amcl", "amcl", "amcl.node:run", False, "finds the robot in a map"),
    LocalisationNode(
        "fake_localization",
        "fake_localization",
        "fake_localization:run",
        True,
        "gives the simulator's true pose in the place of amcl's",
    ),
    LocalisationNode(
        "nav2_amcl",
        "amcl",
        "amcl.node:run_ros2",
        False,
        "finds the robot in a map, ROS 2's package",
    ),
    LocalisationNode(
        "depthimage_to_laserscan",
        "depthimage_to_laserscan",
        "filters.flattening:run_depth",
        True,
        "makes scans of depth pictures",
    ),
    LocalisationNode(
        "depthimage_to_laserscan",
        "depthimage_to_laserscan_node",
        "filters.flattening:run_depth",
        True,
        "makes scans of depth pictures, ROS 2's name",
        "depthimage_to_laserscan",
    ),
    LocalisationNode(
        "pointcloud_to_laserscan",
        "pointcloud_to_laserscan_node",
        "filters.flattening:run_clouds",
        True,
        "makes scans of point clouds",
        "pointcloud_to_laserscan",
    ),
    LocalisationNode(
        "laser_filters",
        "scan_to_scan_filter_chain",
        "filters.laser_filters:run",
        True,
        "takes out of scans what does not belong there",
    ),
    LocalisationNode(
        "robot_localization",
        "ekf_localization_node",
        "filters.ekf:run",
        False,
        "fuses odometry, IMU and poses",
    ),
    LocalisationNode(
        "robot_localization",
        "ekf_node",
        "filters.ekf:run",
        False,
        "fuses odometry, IMU and poses, ROS 2's name",
        "ekf_filter_node",
    ),
    LocalisationNode(
        "tf",
        "tf_remap",
        "tf_remap:run",
        True,
        "publishes transforms with other names of frames",
        "tf_remapper",
    ),
    LocalisationNode(
        "robot_pose_ekf",
        "robot_pose_ekf",
        "filters.pose_ekf:run",
        False,
        "fuses wheel odometry, IMU and visual odometry",
    ),
)
