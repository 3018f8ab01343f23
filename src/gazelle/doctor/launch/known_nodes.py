"""Nodes of ROS that nobody here runs: which joint states and transforms they send.

That is known of the common ones from their documentation (wiki.ros.org/<package>); all of their
topics are not listed, so nothing is said of remaps and topics.
"""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.doctor.launch.launched import Launched, LaunchedNode

__all__ = ["KnownNode", "known_node"]

# None of their nodes sends joint states or transforms.
_QUIET = frozenset(
    {
        "depth_image_proc",
        "depthimage_to_laserscan",
        "diagnostic_aggregator",
        "explore_lite",
        "frontier_exploration",
        "image_proc",
        "image_transport",
        "image_view",
        "interactive_marker_twist_server",
        "joy",
        "joy_teleop",
        "laser_filters",
        "map_server",
        "move_base",
        "moveit_ros_visualization",
        "pointcloud_to_laserscan",
        "rosbridge_server",
        "rqt_gui",
        "rviz",
        "stereo_image_proc",
        "teleop_twist_joy",
        "teleop_twist_keyboard",
        "turtlebot3_teleop",
        "twist_mux",
        "web_video_server",
        "yocs_cmd_vel_mux",
    }
)
_QUIET_FAMILY = "rqt_"
# What a localiser's transform connects: parameters of the two frames, with their defaults.
_LOCALISERS = {
    ("amcl", "amcl"): (("global_frame_id", "map"), ("odom_frame_id", "odom")),
    ("fake_localization", "fake_localization"): (
        ("global_frame_id", "map"),
        ("odom_frame_id", "odom"),
    ),
    ("gmapping", "slam_gmapping"): (("map_frame", "map"), ("odom_frame", "odom")),
    ("slam_gmapping", "slam_gmapping"): (("map_frame", "map"), ("odom_frame", "odom")),
    ("slam_karto", "slam_karto"): (("map_frame", "map"), ("odom_frame", "odom")),
}
_FILTERS = frozenset({"ekf_localization_node", "ukf_localization_node"})
# They send transforms, which depend on more than parameters of a launch.
_SENDING = frozenset({"cartographer_ros", "hector_mapping", "rtabmap_ros", "slam_toolbox"})


@dataclass(frozen=True, slots=True)
class KnownNode:
    """A node that sends no joint states.

    Attributes:
        transforms: parent and child of each it sends; None when they cannot be told.
    """

    transforms: tuple[tuple[str, str], ...] | None = ()


def known_node(node: LaunchedNode, launched: Launched) -> KnownNode | None:
    """Return what is known of a node by its package and type; None when it may send anything."""
    package, type_ = node.spec.package, node.spec.type
    if package in _QUIET or package.startswith(_QUIET_FAMILY):
        return KnownNode()
    if package in _SENDING:
        return KnownNode(None)
    if package == "robot_localization":
        return KnownNode(_filtered(node, launched) if type_ in _FILTERS else None)
    frames = _LOCALISERS.get((package, type_))
    if frames is None:
        return None
    (parent, above), (child, below) = frames
    return KnownNode(
        ((_frame(node, launched, parent, above), _frame(node, launched, child, below)),)
    )


def _filtered(node: LaunchedNode, launched: Launched) -> tuple[tuple[str, str], ...]:
    """Return what a filter of robot_localization sends, by REP 105 from its world frame."""
    if launched.private(node, "publish_tf", True) is False:
        return ()
    odom = _frame(node, launched, "odom_frame", "odom")
    world = _frame(node, launched, "world_frame", odom)
    base = _frame(node, launched, "base_link_frame", "base_link")
    return ((world, odom if world == _frame(node, launched, "map_frame", "map") else base),)


def _frame(node: LaunchedNode, launched: Launched, name: str, default: str) -> str:
    return str(launched.private(node, name, default)).strip("/")
