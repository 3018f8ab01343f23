"""``plan_kinematic_path``, ``compute_cartesian_path`` and what is asked about planners."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from gazelle.interfaces import message_type, service_type
from gazelle.motion.model import JointKind
from gazelle.motion.planning.error_codes import ErrorCode
from gazelle.motion.timing import parameterise
from gazelle.nodes.move_group.cartesian_interpolator import JumpLimits, straight_path
from gazelle.nodes.move_group.constraint_messages import pose_of
from gazelle.nodes.move_group.context import MoveGroupContext
from gazelle.nodes.move_group.error_codes import MoveGroupError, code_message
from gazelle.nodes.move_group.planning_problem import GroupProblem
from gazelle.nodes.move_group.planning_scene_messages import apply_robot_state
from gazelle.nodes.move_group.request_planner import pipeline_of, planning_pipeline
from gazelle.nodes.move_group.robot_state_messages import robot_trajectory

__all__ = ["offer_planning"]

_PLAN = "moveit_msgs/GetMotionPlan"
_CARTESIAN = "moveit_msgs/GetCartesianPath"
_QUERY = "moveit_msgs/QueryPlannerInterfaces"
_GET = "moveit_msgs/GetPlannerParams"
_SET = "moveit_msgs/SetPlannerParams"


def offer_planning(context: MoveGroupContext) -> None:
    """Offer the five services."""
    for name, kind, answer in (
        ("plan_kinematic_path", _PLAN, _plan),
        ("compute_cartesian_path", _CARTESIAN, _cartesian),
        ("query_planner_interface", _QUERY, _query),
        ("get_planner_params", _GET, _get_params),
        ("set_planner_params", _SET, _set_params),
    ):
        context.node.create_service(name, service_type(kind), _bound(context, answer))


def _bound(context: MoveGroupContext, answer: Any) -> Any:
    return lambda request: answer(context, request)


def _plan(context: MoveGroupContext, request: Any) -> Any:
    response: Any = service_type(_PLAN).Response()
    answer, asked = response.motion_plan_response, request.motion_plan_request
    answer.group_name = asked.group_name
    try:
        scene = context.fresh_scene()
        planned = context.planner.plan(scene, asked, context.monitor.frame_of)
    except MoveGroupError as error:
        context.tell("plan_kinematic_path", error)
        answer.error_code = code_message(error.code, error.reason)
        return response
    for note in planned.notes:
        context.node.log("warn", note)
    answer.trajectory_start = context.state_message(planned.start)
    answer.trajectory = robot_trajectory(planned.trajectory, frame=context.robot.frame)
    answer.planning_time = planned.time_s
    answer.error_code = code_message(ErrorCode.SUCCESS)
    context.show(answer.trajectory, planned.start)
    return response


def _cartesian(context: MoveGroupContext, request: Any) -> Any:
    response: Any = service_type(_CARTESIAN).Response()
    monitor = context.monitor
    try:
        context.maker.group(request.group_name)
        scene = apply_robot_state(context.fresh_scene(), request.start_state, monitor.frame_of)
        problem = context.maker.problem(scene, request.group_name, monitor.frame_of)
        response.start_state = context.state_message(scene.positions)
        why = _follow(context, problem, request, response)
        response.error_code = code_message(ErrorCode.SUCCESS, why)
        if why:
            part = f"followed {100 * response.fraction:.1f} % of the path: {why}"
            context.node.log("warn", f"compute_cartesian_path: {part}")
    except MoveGroupError as error:
        context.tell("compute_cartesian_path", error)
        response.error_code = code_message(error.code, error.reason)
    return response


def _follow(context: MoveGroupContext, problem: GroupProblem, request: Any, response: Any) -> str:
    """Put the path into the response; returns why it does not go all the way."""
    link = request.link_name or problem.solver.tip_link
    if link not in context.robot.links:
        text = f"the robot has no link '{link}'"
        raise MoveGroupError(ErrorCode.INVALID_LINK_NAME, text)
    if not request.max_step > 0:
        text = "Maximum step to take between consecutive configurations along Cartesian path was "
        raise MoveGroupError(ErrorCode.FAILURE, f"{text}not specified (this value needs to be > 0)")
    rows, response.fraction, why = straight_path(
        problem.solver,
        problem.start_q,
        _waypoints(problem, request, link),
        link=link,
        step_m=float(request.max_step),
        validity=problem.checker if request.avoid_collisions else None,
        along=problem.constraints(request.path_constraints),
        jumps=JumpLimits(
            float(request.jump_threshold),
            float(request.revolute_jump_threshold),
            float(request.prismatic_jump_threshold),
            _sliding(context, problem),
        ),
    )
    trajectory = parameterise(
        rows,
        problem.group.space,
        velocity_scaling=_scaling(request, "max_velocity_scaling_factor"),
        acceleration_scaling=_scaling(request, "max_acceleration_scaling_factor"),
        path_tolerance=float(request.max_step) / 10,
        validity=problem.checker if request.avoid_collisions else None,
    )
    response.solution = robot_trajectory(trajectory, frame=context.robot.frame)
    context.show(response.solution, problem.scene.positions)
    return why


def _waypoints(problem: GroupProblem, request: Any, link: str) -> list[Any]:
    """Return poses in the planning frame; those in the link's own frame follow on each other."""
    frame = request.header.frame_id.lstrip("/")
    poses = [pose_of(item).matrix() for item in request.waypoints]
    if frame != link:
        T_frame = problem.T_planning_frame(frame)
        return [T_frame @ pose for pose in poses]
    found = [problem.solver.fk(problem.start_q, link)]
    for pose in poses:
        found.append(found[-1] @ pose)
    return found[1:]


def _sliding(context: MoveGroupContext, problem: GroupProblem) -> list[bool]:
    kinds = {name: one.kind for one in context.robot.joints for name in one.variables}
    return [kinds[name] is JointKind.PRISMATIC for name in problem.group.variables]


def _scaling(request: Any, name: str) -> float:
    value = float(getattr(request, name, 0.0))
    return value if 0 < value <= 1 else 1.0


def _query(context: MoveGroupContext, request: Any) -> Any:
    del request
    response: Any = service_type(_QUERY).Response()
    kind = message_type("moveit_msgs/msg/PlannerInterfaceDescription")
    for pipeline in context.config.pipelines.values():
        plans, _ = planning_pipeline(pipeline)
        ids = list(plans.planner_ids(pipeline))
        response.planner_interfaces.append(
            kind(name=plans.title, pipeline_id=pipeline.name, planner_ids=ids)
        )
    return response


def _get_params(context: MoveGroupContext, request: Any) -> Any:
    response: Any = service_type(_GET).Response()
    try:
        found = pipeline_of(context.config, getattr(request, "pipeline_id", ""))
    except MoveGroupError as error:
        context.tell("get_planner_params", error)
        return response
    values: dict[str, Any] = dict(found.planner_configs.get(request.planner_config, {}))
    for owner in ("", request.group):
        changed = context.planner.planner_params
        values.update(changed.get((owner, request.planner_config), {}))
    response.params.keys = list(values)
    response.params.values = [str(value) for value in values.values()]
    return response


def _set_params(context: MoveGroupContext, request: Any) -> Any:
    new: Mapping[str, str] = dict(zip(request.params.keys, request.params.values, strict=False))
    key = (request.group, request.planner_config)
    old = {} if request.replace else context.planner.planner_params.get(key, {})
    context.planner.planner_params[key] = {**old, **new}
    return service_type(_SET).Response()
