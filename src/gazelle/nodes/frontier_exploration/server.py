"""``explore_server``: the action ``ExploreTask``, from frontier to frontier by move_base."""

from __future__ import annotations

import math
import threading
from typing import TYPE_CHECKING, Any

import numpy as np

from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph, Node, TimeJumpError
from gazelle.graph.actions import ActionClient, ClientGoal, ServerGoal
from gazelle.interfaces import message_type
from gazelle.interfaces.poses import set_plane_pose
from gazelle.interfaces.stamps import set_header
from gazelle.mapping.frontiers import Frontier
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.frontier_exploration.bounded_explore_layer import (
    EXPLORE_SERVER,
    BoundedExploreLayer,
    BoundedExploreServices,
    Corners,
)
from gazelle.nodes.navigation.robot_pose import PlanePose
from gazelle.nodes.navigation.simple_action_server import SimpleActionServer
from gazelle.nodes.parameters import log_findings, node_reader, parameter_tree, start_node
from gazelle.parameters.reader import ParameterReader

if TYPE_CHECKING:
    from gazelle.nodes.navigation.costmap_2d_ros import Costmap2DRos

__all__ = ["run"]

_NANO = 1_000_000_000
_RETRIES = 5
_RETRY_NS = 200_000_000
_LOOK_NS = 100_000_000
_WAIT_S = 0.2
_SAME_M = 0.3


def run(arguments: NodeArguments, graph: Graph, stop: threading.Event) -> int:
    """Explore polygons until told to stop."""
    node = start_node(arguments, graph)
    tree = parameter_tree(node, arguments)
    found = Diagnostics()
    settings = node_reader(EXPLORE_SERVER, tree, node.name, found)
    area = BoundedExploreLayer(node, tree, found)
    explorer = _Explorer(node, settings, area, stop)
    settings.report_unknown()
    log_findings(node, found)
    arguments.ready()
    try:
        explorer.work()
    finally:
        explorer.close()
        node.shutdown()
    return 0


