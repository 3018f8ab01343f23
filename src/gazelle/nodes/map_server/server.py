"""``map_server map_server``: publishes a map from a file (ROS 1, noetic)."""

from __future__ import annotations

import math
import threading
from pathlib import Path
from typing import Any

from gazelle.diagnostics import Diagnostics
from gazelle.errors import LaunchError
from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type, service_type
from gazelle.mapping.grids import MapFile, OccupancyGrid, read_map, read_map_image
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.map_server.occupancy_grid import message_of_grid
from gazelle.nodes.parameters import log_findings, private_parameters, start_node
from gazelle.parameters import Parameter, ParameterTable
from gazelle.parameters.reader import ParameterReader

__all__ = ["PARAMETERS", "result_of", "run"]

PARAMETERS = ParameterTable(
    "map_server (ROS 1)",
    "Publishes a map from a file.",
    ("map_server/map_server",),
    (
        Parameter("frame_id", "text", "map", "frame of the map"),
        Parameter("negate", "number", 0.0, "other than 0: white is occupied; without a YAML only"),
        Parameter("occupied_thresh", "number", 0.65, "darker is occupied; without a YAML only"),
        Parameter("free_thresh", "number", 0.196, "lighter is free; without a YAML only"),
    ),
)

_USAGE = "USAGE: map_server <map.yaml>\n  map.yaml: map description file"
_NANO = 1_000_000_000
_RESULTS = (
    ("map.unreadable", 1),
    ("map.no-yaml", 3),
    ("map.bad-value", 3),
    ("map.no-image", 2),
    ("map.bad-image", 2),
)
_UNDEFINED = 255


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Publish the map until told to stop; 255 when there is none to publish.

    Raises:
        LaunchError: the command line is wrong.
    """
    argv = arguments.rest
    if len(argv) not in (1, 2):
        raise LaunchError(f"map_server takes a map's YAML, got {len(argv)} words\n{_USAGE}")
    node = start_node(arguments, graph)
    found = Diagnostics()
    with private_parameters(node, arguments, PARAMETERS) as own:
        grid = _first_map(node, own, argv, found)
    log_findings(node, found)
    if grid is None:
        node.shutdown()
        return 255
    _Server(node, own.text("frame_id"), grid)
    arguments.ready()
    stop.wait()
    node.shutdown()
    return 0


def result_of(found: Diagnostics) -> int:
    """Return the result code of ``LoadMap`` for findings: what is wrong first counts."""
    for code, result in _RESULTS:
        if found.by_code(code):
            return result
    return _UNDEFINED


def _first_map(
    node: Node, own: ParameterReader, argv: tuple[str, ...], found: Diagnostics
) -> OccupancyGrid | None:
    if len(argv) == 1:
        node.log("info", f'Loading map from "{argv[0]}"')
        return read_map(argv[0], found)
    node.log("warn", "Using deprecated map server interface. Please switch to new interface.")
    return _from_parameters(own, argv, found)


def _from_parameters(
    own: ParameterReader, argv: tuple[str, ...], found: Diagnostics
) -> OccupancyGrid | None:
    """Read a picture with a resolution on the command line, the form before the YAML."""
    try:
        resolution_m = float(argv[1])
    except ValueError:
        resolution_m = math.nan
    if not (math.isfinite(resolution_m) and resolution_m > 0):
        text = f"'{argv[1]}' is no resolution in metres per cell"
        found.report("map.bad-value", text, fix="such as `map_server map.pgm 0.05`")
        return None
    described = MapFile(
        path=Path(argv[0]),
        image=Path(argv[0]),
        resolution_m=resolution_m,
        origin=(0.0, 0.0, 0.0),
        negate=own.number("negate") != 0,
        occupied_thresh=own.number("occupied_thresh"),
        free_thresh=own.number("free_thresh"),
    )
    return read_map_image(described, found)


class _Server:
    def __init__(self, node: Node, frame_id: str, grid: OccupancyGrid) -> None:
        self._node, self._frame_id = node, frame_id
        info: Any = message_type("nav_msgs/msg/MapMetaData")
        self._metadata = node.create_publisher("map_metadata", info, latch=True, queue_size=1)
        kind: Any = message_type("nav_msgs/msg/OccupancyGrid")
        self._maps = node.create_publisher("map", kind, latch=True, queue_size=1)
        self._publish(grid)
        node.create_service("static_map", service_type("nav_msgs/srv/GetMap"), self._on_get)
        node.create_service("change_map", service_type("nav_msgs/srv/LoadMap"), self._on_change)

    def _publish(self, grid: OccupancyGrid) -> None:
        self._message = message_of_grid(grid, self._frame_id, self._node.clock.now_ns())
        self._node.log(
            "info",
            f"Read a {grid.width} X {grid.height} map @ {grid.resolution_m:.3f} m/cell",
        )
        self._metadata.publish(self._message.info)
        self._maps.publish(self._message)

    def _on_get(self, _request: Any) -> Any:
        self._node.log("info", "Sending map")
        return service_type("nav_msgs/srv/GetMap").Response(map=self._message)

    def _on_change(self, request: Any) -> Any:
        found = Diagnostics()
        grid = read_map(request.map_url.removeprefix("file://"), found)
        log_findings(self._node, found)
        response = service_type("nav_msgs/srv/LoadMap").Response()
        if grid is None:
            response.result = result_of(found)
            return response
        self._publish(grid)
        self._node.log("info", f"Changed map to {request.map_url}")
        response.map = self._message
        return response
