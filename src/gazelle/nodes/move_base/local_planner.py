"""move_base's local planner: a plug-in by its name, its topics and its frame."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gazelle.diagnostics import Diagnostics, did_you_mean
from gazelle.interfaces import message_type
from gazelle.mapping.se2 import compose
from gazelle.navigation.controllers import (
    CONTROLLERS,
    REFUSED_CONTROLLERS,
    Command,
    Controller,
    ControllerSetting,
    RobotState,
)
from gazelle.nodes.move_base.global_planner import short_name
from gazelle.nodes.navigation.costmap_2d_ros import Costmap2DRos
from gazelle.nodes.navigation.robot_pose import Odometry, PlanePose, path_message
from gazelle.nodes.parameters import node_reader
from gazelle.parameters import Parameter, ParameterTable
from gazelle.parameters.dataclass_tables import table_of

if TYPE_CHECKING:
    from gazelle.graph import Node

__all__ = ["LocalPlanner", "local_planner_tables"]

_DEFAULT = "base_local_planner/TrajectoryPlannerROS"
_OWN_ROWS = (
    Parameter("odom_topic", "text", "odom", "topic of odometry"),
    Parameter("controller_frequency", "refused", None, "move_base's own counts"),
)


def local_planner_tables() -> tuple[ParameterTable, ...]:
    """Return the parameters of all local planners of ROS 1."""
    return tuple(_table(name) for name in CONTROLLERS if _is_ros1(name))


class LocalPlanner:
    """Follows the global plan in the local costmap.

    Attributes:
        name: its namespace below the node, such as ``DWAPlannerROS``.
        settings: its parameters.
        odometry: how the robot moves.
    """

    def __init__(
        self,
        node: Node,
        costmap: Costmap2DRos,
        plugin: str,
        tree: Mapping[str, Any],
        period_s: float,
        diagnostics: Diagnostics,
    ) -> None:
        """Offer ``global_plan`` and ``local_plan`` below the planner's name."""
        if plugin not in CONTROLLERS:
            _refuse(plugin, node.name, diagnostics)
            plugin = _DEFAULT
        self.name = short_name(plugin)
        self._node = node
        self._costmap = costmap
        self._kind = CONTROLLERS[plugin]
        self._period_s = period_s
        below = tree.get(self.name)
        own = below if isinstance(below, Mapping) else {}
        self.settings = node_reader(_table(plugin), own, f"{node.name}/{self.name}", diagnostics)
        self.odometry = Odometry(node, self.settings.text("odom_topic"))
        self._controller: Controller = self._made()
        self.settings.report_unknown()
        path = message_type("nav_msgs/msg/Path")
        self._global_out = node.create_publisher(f"~/{self.name}/global_plan", path, queue_size=1)
        self._local_out = node.create_publisher(f"~/{self.name}/local_plan", path, queue_size=1)
        self._plan: NDArray[np.float64] = np.zeros((0, 3))
        self._plan_frame = ""
        self._T_local_plan: PlanePose | None = None

    def set_plan(self, plan: NDArray[np.float64], frame: str) -> bool:
        """Take a plan, (n, 3): x, y (m), yaw (rad) in a frame; False when tf does not know that."""
        self._plan, self._plan_frame, self._T_local_plan = plan, frame, None
        return self._place_plan() == ""

    def goal_reached(self) -> bool:
        """Ask the controller."""
        pose = self._costmap.pose()
        if pose is None or self._place_plan():
            return False
        return self._controller.goal_reached(RobotState(pose, self.odometry.velocity))

    def compute(self) -> Command | str:
        """Return the next velocity, or why there is none."""
        why = self._place_plan()
        if why:
            return why
        pose = self._costmap.pose_or_why()
        if isinstance(pose, str):
            return f"Could not get robot pose: {pose}"
        state = RobotState(pose, self.odometry.velocity)
        with self._costmap.lock:
            found = self._controller.compute(state, self._costmap.grid, self._costmap.footprint)
        if not isinstance(found, Command):
            return found.reason
        if found.note:
            self._node.log("warn", found.note)
        self._tell(found)
        return found

    def reset(self) -> None:
        """Forget the plan."""
        self._controller.reset()
        self._plan, self._T_local_plan = np.zeros((0, 3)), None

    def limit_speed(self, m_s: float | None) -> None:
        """Drive no faster than this; None for the planner's own limits."""
        self._controller.limit_speed(m_s)

    def change(self, values: Mapping[str, Any]) -> None:
        """Take new values of parameters; the plan is followed on."""
        self.settings.tree.update(values)
        self._controller = self._made()
        self._T_local_plan = None

    def _made(self) -> Controller:
        options = self.settings.fill(self._kind.options)
        given = tuple(self.settings.tree)
        return self._kind.make(options, ControllerSetting(self._period_s, {}, given=given))

    def _place_plan(self) -> str:
        """Give the plan to the controller where its frame has moved; returns why it cannot be."""
        if not len(self._plan):
            return "there is no plan to follow"
        frames, local = self._costmap.frames, self._costmap.global_frame
        found = frames.between(local, self._plan_frame)
        if isinstance(found, str):
            return f"the plan's frame {self._plan_frame} is not known in {local}: {found}"
        T_local_plan = found.xy_yaw
        if self._T_local_plan != T_local_plan:
            has_moved = self._T_local_plan is not None
            self._T_local_plan = T_local_plan
            self._controller.set_plan(compose(T_local_plan, self._plan), has_moved=has_moved)
        return ""

    def _tell(self, command: Command) -> None:
        now_ns = self._node.clock.now_ns()
        frame = self._costmap.global_frame
        if self._local_out.matched:
            self._local_out.publish(path_message(command.trajectory, frame, now_ns))
        if self._global_out.matched and self._T_local_plan is not None:
            poses = compose(self._T_local_plan, self._plan)
            self._global_out.publish(path_message(poses, frame, now_ns))


def _is_ros1(name: str) -> bool:
    return "::" not in name and not name.startswith(("nav2_", "dwb_"))


def _table(plugin: str) -> ParameterTable:
    kind = CONTROLLERS[plugin]
    summary = "Drives along the plan." + (f" {kind.note}." if kind.note else "")
    live = [row.key for row in table_of(kind.options, "", "").rows if row.kind != "refused"]
    made = table_of(kind.options, short_name(plugin), summary, (plugin,), live=live)
    known = {row.key for row in made.rows}
    return made.plus(row for row in _OWN_ROWS if row.key not in known)


def _refuse(plugin: str, name: str, diagnostics: Diagnostics) -> None:
    known = [one for one in CONTROLLERS if _is_ros1(one)]
    why = REFUSED_CONTROLLERS.get(plugin) or did_you_mean(plugin, known)
    text = f"{name}: base_local_planner '{plugin}' is not known; there are {', '.join(known)}"
    diagnostics.report("navigation.unknown-plugin", f"{text}. {_DEFAULT} drives instead", fix=why)
