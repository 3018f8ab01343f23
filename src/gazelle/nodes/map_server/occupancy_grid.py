"""Grids as messages, and back."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.interfaces import message_type
from gazelle.interfaces.poses import pose_of, set_plane_pose
from gazelle.interfaces.stamps import set_stamp
from gazelle.mapping.grids import OccupancyGrid

__all__ = ["grid_of_message", "message_of_grid"]


def message_of_grid(grid: OccupancyGrid, frame_id: str, now_ns: int) -> Any:
    """Return a ``nav_msgs/OccupancyGrid``."""
    message = message_type("nav_msgs/msg/OccupancyGrid")()
    message.header.frame_id = frame_id
    for stamp in (message.header.stamp, message.info.map_load_time):
        set_stamp(stamp, now_ns)
    message.info.resolution = float(np.float32(grid.resolution_m))
    message.info.width, message.info.height = grid.width, grid.height
    set_plane_pose(message.info.origin, grid.origin)
    message.data = np.ascontiguousarray(grid.cells).reshape(-1)
    return message


def grid_of_message(message: Any) -> OccupancyGrid:
    """Return the grid of a ``nav_msgs/OccupancyGrid``.

    Raises:
        ValueError: size and data do not go together, or a number is none.
    """
    width, height = int(message.info.width), int(message.info.height)
    data = np.asarray(message.data, np.int64).astype(np.int8)
    if data.size != width * height or not data.size:
        raise ValueError(f"the map says {width} × {height} cells and has {data.size}")
    # A float32 of 0.05 is 0.0500000007…, which is not what the map was made with.
    resolution_m = float(f"{float(message.info.resolution):.7g}")
    origin = pose_of(message.info.origin).xy_yaw
    return OccupancyGrid(data.reshape(height, width), resolution_m, origin)
