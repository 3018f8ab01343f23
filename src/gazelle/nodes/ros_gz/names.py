"""Names of the nodes of ros_gz, for the registry."""

from __future__ import annotations

__all__ = ["ROS_GZ_NAMES"]

# Package, type, function, light, help, other names, the node's own name.
ROS_GZ_NAMES: tuple[tuple[str, str, str, bool, str, tuple[tuple[str, str], ...], str], ...] = (
    (
        "ros_gz_sim",
        "create",
        "create:run",
        True,
        "puts a model into the running world, the new Gazebo's way",
        (("ros_ign_gazebo", "create"),),
        "ros_gz_sim",
    ),
    (
        "ros_gz_sim",
        "remove",
        "remove:run",
        True,
        "takes a model out of the running world, the new Gazebo's way",
        (),
        "ros_gz_sim_remove_entity",
    ),
    ("ros_gz_sim", "gzserver", "server:run", False, "a world of the new Gazebo", (), "gazebo"),
    (
        "ros_gz_bridge",
        "parameter_bridge",
        "parameter_bridge:run",
        True,
        "passes topics of the new Gazebo on under names of ROS",
        (("ros_ign_bridge", "parameter_bridge"), ("ros_gz_bridge", "bridge_node")),
        "ros_gz_bridge",
    ),
    (
        "ros_gz_image",
        "image_bridge",
        "parameter_bridge:run_image",
        True,
        "passes images of the new Gazebo on",
        (("ros_ign_image", "image_bridge"),),
        "ros_gz_image",
    ),
)
