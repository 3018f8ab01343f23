"""Lengths and distances of the messages that trees hand about."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

from gazelle.interfaces.poses import pose_of
from gazelle.nodes.nav2.behavior_trees.ros_interface import Pose2

__all__ = ["distance_m", "goals_of", "path_length_m", "plane_pose", "poses_of"]


def poses_of(path: Any) -> list[Any]:
    """Return the ``PoseStamped`` of a ``nav_msgs/Path``."""
    return list(path.poses)


def goals_of(goals: Any) -> list[Any]:
    """Return the poses of a list, or of a ``nav_msgs/Goals``."""
    return list(goals.goals) if hasattr(goals, "goals") else list(goals or ())


def plane_pose(pose: Any) -> Pose2:
    """Return a ``geometry_msgs/Pose`` in the plane."""
    return Pose2(*pose_of(pose).xy_yaw)


def distance_m(first: Any, second: Any) -> float:
    """Return the distance of two ``geometry_msgs/Pose`` in the plane."""
    return math.hypot(first.position.x - second.position.x, first.position.y - second.position.y)


def path_length_m(path: Any) -> float:
    """Return the length of a ``nav_msgs/Path``."""
    poses = poses_of(path)
    return sum(distance_m(one.pose, other.pose) for one, other in pairwise(poses))
