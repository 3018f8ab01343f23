"""Costmaps as topics: all of it, latched, and what changed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import set_header
from gazelle.navigation.costmap import CostGrid, Window, occupancy_of_costs

if TYPE_CHECKING:
    from gazelle.graph import Node, Publisher

__all__ = ["CostmapPublisher"]


class CostmapPublisher:
    """``costmap``, ``costmap_updates``, ``footprint``, and in ROS 2 ``costmap_raw``."""

    def __init__(
        self, node: Node, namespace: str, frame_id: str, *, raw: bool = False, footprint: str = ""
    ) -> None:
        """Offer the topics.

        Args:
            node: the owner.
            namespace: what comes before the topics' names, such as ``~/local_costmap``.
            frame_id: frame of the costs.
            raw: also publish costs as they are (``nav2_msgs/Costmap``).
            footprint: topic of the outline, ``footprint`` by default.
        """
        grid = message_type("nav_msgs/msg/OccupancyGrid")
        update = message_type("map_msgs/msg/OccupancyGridUpdate")
        polygon = message_type("geometry_msgs/msg/PolygonStamped")
        self._frame_id = frame_id
        self._full = node.create_publisher(f"{namespace}/costmap", grid, latch=True, queue_size=1)
        self._updates = node.create_publisher(f"{namespace}/costmap_updates", update)
        outline = f"{namespace}/{footprint or 'footprint'}"
        self._footprint = node.create_publisher(outline, polygon, queue_size=1)
        self._raw: Publisher | None = None
        if raw:
            kind = message_type("nav2_msgs/msg/Costmap")
            name = f"{namespace}/costmap_raw"
            self._raw = node.create_publisher(name, kind, latch=True, queue_size=1)
        self._place: tuple[Any, ...] = ()
        self._listeners = 0

    def publish(
        self, grid: CostGrid, changed: Window | None, now_ns: int, *, always_full: bool = False
    ) -> None:
        """Tell what changed since the last call, or everything when size or place changed."""
        place = (grid.origin, grid.costs.shape, grid.resolution_m)
        listeners = self._full.subscription_count
        # Who came meanwhile got a latched costmap that is out of date.
        is_new = listeners > self._listeners
        self._listeners = listeners
        if always_full or place != self._place or is_new:
            self._place = place
            self._full.publish(self._full_message(grid, now_ns))
        elif changed is not None and not changed.empty and self._updates.matched:
            self._updates.publish(self._update_message(grid, changed, now_ns))
        if self._raw is not None and (changed is not None or is_new) and self._raw.matched:
            self._raw.publish(self.raw_message(grid, now_ns))

    def publish_footprint(self, corners: NDArray[np.float64], now_ns: int) -> None:
        """Publish the robot's outline, corners in the costmap's frame (m), (n, 2)."""
        if not self._footprint.matched:
            return
        point: Any = message_type("geometry_msgs/msg/Point32")
        message = self._footprint.message_class()
        set_header(message, now_ns, self._frame_id)
        message.polygon.points = [point(x=float(x), y=float(y)) for x, y in corners]
        self._footprint.publish(message)

    def close(self) -> None:
        """Take the topics off the graph."""
        for one in (self._full, self._updates, self._footprint, self._raw):
            if one is not None:
                one.unregister()

    def _full_message(self, grid: CostGrid, now_ns: int) -> Any:
        message = self._full.message_class()
        set_header(message, now_ns, self._frame_id)
        info = message.info
        info.map_load_time = message.header.stamp
        info.resolution = grid.resolution_m
        info.width, info.height = grid.width, grid.height
        info.origin.position.x, info.origin.position.y = grid.origin
        info.origin.orientation.w = 1.0
        message.data = occupancy_of_costs(grid.costs).ravel()
        return message

    def _update_message(self, grid: CostGrid, window: Window, now_ns: int) -> Any:
        window = window.within(grid.width, grid.height)
        message = self._updates.message_class()
        set_header(message, now_ns, self._frame_id)
        message.x, message.y = window.x0, window.y0
        message.width, message.height = window.x1 - window.x0, window.y1 - window.y0
        message.data = occupancy_of_costs(grid.costs[window.cells]).ravel()
        return message

    def raw_message(self, grid: CostGrid, now_ns: int) -> Any:
        """Return costs as they are (``nav2_msgs/Costmap``)."""
        message: Any = message_type("nav2_msgs/msg/Costmap")()
        set_header(message, now_ns, self._frame_id)
        data = message.metadata
        data.update_time = message.header.stamp
        data.layer = "master"
        data.resolution = grid.resolution_m
        data.size_x, data.size_y = grid.width, grid.height
        data.origin.position.x, data.origin.position.y = grid.origin
        data.origin.orientation.w = 1.0
        message.data = grid.costs.ravel().copy()
        return message
