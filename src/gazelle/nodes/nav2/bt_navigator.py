"""``nav2_bt_navigator bt_navigator``: drives to poses by behaviour trees."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterable
from functools import partial
from pathlib import Path
from typing import Any

from gazelle.diagnostics import Diagnostics
from gazelle.documents.files import is_file
from gazelle.errors import GazelleError
from gazelle.graph import Graph
from gazelle.graph.actions import ServerGoal
from gazelle.interfaces import action_type, message_type
from gazelle.interfaces.poses import set_plane_pose
from gazelle.interfaces.stamps import set_header, set_stamp
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.nav2.behavior_trees.ros_client import GraphInterface
from gazelle.nodes.nav2.behavior_trees.ros_interface import path_length_m, plane_pose
from gazelle.nodes.nav2.behavior_trees.tree_node import Blackboard, Status, TreeNode
from gazelle.nodes.nav2.behavior_trees.xml_parsing import TreeFile, build_tree, read_trees
from gazelle.nodes.nav2.lifecycle_server import ManagedServer, ServedAction, ServerSetup, run_server
from gazelle.nodes.nav2.parameters import BT_NAVIGATOR
from gazelle.nodes.navigation.robot_pose import Frames, Odometry
from gazelle.nodes.navigation.simple_action_server import SimpleActionServer
from gazelle.parameters.reader import ParameterReader
from gazelle.workspace.environment_paths import BUILTIN

__all__ = ["run"]

_NANO = 1_000_000_000
_TREES = BUILTIN / "packages" / "nav2_bt_navigator" / "behavior_trees"
_OWN = {
    "NavigateToPose": "navigate_to_pose_w_replanning_and_recovery.xml",
    "NavigateThroughPoses": "navigate_through_poses_w_replanning_and_recovery.xml",
}
_PARAMETERS = {
    "NavigateToPose": ("default_nav_to_pose_bt_xml", "default_bt_xml_filename"),
    "NavigateThroughPoses": ("default_nav_through_poses_bt_xml",),
}
_ACTIONS = {"NavigateToPose": "navigate_to_pose", "NavigateThroughPoses": "navigate_through_poses"}


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Navigate until told to stop."""
    return run_server(_Navigator, arguments, graph, stop)


