"""Forward kinematics: where all links of a robot are."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache

import numpy as np

from gazelle.motion.kinematics.chain import LinkTree, link_tree
from gazelle.motion.kinematics.kernels import tree
from gazelle.motion.model import RobotModel
from gazelle.motion.space import FloatArray

__all__ = ["link_poses"]


def link_poses(
    robot: RobotModel, positions: FloatArray, links: Iterable[str] | None = None
) -> dict[str, FloatArray]:
    """Return 4×4 poses of links in the robot's frame.

    Args:
        robot: the robot.
        positions: of all its variables, rad or m, see `RobotModel.positions`.
        links: those that are wanted; all when None.

    Raises:
        KeyError: there is no such link.
    """
    arrays = _tree_of(robot)
    count = len(arrays.parents)
    R, p = np.empty((count, 3, 3)), np.empty((count, 3))
    tree(arrays, np.ascontiguousarray(positions, dtype=np.float64), R, p)
    poses = np.zeros((count, 4, 4))
    poses[:, :3, :3], poses[:, :3, 3], poses[:, 3, 3] = R, p, 1.0
    found = dict(zip(robot.links, poses, strict=True))
    return found if links is None else {name: found[name] for name in links}


@lru_cache(maxsize=8)
def _tree_of(robot: RobotModel) -> LinkTree:
    return link_tree(robot)
