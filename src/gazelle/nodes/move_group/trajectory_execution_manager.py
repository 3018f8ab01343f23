"""Executes trajectories on controllers and watches them, as MoveIt's manager of execution does."""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Collection, Mapping, Sequence
from enum import Enum
from typing import Any, NamedTuple

from gazelle.description.moveit import ExecutionSettings
from gazelle.errors import GraphError, NotFoundError
from gazelle.graph import Node
from gazelle.graph.actions import ActionClient, ClientGoal
from gazelle.interfaces.stamps import ns_of
from gazelle.motion.planning.error_codes import ErrorCode
from gazelle.nodes.move_group.error_codes import MoveGroupError
from gazelle.nodes.move_group.planning_scene_monitor import CurrentStateMonitor
from gazelle.nodes.move_group.simple_controller_manager import (
    ControllerSpec,
    choose_controllers,
    controller_goal,
    goal_end,
    part_of,
)

__all__ = ["ExecutionStatus", "Outcome", "TrajectoryExecutor"]

_NANO = 1_000_000_000
_LOOK_S = 0.02
_STATE_S = 1.0
_SERVER_S = 15.0
_CANCEL_S = 5.0
_STANDING_S = 1.0
_STANDING_COUNT = 3


class ExecutionStatus(Enum):
    """How an execution ended, in MoveIt's words."""

    SUCCEEDED = "SUCCEEDED"
    PREEMPTED = "PREEMPTED"
    TIMED_OUT = "TIMED_OUT"
    ABORTED = "ABORTED"

    @property
    def code(self) -> ErrorCode:
        """The error code that clients get for it."""
        return {
            ExecutionStatus.SUCCEEDED: ErrorCode.SUCCESS,
            ExecutionStatus.PREEMPTED: ErrorCode.PREEMPTED,
            ExecutionStatus.TIMED_OUT: ErrorCode.TIMED_OUT,
            ExecutionStatus.ABORTED: ErrorCode.CONTROL_FAILED,
        }[self]


class Outcome(NamedTuple):
    """End of an execution, with the reason when it is not a good one."""

    status: ExecutionStatus
    why: str = ""


_Sent = list[tuple[ControllerSpec, ClientGoal]]


