"""Mapping and exploring."""

from __future__ import annotations

from gazelle.node_specs.common_topics import TF_LISTENED
from gazelle.node_specs.spec import (
    ROS_1,
    ROS_2,
    FrameRow,
    NodeName,
    NodeSpec,
    listens,
    offers,
    publishes,
)

__all__ = ["SLAM"]

_MAP = (
    publishes("/tf", "tf2_msgs/msg/TFMessage"),
    publishes("map", "nav_msgs/msg/OccupancyGrid"),
    publishes("map_metadata", "nav_msgs/msg/MapMetaData"),
)
_TOOLBOX_TOPICS = (
    *_MAP,
    listens("{~scan_topic|/scan}", "sensor_msgs/msg/LaserScan"),
    *TF_LISTENED,
)
_TOOLBOX_SERVICES = (
    offers("~deserialize_map", "slam_toolbox/srv/DeserializePoseGraph"),
    offers("~dynamic_map", "nav_msgs/srv/GetMap"),
    offers("~pause_new_measurements", "slam_toolbox/srv/Pause"),
    offers("~reset", "slam_toolbox/srv/Reset"),
    offers("~save_map", "slam_toolbox/srv/SaveMap"),
    offers("~serialize_map", "slam_toolbox/srv/SerializePoseGraph"),
)

SLAM = (
    NodeSpec(
        package="explore_lite",
        executable="explore",
        entry="gazelle.nodes.slam.node:run_explore",
        does="drives to frontiers until all is known",
        is_light=False,
        parameters="gazelle.nodes.slam.explore_lite:EXPLORE",
        topics=(
            listens("{~costmap_topic|costmap}", "nav_msgs/msg/OccupancyGrid"),
            *TF_LISTENED,
        ),
    ),
    NodeSpec(
        package="gmapping",
        executable="slam_gmapping",
        ros=ROS_1,
        entry="gazelle.nodes.slam.node:run_gmapping",
        does="SLAM, gmapping's names",
        is_light=False,
        parameters="gazelle.nodes.slam.parameters:GMAPPING",
        topics=(*_MAP, listens("scan", "sensor_msgs/msg/LaserScan"), *TF_LISTENED),
        services=(offers("dynamic_map", "nav_msgs/srv/GetMap"),),
        frames=(FrameRow("{~map_frame|map}", "{~odom_frame|odom}"),),
    ),
    NodeSpec(
        package="slam_karto",
        executable="slam_karto",
        ros=ROS_1,
        entry="gazelle.nodes.slam.node:run_karto",
        does="SLAM, slam_karto's names",
        is_light=False,
        parameters="gazelle.nodes.slam.parameters:KARTO",
        topics=(*_MAP, listens("scan", "sensor_msgs/msg/LaserScan"), *TF_LISTENED),
        services=(offers("dynamic_map", "nav_msgs/srv/GetMap"),),
        frames=(FrameRow("{~map_frame|map}", "{~odom_frame|odom}"),),
    ),
    NodeSpec(
        package="hector_mapping",
        executable="hector_mapping",
        ros=ROS_1,
        entry="gazelle.nodes.slam.node:run_hector",
        does="SLAM, hector_mapping's names",
        is_light=False,
        parameters="gazelle.nodes.slam.parameters:HECTOR",
        topics=(*_MAP, listens("scan", "sensor_msgs/msg/LaserScan"), *TF_LISTENED),
        services=(offers("dynamic_map", "nav_msgs/srv/GetMap"),),
        frames=None,
    ),
    NodeSpec(
        package="cartographer_ros",
        executable="cartographer_node",
        entry="gazelle.nodes.slam.node:run_cartographer",
        does="SLAM, cartographer's names",
        is_light=False,
        parameters="gazelle.nodes.slam.parameters:CARTOGRAPHER",
        topics=(*_MAP, listens("scan", "sensor_msgs/msg/LaserScan"), *TF_LISTENED),
        services=(offers("dynamic_map", "nav_msgs/srv/GetMap"),),
        frames=None,
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
        parameters="gazelle.nodes.slam.parameters:TOOLBOX",
        aliases=(
            NodeName("slam_toolbox", "sync_slam_toolbox_node"),
            NodeName("slam_toolbox", "lifelong_slam_toolbox_node"),
            NodeName("slam_toolbox", "map_and_localization_slam_toolbox_node", ROS_2),
        ),
        name="slam_toolbox",
        topics=_TOOLBOX_TOPICS,
        services=_TOOLBOX_SERVICES,
        frames=None,
    ),
    NodeSpec(
        package="slam_toolbox",
        executable="localization_slam_toolbox_node",
        entry="gazelle.nodes.slam.node:run_localization",
        does="localisation in a saved graph of poses, slam_toolbox's names",
        is_light=False,
        parameters="gazelle.nodes.slam.parameters:TOOLBOX",
        name="slam_toolbox",
        topics=_TOOLBOX_TOPICS,
        services=_TOOLBOX_SERVICES,
        frames=None,
    ),
    NodeSpec(
        package="frontier_exploration",
        executable="explore_server",
        ros=ROS_1,
        entry="gazelle.nodes.frontier_exploration.server:run",
        does="explores what lies inside of a polygon, by move_base",
        is_light=False,
        parameters="gazelle.nodes.frontier_exploration.bounded_explore_layer:EXPLORE_SERVER",
        topics=(
            publishes("~explore_costmap/costmap", "nav_msgs/msg/OccupancyGrid"),
            publishes("~explore_costmap/costmap_updates", "map_msgs/msg/OccupancyGridUpdate"),
            publishes("~explore_costmap/explore_boundary/frontiers", "sensor_msgs/msg/PointCloud2"),
            publishes("~explore_costmap/footprint", "geometry_msgs/msg/PolygonStamped"),
            *TF_LISTENED,
        ),
        services=(
            offers(
                "~explore_costmap/explore_boundary/get_next_frontier",
                "frontier_exploration/srv/GetNextFrontier",
            ),
            offers(
                "~explore_costmap/explore_boundary/update_boundary_polygon",
                "frontier_exploration/srv/UpdateBoundaryPolygon",
            ),
        ),
        actions=(offers("~", "frontier_exploration/action/ExploreTask"),),
    ),
    NodeSpec(
        package="frontier_exploration",
        executable="explore_client",
        ros=ROS_1,
        entry="gazelle.nodes.frontier_exploration.client:run",
        does="makes a polygon of clicked points and lets explore_server explore it",
        is_light=True,
        topics=(
            publishes("exploration_polygon_marker", "visualization_msgs/msg/Marker"),
            listens("/clicked_point", "geometry_msgs/msg/PointStamped"),
        ),
    ),
)
