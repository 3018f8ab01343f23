"""``nav2_behaviors behavior_server``: spin, back up, drive on, wait."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import Any

from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph
from gazelle.graph.actions import ServerGoal
from gazelle.interfaces import action_type
from gazelle.interfaces.stamps import ns_of, set_stamp
from gazelle.navigation.costmap import CostGrid, Footprint, footprint_cost
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.nav2.costmap_node import grid_of_costmap, outline_in_base
from gazelle.nodes.nav2.lifecycle_server import ManagedServer, ServedAction, ServerSetup, run_server
from gazelle.nodes.nav2.parameters import BEHAVIOR_SERVER
from gazelle.nodes.navigation.robot_pose import Frames, PlanePose
from gazelle.nodes.navigation.simple_action_server import SimpleActionServer
from gazelle.nodes.parameters import ticks
from gazelle.nodes.twist_publisher import TwistPublisher
from gazelle.parameters.reader import ParameterReader

__all__ = ["run"]

_NANO = 1_000_000_000
_TYPES = {
    "Spin": ("spin", "Spin"),
    "BackUp": ("backup", "BackUp"),
    "DriveOnHeading": ("drive_on_heading", "DriveOnHeading"),
    "Wait": ("wait", "Wait"),
}


class _EndError(Exception):
    """A behaviour cannot go on; the arguments are the word of the error code and the reason."""


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Offer behaviours until told to stop."""
    return run_server(_BehaviorServer, arguments, graph, stop)


