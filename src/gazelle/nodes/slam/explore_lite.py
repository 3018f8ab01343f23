"""``explore_lite/explore``: drives to frontiers until the whole map is known."""

from __future__ import annotations

import math
import threading
from typing import Any

from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph, Node
from gazelle.graph.actions import ActionClient, ClientGoal
from gazelle.interfaces.poses import set_plane_pose
from gazelle.interfaces.stamps import set_header
from gazelle.mapping.frontiers import Frontier, find_frontiers
from gazelle.mapping.grids import OccupancyGrid
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.map_server.occupancy_grid import grid_of_message
from gazelle.nodes.navigation.robot_pose import Frames
from gazelle.nodes.parameters import log_findings, node_reader, parameter_tree, start_node, ticks
from gazelle.parameters import Parameter, ParameterTable, refused
from gazelle.parameters.reader import ParameterReader

__all__ = ["EXPLORE", "run_explore"]

_NANO = 1_000_000_000
_SAME_M = 0.3
_ACTIONS = (
    ("move_base", "move_base_msgs/MoveBase", "target_pose"),
    ("navigate_to_pose", "nav2_msgs/NavigateToPose", "pose"),
)

EXPLORE = ParameterTable(
    "explore_lite",
    "Drives to the border of the unknown, by move_base or Nav2, until there is none.",
    ("explore_lite/explore",),
    (
        Parameter("robot_base_frame", "text", "base_link", "the robot's frame"),
        Parameter("costmap_topic", "text", "costmap", "map or costmap to explore"),
        Parameter("planner_frequency", "number", 1.0, "how often frontiers are looked for", "Hz",
                  0.01),
        Parameter("progress_timeout", "number", 30.0,
                  "a goal is given up after so long without coming"
            " nearer", "s", 0.0),
        Parameter("potential_scale", "number", 1e-3, "weight of the distance", "", 0.0),
        Parameter("gain_scale", "number", 1.0, "weight of the frontier's size", "", 0.0),
        Parameter("transform_tolerance", "number", 0.3, "how old the robot's pose may be", "s",
                  0.0),
        Parameter("min_frontier_size", "number", 0.5, "smaller frontiers are left out", "m", 0.0),
        *refused("maps are taken whole", "costmap_updates_topic"),
        *refused("frontiers are not drawn", "visualize"),
        *refused("the original reads it and does not use it", "orientation_scale"),
    ),
)  # fmt: skip


def run_explore(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """``explore_lite/explore``."""
    node = start_node(arguments, graph)
    tree = parameter_tree(node, arguments)
    found = Diagnostics()
    settings = node_reader(EXPLORE, tree, node.resolve_name("~"), found)
    explorer = _Explorer(node, settings)
    settings.report_unknown()
    log_findings(node, found)
    arguments.ready()
    for now_ns in ticks(node, int(_NANO / settings.number("planner_frequency")), stop):
        if explorer.step(now_ns):
            break
    stop.wait()
    explorer.cancel()
    node.shutdown()
    return 0


class _Explorer:
    def __init__(self, node: Node, settings: ParameterReader) -> None:
        self._node, self._frames = node, Frames(node)
        self._base = settings.text("robot_base_frame").removeprefix("/")
        self._tolerance_s = settings.number("transform_tolerance")
        self._patience_ns = int(settings.number("progress_timeout") * _NANO)
        self._least_m = settings.number("min_frontier_size")
        self._scales = settings.number("potential_scale"), settings.number("gain_scale")
        self._map: tuple[str, OccupancyGrid] | None = None
        self._given_up: list[tuple[float, float]] = []
        self._goal: ClientGoal | None = None
        self._to: tuple[float, float] | None = None
        self._nearest_m, self._nearer_ns = math.inf, 0
        self._clients = [
            (ActionClient(node, name, kind), name_of_pose) for name, kind, name_of_pose in _ACTIONS
        ]
        node.create_subscription(
            settings.text("costmap_topic"), "nav_msgs/msg/OccupancyGrid", self._on_map
        )

    def step(self, now_ns: int) -> bool:
        """Go on to the best frontier; return whether there is none any more."""
        client = next((one for one in self._clients if one[0].is_server_ready), None)
        if self._map is None or client is None:
            what = "map" if self._map is None else "action server move_base or navigate_to_pose"
            self._frames.say("warn", f"waiting: there is no {what} yet", what)
            return False
        frame, grid = self._map
        robot = self._frames.robot(frame, self._base, self._tolerance_s)
        if isinstance(robot, str):
            self._frames.say("warn", robot, "robot")
            return False
        self._judge(robot.pose[:2], now_ns)
        best = self._best(grid, robot.pose[:2])
        if best is None:
            self.cancel()
            self._node.log("info", "explored: there is no frontier left that can be reached")
            return True
        if self._to is None or math.dist(best.nearest_m, self._to) > _SAME_M:
            self._send(client, frame, best, now_ns)
        return False

    def cancel(self) -> None:
        """Give the goal up."""
        if self._goal is not None and not self._goal.is_done:
            self._goal.cancel()
        self._goal = self._to = None

    def _on_map(self, message: Any) -> None:
        try:
            self._map = (str(message.header.frame_id) or "map", grid_of_message(message))
        except ValueError as error:
            self._node.log("error", f"a map is not taken: {error}")

    def _best(self, grid: OccupancyGrid, robot_m: tuple[float, float]) -> Frontier | None:
        potential, gain = self._scales
        frontiers = find_frontiers(
            grid, robot_m,
            least_size_m=self._least_m, potential_scale=potential, gain_scale=gain,
        )  # fmt: skip
        return next((one for one in frontiers if not self._is_given_up(one)), None)

    def _is_given_up(self, one: Frontier) -> bool:
        return any(math.dist(one.nearest_m, other) < _SAME_M for other in self._given_up)

    def _judge(self, robot_m: tuple[float, float], now_ns: int) -> None:
        """Give up a frontier that cannot be reached, or that does not come nearer."""
        if self._goal is None or self._to is None:
            return
        far_m = math.dist(robot_m, self._to)
        if far_m < self._nearest_m - 0.05:
            self._nearest_m, self._nearer_ns = far_m, now_ns
        failed = self._goal.is_done and self._goal.status.name != "SUCCEEDED"
        stuck = now_ns - self._nearer_ns > self._patience_ns
        if failed or stuck or self._goal.is_done:
            # A frontier that is still there after the robot stood at it will not go away.
            self._given_up.append(self._to)
            if failed or stuck:
                x, y = self._to
                why = "cannot be reached" if failed else "does not come nearer"
                self._node.log("warn", f"the frontier at ({x:.2f}, {y:.2f}) {why}; it is left out")
            self.cancel()

    def _send(
        self, client: tuple[ActionClient, str], frame: str, best: Frontier, now_ns: int
    ) -> None:
        action, name_of_pose = client
        goal = action.types.Goal()
        pose = getattr(goal, name_of_pose)
        set_header(pose, now_ns, frame)
        set_plane_pose(pose.pose, (*best.nearest_m, 0.0))
        self._to, self._nearest_m, self._nearer_ns = best.nearest_m, math.inf, now_ns
        self._goal = action.send_goal(goal)
