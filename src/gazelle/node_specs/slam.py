"""Mapping and exploring."""

from __future__ import annotations

from gazelle.node_specs.spec import ROS_1, ROS_2, NodeName, NodeSpec

__all__ = ["SLAM"]

SLAM = (
    NodeSpec(
        package="explore_lite",
        executable="explore",
        entry="gazelle.nodes.slam.node:run_explore",
        does="drives to frontiers until all is known",
        is_light=False,
    ),
    NodeSpec(
        package="gmapping",
        executable="slam_gmapping",
        ros=ROS_1,
        entry="gazelle.nodes.slam.node:run_gmapping",
        does="SLAM, gmapping's names",
        is_light=False,
    ),
    NodeSpec(
        package="slam_karto",
        executable="slam_karto",
        ros=ROS_1,
        entry="gazelle.nodes.slam.node:run_karto",
        does="SLAM, slam_karto's names",
        is_light=False,
    ),
    NodeSpec(
        package="hector_mapping",
        executable="hector_mapping",
        ros=ROS_1,
        entry="gazelle.nodes.slam.node:run_hector",
        does="SLAM, hector_mapping's names",
        is_light=False,
    ),
    NodeSpec(
        package="cartographer_ros",
        executable="cartographer_node",
        entry="gazelle.nodes.slam.node:run_cartographer",
        does="SLAM, cartographer's names",
        is_light=False,
    ),
    NodeSpec(
        package="cartographer_ros",
        executable="cartographer_occupancy_grid_node",
        entry="gazelle.nodes.slam.node:run_occupancy_grid",
        does="stays beside cartographer_node, which publishes the map itself",
        is_light=False,
        aliases=(NodeName("cartographer_ros", "occupancy_grid_node", ROS_2),),
    ),
    NodeSpec(
        package="slam_toolbox",
        executable="async_slam_toolbox_node",
        entry="gazelle.nodes.slam.node:run_toolbox",
        does="SLAM, slam_toolbox's names",
        is_light=False,
        aliases=(
            NodeName("slam_toolbox", "sync_slam_toolbox_node"),
            NodeName("slam_toolbox", "lifelong_slam_toolbox_node"),
            NodeName("slam_toolbox", "map_and_localization_slam_toolbox_node", ROS_2),
        ),
        name="slam_toolbox",
    ),
    NodeSpec(
        package="slam_toolbox",
        executable="localization_slam_toolbox_node",
        entry="gazelle.nodes.slam.node:run_localization",
        does="localisation in a saved graph of poses, slam_toolbox's names",
        is_light=False,
        name="slam_toolbox",
    ),
    NodeSpec(
        package="frontier_exploration",
        executable="explore_server",
        ros=ROS_1,
        entry="gazelle.nodes.frontier_exploration.server:run",
        does="explores what lies inside of a polygon, by move_base",
        is_light=False,
    ),
    NodeSpec(
        package="frontier_exploration",
        executable="explore_client",
        ros=ROS_1,
        entry="gazelle.nodes.frontier_exploration.client:run",
        does="makes a polygon of clicked points and lets explore_server explore it",
        is_light=True,
    ),
)
