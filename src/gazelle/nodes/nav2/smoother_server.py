"""``nav2_smoother smoother_server``: smoother paths."""

from __future__ import annotations

import threading
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph
from gazelle.graph.actions import ServerGoal
from gazelle.interfaces import action_type
from gazelle.interfaces.poses import unit_pose_of
from gazelle.interfaces.stamps import set_stamp
from gazelle.navigation.costmap import INSCRIBED, UNKNOWN, CostGrid
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.nav2.costmap_node import grid_of_costmap
from gazelle.nodes.nav2.lifecycle_server import ManagedServer, ServedAction, ServerSetup, run_server
from gazelle.nodes.nav2.parameters import SMOOTHER, SMOOTHER_SERVER
from gazelle.nodes.navigation.robot_pose import path_message
from gazelle.nodes.navigation.simple_action_server import SimpleActionServer
from gazelle.parameters.reader import ParameterReader

__all__ = ["run", "smoothed"]

_SIMPLE = "nav2_smoother::SimpleSmoother"


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Smooth until told to stop."""
    return run_server(_SmootherServer, arguments, graph, stop)


def smoothed(
    points: NDArray[np.float64],
    *,
    w_data: float,
    w_smooth: float,
    tolerance_m: float,
    most: int,
    grid: CostGrid | None = None,
) -> NDArray[np.float64]:
    """Return points, (n, 2), drawn to each other and to where they were; the ends stay.

    This is gradient descent as ``SimpleSmoother`` does it; a round that would lead through what is
    lethal, by `grid`, is not done.
    """
    given, now = points, points.copy()
    for _ in range(most if len(points) > 2 else 0):
        inner = now[1:-1]
        pull = w_data * (given[1:-1] - inner) + w_smooth * (now[2:] + now[:-2] - 2 * inner)
        new = now.copy()
        new[1:-1] = inner + pull
        if grid is not None and _hits(new, grid):
            return now
        moved = float(np.abs(pull).max())
        now = new
        if moved < tolerance_m:
            break
    return now


class _SmootherServer(ManagedServer):
    def __init__(self, setup: ServerSetup) -> None:
        super().__init__(setup, SMOOTHER_SERVER)
        self._smoothers: dict[str, ParameterReader] = {}
        self._grid: CostGrid | None = None

    def _configured(self, settings: ParameterReader, diagnostics: Diagnostics) -> bool:
        names = settings.texts("smoother_plugins")
        for name in names:
            below = self._tree.get(name)
            own = dict(below) if isinstance(below, dict) else {}
            plugin = str(own.pop("plugin", _SIMPLE))
            if plugin.replace("/", "::") != _SIMPLE:
                text = f"smoother '{name}' is of type '{plugin}', which is not known; there is "
                settings.report("navigation.unknown-plugin", f"{text}{_SIMPLE}")
                continue
            self._smoothers[name] = settings.with_table(SMOOTHER, own, name)
            self._smoothers[name].report_unknown()
        settings.report_unknown(*names)
        topic = settings.text("costmap_topic")
        self._node.create_subscription(topic, "nav2_msgs/msg/Costmap", self._on_costs)
        return bool(self._smoothers)

    def _served(self) -> Iterable[ServedAction]:
        return (ServedAction("smooth_path", "SmoothPath", self._answer),)

    def _on_costs(self, message: Any) -> None:
        self._grid = grid_of_costmap(message)

    def _answer(self, action: SimpleActionServer, goal: ServerGoal) -> None:
        result = action.result_class()
        codes: Any = action_type("nav2_msgs/SmoothPath").Result
        name = goal.request.smoother_id or next(iter(self._smoothers))
        path = goal.request.path
        if name not in self._smoothers or not path.poses:
            known = ", ".join(self._smoothers)
            reason = f"smoother {name} is not a valid smoother. Smoother names are: {known}"
            word = "INVALID_SMOOTHER"
            if name in self._smoothers:
                word, reason = "INVALID_PATH", "the path is empty"
            result.error_code, result.error_msg = int(getattr(codes, word)), reason
            self._node.log("error", reason)
            action.abort(result, reason)
            return
        began_ns = self._node.clock.now_ns()
        poses = np.array([unit_pose_of(one.pose).xy_yaw for one in path.poses])
        points = self._smooth(poses[:, :2], self._smoothers[name])
        now_ns = self._node.clock.now_ns()
        result.path = path_message(_directed(points, poses), str(path.header.frame_id), now_ns)
        took_ns = max(now_ns - began_ns, 0)
        duration = result.smoothing_duration
        set_stamp(duration, took_ns)
        result.was_completed = True
        if (
            goal.request.check_for_collisions
            and self._grid is not None
            and _hits(points, self._grid)
        ):
            result.error_code = int(codes.SMOOTHED_PATH_IN_COLLISION)
            result.error_msg = "the smoothed path leads through an obstacle"
            action.abort(result, result.error_msg)
            return
        action.succeed(result)

    def _smooth(
        self, points: NDArray[np.float64], settings: ParameterReader
    ) -> NDArray[np.float64]:
        rounds = settings.integer("refinement_num") if settings.flag("do_refinement") else 0
        for _ in range(1 + max(rounds, 0)):
            points = smoothed(
                points,
                w_data=settings.number("w_data"),
                w_smooth=settings.number("w_smooth"),
                tolerance_m=settings.number("tolerance"),
                most=settings.integer("max_its"),
                grid=self._grid,
            )
        return points


def _hits(points: NDArray[np.float64], grid: CostGrid) -> bool:
    costs = [grid.cost_at(float(x), float(y)) for x, y in points]
    return any(INSCRIBED <= cost < UNKNOWN for cost in costs)


def _directed(points: NDArray[np.float64], poses: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return points that look along the path; the ends keep their directions."""
    yaws = poses[:, 2].copy()
    steps = np.diff(points, axis=0)
    if len(points) > 2:
        yaws[1:-1] = np.arctan2(steps[1:, 1], steps[1:, 0])
    return np.column_stack([points, yaws])
