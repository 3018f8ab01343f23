"""``nav2_map_server map_server``: publishes a map from a file (ROS 2)."""

from __future__ import annotations

import threading
from typing import Any

from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type, service_type
from gazelle.mapping.grids import read_map
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.lifecycle import Lifecycle
from gazelle.nodes.map_server.occupancy_grid import message_of_grid
from gazelle.nodes.map_server.server import result_of
from gazelle.nodes.parameters import log_findings, private_parameters, start_node
from gazelle.parameters import Parameter, ParameterTable

__all__ = ["PARAMETERS", "run"]

PARAMETERS = ParameterTable(
    "map_server (ROS 2)",
    "Publishes a map from a file, as a managed node.",
    ("nav2_map_server/map_server",),
    (
        Parameter("yaml_filename", "text", "", "the map; none until one is loaded when empty"),
        Parameter("topic_name", "text", "map", "where it is published"),
        Parameter("frame_id", "text", "map", "frame of the map"),
    ),
)

_POLL_S = 0.2


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Be a managed node until told to stop."""
    node = start_node(arguments, graph)
    server = _Server(node, arguments)
    arguments.ready()
    while not stop.wait(_POLL_S) and not server.lifecycle.finalized:
        pass
    node.shutdown()
    return 0


class _Server:
    """The map appears when the node is configured, and is published while it is active."""

    def __init__(self, node: Node, arguments: NodeArguments) -> None:
        self._node = node
        self._message: Any = None
        self._maps: Any = None
        callbacks = {
            "configure": self._configure,
            "activate": self._activate,
            "deactivate": self._deactivate,
            "cleanup": self._cleanup,
        }
        with private_parameters(node, arguments, PARAMETERS) as own:
            self._path, self._topic = own.text("yaml_filename"), own.text("topic_name")
            self._frame_id = own.text("frame_id")
        self.lifecycle = Lifecycle(node, callbacks)
        node.log("info", "Creating; waits to be configured and activated by a lifecycle manager")
        node.create_service("~/map", service_type("nav_msgs/srv/GetMap"), self._on_get)
        node.create_service("~/load_map", service_type("nav2_msgs/srv/LoadMap"), self._on_load)

    def _configure(self) -> bool:
        self._node.log("info", "Configuring")
        path = self._path
        if not path:
            text = "yaml-filename parameter is empty, set map through '~/load_map'-service"
            self._node.log("info", text)
        elif self._load(path) != 0:
            self._node.log("error", f"Failed to load map yaml file: {path}")
            return False
        kind: Any = message_type("nav_msgs/msg/OccupancyGrid")
        self._maps = self._node.create_publisher(self._topic, kind, latch=True, queue_size=1)
        return True

    def _activate(self) -> bool:
        self._node.log("info", "Activating")
        if self._message is not None:
            self._maps.publish(self._message)
        return True

    def _deactivate(self) -> bool:
        self._node.log("info", "Deactivating")
        return True

    def _cleanup(self) -> bool:
        self._node.log("info", "Cleaning up")
        self._maps.unregister()
        self._message = None
        return True

    def _load(self, path: str) -> int:
        """Read a map; returns the result code."""
        found = Diagnostics()
        grid = read_map(path.removeprefix("file://"), found, ros_version=2)
        log_findings(self._node, found)
        if grid is None:
            return result_of(found)
        self._message = message_of_grid(grid, self._frame_id, self._node.clock.now_ns())
        text = f"Read map {path}: {grid.width} X {grid.height} map @ {grid.resolution_m:g} m/cell"
        self._node.log("info", text)
        return 0

    def _on_get(self, _request: Any) -> Any:
        response = service_type("nav_msgs/srv/GetMap").Response()
        if self.lifecycle.active and self._message is not None:
            response.map = self._message
        else:
            text = "Received GetMap request but not in ACTIVE state, ignoring!"
            self._node.log("warn", text)
        return response

    def _on_load(self, request: Any) -> Any:
        response = service_type("nav2_msgs/srv/LoadMap").Response()
        if not self.lifecycle.active:
            text = "Received LoadMap request but not in ACTIVE state, ignoring!"
            self._node.log("warn", text)
            response.result = 255
            return response
        self._node.log("info", "Handling LoadMap request")
        response.result = self._load(request.map_url)
        if response.result == 0:
            self._maps.publish(self._message)
            response.map = self._message
        return response