class _Explorer:
    def __init__(
        self,
        node: Node,
        settings: ParameterReader,
        area: BoundedExploreLayer,
        stop: threading.Event,
    ) -> None:
        self._node, self._area, self._stop = node, area, stop
        self._frequency_hz = settings.number("frequency")
        self._same_m = settings.number("goal_aliasing") / 2
        self._goals = SimpleActionServer(
            node, node.name.rpartition("/")[2], "frontier_exploration/ExploreTask"
        )
        self._services = BoundedExploreServices(node, area)
        self._client = ActionClient(node, "move_base", "move_base_msgs/MoveBase")
        self._move: ClientGoal | None = None
        self._to: PlanePose | None = None
        self._frontier: tuple[float, float] | None = None
        self._left_out: list[tuple[float, float]] = []
        self._failures = 0
        self._feedback = message_type("frontier_exploration/action/ExploreTask_Feedback")()

    @property
    def _costmap(self) -> Costmap2DRos:
        return self._area.costmap

    def work(self) -> None:
        """Take goals until told to stop."""
        while not self._stop.is_set() and not self._node.closed:
            if not self._goals.wait(_WAIT_S):
                continue
            goal = self._goals.take()
            if goal is not None:
                self._explore(goal)
                self._rest()
        self._rest()

    def close(self) -> None:
        """Withdraw everything."""
        self._goals.close()
        self._area.close()

    def _explore(self, goal: ServerGoal) -> None:
        corners = self._services.corners(goal.request.explore_boundary)
        centre = self._services.place(goal.request.explore_center)
        while not self._client.is_server_ready:
            self._costmap.frames.say("warn", "waiting for the action server move_base", "server")
            if self._is_over(_LOOK_NS):
                return
        why = next((one for one in (corners, centre) if isinstance(one, str)), "")
        if why:
            self._node.log("error", f"Failed to set region boundary: {why}")
            self._goals.abort(text=why)
            return
        assert not isinstance(corners, str) and not isinstance(centre, str)
        self._area.limit(corners)
        self._left_out, self._failures = [], 0
        self._node.log("info", "Region boundary set")
        self._drive_around(corners, centre)

    def _drive_around(self, corners: Corners, centre: tuple[float, float]) -> None:
        """Go from frontier to frontier until there is none."""
        tries, driven = _RETRIES, 0
        while True:
            robot = self._costmap.pose() if self._costmap.is_ready else None
            to = None if robot is None else self._next(robot, centre, warns=driven > 0)
            if to is None:
                if tries == 0:
                    self._finish(driven)
                    return
                tries -= robot is not None
            else:
                tries = _RETRIES
                driven += self._send(to) and self._frontier is not None
            if self._is_over(_RETRY_NS if to is None else self._pause_ns) or self._gives_up():
                return

    @property
    def _pause_ns(self) -> int:
        """How long to wait before looking again, 0 for until the robot has arrived."""
        return int(_NANO / self._frequency_hz) if self._frequency_hz > 0 else 0

    def _next(
        self, robot: PlanePose, centre: tuple[float, float], *, warns: bool
    ) -> PlanePose | None:
        here, self._frontier = robot[:2], None
        if not self._area.contains(here):
            if warns:
                text = "Robot left exploration boundary, returning to center"
                self._costmap.frames.say("warn", text)
            return *centre, math.atan2(centre[1] - here[1], centre[0] - here[0])
        frontiers = [one for one in self._area.frontiers(here) if not self._is_left_out(one)]
        self._services.show(frontiers)
        if not frontiers:
            return None
        self._frontier = frontiers[0].nearest_m
        to = self._area.goal(frontiers[0], here)
        self._fill(self._feedback.next_frontier, to)
        return to

    def _finish(self, driven: int) -> None:
        """End the task; `driven` counts the frontiers that were driven to."""
        if driven > self._failures:
            self._node.log("warn", "Finished exploring room")
            self._goals.succeed(text="Finished exploring room")
            return
        count = len(self._left_out)
        text = (
            f"Failed exploration: none of {count} frontiers inside of the boundary can be reached"
        )
        self._node.log("error", text)
        self._goals.abort(text=text)

    def _send(self, to: PlanePose) -> bool:
        """Drive somewhere; False when the robot is on the way there already or has just ended."""
        if self._move is not None and self._move.is_done:
            # What came of it is looked at before anything is sent again.
            return False
        is_near = self._to is not None and math.dist(to[:2], self._to[:2]) <= self._same_m
        if self._move is not None and is_near:
            return False
        target = message_type("geometry_msgs/msg/PoseStamped")()
        self._fill(target, to)
        self._to = to
        self._move = self._client.send_goal(
            self._client.types.Goal(target_pose=target), on_feedback=self._on_feedback
        )
        return True

    def _is_left_out(self, frontier: Frontier) -> bool:
        return any(math.dist(frontier.nearest_m, other) < _SAME_M for other in self._left_out)

    def _gives_up(self) -> bool:
        """Leave out a frontier that move_base is done with; True when the task ends.

        One that is still there after the robot stood at it will not go away. The original ends its
        task with the first goal that move_base gives up; here only one at the centre does that.
        """
        if self._move is None or not self._move.is_done:
            return False
        status, why, self._move = self._move.status.name, self._move.text, None
        if status not in ("ABORTED", "SUCCEEDED"):
            return False
        failed = status == "ABORTED"
        if self._frontier is not None:
            self._left_out.append(self._frontier)
            self._failures += failed
            if failed:
                x, y = self._frontier
                self._node.log("warn", f"the frontier at ({x:.2f}, {y:.2f}) is left out: {why}")
        elif failed:
            text = f"Failed to move: {why}"
            self._node.log("error", text)
            self._goals.abort(text=text)
            return True
        return False

    def _is_over(self, pause_ns: int) -> bool:
        """Wait for a while, or with 0 until the robot stands; True when the task is to end."""
        clock = self._node.clock
        until_ns = clock.now_ns() + pause_ns
        while True:
            if self._stop.is_set() or self._node.closed or self._goals.should_end:
                self._end_task()
                return True
            is_moving = self._move is not None and not self._move.is_done
            if clock.now_ns() >= until_ns if pause_ns else not is_moving:
                return False
            step_ns = min(until_ns - clock.now_ns(), _LOOK_NS) if pause_ns else _LOOK_NS
            try:
                clock.sleep_until(clock.now_ns() + step_ns, self._stop)
            except TimeJumpError:
                until_ns = clock.now_ns() + pause_ns

    def _end_task(self) -> None:
        if self._goals.is_cancelled:
            self._node.log("warn", "Current exploration task cancelled")
            self._goals.cancel(text="Current exploration task cancelled")

    def _rest(self) -> None:
        """Let move_base have nothing to do."""
        if self._move is not None and not self._move.is_done and not self._node.closed:
            self._move.cancel()
        self._move = self._to = None

    def _on_feedback(self, feedback: Any) -> None:
        self._feedback.base_position = feedback.base_position
        self._goals.feedback(self._feedback)

    def _fill(self, message: Any, pose: PlanePose) -> None:
        set_header(message, self._node.clock.now_ns(), self._costmap.global_frame)
        set_plane_pose(message.pose, tuple(np.asarray(pose, float).tolist()))
