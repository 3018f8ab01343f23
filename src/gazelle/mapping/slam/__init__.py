"""The SLAM engine: scans and odometry in, a trajectory and a map out."""

from __future__ import annotations

from gazelle.mapping.slam.occupancy_counts import MapDrawer
from gazelle.mapping.slam.pose_graph_files import SUFFIX, SavedGraphError, load_graph, save_graph
from gazelle.mapping.slam.slam_engine import Slam, SlamResult, Update, slam
from gazelle.mapping.slam.slam_parameters import SlamParameters

__all__ = [
    "SUFFIX",
    "MapDrawer",
    "SavedGraphError",
    "Slam",
    "SlamParameters",
    "SlamResult",
    "Update",
    "load_graph",
    "save_graph",
    "slam",
]
