"""``plan_sequence_path`` and ``sequence_move_group``: several motions in one go, as with Pilz."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Any

from gazelle.graph.actions import ServerGoal
from gazelle.interfaces import action_type, message_type, service_type
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.planning import ErrorCode
from gazelle.motion.planning.error_codes import CodedError
from gazelle.motion.scene import PlanningScene
from gazelle.nodes.move_group.action_servers import OneAtATime
from gazelle.nodes.move_group.context import MoveGroupContext
from gazelle.nodes.move_group.error_codes import MoveGroupError, code_message
from gazelle.nodes.move_group.pilz_pipeline import PILZ
from gazelle.nodes.move_group.plan_execution import Attempt, PlanExecution
from gazelle.nodes.move_group.planning_pipeline import PlanningPipeline, SequenceJob
from gazelle.nodes.move_group.planning_scene_messages import apply_robot_state
from gazelle.nodes.move_group.request_planner import Planned
from gazelle.nodes.move_group.robot_state_messages import robot_trajectory

__all__ = ["offer_sequences"]

_PLAN = "moveit_msgs/GetMotionSequence"
_MOVE = "moveit_msgs/MoveGroupSequence"


@dataclass(frozen=True)
class _Segment:
    """Items of one group that are planned together."""

    plans: PlanningPipeline
    items: tuple[Any, ...]


def offer_sequences(context: MoveGroupContext) -> None:
    """Offer service and action."""
    context.node.create_service(
        "plan_sequence_path", service_type(_PLAN), lambda request: _answer(context, request)
    )
    mover = PlanExecution(context)

    def work(goal: ServerGoal, stop: threading.Event) -> None:
        goal.publish_feedback({"state": "PLANNING"})
        plans, response = _planned(context, goal.request.request.items)
        attempt = Attempt(ErrorCode(int(response.error_code.val)), response.error_code.message)
        if attempt.code is ErrorCode.SUCCESS and not goal.request.planning_options.plan_only:
            goal.publish_feedback({"state": "MONITOR"})
            attempt = _executed(mover, plans, stop)
            response.error_code = code_message(attempt.code, attempt.why)
        result = action_type(_MOVE).Result(response=response)
        goal.publish_feedback({"state": "IDLE"})
        if attempt.code is ErrorCode.SUCCESS:
            goal.succeed(result)
        elif goal.is_cancel_requested:
            goal.cancel(result, attempt.why)
        else:
            goal.abort(result, attempt.why)

    OneAtATime(context, "sequence_move_group", _MOVE, work)


def _answer(context: MoveGroupContext, request: Any) -> Any:
    _, response = _planned(context, request.request.items)
    return service_type(_PLAN).Response(response=response)


def _executed(mover: PlanExecution, plans: Sequence[Planned], stop: threading.Event) -> Attempt:
    attempt = Attempt()
    for planned in plans:
        attempt = Attempt(planned=planned)
        mover.execute(attempt, stop)
        if attempt.code is not ErrorCode.SUCCESS:
            break
    return attempt


def _planned(context: MoveGroupContext, items: Sequence[Any]) -> tuple[list[Planned], Any]:
    response: Any = message_type("moveit_msgs/msg/MotionSequenceResponse")()
    began = time.perf_counter()
    plans: list[Planned] = []
    try:
        scene = context.fresh_scene()
        response.sequence_start = context.state_message(scene.positions)
        for stretch in _segments(context, items):
            for planned in _plan(context, scene, stretch):
                plans.append(planned)
                scene = scene.with_positions(_end(context, planned))
        if plans:
            response.sequence_start = context.state_message(plans[0].start)
        code, why = ErrorCode.SUCCESS, ""
    except CodedError as error:
        code, why = error.code, error.reason
    if why:
        context.tell("sequence", MoveGroupError(code, why))
        plans = []
    frame = context.robot.frame
    response.planned_trajectories = [robot_trajectory(p.trajectory, frame=frame) for p in plans]
    response.planning_time = time.perf_counter() - began
    response.error_code = code_message(code, why)
    for planned, message in zip(plans, response.planned_trajectories, strict=True):
        context.show(message, planned.start)
    return plans, response


def _segments(context: MoveGroupContext, items: Sequence[Any]) -> Iterator[_Segment]:
    """Yield what is planned together; only items of one group can be blended."""

    def kind(item: Any) -> tuple[str, PlanningPipeline]:
        return item.req.group_name, context.planner.choice(item.req).plans

    for number, item in enumerate(items[1:], 1):
        if len(item.req.start_state.joint_state.name):
            text = f"only the first item of a sequence may have a start state, [{number}] has one"
            raise MoveGroupError(ErrorCode.INVALID_ROBOT_STATE, text)
    if len(items) and items[-1].blend_radius:
        text = "the last blend radius must be zero: there is nothing to blend with"
        raise MoveGroupError(ErrorCode.INVALID_MOTION_PLAN, text)
    for (_, plans), rows in groupby(items, kind):
        stretch = _Segment(plans, tuple(rows))
        if plans.plan_sequence is None and any(item.blend_radius for item in stretch.items):
            text = f"only motions of {PILZ.name} can be blended"
            raise MoveGroupError(ErrorCode.INVALID_MOTION_PLAN, text)
        yield stretch


def _plan(context: MoveGroupContext, scene: PlanningScene, stretch: _Segment) -> Iterator[Planned]:
    frame_of = context.monitor.frame_of
    plan_sequence = stretch.plans.plan_sequence
    if plan_sequence is None:
        for item in stretch.items:
            planned = context.planner.plan(scene, item.req, frame_of)
            yield planned
            scene = scene.with_positions(_end(context, planned))
        return
    began = time.perf_counter()
    requests = [item.req for item in stretch.items]
    group = requests[0].group_name
    scene = apply_robot_state(scene, requests[0].start_state, frame_of)
    problem = context.maker.problem(scene, group, frame_of)
    planners = [context.planner.choice(request).planner for request in requests]
    radii = [float(item.blend_radius) for item in stretch.items]
    # What leaves a stretch for another group cannot be blended into it.
    radii[-1] = 0.0
    made = plan_sequence(SequenceJob(context.config, problem, planners, requests, radii))
    took_s = time.perf_counter() - began
    yield Planned(made, scene.positions, scene, group, "/".join(planners), took_s, made.notes)


def _end(context: MoveGroupContext, planned: Planned) -> FloatArray:
    group = context.maker.group(planned.group)
    return context.robot.with_group(group, planned.trajectory.positions[-1], planned.start)