class _Navigator(ManagedServer):
    def __init__(self, setup: ServerSetup) -> None:
        super().__init__(setup, BT_NAVIGATOR)
        # One navigator at a time, as in Nav2.
        self._turns = threading.Lock()
        node = self._node
        self._frames = Frames(node)
        self._ros: GraphInterface | None = None
        self._files: dict[str, TreeFile] = {}
        kind = message_type("nav2_msgs/msg/BehaviorTreeLog")
        self._log_out = node.create_publisher("behavior_tree_log", kind)
        pose = "geometry_msgs/msg/PoseStamped"
        node.create_subscription("goal_pose", pose, self._on_goal_pose)

    def _configured(self, settings: ParameterReader, diagnostics: Diagnostics) -> bool:
        settings.report_unknown(*settings.texts("navigators"))
        self._ros = GraphInterface(
            self._node,
            self._frames,
            Odometry(self._node, settings.text("odom_topic")),
            global_frame=settings.text("global_frame"),
            base_frame=settings.text("robot_base_frame"),
            # Localisation in simulators is seldom faster than 10 Hz.
            tolerance_s=max(settings.number("transform_tolerance"), 1.0),
        )
        for kind, keys in _PARAMETERS.items():
            path = next((text for key in keys if (text := settings.text(key))), "")
            found = self._file(kind, path, diagnostics)
            if found is not None:
                self._files[kind] = found
        return len(self._files) == len(_PARAMETERS)

    def _served(self) -> Iterable[ServedAction]:
        for kind, name in _ACTIONS.items():
            yield ServedAction(name, kind, partial(self._navigate, kind))

    def _file(self, kind: str, path: str, diagnostics: Diagnostics) -> TreeFile | None:
        """Return the trees of a file; without one, or for Nav2's own, those that Gazelle has."""
        own = _TREES / _OWN[kind]
        file = Path(path) if path else own
        if not is_file(file):
            named = _TREES / file.name
            if not is_file(named) and not file.name.startswith("navigate_"):
                known = ", ".join(sorted(one.name for one in _TREES.iterdir()))
                text = f"{self._node.name}: the behaviour tree '{path}' does not exist"
                fix = f"give the path of an XML file; Gazelle has {known}"
                diagnostics.report("navigation.tree-structure", text, fix=fix)
                return None
            file = named if is_file(named) else own
            text = f"{Path(path).name} is Nav2's own file; Gazelle's {file.name} runs"
            self._node.log("info", text)
        found = read_trees(file, diagnostics)
        if kind == "NavigateThroughPoses" and found is not None and not _goes_through(file):
            text = f"{file.name} reads no {{goals}}, so that Nav2 would go nowhere"
            self._node.log("warn", f"{kind}: {text}; {own.name} runs in its place")
            return read_trees(own, diagnostics)
        return found

    def _navigate(self, kind: str, action: SimpleActionServer, goal: ServerGoal) -> None:
        """Run a goal's tree to its end."""
        result = action.result_class()
        try:
            trip = self._trip(kind, goal)
        except GazelleError as error:
            self._node.log("error", str(error))
            action.abort(_failed(result, str(error)), str(error))
            return
        self._node.log("info", f"Begin navigating {trip.words}")
        period_s = self._settings.number("bt_loop_duration") / 1000
        while True:
            began = time.monotonic()
            if action.has_new and not action.is_cancelled:
                newer = action.take()
                if newer is not None and not self._changed(trip, kind, newer):
                    trip.tree.halt()
                    self._navigate(kind, action, newer)
                    return
            if action.is_cancelled or self._ending.is_set():
                trip.tree.halt()
                action.cancel(result, "Goal canceled")
                return
            try:
                status = trip.tree.execute()
            except GazelleError as error:
                trip.tree.halt()
                action.abort(_failed(result, str(error)), str(error))
                self._node.log("error", str(error))
                return
            trip.tell()
            self._feedback(action, trip)
            if status not in (Status.RUNNING, Status.IDLE):
                self._finish(action, trip, status, result)
                return
            self._ending.wait(max(period_s - (time.monotonic() - began), 0.0))

    def _finish(self, action: SimpleActionServer, trip: _Trip, status: Status, result: Any) -> None:
        trip.tree.halt()
        if status is Status.FAILURE:
            board = trip.blackboard
            for key in ("follow_path_error_code", "compute_path_error_code"):
                code = int(board.get(key, 0) or 0)
                if code and hasattr(result, "error_code"):
                    result.error_code = code
            text = f"Goal failed{': ' + trip.why if trip.why else ''}"
            self._node.log("error", text)
            action.abort(_failed(result, text), text)
        else:
            self._node.log("info", "Goal succeeded")
            action.succeed(result)

    def _trip(self, kind: str, goal: ServerGoal) -> _Trip:
        """Return tree and blackboard of a goal."""
        assert self._ros is not None
        file = self._files[kind]
        if goal.request.behavior_tree:
            diagnostics = Diagnostics()
            found = self._file(kind, str(goal.request.behavior_tree), diagnostics)
            diagnostics.raise_if_errors()
            file = found or file
        trip = _Trip(self._ros, self._log_out)
        trip.blackboard.set("goal_reached_tol", self._settings.number("goal_reached_tol"))
        trip.tree = build_tree(file, trip.blackboard, trip)
        trip.listen(trip.tree)
        self._set_goals(trip, kind, goal)
        return trip

    def _changed(self, trip: _Trip, kind: str, goal: ServerGoal) -> bool:
        """Let the tree that runs go on to a newer goal; False when it asks for another tree."""
        if goal.request.behavior_tree:
            return False
        try:
            self._set_goals(trip, kind, goal)
        except GazelleError as error:
            self._node.log("error", f"the newer goal is left out: {error}")
        return True

    def _set_goals(self, trip: _Trip, kind: str, goal: ServerGoal) -> None:
        request = goal.request
        given = [request.pose] if kind == "NavigateToPose" else list(_poses(request))
        if not given:
            raise GazelleError("no poses to go through are given")
        found = [self._frames.message_in(one, self._settings.text("global_frame")) for one in given]
        for one in found:
            if isinstance(one, str):
                raise GazelleError(f"the goal cannot be used: {one}")
        if kind == "NavigateToPose":
            trip.blackboard.set("goal", found[0])
            at = plane_pose(found[0].pose)
            trip.words = f"from current location to ({at.x_m:.2f}, {at.y_m:.2f})"
        else:
            trip.blackboard.set("goals", found)
            trip.words = f"through {len(found)} poses"
        trip.blackboard.set("number_recoveries", 0)

    def _feedback(self, action: SimpleActionServer, trip: _Trip) -> None:
        goal = action.current
        if goal is None or not goal.is_feedback_wanted:
            return
        made: Any = action_type(f"nav2_msgs/{_kind_of(action.name)}").Feedback()
        assert self._ros is not None
        pose = self._ros.pose()
        if pose is not None:
            set_header(made.current_pose, self._ros.now_ns(), self._settings.text("global_frame"))
            set_plane_pose(made.current_pose.pose, (pose.x_m, pose.y_m, pose.yaw_rad))
        took_ns = max(self._ros.now_ns() - trip.began_ns, 0)
        set_stamp(made.navigation_time, took_ns)
        made.number_of_recoveries = int(trip.blackboard.get("number_recoveries", 0))
        path = trip.blackboard.get("path")
        if path is not None:
            made.distance_remaining = path_length_m(path)
            speed = self._ros.speed_m_s()
            if speed > 0.01:
                left_ns = int(made.distance_remaining / speed * _NANO)
                left = made.estimated_time_remaining
                set_stamp(left, left_ns)
        if hasattr(made, "number_of_poses_remaining"):
            made.number_of_poses_remaining = len(trip.blackboard.get("goals") or ())
        goal.publish_feedback(made)

    def _on_goal_pose(self, message: Any) -> None:
        action = self._actions.get(_ACTIONS["NavigateToPose"])
        if action is not None:
            action.submit(action.goal_class(pose=message))


