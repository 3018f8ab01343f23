"""Services and pictures of the layer with the polygon, and messages of places."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from gazelle.interfaces import message_type, service_type
from gazelle.interfaces.poses import set_plane_pose, unit_pose_of
from gazelle.interfaces.stamps import set_header
from gazelle.mapping.frontiers import Frontier
from gazelle.nodes.frontier_exploration.bounded_explore_layer import Area, Corners

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["Services"]

_CHOSEN, _OTHERS = 100.0, 50.0
_FLOAT32 = 7


class Services:
    """``update_boundary_polygon``, ``get_next_frontier`` and ``frontiers`` of the layer."""

    def __init__(self, node: Node, area: Area) -> None:
        """Offer them."""
        self._node, self._area = node, area
        below = f"~/explore_costmap/{area.layer}"
        self._update = service_type("frontier_exploration/UpdateBoundaryPolygon")
        self._next = service_type("frontier_exploration/GetNextFrontier")
        self._cloud: Any = message_type("sensor_msgs/msg/PointCloud2")
        self._out = node.create_publisher(f"{below}/frontiers", self._cloud, queue_size=5)
        node.create_service(f"{below}/update_boundary_polygon", self._update, self._on_update)
        node.create_service(f"{below}/get_next_frontier", self._next, self._on_next)

    def corners(self, boundary: Any) -> Corners | str:
        """Return a ``PolygonStamped`` in the costmap's frame, or why it is not known."""
        found = [self._placed(boundary.header, one) for one in boundary.polygon.points]
        why = next((one for one in found if isinstance(one, str)), None)
        if why is not None:
            return why
        if 0 < len(found) < 3:
            return f"the boundary has {len(found)} corners; 3 or more make a polygon"
        return np.array(found, float).reshape(-1, 2)

    def place(self, point: Any) -> tuple[float, float] | str:
        """Return a ``PointStamped`` in the costmap's frame, or why it is not known."""
        return self._placed(point.header, point.point)

    def show(self, frontiers: Sequence[Frontier]) -> None:
        """Publish one point for each frontier; the first one is where the robot goes."""
        if not self._out.matched:
            return
        rows = [(*one.nearest_m, 0.0, _CHOSEN if k == 0 else _OTHERS)
                for k, one in enumerate(frontiers)]  # fmt: skip
        data = np.array(rows, "<f4").reshape(-1, 4)
        field = message_type("sensor_msgs/msg/PointField")
        names = ("x", "y", "z", "intensity")
        cloud = self._cloud(
            height=1,
            width=len(data),
            fields=[field(name=name, offset=4 * k, datatype=_FLOAT32, count=1)
                    for k, name in enumerate(names)],
            point_step=16,
            row_step=16 * len(data),
            data=data.tobytes(),
            is_dense=True,
        )  # fmt: skip
        set_header(cloud, self._node.clock.now_ns(), self._area.costmap.global_frame)
        self._out.publish(cloud)

    def _placed(self, header: Any, point: Any) -> tuple[float, float] | str:
        stamped: Any = message_type("geometry_msgs/msg/PoseStamped")()
        stamped.header.frame_id = header.frame_id
        stamped.pose.position.x, stamped.pose.position.y = float(point.x), float(point.y)
        costmap = self._area.costmap
        found = costmap.frames.message_in(stamped, costmap.global_frame)
        if isinstance(found, str):
            return found
        return found.pose.position.x, found.pose.position.y

    def _on_update(self, request: Any) -> Any:
        corners = self.corners(request.explore_boundary)
        if isinstance(corners, str):
            raise ValueError(corners)
        self._area.limit(corners)
        return self._update.Response()

    def _on_next(self, request: Any) -> Any:
        costmap = self._area.costmap
        start = costmap.frames.message_in(request.start_pose, costmap.global_frame)
        if isinstance(start, str):
            raise ValueError(start)
        here = unit_pose_of(start.pose).xy_yaw[:2]
        frontiers = self._area.frontiers(here)
        self.show(frontiers)
        if not frontiers:
            raise ValueError("No frontiers found, exploration complete")
        response = self._next.Response()
        set_header(response.next_frontier, self._node.clock.now_ns(), costmap.global_frame)
        set_plane_pose(response.next_frontier.pose, self._area.goal(frontiers[0], here))
        return response
