"""Planning and executing together: replanning, and stopping when the scene gets in the way."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from gazelle.interfaces import message_type
from gazelle.interfaces.stamps import set_stamp
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.planning import ErrorCode, first_fault
from gazelle.motion.timing import Trajectory
from gazelle.nodes.move_group.context import MoveGroupContext
from gazelle.nodes.move_group.error_codes import MoveGroupError
from gazelle.nodes.move_group.request_planner import Planned
from gazelle.nodes.move_group.robot_state_messages import joint_trajectory, robot_trajectory
from gazelle.nodes.move_group.trajectory_execution_manager import ExecutionStatus

__all__ = ["Attempt", "PlanExecution"]

_LOOK_S = 0.1
_STEP = 0.02
_NANO = 1_000_000_000
_STOPPED = ErrorCode.PREEMPTED
_INVALIDATED = ErrorCode.MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE


@dataclass
class Attempt:
    """What became of one request.

    Attributes:
        code: the answer.
        why: what is in the way, empty when nothing is.
        planned: the last plan.
        executed: where the robot was, with times of the node's clock.
    """

    code: ErrorCode = ErrorCode.SUCCESS
    why: str = ""
    planned: Planned | None = None
    executed: list[tuple[int, dict[str, float]]] = field(default_factory=list)

    def executed_message(self) -> Any:
        """Return the ``RobotTrajectory`` of what was executed."""
        made: Any = message_type("moveit_msgs/msg/RobotTrajectory")()
        if not self.executed or self.planned is None:
            return made
        names = self.planned.trajectory.names
        made.joint_trajectory.joint_names = list(names)
        point = message_type("trajectory_msgs/msg/JointTrajectoryPoint")
        begin_ns = self.executed[0][0]
        for at_ns, values in self.executed:
            row: Any = point(positions=[values[name] for name in names])
            set_stamp(row.time_from_start, at_ns - begin_ns)
            made.joint_trajectory.points.append(row)
        return made

    def planned_message(self, frame: str) -> Any:
        """Return the ``RobotTrajectory`` of the plan, empty without one."""
        return robot_trajectory(self.planned.trajectory if self.planned else None, frame=frame)


class PlanExecution:
    """Plans, executes and watches on behalf of actions."""

    def __init__(self, context: MoveGroupContext) -> None:
        """Act for a move_group."""
        self._context = context

    def plan(self, request: Any, options: Any) -> Attempt:
        """Plan a ``MotionPlanRequest`` with the scene diff of ``PlanningOptions``."""
        attempt = Attempt()
        context = self._context
        try:
            scene = context.fresh_scene(options.planning_scene_diff)
            attempt.planned = context.planner.plan(scene, request, context.monitor.frame_of)
        except MoveGroupError as error:
            attempt.code, attempt.why = error.code, error.reason
            return attempt
        self._tell_plan(attempt.planned)
        return attempt

    def move(
        self, request: Any, options: Any, stop: threading.Event, executing: Callable[[], None]
    ) -> Attempt:
        """Plan and execute, again where that is allowed and may help.

        Args:
            request: a ``MotionPlanRequest``.
            options: ``PlanningOptions``.
            stop: set when the client wants no more.
            executing: called when the robot begins to move.
        """
        tries = max(1, int(options.replan_attempts)) if options.replan else 1
        attempt = Attempt()
        for number in range(tries):
            if number and not self._context.node.clock.sleep(round(options.replan_delay * _NANO)):
                break
            attempt = self.plan(request, options)
            if stop.is_set():
                attempt.code, attempt.why = _STOPPED, "the client cancelled the goal"
                return attempt
            if attempt.code is ErrorCode.SUCCESS:
                executing()
                self.execute(attempt, stop)
            if attempt.code is not _INVALIDATED and attempt.planned is not None:
                return attempt
        return attempt

    def execute(self, attempt: Attempt, stop: threading.Event) -> None:
        """Execute what was planned and note in the attempt how that ends."""
        context, planned = self._context, attempt.planned
        assert planned is not None
        if context.executor is None:
            attempt.code = ErrorCode.CONTROL_FAILED
            attempt.why = "allow_trajectory_execution is false"
            return
        over = threading.Event()
        watch = threading.Thread(target=self._watch, args=(attempt, stop, over), daemon=True)
        watch.start()
        outcome = context.executor.execute(joint_trajectory(planned.trajectory))
        over.set()
        watch.join()
        if outcome.status is not ExecutionStatus.SUCCEEDED and attempt.code is ErrorCode.SUCCESS:
            attempt.code, attempt.why = outcome.status.code, outcome.why

    def _tell_plan(self, planned: Planned) -> None:
        context = self._context
        for note in planned.notes:
            context.node.log("warn", note)
        context.show(robot_trajectory(planned.trajectory, frame=context.robot.frame), planned.start)

    def _watch(self, attempt: Attempt, stop: threading.Event, over: threading.Event) -> None:
        """Stop the execution for the client, or when what is left of it collides."""
        context, planned = self._context, attempt.planned
        assert planned is not None and context.executor is not None
        version = context.monitor.version
        while not over.wait(_LOOK_S):
            self._record(attempt)
            if stop.is_set():
                context.executor.stop("the client")
            elif context.monitor.version != version:
                version = context.monitor.version
                fault = self._fault(planned, context.executor.elapsed_s)
                if fault:
                    attempt.code, attempt.why = _INVALIDATED, f"what is left of the path: {fault}"
                    context.executor.stop("a change of the planning scene")
        self._record(attempt)

    def _fault(self, planned: Planned, elapsed_s: float) -> str:
        context = self._context
        rows = _rest(planned.trajectory, elapsed_s)
        checker = context.maker.checker(context.monitor.scene, planned.group)
        space = context.maker.group(planned.group).space
        return first_fault(space, checker, rows, _STEP)

    def _record(self, attempt: Attempt) -> None:
        assert attempt.planned is not None
        known = self._context.monitor.states.positions
        names = attempt.planned.trajectory.names
        if all(name in known for name in names):
            now_ns = self._context.node.clock.now_ns()
            attempt.executed.append((now_ns, {name: known[name] for name in names}))


def _rest(trajectory: Trajectory, elapsed_s: float) -> FloatArray:
    """Return where the joints are at and after a time of a trajectory."""
    left: FloatArray = trajectory.positions[trajectory.times_s >= elapsed_s]
    return left if len(left) else trajectory.positions[-1:]
