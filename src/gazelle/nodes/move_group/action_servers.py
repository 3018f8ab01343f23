"""``move_action`` (ROS 1: ``move_group``) and ``execute_trajectory``."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from gazelle.graph.actions import ActionServer, ServerGoal
from gazelle.interfaces import action_type
from gazelle.motion.planning.error_codes import ErrorCode
from gazelle.nodes.move_group.context import MoveGroupContext
from gazelle.nodes.move_group.error_codes import MoveGroupError, code_message
from gazelle.nodes.move_group.goals import Goal
from gazelle.nodes.move_group.plan_execution import Attempt, PlanExecution
from gazelle.nodes.move_group.trajectory_execution_manager import ExecutionStatus

__all__ = ["OneAtATime", "offer_execute_action", "offer_move_action"]

_MOVE = "moveit_msgs/MoveGroup"
_EXECUTE = "moveit_msgs/ExecuteTrajectory"
_NAMES = {1: "move_group", 2: "move_action"}

Work = Callable[[ServerGoal, threading.Event], None]


class OneAtATime:
    """Serves an action in threads of its own; a new goal stops the one before, as in MoveIt."""

    def __init__(self, context: MoveGroupContext, name: str, kind: str, work: Work) -> None:
        """Offer an action.

        Args:
            context: the move_group.
            name: of the action.
            kind: its type.
            work: handles an accepted goal and ends it; the event is set when it shall stop.
        """
        self._work = work
        self._node = context.node
        self._name = context.node.resolve_name(name)
        self._turn = threading.Lock()
        self._stops: dict[str, threading.Event] = {}
        self.server = ActionServer(
            context.node,
            name,
            kind,
            on_goal=self._on_goal,
            on_cancel=self._on_cancel,
            ros_version=context.ros_version,
        )

    def _on_goal(self, goal: ServerGoal) -> None:
        for stop in tuple(self._stops.values()):
            stop.set()
        goal.accept()
        self._stops[goal.goal_id] = threading.Event()
        threading.Thread(target=self._run, args=(goal,), daemon=True).start()

    def _on_cancel(self, goal: ServerGoal) -> bool:
        stop = self._stops.get(goal.goal_id)
        if stop is not None:
            stop.set()
        return stop is not None

    def _run(self, goal: ServerGoal) -> None:
        with self._turn:
            stop = self._stops[goal.goal_id]
            try:
                self._work(goal, stop)
            except Exception as error:
                self._node.log("error", f"{self._name}: {type(error).__name__}: {error}")
                raise
            finally:
                self._stops.pop(goal.goal_id, None)
                if goal.is_active or goal.is_cancel_requested:
                    goal.abort(None, "move_group failed; its log says why")


def offer_move_action(context: MoveGroupContext) -> OneAtATime:
    """Offer planning and executing."""
    mover = PlanExecution(context)

    def work(goal: ServerGoal, stop: threading.Event) -> None:
        options = goal.request.planning_options
        _feedback(goal, "PLANNING")
        if options.plan_only or context.executor is None:
            attempt = mover.plan(goal.request.request, options)
            if stop.is_set():
                attempt.code, attempt.why = ErrorCode.PREEMPTED, "the client cancelled the goal"
        elif _is_there_already(context, goal.request):
            text = "Goal constraints are already satisfied. No need to plan or execute any motions"
            context.node.log("info", text)
            attempt = Attempt()
        else:
            attempt = mover.move(
                goal.request.request, options, stop, lambda: _feedback(goal, "MONITOR")
            )
        _feedback(goal, "IDLE")
        if attempt.why:
            context.tell("motion request", MoveGroupError(attempt.code, attempt.why))
        _end(goal, attempt.code, attempt.why, _move_result(context, attempt))

    return OneAtATime(context, _NAMES[context.ros_version], _MOVE, work)


def offer_execute_action(context: MoveGroupContext) -> OneAtATime:
    """Offer executing trajectories that were planned before."""

    def work(goal: ServerGoal, stop: threading.Event) -> None:
        result: Any = action_type(_EXECUTE).Result()
        code, why = ErrorCode.CONTROL_FAILED, "allow_trajectory_execution is false"
        _feedback(goal, "MONITOR")
        if context.executor is not None:
            over = threading.Event()
            executor = context.executor

            def watch() -> None:
                while not over.wait(0.02):
                    if stop.is_set():
                        executor.stop("the client")

            thread = threading.Thread(target=watch, daemon=True)
            thread.start()
            names = list(getattr(goal.request, "controller_names", ()))
            outcome = executor.execute(goal.request.trajectory.joint_trajectory, names)
            over.set()
            thread.join()
            code, why = outcome.status.code, outcome.why
            if outcome.status is ExecutionStatus.SUCCEEDED:
                why = ""
        result.error_code = code_message(code, why)
        _feedback(goal, "IDLE")
        if why:
            context.tell("execution", MoveGroupError(code, why))
        _end(goal, code, why, result)

    return OneAtATime(context, "execute_trajectory", _EXECUTE, work)


def _move_result(context: MoveGroupContext, attempt: Attempt) -> Any:
    result: Any = action_type(_MOVE).Result()
    result.error_code = code_message(attempt.code, attempt.why)
    if attempt.planned is not None:
        result.trajectory_start = context.state_message(attempt.planned.start)
        result.planning_time = attempt.planned.time_s
        result.planned_trajectory = attempt.planned_message(context.robot.frame)
        result.executed_trajectory = attempt.executed_message()
    return result


def _is_there_already(context: MoveGroupContext, request: Any) -> bool:
    """Whether the robot is where it shall go, within the goal's tolerances."""
    motion = request.request
    diff = request.planning_options.planning_scene_diff
    if len(diff.world.collision_objects) or len(diff.robot_state.attached_collision_objects):
        return False
    try:
        scene = context.fresh_scene()
        problem = context.maker.problem(scene, motion.group_name, context.monitor.frame_of)
        size = problem.group.space.size
        along = problem.constraints(motion.path_constraints)
        goals = [Goal((*problem.constraints(one), *along), size) for one in motion.goal_constraints]
    except MoveGroupError:
        # Planning meets the same fault and tells it.
        return False
    return any(goal.constraints and goal.is_met(problem.start_q) for goal in goals)


def _feedback(goal: ServerGoal, state: str) -> None:
    goal.publish_feedback({"state": state})


def _end(goal: ServerGoal, code: ErrorCode, why: str, result: Any) -> None:
    if code is ErrorCode.SUCCESS:
        goal.succeed(result)
    elif goal.is_cancel_requested:
        goal.cancel(result, why)
    else:
        goal.abort(result, why)
