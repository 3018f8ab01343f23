"""``nav2_waypoint_follower waypoint_follower``: one pose after another."""

from __future__ import annotations

import contextlib
import threading
from typing import Any

from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph, Node, TimeJumpError
from gazelle.graph.actions import ActionClient, ServerGoal
from gazelle.interfaces import action_type, message_type
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.findings import log_findings
from gazelle.nodes.nav2.starting import offer_parameters, serve, start
from gazelle.nodes.nav2.tables import WAYPOINT_FOLLOWER
from gazelle.nodes.navigation.single_goal import SingleGoal
from gazelle.nodes.reading import node_reader

__all__ = ["run"]

_WAIT_S = 0.2
_SERVER_S = 10.0
_WAITING = "WaitAtWaypoint"


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Follow waypoints until told to stop."""
    node, tree = start(arguments, graph)
    follower = _Follower(node, tree)
    serve(arguments, node, stop, {
        "configure": follower.configure, "activate": follower.activate,
        "deactivate": follower.deactivate, "cleanup": follower.deactivate,
    })  # fmt: skip
    follower.deactivate()
    node.shutdown()
    return 0


class _Follower:
    def __init__(self, node: Node, tree: dict[str, Any]) -> None:
        self._node, self._tree = node, tree
        self._parameters = offer_parameters(node, tree)
        self._settings = node_reader(WAYPOINT_FOLLOWER, tree, node.name, Diagnostics())
        self._client = ActionClient(
            node, "navigate_to_pose", "nav2_msgs/NavigateToPose", generation=2
        )
        self._action: SingleGoal | None = None
        self._ending = threading.Event()
        self._pause_s = 0.0

    def configure(self) -> bool:
        diagnostics = Diagnostics()
        self._settings = node_reader(WAYPOINT_FOLLOWER, self._tree, self._node.name, diagnostics)
        name = self._settings.text("waypoint_task_executor_plugin")
        self._settings.report_unknown(name)
        below = self._tree.get(name)
        own = below if isinstance(below, dict) else {}
        plugin = str(own.get("plugin", f"nav2_waypoint_follower::{_WAITING}"))
        if not plugin.endswith(_WAITING):
            text = f"task '{name}' is of type '{plugin}', which is not known; there is "
            text += f"nav2_waypoint_follower::{_WAITING}. Nothing is done at the poses"
            self._settings.report("navigation.unknown-plugin", text)
        elif own.get("enabled", True):
            self._pause_s = float(own.get("waypoint_pause_duration", 0.0)) / 1000
        log_findings(self._node, diagnostics)
        return True

    def activate(self) -> bool:
        self._ending.clear()
        self._action = SingleGoal(
            self._node, "follow_waypoints", "nav2_msgs/FollowWaypoints", generation=2
        )
        threading.Thread(target=self._work, name="follow_waypoints", daemon=True).start()
        return True

    def deactivate(self) -> bool:
        self._ending.set()
        if self._action is not None:
            self._action.close()
            self._action = None
        return True

    def _work(self) -> None:
        action = self._action
        while action is not None and not self._ending.is_set() and not self._node.closed:
            if action.wait(_WAIT_S) and (goal := action.take()) is not None:
                self._follow(action, goal)

    def _follow(self, action: SingleGoal, goal: ServerGoal) -> None:
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

    def _missed(self, action: SingleGoal, result: Any, index: int, pose: Any, why: str) -> bool:
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

    def _drive(self, action: SingleGoal, pose: Any) -> str:
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
