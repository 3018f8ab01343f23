"""The costmap nodes of Nav2's planner and controller servers, and the outlines they publish."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph, Node
from gazelle.graph.log_output import print_ros2
from gazelle.graph.names import join
from gazelle.interfaces import service_type
from gazelle.navigation.costmap import CostGrid
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.navigation.costmap_2d_ros import Costmap2DRos
from gazelle.nodes.navigation.costmap_from_parameters import assemble
from gazelle.nodes.navigation.costmap_publisher import CostmapPublisher
from gazelle.nodes.navigation.robot_pose import Frames
from gazelle.nodes.parameters import offer_parameters, tree_of_node

__all__ = ["CostmapNode", "grid_of_costmap", "outline_in_base"]


class CostmapNode:
    """``/local_costmap/local_costmap`` or its global sister, with topics and services.

    Attributes:
        node: the costmap's own.
        live: the costmap.
    """

    def __init__(
        self, name: str, arguments: NodeArguments, graph: Graph, diagnostics: Diagnostics
    ) -> None:
        """Make node and costmap; it is updated from `Costmap2DRos.start` on."""
        space = f"{arguments.namespace.rstrip('/')}/{name}"
        self.node: Node = graph.create_node(
            name,
            namespace=space,
            remappings=_rules(arguments.remappings, arguments.namespace),
            is_ros2=True,
        )
        self.node.console = print_ros2
        tree = tree_of_node(arguments, self.node.name)
        if name == "local_costmap":
            tree.setdefault("global_frame", "odom")
        made = assemble(tree, self.node.name, diagnostics, ros_version=2)
        frame = made.costmap.options.global_frame.removeprefix("/")
        publisher = CostmapPublisher(
            self.node, space, frame, raw=True, footprint="published_footprint"
        )
        self.live = Costmap2DRos(
            self.node, Frames(self.node), made, publisher,
            topics_in=arguments.namespace, refuses_late=False,
        )  # fmt: skip
        self._parameters = offer_parameters(self.node, tree)
        with self.node.announced_together():
            self._offer(name, space)

    def close(self) -> None:
        """Take everything off the graph."""
        self.live.close()
        self._parameters.close()
        self.node.shutdown()

    def _offer(self, name: str, space: str) -> None:
        for word, kind, handler in (
            ("clear_entirely", "ClearEntireCostmap", self._on_clear_all),
            ("clear_around", "ClearCostmapAroundRobot", self._on_clear_around),
            ("clear_except", "ClearCostmapExceptRegion", self._on_clear_except),
        ):
            service = service_type(f"nav2_msgs/srv/{kind}")
            self.node.create_service(f"{space}/{word}_{name}", service, handler)
        service = service_type("nav2_msgs/srv/GetCostmap")
        self.node.create_service(f"{space}/get_costmap", service, self._on_get)

    def _on_clear_all(self, _request: Any) -> Any:
        self.live.reset()
        return service_type("nav2_msgs/srv/ClearEntireCostmap").Response()

    def _on_clear_around(self, request: Any) -> Any:
        self.live.clear_around(float(request.reset_distance), inside=True)
        return service_type("nav2_msgs/srv/ClearCostmapAroundRobot").Response()

    def _on_clear_except(self, request: Any) -> Any:
        self.live.clear_around(float(request.reset_distance))
        return service_type("nav2_msgs/srv/ClearCostmapExceptRegion").Response()

    def _on_get(self, _request: Any) -> Any:
        response = service_type("nav2_msgs/srv/GetCostmap").Response()
        response.map = self.live.raw_message()
        return response


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


def grid_of_costmap(message: Any) -> CostGrid:
    """Return the grid of a ``nav2_msgs/Costmap``."""
    data = message.metadata
    costs = np.asarray(message.data, np.uint8).reshape(int(data.size_y), int(data.size_x))
    origin = (float(data.origin.position.x), float(data.origin.position.y))
    # A float32 of 0.05 is 0.0500000007…
    resolution_m = float(f"{float(data.resolution):.7g}")
    return CostGrid(np.ascontiguousarray(costs), resolution_m, origin)


def _rules(remappings: Mapping[str, str], namespace: str) -> dict[str, str]:
    """Return the rules of the server for its costmap, which is one namespace further down.

    ``/tf:=tf`` means the transforms of the server's namespace.
    """
    return {
        name: join(namespace, value) if name.startswith("/") else value
        for name, value in remappings.items()
    }