class TrajectoryExecutor:
    """Sends each controller its part of a trajectory and waits for all.

    One trajectory at a time: a second one stops the first, as in MoveIt.

    Attributes:
        specs: the controllers there are.
        settings: tolerances; may be replaced at any time.
    """

    def __init__(
        self,
        node: Node,
        specs: Sequence[ControllerSpec],
        settings: ExecutionSettings,
        states: CurrentStateMonitor,
        *,
        endless_joints: Collection[str] = (),
    ) -> None:
        """Prepare a client for every controller.

        Args:
            node: sends the goals.
            specs: the controllers there are.
            settings: tolerances.
            states: where the robot is.
            endless_joints: continuous joints, whose positions differ by whole turns.
        """
        self._endless = frozenset(endless_joints)
        self.specs = tuple(specs)
        self.settings = settings
        self._node = node
        self._states = states
        self._clients = {
            spec.name: ActionClient(node, spec.action, spec.kind.action_type) for spec in specs
        }
        self._turn = threading.Lock()
        self._stop = threading.Event()
        self._stop_why = ""
        self._began_ns = -1

    @property
    def elapsed_s(self) -> float:
        """Time of the node's clock since the trajectory that runs was sent, -1 when none runs."""
        began_ns = self._began_ns
        return -1.0 if began_ns < 0 else (self._node.clock.now_ns() - began_ns) / _NANO

    def stop(self, why: str = "a request to stop") -> None:
        """Stop what is being executed; nothing happens when nothing is."""
        self._stop_why = why
        self._stop.set()

    def execute(self, trajectory: Any, controllers: Sequence[str] = ()) -> Outcome:
        """Execute a ``JointTrajectory`` and wait for its end.

        Args:
            trajectory: positions with times; one without points is done at once.
            controllers: names of the controllers to use, any when empty.
        """
        if not trajectory.points or not trajectory.joint_names:
            return Outcome(ExecutionStatus.SUCCEEDED)
        if not self._turn.acquire(blocking=False):
            self.stop("another trajectory")
            self._turn.acquire()
        self._stop.clear()
        try:
            return self._run(trajectory, controllers)
        except MoveGroupError as error:
            return Outcome(ExecutionStatus.ABORTED, error.reason)
        finally:
            self._began_ns = -1
            self._turn.release()

    def _run(self, trajectory: Any, controllers: Sequence[str]) -> Outcome:
        chosen = choose_controllers(self.specs, trajectory.joint_names, controllers)
        self._check_start(trajectory)
        self._node.log("info", "Starting trajectory execution ...")
        sent = self._send_all(trajectory, chosen)
        self._began_ns = self._node.clock.now_ns()
        outcome = self._watch(sent, self._allowed_ns(trajectory, chosen))
        if outcome.status is ExecutionStatus.SUCCEEDED:
            self._wait_until_standing(trajectory.joint_names)
        text = f"Completed trajectory execution with status {outcome.status.value} ..."
        self._node.log("info", text)
        return outcome

    def _check_start(self, trajectory: Any) -> None:
        """Raise when the robot is not where the trajectory begins."""
        tolerance = self._tolerance
        joints = [name for name in trajectory.joint_names if tolerance(name) > 0]
        late = self._states.wait(joints, 0, _STATE_S)
        if late:
            text = "Failed to validate trajectory: couldn't receive full current joint state "
            text += f"within {_STATE_S:g}s; nothing on {self._states.topic} tells of "
            raise MoveGroupError(ErrorCode.CONTROL_FAILED, text + ", ".join(late))
        first = trajectory.points[0].positions
        if len(first) != len(trajectory.joint_names):
            text = f"Wrong trajectory: #joints: {len(trajectory.joint_names)} != "
            raise MoveGroupError(ErrorCode.CONTROL_FAILED, f"{text}#positions: {len(first)}")
        expected = dict(zip(trajectory.joint_names, map(float, first), strict=True))
        now = self._states.positions
        for name in joints:
            if self._distance(name, now[name], expected[name]) > tolerance(name):
                raise MoveGroupError(
                    ErrorCode.CONTROL_FAILED,
                    "Invalid Trajectory: start point deviates from current robot state more than "
                    f"{tolerance(name):g}\njoint '{name}': expected: {expected[name]:.6g}, "
                    f"current: {now[name]:.6g}; plan again from the present state, or raise "
                    "trajectory_execution.allowed_start_tolerance",
                )

    def _send_all(self, trajectory: Any, chosen: tuple[ControllerSpec, ...]) -> _Sent:
        sent: _Sent = []
        try:
            for spec in chosen:
                self._node.log("info", f"sending trajectory to {spec.name}")
                client = self._clients[spec.name]
                client.require_server(_SERVER_S)
                goal = controller_goal(part_of(trajectory, spec), spec)
                sent.append((spec, client.send_goal(goal)))
        except (NotFoundError, GraphError, MoveGroupError) as error:
            self._cancel(sent)
            text = f"controller '{spec.name}': {error}"
            raise MoveGroupError(ErrorCode.CONTROL_FAILED, text) from error
        return sent

    def _allowed_ns(self, trajectory: Any, chosen: tuple[ControllerSpec, ...]) -> float:
        """How long it may take; of several controllers the most generous one counts."""
        settings = self.settings
        if not settings.duration_monitoring:
            return float("inf")
        last = trajectory.points[-1].time_from_start
        planned_ns = float(ns_of(last))
        return max(
            planned_ns * _or(spec.duration_scaling, settings.allowed_duration_scaling)
            + _or(spec.goal_margin_s, settings.allowed_duration_margin_s) * _NANO
            for spec in chosen
        )

    def _watch(self, sent: _Sent, allowed_ns: float) -> Outcome:
        clock = self._node.clock
        for spec, goal in sent:
            while not goal.wait(_LOOK_S):
                if self._stop.is_set():
                    self._cancel(sent)
                    self._node.log("info", "Stopped trajectory execution.")
                    return Outcome(ExecutionStatus.PREEMPTED, f"stopped by {self._stop_why}")
                if clock.now_ns() - self._began_ns > allowed_ns:
                    self._cancel(sent)
                    text = "Controller is taking too long to execute trajectory (the expected "
                    text += "upper bound for the trajectory execution was "
                    text += f"{allowed_ns / _NANO:f} seconds). Stopping trajectory."
                    return Outcome(ExecutionStatus.TIMED_OUT, f"{text} ({spec.name})")
            end = goal_end(goal, spec)
            if not end.is_good:
                self._cancel(sent)
                return Outcome(ExecutionStatus.ABORTED, end.why)
        return Outcome(ExecutionStatus.SUCCEEDED)

    def _cancel(self, sent: _Sent) -> None:
        running = [goal for _, goal in sent if not goal.is_done]
        for goal in running:
            goal.cancel()
        deadline = time.monotonic() + _CANCEL_S
        for goal in running:
            goal.wait(max(0.0, deadline - time.monotonic()))

    def _wait_until_standing(self, joints: Sequence[str]) -> None:
        """Three states in a row without motion count as standing."""
        if not self.settings.wait_for_completion:
            return
        deadline, still = time.monotonic() + _STANDING_S, 0
        before = self._states.positions
        while still < _STANDING_COUNT and not self._stop.is_set():
            left_s = deadline - time.monotonic()
            if left_s <= 0 or not self._states.wait_for_next(left_s):
                return
            now = self._states.positions
            still = 0 if self._moved(joints, before, now) else still + 1
            before = now

    def _tolerance(self, joint: str) -> float:
        settings = self.settings
        return settings.joint_start_tolerances.get(joint, settings.allowed_start_tolerance)

    def _distance(self, joint: str, one: float, other: float) -> float:
        turn = one - other
        return abs(math.remainder(turn, math.tau) if joint in self._endless else turn)

    def _moved(
        self, joints: Sequence[str], before: Mapping[str, float], now: Mapping[str, float]
    ) -> bool:
        return any(
            self._distance(name, now[name], before[name]) > self._tolerance(name)
            for name in joints
            if name in before and name in now
        )


def _or(value: float | None, default: float) -> float:
    return default if value is None else value
