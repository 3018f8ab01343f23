"""move_base's global planner: a plug-in by its name, its topic and its services."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.interfaces import message_type, service_type
from gazelle.interfaces.poses import unit_pose_of
from gazelle.navigation.planners import PLANNERS, REFUSED_PLANNERS, NoPlan, Plan, make_plan
from gazelle.nodes.navigation.costmap_2d_ros import Costmap2DRos
from gazelle.nodes.navigation.robot_pose import PlanePose, path_message
from gazelle.nodes.parameters import node_reader
from gazelle.parameters import ParameterTable
from gazelle.parameters.dataclass_tables import table_of

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["GlobalPlanner", "planner_tables", "short_name"]

_DEFAULT = "navfn/NavfnROS"


def short_name(plugin: str) -> str:
    """Return a plug-in's namespace, as move_base takes it from its type."""
    return plugin.replace("::", "/").rpartition("/")[2]


def planner_tables() -> tuple[ParameterTable, ...]:
    """Return the parameters of all planners of ROS 1."""
    return tuple(
        _table(name) for name, kind in PLANNERS.items() if not name.startswith("nav2_") and kind
    )


class GlobalPlanner:
    """Plans over the global costmap.

    Attributes:
        name: its namespace below the node, such as ``NavfnROS``.
    """

    def __init__(
        self,
        node: Node,
        costmap: Costmap2DRos,
        plugin: str,
        tree: Mapping[str, Any],
        diagnostics: Diagnostics,
    ) -> None:
        """Offer ``plan`` and ``make_plan`` below the planner's name."""
        if plugin not in PLANNERS:
            _refuse(plugin, node.name, diagnostics)
            plugin = _DEFAULT
        self.name = short_name(plugin)
        self._node = node
        self._costmap = costmap
        below = tree.get(self.name)
        own = below if isinstance(below, Mapping) else {}
        self._settings = node_reader(_table(plugin), own, f"{node.name}/{self.name}", diagnostics)
        self._options = self._settings.fill(PLANNERS[plugin].options)
        self._settings.report_unknown()
        kind = message_type("nav_msgs/msg/Path")
        self._out = node.create_publisher(f"~/{self.name}/plan", kind, queue_size=1)
        get_plan = service_type("nav_msgs/GetPlan")
        node.create_service(f"~/{self.name}/make_plan", get_plan, self._on_make_plan)

    def plan(
        self, start: PlanePose, goal: PlanePose, tolerance_m: float | None = None
    ) -> Plan | NoPlan:
        """Plan, and publish what was found; an empty path when there is none."""
        found = make_plan(self._costmap.snapshot(), start, goal, self._options, tolerance_m)
        if self._out.matched:
            poses = found.poses if isinstance(found, Plan) else ()
            self._out.publish(self.message(poses))
        return found

    def message(self, poses: Any) -> Any:
        """Return poses as a ``nav_msgs/Path`` of the costmap's frame."""
        return path_message(poses, self._costmap.global_frame, self._node.clock.now_ns())

    def answer(self, request: Any) -> Any:
        """Answer ``nav_msgs/GetPlan``: start (the robot without a frame), goal and tolerance."""
        response = service_type("nav_msgs/GetPlan").Response()
        ends = [self._end(request.start, is_start=True), self._end(request.goal, is_start=False)]
        if any(end is None for end in ends):
            return response
        start, goal = (end for end in ends if end is not None)
        found = self.plan(start, goal, max(float(request.tolerance), 0.0))
        if isinstance(found, NoPlan):
            self._node.log("warn", f"make_plan: {found.reason}")
        else:
            response.plan = self.message(found.poses)
        response.plan.header.frame_id = self._costmap.global_frame
        return response

    def _on_make_plan(self, request: Any) -> Any:
        return self.answer(request)

    def _end(self, pose: Any, *, is_start: bool) -> PlanePose | None:
        if is_start and not pose.header.frame_id:
            return self._costmap.pose()
        found = self._costmap.frames.message_in(pose, self._costmap.global_frame)
        if isinstance(found, str):
            self._node.log("error", f"make_plan: {found}")
            return None
        at = unit_pose_of(found.pose).xy_yaw
        return at if all(map(math.isfinite, at)) else None


def _table(plugin: str) -> ParameterTable:
    kind = PLANNERS[plugin]
    summary = "Plans over the whole costmap." + (f" {kind.note}." if kind.note else "")
    return table_of(kind.options, short_name(plugin), summary, (plugin,))


def _refuse(plugin: str, name: str, diagnostics: Diagnostics) -> None:
    known = [one for one in PLANNERS if not one.startswith("nav2_")]
    why = REFUSED_PLANNERS.get(plugin) or did_you_mean(plugin, known)
    text = f"{name}: base_global_planner '{plugin}' is not known; there are {', '.join(known)}"
    diagnostics.report("navigation.unknown-plugin", f"{text}. {_DEFAULT} plans instead", fix=why)
