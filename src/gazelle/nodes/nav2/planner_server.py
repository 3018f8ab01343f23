"""``nav2_planner planner_server``: paths to a pose, or through poses."""

from __future__ import annotations

import threading
from collections.abc import Iterable, Mapping
from functools import partial
from typing import Any

import numpy as np

from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.graph import Graph
from gazelle.graph.actions import ServerGoal
from gazelle.interfaces import action_type, message_type, service_type
from gazelle.interfaces.poses import unit_pose_of
from gazelle.interfaces.stamps import set_stamp
from gazelle.navigation.costmap import INSCRIBED, UNKNOWN
from gazelle.navigation.planners import (
    PLANNERS,
    REFUSED_PLANNERS,
    NoPlan,
    PlannerOptions,
    make_plan,
)
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.nav2.lifecycle_server import ManagedServer, ServedAction, ServerSetup, run_server
from gazelle.nodes.nav2.parameters import PLANNER_SERVER, planner_table
from gazelle.nodes.navigation.robot_pose import PlanePose, path_message
from gazelle.nodes.navigation.simple_action_server import SimpleActionServer
from gazelle.parameters.reader import ParameterReader

__all__ = ["run"]

_DEFAULT = "nav2_navfn_planner::NavfnPlanner"
_READY_S = 10.0


class _RefusedError(Exception):
    """There is no path; the arguments are the word of the error code and the reason."""


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Plan until told to stop."""
    return run_server(_PlannerServer, arguments, graph, stop)


class _PlannerServer(ManagedServer):
    def __init__(self, setup: ServerSetup) -> None:
        super().__init__(setup, PLANNER_SERVER, "global_costmap")
        self._planners: dict[str, PlannerOptions] = {}
        kind = message_type("nav_msgs/msg/Path")
        self._out = self._node.create_publisher("plan", kind, queue_size=1)
        service = service_type("nav2_msgs/srv/IsPathValid")
        self._node.create_service("is_path_valid", service, self._on_is_valid)

    def _configured(self, settings: ParameterReader, diagnostics: Diagnostics) -> bool:
        names = settings.texts("planner_plugins")
        self._planners = {}
        for name in names:
            below = self._tree.get(name)
            options = _options(name, below if isinstance(below, Mapping) else {}, settings)
            if options is not None:
                self._planners[name] = options
        settings.report_unknown(*names)
        return bool(self._planners)

    def _served(self) -> Iterable[ServedAction]:
        for name, kind, work in (
            ("compute_path_to_pose", "ComputePathToPose", self._to_pose),
            ("compute_path_through_poses", "ComputePathThroughPoses", self._through_poses),
        ):
            yield ServedAction(name, kind, partial(self._answer, kind, work))

    def _answer(
        self, type_name: str, work: Any, action: SimpleActionServer, goal: ServerGoal
    ) -> None:
        if action.is_cancelled:
            action.cancel()
            return
        result = action.result_class()
        began_ns = self._node.clock.now_ns()
        try:
            poses = work(goal.request)
        except _RefusedError as refused:
            word, reason = refused.args
            self._node.log("warn", f"{action.name}: {reason}")
            codes = action_type(f"nav2_msgs/{type_name}").Result
            result.error_code, result.error_msg = int(getattr(codes, word, 0)), reason
            action.abort(result, reason)
            return
        assert self._costmap is not None
        now_ns = self._node.clock.now_ns()
        result.path = path_message(poses, self._costmap.live.global_frame, now_ns)
        took_ns = max(now_ns - began_ns, 0)
        set_stamp(result.planning_time, took_ns)
        if self._out.matched:
            self._out.publish(result.path)
        action.succeed(result)

    def _to_pose(self, request: Any) -> Any:
        start, options = self._begin(request)
        return self._between(start, self._in_map(request.goal), options)

    def _through_poses(self, request: Any) -> Any:
        goals = request.goals.goals if hasattr(request.goals, "goals") else request.goals
        if not goals:
            raise _RefusedError("NO_VIAPOINTS_GIVEN", "no poses to go through are given")
        start, options = self._begin(request)
        parts = []
        for goal in goals:
            target = self._in_map(goal)
            parts.append(self._between(start, target, options))
            start = target
        return np.concatenate(parts)

    def _begin(self, request: Any) -> tuple[PlanePose, PlannerOptions]:
        """Return where the path begins, and who plans it."""
        name = request.planner_id
        if not name and len(self._planners) == 1:
            name = next(iter(self._planners))
        if name not in self._planners:
            known = ", ".join(self._planners)
            text = f"planner {name} is not a valid planner. Planner names are: {known}"
            raise _RefusedError("INVALID_PLANNER", f"{text}. {did_you_mean(name, self._planners)}")
        self._wait_for_costmap()
        if request.use_start:
            return self._in_map(request.start), self._planners[name]
        assert self._costmap is not None
        pose = self._costmap.live.pose()
        if pose is None:
            raise _RefusedError("TF_ERROR", "the robot's pose in the map is not known")
        return pose, self._planners[name]

    def _wait_for_costmap(self) -> None:
        assert self._costmap is not None
        live, clock = self._costmap.live, self._node.clock
        deadline_ns = clock.now_ns() + int(_READY_S * 1e9)
        pause = threading.Event()
        while not live.is_ready and (live.is_updating or clock.now_ns() < deadline_ns):
            pause.wait(0.05)
            if self._ending.is_set():
                break
        if not live.is_ready:
            why = "; ".join(live.stale())
            raise _RefusedError("TIMEOUT", f"the global costmap is not there yet: {why}")

    def _in_map(self, pose: Any) -> PlanePose:
        assert self._costmap is not None
        live = self._costmap.live
        found = live.frames.message_in(pose, live.global_frame)
        if isinstance(found, str):
            raise _RefusedError("TF_ERROR", found)
        return unit_pose_of(found.pose).xy_yaw

    def _between(self, start: PlanePose, goal: PlanePose, options: PlannerOptions) -> Any:
        assert self._costmap is not None
        found = make_plan(self._costmap.live.snapshot(), start, goal, options)
        if isinstance(found, NoPlan):
            raise _RefusedError(found.failure.value, found.reason)
        return found.poses

    def _on_is_valid(self, request: Any) -> Any:
        response = service_type("nav2_msgs/srv/IsPathValid").Response()
        if self._costmap is None or not request.path.poses:
            return response
        grid = self._costmap.live.snapshot()
        poses = [unit_pose_of(one.pose).xy_yaw for one in request.path.poses]
        costs = [grid.cost_at(x, y) for x, y, _ in poses]
        bad = [place for place, cost in enumerate(costs) if INSCRIBED <= cost < UNKNOWN]
        response.is_valid = not bad
        response.invalid_pose_indices = bad
        return response


def _options(
    name: str, tree: Mapping[str, Any], settings: ParameterReader
) -> PlannerOptions | None:
    plugin = str(tree.get("plugin", _DEFAULT))
    if plugin not in PLANNERS:
        why = REFUSED_PLANNERS.get(plugin) or did_you_mean(plugin, PLANNERS)
        known = ", ".join(sorted(one for one in PLANNERS if "::" in one))
        text = f"planner '{name}' is of type '{plugin}', which is not known; there are {known}"
        settings.report("navigation.unknown-plugin", text, why)
        return None
    own = {key: value for key, value in tree.items() if key != "plugin"}
    below = settings.with_table(planner_table(plugin), own, name)
    options = below.fill(PLANNERS[plugin].options)
    below.report_unknown()
    return options