class _BehaviorServer(ManagedServer):
    def __init__(self, setup: ServerSetup) -> None:
        super().__init__(setup, BEHAVIOR_SERVER)
        self._frames = Frames(self._node)
        stamped = self._settings.flag("enable_stamped_cmd_vel")
        self._out = TwistPublisher(self._node, is_stamped=stamped)
        self._grid: CostGrid | None = None
        self._footprint: Footprint | None = None

    def _configured(self, settings: ParameterReader, diagnostics: Diagnostics) -> bool:
        names = self._names()
        for name in names:
            kind = self._kind(name)
            if kind not in _TYPES and kind != "AssistedTeleop":
                known = ", ".join(f"nav2_behaviors::{one}" for one in _TYPES)
                text = f"behaviour '{name}' is of type '{kind}', which is not known; there are "
                settings.report("navigation.unknown-plugin", text + known)
        settings.report_unknown(*names)
        given = settings.text
        costs = given("costmap_topic") or given("local_costmap_topic")
        outline = given("footprint_topic") or given("local_footprint_topic")
        self._node.create_subscription(costs, "nav2_msgs/msg/Costmap", self._on_costs)
        kind = "geometry_msgs/msg/PolygonStamped"
        self._node.create_subscription(outline, kind, self._on_outline)
        return True

    def _served(self) -> Iterable[ServedAction]:
        for name in self._names():
            known = _TYPES.get(self._kind(name))
            if known is not None:
                yield ServedAction(name, known[1], partial(self._behave, known[1]))

    def _names(self) -> list[str]:
        return list(self._settings.texts("recovery_plugins")) or list(
            self._settings.texts("behavior_plugins")
        )

    def _kind(self, name: str) -> str:
        """Return the bare type of a behaviour, ``nav2_behaviors/Spin`` and its like."""
        below = self._tree.get(name)
        plugin = str(below.get("plugin", "")) if isinstance(below, dict) else ""
        defaults = {row[0]: kind for kind, row in _TYPES.items()}
        bare = plugin.replace("::", "/").rpartition("/")[2]
        return bare or defaults.get(name, name)

    def _behave(self, kind: str, action: SimpleActionServer, goal: ServerGoal) -> None:
        """Work on a goal of a behaviour."""
        runs: dict[str, Callable[[SimpleActionServer, ServerGoal], None]] = {
            "Spin": self._spin, "BackUp": self._drive, "DriveOnHeading": self._drive,
            "Wait": self._wait,
        }  # fmt: skip
        began_ns = self._node.clock.now_ns()
        result = action.result_class()
        word, reason = "NONE", ""
        try:
            runs[kind](action, goal)
        except _EndError as end:
            word, reason = end.args
        if kind != "Wait":
            self._out.stop()
        set_stamp(result.total_elapsed_time, max(self._node.clock.now_ns() - began_ns, 0))
        self._finish(action, kind, result, word, reason)

    def _finish(
        self, action: SimpleActionServer, kind: str, result: Any, word: str, reason: str
    ) -> None:
        if action.is_cancelled:
            action.cancel(result)
        elif word == "NONE":
            action.succeed(result)
        else:
            codes = action_type(f"nav2_msgs/{kind}").Result
            result.error_code, result.error_msg = int(getattr(codes, word, 0)), reason
            self._node.log("warn", f"{action.name}: {reason}")
            action.abort(result, reason)

    def _spin(self, action: SimpleActionServer, goal: ServerGoal) -> None:
        """Turn by an angle."""
        wanted = float(goal.request.target_yaw)
        number = self._settings.number
        turned, last = 0.0, self._pose()[2]
        for _ in self._rounds(action, goal):
            yaw = self._pose()[2]
            turned += math.remainder(yaw - last, math.tau)
            last = yaw
            left = abs(wanted) - turned * math.copysign(1.0, wanted)
            if left < 1e-6:
                return
            fastest = math.sqrt(2 * number("rotational_acc_lim") * left)
            speed = min(max(fastest, number("min_rotational_vel")), number("max_rotational_vel"))
            turn = math.copysign(speed, wanted)
            self._look_ahead(0.0, turn, left / speed)
            self._out.publish(0.0, 0.0, turn)
            feedback = action_type("nav2_msgs/Spin").Feedback()
            feedback.angular_distance_traveled = turned
            action.feedback(feedback)

    def _drive(self, action: SimpleActionServer, goal: ServerGoal) -> None:
        """Drive along a line; `BackUp` goes backwards whatever the signs are."""
        request = goal.request
        if request.target.y or request.target.z:
            text = "y and z of a target are not there; the robot only drives straight on"
            raise _EndError("INVALID_INPUT", text)
        is_backup = "backup" in action.name or "BackUp" in type(request).__name__
        distance, speed = float(request.target.x), float(request.speed)
        if is_backup:
            distance, speed = -abs(distance), -abs(speed)
        elif distance * speed < 0:
            raise _EndError("INVALID_INPUT", "Speed and command sign did not match")
        begin = self._pose()
        for _ in self._rounds(action, goal):
            pose = self._pose()
            gone = math.hypot(pose[0] - begin[0], pose[1] - begin[1])
            if gone >= abs(distance):
                return
            self._look_ahead(speed, 0.0, (abs(distance) - gone) / max(abs(speed), 1e-6))
            self._out.publish(speed, 0.0, 0.0)
            feedback = action_type("nav2_msgs/BackUp").Feedback()
            feedback.distance_traveled = gone
            action.feedback(feedback)

    def _wait(self, action: SimpleActionServer, goal: ServerGoal) -> None:
        """Do nothing for a time."""
        end_ns = self._node.clock.now_ns() + ns_of(goal.request.time)
        for now_ns in self._rounds(action, None):
            if now_ns >= end_ns:
                return
            feedback = action_type("nav2_msgs/Wait").Feedback()
            left = feedback.time_left
            set_stamp(left, end_ns - now_ns)
            action.feedback(feedback)

    def _rounds(self, action: SimpleActionServer, goal: ServerGoal | None) -> Iterator[int]:
        """Yield the time at each round; ends with the goal."""
        allowance_ns = 0 if goal is None else ns_of(goal.request.time_allowance)
        end_ns = self._node.clock.now_ns() + allowance_ns
        period_ns = int(_NANO / self._settings.number("cycle_frequency"))
        for now_ns in ticks(self._node, period_ns, self._ending):
            if action.should_end:
                if action.has_new and not action.is_cancelled:
                    raise _EndError("UNKNOWN", "another goal was received")
                return
            if allowance_ns > 0 and now_ns > end_ns:
                raise _EndError("TIMEOUT", "Exceeded time allowance before reaching the goal")
            yield now_ns
        raise _EndError("UNKNOWN", "the behavior server was deactivated")

    def _pose(self) -> PlanePose:
        text = self._settings.text
        frames = text("local_frame"), text("robot_base_frame")
        tolerance_s = self._settings.number("transform_tolerance")
        found = self._frames.robot(*frames, tolerance_s, refuses_late=False)
        if isinstance(found, str):
            raise _EndError("TF_ERROR", found)
        return found.pose

    def _look_ahead(self, linear: float, turn: float, left_s: float) -> None:
        """Stop before the robot touches something.

        Raises:
            _EndError: it would, within the look-ahead.
        """
        if self._grid is None or self._footprint is None:
            return
        x, y, yaw = self._pose()
        span_s = min(self._settings.number("simulate_ahead_time"), left_s)
        step_s = 1.0 / self._settings.number("cycle_frequency")
        for number in range(1, int(span_s / step_s) + 1):
            t = number * step_s
            at = (x + linear * t * math.cos(yaw), y + linear * t * math.sin(yaw), yaw + turn * t)
            if footprint_cost(self._grid, self._footprint, at) == -1:
                raise _EndError("COLLISION_AHEAD", "Collision Ahead - Exiting")

    def _on_costs(self, message: Any) -> None:
        self._grid = grid_of_costmap(message)

    def _on_outline(self, message: Any) -> None:
        base = self._settings.text("robot_base_frame")
        found = outline_in_base(self._frames, message, base)
        if found is not None:
            self._footprint = Footprint(tuple((float(x), float(y)) for x, y in found))
