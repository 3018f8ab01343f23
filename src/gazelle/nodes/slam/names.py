"""Names of the SLAM nodes, for the registry."""

from __future__ import annotations

__all__ = ["SLAM_NAMES"]

SLAM_NAMES = (
    ("explore_lite", ("explore",), "run_explore", "drives to frontiers until all is known", ""),
    ("gmapping", ("slam_gmapping",), "run_gmapping", "SLAM, gmapping's names", ""),
    ("slam_karto", ("slam_karto",), "run_karto", "SLAM, slam_karto's names", ""),
    ("hector_mapping", ("hector_mapping",), "run_hector", "SLAM, hector_mapping's names", ""),
    (
        "cartographer_ros",
        ("cartographer_node",),
        "run_cartographer",
        "SLAM, cartographer's names",
        "",
    ),
    (
        "cartographer_ros",
        ("cartographer_occupancy_grid_node", "occupancy_grid_node"),
        "run_occupancy_grid",
        "stays beside cartographer_node, which publishes the map itself",
        "",
    ),
    (
        "slam_toolbox",
        (
            "async_slam_toolbox_node",
            "sync_slam_toolbox_node",
            "lifelong_slam_toolbox_node",
            "map_and_localization_slam_toolbox_node",
        ),
        "run_toolbox",
        "SLAM, slam_toolbox's names",
        "slam_toolbox",
    ),
    (
        "slam_toolbox",
        ("localization_slam_toolbox_node",),
        "run_localization",
        "localisation in a saved graph of poses, slam_toolbox's names",
        "slam_toolbox",
    ),
)
"""Package, types, function, help, name of the node when nobody names it."""
