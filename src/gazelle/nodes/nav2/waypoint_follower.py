"""``nav2_waypoint_follower waypoint_follower``: one pose after another."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Iterable
from typing import Any

from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph, TimeJumpError
from gazelle.graph.actions import ActionClient, ServerGoal
from gazelle.interfaces import action_type, message_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.nav2.lifecycle_server import ManagedServer, ServedAction, ServerSetup, run_server
from gazelle.nodes.nav2.parameters import WAYPOINT_FOLLOWER
from gazelle.nodes.navigation.simple_action_server import SimpleActionServer
from gazelle.parameters.reader import ParameterReader

__all__ = ["run"]

_SERVER_S = 10.0
_WAITING = "WaitAtWaypoint"


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Follow waypoints until told to stop."""
    return run_server(_Follower, arguments, graph, stop)


class _Follower(ManagedServer):
    # Nothing that may be wrong keeps it from driving from pose to pose.
    errors_refuse = False

    def __init__(self, setup: ServerSetup) -> None:
        super().__init__(setup, WAYPOINT_FOLLOWER)
        self._client = ActionClient(
            self._node, "navigate_to_pose", "nav2_msgs/NavigateToPose", ros_version=2
        )
        self._pause_s = 0.0

    def _configured(self, settings: ParameterReader, diagnostics: Diagnostics) -> bool:
        name = settings.text("waypoint_task_executor_plugin")
        settings.report_unknown(name)
        below = self._tree.get(name)
        own = below if isinstance(below, dict) else {}
        plugin = str(own.get("plugin", f"nav2_waypoint_follower::{_WAITING}"))
        if not plugin.endswith(_WAITING):
            text = f"task '{name}' is of type '{plugin}', which is not known; there is "
            text += f"nav2_waypoint_follower::{_WAITING}. Nothing is done at the poses"
            settings.report("navigation.unknown-plugin", text)
        elif own.get("enabled", True):
            self._pause_s = float(own.get("waypoint_pause_duration", 0.0)) / 1000
        return True

    def _served(self) -> Iterable[ServedAction]:
        return (ServedAction("follow_waypoints", "FollowWaypoints", self._follow),)

    def _follow(self, action: SimpleActionServer, goal: ServerGoal) -> None:
        """Drive to all poses of a goal, as often as it says."""
        result = action.result_class()
        poses = list(goal.request.poses)
        if not poses:
            self._node.log("error", "Empty vector of waypoints passed to waypoint following action "
                           "potentially due to conversation failure or empty request.")  # fmt: skip
            action.abort(result, "there are no waypoints")
            return
        loops = int(getattr(goal.request, "number_of_loops", 0))
        first = int(getattr(goal.request, "goal_index", 0))
        for loop in range(loops + 1):
            for index in range(first if loop == 0 else 0, len(poses)):
                feedback = action_type("nav2_msgs/FollowWaypoints").Feedback()
                feedback.current_waypoint = index
                action.feedback(feedback)
                why = self._drive(action, poses[index])
                if action.should_end or self._ending.is_set():
                    if action.is_cancelled:
                        action.cancel(result)
                    return
                if why and self._missed(action, result, index, poses[index], why):
                    return
        action.succeed(result, f"Completed all {len(poses)} waypoints requested.")

    def _missed(
        self, action: SimpleActionServer, result: Any, index: int, pose: Any, why: str
    ) -> bool:
        """Note a pose that was not reached; tells whether that is the end."""
        self._node.log("warn", f"Failed to process waypoint {index}: {why}")
        missed: Any = result.missed_waypoints
        kind = message_type("nav2_msgs/msg/MissedWaypoint")
        result.missed_waypoints = [*missed, kind(index=index, goal=pose)]
        if not self._settings.flag("stop_on_failure"):
            return False
        text = f"Failed to process waypoint {index} in waypoint list and stop on failure is enabled"
        action.abort(result, f"{text}: {why}")
        return True

    def _drive(self, action: SimpleActionServer, pose: Any) -> str:
        """Drive to one pose and wait there; returns why it was not reached."""
        if not self._client.wait_for_server(_SERVER_S):
            return "the action server navigate_to_pose is not there"
        sent = self._client.send_goal(self._client.types.Goal(pose=pose))
        period_s = 1.0 / self._settings.number("loop_rate")
        while not sent.wait(period_s):
            if action.should_end or self._ending.is_set():
                sent.cancel()
                return "it was left"
        if sent.status.name != "SUCCEEDED":
            said = getattr(sent.result, "error_msg", "") or sent.text
            return f"{sent.status.name.lower()} {said}".strip()
        until_ns = self._node.clock.now_ns() + int(self._pause_s * 1e9)
        # A clock that went back is not waited for: the pause is over.
        with contextlib.suppress(TimeJumpError):
            self._node.clock.sleep_until(until_ns, self._ending)
        return ""
