"""``explore_client``: a polygon of clicked points becomes a task of ``explore_server``."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any

from gazelle.graph import Graph
from gazelle.graph.actions import ActionClient
from gazelle.interfaces import message_type
from gazelle.mapping.frontiers import are_inside, perimeter_m
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.parameters import start_node

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["PointClient", "run"]

_NEAR = 0.1
_SPHERES, _LINE_STRIP = 7, 4
_ADD, _DELETE = 0, 2
_HELLO = "Please use the 'Point' tool in Rviz to select an exporation boundary."


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Take clicked points until told to stop."""
    node = start_node(arguments, graph)
    PointClient(node)
    arguments.ready()
    stop.wait()
    node.shutdown()
    return 0


class PointClient:
    """Collects corners; a click near the first one closes the polygon, the next one starts."""

    def __init__(self, node: Node) -> None:
        """Listen to ``/clicked_point``."""
        self._node = node
        self._corners: list[tuple[float, float]] = []
        self._header: Any = None
        self._is_closed = False
        self._marker: Any = message_type("visualization_msgs/msg/Marker")
        self._point: Any = message_type("geometry_msgs/msg/Point")
        self._client = ActionClient(node, "explore_server", "frontier_exploration/ExploreTask")
        self._out = node.create_publisher("exploration_polygon_marker", self._marker, latch=True)
        node.create_subscription(
            "/clicked_point", "geometry_msgs/msg/PointStamped", self.click, queue_size=10
        )
        node.log("info", _HELLO)

    def click(self, message: Any) -> None:
        """Take a point."""
        place = float(message.point.x), float(message.point.y)
        if self._is_closed:
            self._start(message, place)
        elif not self._corners:
            self._header = message.header
            self._corners.append(place)
        elif message.header.frame_id != self._header.frame_id:
            self._restart("Frame mismatch, restarting polygon selection")
        elif len(self._corners) > 1 and self._is_near_first(place):
            self._close()
        else:
            self._corners.append(place)
        self._draw()

    def _is_near_first(self, place: tuple[float, float]) -> bool:
        near_m = _NEAR * perimeter_m(self._corners) / len(self._corners)
        return perimeter_m([place, self._corners[0]]) / 2 <= near_m

    def _close(self) -> None:
        if len(self._corners) < 3:
            self._restart("Not a valid polygon, restarting")
            return
        self._is_closed = True
        self._node.log("warn", "Please select an initial point for exploration inside the polygon")

    def _start(self, message: Any, place: tuple[float, float]) -> None:
        if not are_inside([place], self._corners)[0]:
            self._restart("Center not inside polygon, restarting")
            return
        if not self._client.wait_for_server(0.0):
            self._node.log("warn", "waiting for the action server explore_server; click again")
            return
        self._node.log("info", "Sending goal")
        goal = self._client.types.Goal()
        goal.explore_center = message
        goal.explore_boundary.header = self._header
        corner: Any = message_type("geometry_msgs/msg/Point32")
        goal.explore_boundary.polygon.points = [corner(x=x, y=y) for x, y in self._corners]
        self._client.send_goal(goal)
        self._forget()

    def _restart(self, why: str) -> None:
        self._node.log("error", why)
        self._forget()

    def _forget(self) -> None:
        self._corners, self._is_closed = [], False

    def _draw(self) -> None:
        """Publish corners and outline: blue while they are chosen, red when they are closed."""
        points = [self._point(x=x, y=y) for x, y in self._corners]
        line = points + points[:1] if self._is_closed else points
        for number, kind, own in ((0, _SPHERES, points), (1, _LINE_STRIP, line)):
            marker = self._marker(ns="explore_points", id=number, type=kind, points=own)
            marker.header = self._header
            marker.action = _ADD if points else _DELETE
            marker.pose.orientation.w = 1.0
            marker.scale.x, marker.scale.y = (0.1, 0.1) if number == 0 else (0.05, 0.0)
            marker.color.a = 1.0
            marker.color.r, marker.color.b = (1.0, 0.0) if self._is_closed else (0.0, 1.0)
            self._out.publish(marker)
