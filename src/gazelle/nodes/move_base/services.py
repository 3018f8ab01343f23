"""move_base's services: plans for others, clearing."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from gazelle.graph import ServiceRefusedError
from gazelle.interfaces import message_type, service_type
from gazelle.interfaces.poses import unit_pose_of
from gazelle.nodes.move_base.global_planner import GlobalPlanner
from gazelle.nodes.navigation.costmap_2d_ros import LiveCostmap
from gazelle.nodes.navigation.simple_action_server import SingleGoal
from gazelle.parameters.reader import ParameterReader

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["Services"]


class Services:
    """``make_plan`` and ``clear_costmaps``."""

    def __init__(
        self,
        node: Node,
        planner: GlobalPlanner,
        costmaps: Mapping[str, LiveCostmap],
        goals: SingleGoal,
        settings: ParameterReader,
    ) -> None:
        """Offer them below the node's name."""
        self._planner = planner
        self._costmaps = costmaps
        self._goals = goals
        self._settings = settings
        self._empty = service_type("std_srvs/Empty")
        node.create_service("~/make_plan", service_type("nav_msgs/GetPlan"), self._on_make_plan)
        node.create_service("~/clear_costmaps", self._empty, self._on_clear)

    def _on_make_plan(self, request: Any) -> Any:
        if self._goals.current is not None:
            raise ServiceRefusedError(
                "move_base must be in an inactive state to make a plan for an external user"
            )
        whole = self._costmaps["global_costmap"]
        if not whole.is_ready:
            raise ServiceRefusedError(
                "move_base cannot make a plan for you because it doesn't have a costmap"
            )
        if self._settings.flag("make_plan_clear_costmap"):
            self._clear_start(whole, request.start)
        response = self._planner.answer(request)
        if response.plan.poses and self._settings.flag("make_plan_add_unreachable_goal"):
            self._add_goal(response.plan, request.goal, whole)
        return response

    def _clear_start(self, whole: LiveCostmap, start: Any) -> None:
        radius = self._settings.number("clearing_radius", whole.footprint.circumscribed_m)
        centre = None
        if start.header.frame_id:
            found = whole.frames.message_in(start, whole.global_frame)
            centre = None if isinstance(found, str) else unit_pose_of(found.pose).xy_yaw
        whole.clear_around(2 * radius, inside=True, centre=centre)

    def _add_goal(self, plan: Any, goal: Any, whole: LiveCostmap) -> None:
        """Let a plan that ends near the goal end in it."""
        found = whole.frames.message_in(goal, whole.global_frame)
        if isinstance(found, str):
            return
        last = plan.poses[-1].pose
        if unit_pose_of(last).xy_yaw != unit_pose_of(found.pose).xy_yaw:
            end: Any = message_type("geometry_msgs/msg/PoseStamped")(
                header=plan.header, pose=found.pose
            )
            plan.poses.append(end)

    def _on_clear(self, _request: Any) -> Any:
        for costmap in self._costmaps.values():
            costmap.reset()
        return self._empty.Response()
