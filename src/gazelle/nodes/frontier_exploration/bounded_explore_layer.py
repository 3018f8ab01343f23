"""The costmap layer ``BoundedExploreLayer``: a polygon, frontiers inside of it, services."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gazelle.diagnostics import Diagnostics
from gazelle.interfaces import message_type, service_type
from gazelle.interfaces.poses import set_plane_pose, unit_pose_of
from gazelle.interfaces.stamps import set_header
from gazelle.mapping.frontiers import Frontier, are_inside, find_frontiers
from gazelle.mapping.grids import OccupancyGrid
from gazelle.navigation.costmap import CostGrid, ObstacleLayer, occupancy_of_costs
from gazelle.nodes.navigation.costmap_2d_ros import Costmap2DRos
from gazelle.nodes.navigation.costmap_from_parameters import assemble
from gazelle.nodes.navigation.costmap_publisher import CostmapPublisher
from gazelle.nodes.navigation.robot_pose import Frames, PlanePose
from gazelle.nodes.parameters import node_reader
from gazelle.parameters import Parameter, ParameterTable

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = [
    "BOUNDED_EXPLORE",
    "EXPLORE_SERVER",
    "LAYER_TYPE",
    "BoundedExploreLayer",
    "BoundedExploreServices",
]


LAYER_TYPE = "frontier_exploration::BoundedExploreLayer"

EXPLORE_SERVER = ParameterTable(
    "frontier_exploration",
    "Explores what lies inside of a polygon: the action ``ExploreTask``, by move_base. Its costmap"
    " is `explore_costmap`, with the parameters of any costmap.",
    ("frontier_exploration/explore_server",),
    (
        Parameter("frequency", "number", 0.0,
                  "how often a new goal is looked for while the robot drives;"
            " 0 for only where it has arrived", "Hz", 0.0),
        Parameter("goal_aliasing", "number", 0.1, "a new goal within half of this is the old one",
                  "m",
            0.0),
        Parameter("explore_costmap", "group", None, "the costmap that frontiers are looked for in"),
    ),
)  # fmt: skip

BOUNDED_EXPLORE = ParameterTable(
    "frontier_exploration's layer",
    "The polygon in explore_server's costmap.",
    (LAYER_TYPE,),
    (
        Parameter("enabled", "flag", True, "frontiers end at the polygon"),
        Parameter("explore_clear_space", "flag", True,
                  "what the map calls free counts as unknown until"
            " the costmap's sensors have seen it"),
        Parameter("resize_to_boundary", "flag", True, "the costmap gets the polygon's size"),
        Parameter("frontier_travel_point", "text", "closest",
                  "where to go to: closest, middle (both its"
            " nearest cell) or centroid"),
    ),
)  # fmt: skip
_NAME = "explore_costmap"
_LAYER = "explore_boundary"
_TRAVEL_POINTS = ("closest", "middle", "centroid")

# Single cells are no frontiers.
_MIN_CELLS = 2
_UNKNOWN, _OCCUPIED, _FREE_BELOW = -1, 100, 50
Corners = NDArray[np.float64]
_CHOSEN, _OTHERS = 100.0, 50.0
_FLOAT32 = 7


class BoundedExploreLayer:
    """What is explored.

    Attributes:
        costmap: its costs, in its own frame.
        layer: the name of the layer with the polygon.
        corners: the polygon, (n, 2) in the costmap's frame; empty for no limit.
    """

    def __init__(self, node: Node, tree: Mapping[str, Any], diagnostics: Diagnostics) -> None:
        """Begin without a polygon; what is wrong with the parameters is reported."""
        self._node, self._frames = node, Frames(node)
        self._above = tree
        below = tree.get(_NAME)
        self._tree: dict[str, Any] = dict(below) if isinstance(below, Mapping) else {}
        self.layer = self._take_layer()
        own = self._tree.pop(self.layer, None)
        name = f"{node.name}/{_NAME}/{self.layer}"
        values = own if isinstance(own, Mapping) else {}
        self.settings = node_reader(BOUNDED_EXPLORE, values, name, diagnostics)
        self._travels_to = self._travel_point()
        self.settings.report_unknown()
        self.corners: Corners = np.zeros((0, 2))
        self.costmap = self._made(self._tree, diagnostics)
        self.costmap.start()

    def limit(self, corners: Corners) -> None:
        """Forget what was seen and explore a polygon of the costmap's frame from now on."""
        self.corners = corners
        if not (len(corners) and self.settings.flag("resize_to_boundary")):
            self.costmap.reset()
            return
        low, high = corners.min(axis=0), corners.max(axis=0)
        size = high - low
        place = {"width": size[0], "height": size[1], "origin_x": low[0], "origin_y": low[1]}
        self.costmap.close()
        resized = {**self._tree, **{key: float(value) for key, value in place.items()}}
        self.costmap = self._made(resized, Diagnostics())
        self.costmap.start()

    def contains(self, place_m: tuple[float, float]) -> bool:
        """Tell whether a place of the costmap's frame lies in the polygon."""
        return not len(self.corners) or bool(are_inside([place_m], self.corners)[0])

    def frontiers(self, robot_m: tuple[float, float]) -> list[Frontier]:
        """Return what can be explored, the nearest first."""
        with self.costmap.lock:
            grid = self._limited(self.costmap.grid)
        found = find_frontiers(
            grid, robot_m, free_below=_FREE_BELOW, least_size_m=_MIN_CELLS * grid.resolution_m
        )
        return sorted(found, key=lambda one: one.distance_m)

    def goal(self, frontier: Frontier, robot_m: tuple[float, float]) -> PlanePose:
        """Return where to go for a frontier: the free place next to it, looking away from here."""
        x, y = frontier.centroid_m if self._travels_to == "centroid" else frontier.nearest_m
        with self.costmap.lock:
            grid = self._limited(self.costmap.grid)
        rows, columns = np.nonzero((grid.cells >= 0) & (grid.cells < _FREE_BELOW))
        if len(rows):
            u, v = grid.cell_to_world(columns, rows)
            nearest = int(np.hypot(u - x, v - y).argmin())
            x, y = float(u[nearest]), float(v[nearest])
        return x, y, math.atan2(y - robot_m[1], x - robot_m[0])

    def close(self) -> None:
        """Stop listening."""
        self.costmap.close()

    def _limited(self, grid: CostGrid) -> OccupancyGrid:
        """Return the costs as a map that ends at the polygon."""
        cells = occupancy_of_costs(grid.costs).copy()
        if self.settings.flag("explore_clear_space"):
            cells[~self._seen(grid) & (cells < _OCCUPIED)] = _UNKNOWN
        made = OccupancyGrid(cells, grid.resolution_m, (*grid.origin, 0.0))
        if len(self.corners) and self.settings.flag("enabled"):
            rows, columns = np.indices(cells.shape)
            places = np.column_stack(made.cell_to_world(columns.ravel(), rows.ravel()))
            cells[~are_inside(places, self.corners).reshape(cells.shape)] = _OCCUPIED
        return made

    def _seen(self, grid: CostGrid) -> NDArray[np.bool_]:
        seen = np.zeros(grid.costs.shape, np.bool_)
        for layer in self.costmap.assembly.costmap.layers:
            if isinstance(layer, ObstacleLayer) and layer.grid is not None:
                seen |= layer.grid.costs != 255
        return seen

    def _take_layer(self) -> str:
        """Take the polygon's layer out of ``plugins`` and return its name."""
        plugins = self._tree.get("plugins")
        rows = plugins if isinstance(plugins, list) else []
        own = [row for row in rows if isinstance(row, Mapping) and row.get("type") == LAYER_TYPE]
        if not own:
            return _LAYER
        self._tree["plugins"] = [row for row in rows if row not in own]
        return str(own[0].get("name", _LAYER))

    def _travel_point(self) -> str:
        point = self.settings.text("frontier_travel_point")
        if point in _TRAVEL_POINTS:
            return point
        text = f"Invalid 'frontier_travel_point' parameter '{point}', falling back to 'closest'"
        known = ", ".join(_TRAVEL_POINTS)
        self.settings.report("parameter.bad-value", text, f"there are {known}")
        return "closest"

    def _made(self, tree: Mapping[str, Any], diagnostics: Diagnostics) -> Costmap2DRos:
        name = f"{self._node.name}/{_NAME}"
        made = assemble({**tree}, name, diagnostics, above=self._above)
        frame = made.costmap.options.global_frame.removeprefix("/")
        publisher = CostmapPublisher(self._node, f"~/{_NAME}", frame)
        return Costmap2DRos(self._node, self._frames, made, publisher)


class BoundedExploreServices:
    """``update_boundary_polygon``, ``get_next_frontier`` and ``frontiers`` of the layer."""

    def __init__(self, node: Node, area: BoundedExploreLayer) -> None:
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