class _Trip:
    """One goal's tree; it is the tree's world, and remembers why something failed.

    Attributes:
        why: what failed last.
    """

    tree: TreeNode

    def __init__(self, ros: GraphInterface, log_out: Any) -> None:
        self.blackboard = Blackboard()
        self.why = ""
        self.words = ""
        self.began_ns = ros.now_ns()
        self._ros = ros
        self._log_out = log_out
        self._changes: list[Any] = []

    def __getattr__(self, name: str) -> Any:
        # Everything that is not told apart here is the graph's.
        return getattr(self._ros, name)

    def log(self, level: str, text: str) -> None:
        """Keep why leaves fail, and say it."""
        self.why = text
        self._ros.log("info" if level == "debug" else level, text)

    def listen(self, node: TreeNode) -> None:
        """Hear of each change of a status in the tree."""
        node.on_change = self._on_change
        for child in node.children:
            self.listen(child)

    def tell(self) -> None:
        """Publish the changes since the last call."""
        changes, self._changes = self._changes, []
        if changes and self._log_out.matched:
            message = self._log_out.message_class(event_log=changes)
            now_ns = self._ros.now_ns()
            set_stamp(message.timestamp, now_ns)
            self._log_out.publish(message)

    def _on_change(self, node: TreeNode, before: Status) -> None:
        if self._log_out.matched:
            kind = message_type("nav2_msgs/msg/BehaviorTreeStatusChange")
            change: Any = kind(
                node_name=node.name,
                previous_status=before.value,
                current_status=node.status.value,
            )
            set_stamp(change.timestamp, self._ros.now_ns())
            self._changes.append(change)


def _goes_through(file: Path) -> bool:
    """Tell whether a tree, or one that it includes, may look at the poses to go through."""
    text = file.read_text(encoding="utf-8")
    return "{goals}" in text or "<include" in text


def _poses(request: Any) -> Any:
    return request.poses.goals if hasattr(request.poses, "goals") else request.poses


def _kind_of(action: str) -> str:
    return next(kind for kind, name in _ACTIONS.items() if name == action)


def _failed(result: Any, text: str) -> Any:
    if hasattr(result, "error_msg"):
        result.error_msg = text
    return result
