"""Where a robot looks along a path."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gazelle.navigation.planners.planner import Facing

__all__ = ["directed"]

Pose = tuple[float, float, float]
_INTERPOLATE, _MIXED = 2, 3
_TURNS = {1: 0.0, 3: 0.0, 4: math.pi, 5: -math.pi / 2, 6: math.pi / 2}
_STRAIGHT_RAD = 0.35
_APPROACH = 8


def directed(
    poses: NDArray[np.float64],
    start: Pose,
    goal: Pose,
    facing: Facing,
    is_there: bool,
) -> NDArray[np.float64]:
    """Return a path with directions that ends in the goal's pose where it reaches its cell.

    It is (n, 3) in the costmap's frame: x, y (m) and yaw (rad).

    NavfnROS leaves directions at 0; here they point along the path, which its followers do not look
    at and people do. Modes are those of ``OrientationFilter`` of global_planner.
    """
    mode, window, arrives = facing
    end = np.array(goal if is_there else (poses[-1, 0], poses[-1, 1], goal[2]))
    poses = np.vstack([poses[:-1], end]) if len(poses) > 1 else np.array([start, end])
    if mode in _TURNS:
        poses[:-1, 2] = _along(poses, window) + _TURNS[mode]
    if mode == _INTERPOLATE:
        _interpolate(poses, 0, start[2])
    if mode == _MIXED:
        _mixed(poses, start[2])
    if arrives and len(poses) > 1:
        step = poses[-1, :2] - poses[-min(len(poses), _APPROACH), :2]
        poses[-1, 2] = math.atan2(step[1], step[0])
    poses[:, 2] = np.remainder(poses[:, 2] + math.pi, math.tau) - math.pi
    return poses


def _along(poses: NDArray[np.float64], window: int) -> NDArray[np.float64]:
    count = len(poses)
    k = np.arange(count - 1)
    before, after = np.maximum(k - window + 1, 0), np.minimum(k + window, count - 1)
    if window > 1:
        before = np.maximum(k - window, 0)
    step = poses[after, :2] - poses[before, :2]
    return np.arctan2(step[:, 1], step[:, 0])


def _interpolate(poses: NDArray[np.float64], first: int, yaw: float) -> None:
    turn = math.remainder(poses[-1, 2] - yaw, math.tau)
    poses[first:, 2] = yaw + turn * np.linspace(0, 1, len(poses) - first)


def _mixed(poses: NDArray[np.float64], start_yaw: float) -> None:
    """Look forward, and turn to the goal over the last straight part."""
    first = max(len(poses) - 3, 0)
    last = poses[first, 2]
    while first > 0 and abs(math.remainder(poses[first - 1, 2] - last, math.tau)) <= _STRAIGHT_RAD:
        first -= 1
    poses[0, 2] = start_yaw
    _interpolate(poses, first, float(poses[first, 2]))
