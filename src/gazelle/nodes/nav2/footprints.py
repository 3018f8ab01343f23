"""Outlines that are published, as the robot has them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.nodes.navigation.robot_pose import Frames

__all__ = ["outline_in_base"]


def outline_in_base(frames: Frames, message: Any, base_frame: str) -> NDArray[np.float64] | None:
    """Return the corners of a ``PolygonStamped`` in the robot's frame, (n, 2) in metres.

    None when it has fewer than three, or when its frame is not known.
    """
    corners = np.array([(p.x, p.y) for p in message.polygon.points], float).reshape(-1, 2)
    if len(corners) < 3:
        return None
    frame = str(message.header.frame_id).removeprefix("/")
    if frame in ("", base_frame):
        return corners
    found = frames.robot(frame, base_frame, 0.0)
    if isinstance(found, str):
        return None
    x, y, yaw = found.pose
    away = corners - (x, y)
    c, s = math.cos(yaw), math.sin(yaw)
    return np.column_stack([away @ (c, s), away @ (-s, c)])
