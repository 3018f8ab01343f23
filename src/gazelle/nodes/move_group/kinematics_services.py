"""``compute_ik``, ``compute_fk`` and ``check_state_validity``."""

from __future__ import annotations

from typing import Any

from gazelle.errors import NotFoundError
from gazelle.geometry import Pose
from gazelle.interfaces import message_type, service_type
from gazelle.interfaces.poses import set_xyz
from gazelle.interfaces.stamps import seconds_of, set_stamp
from gazelle.motion.constraints import Constrained
from gazelle.motion.joint_space import FloatArray, Validity
from gazelle.motion.kinematics import Patience, link_poses
from gazelle.motion.planning.error_codes import ErrorCode
from gazelle.motion.scene import PlanningScene
from gazelle.nodes.move_group.constraint_messages import pose_of
from gazelle.nodes.move_group.context import MoveGroupContext
from gazelle.nodes.move_group.error_codes import MoveGroupError, code_message
from gazelle.nodes.move_group.planning_problem import GroupProblem
from gazelle.nodes.move_group.planning_scene_messages import apply_robot_state
from gazelle.nodes.move_group.shape_messages import pose_message

__all__ = ["offer_kinematics"]

_IK = "moveit_msgs/GetPositionIK"
_FK = "moveit_msgs/GetPositionFK"
_VALIDITY = "moveit_msgs/GetStateValidity"
_CONTACT_KINDS = {"link": 0, "object": 1, "attached object": 2}


def offer_kinematics(context: MoveGroupContext) -> None:
    """Offer the three services."""
    node = context.node
    node.create_service("compute_ik", service_type(_IK), lambda r: _ik(context, r))
    node.create_service("compute_fk", service_type(_FK), lambda r: _fk(context, r))
    node.create_service(
        "check_state_validity", service_type(_VALIDITY), lambda r: _validity(context, r)
    )


def _ik(context: MoveGroupContext, request: Any) -> Any:
    response: Any = service_type(_IK).Response()
    try:
        positions = _ik_positions(context, request.ik_request)
        response.solution = context.state_message(positions)
        response.error_code = code_message(ErrorCode.SUCCESS)
    except MoveGroupError as error:
        context.tell("compute_ik", error)
        response.error_code = code_message(error.code, error.reason)
    return response


def _ik_positions(context: MoveGroupContext, ask: Any) -> FloatArray:
    context.maker.group(ask.group_name)
    monitor = context.monitor
    scene = apply_robot_state(monitor.scene, ask.robot_state, monitor.frame_of)
    problem = context.maker.problem(scene, ask.group_name, monitor.frame_of)
    if len(ask.pose_stamped_vector) > 1:
        text = "poses of several links at once are not solved; ask for one link"
        raise MoveGroupError(ErrorCode.NO_IK_SOLUTION, text)
    stamped, link = ask.pose_stamped, ask.ik_link_name
    if len(ask.pose_stamped_vector):
        stamped = ask.pose_stamped_vector[0]
        link = ask.ik_link_names[0] if len(ask.ik_link_names) else link
    target = problem.T_planning_frame(stamped.header.frame_id) @ pose_of(stamped.pose).matrix()
    along = problem.constraints(ask.constraints, ErrorCode.INVALID_GOAL_CONSTRAINTS)
    validity: Validity | None = problem.checker if ask.avoid_collisions else None
    if along:
        validity = Constrained(validity or _Anything(), along)
    timeout_s = seconds_of(ask.timeout)
    timeout_s = timeout_s or problem.solver.settings.timeout_s
    return problem.positions(_solved(problem, target, link, validity, timeout_s))


def _solved(
    problem: GroupProblem,
    target: FloatArray,
    link: str,
    validity: Validity | None,
    timeout_s: float,
) -> FloatArray:
    solver, seed = problem.solver, problem.start_q
    patience = Patience(timeout_s=timeout_s)
    try:
        q = solver.ik(target, seed_q=seed, patience=patience, validity=validity, link=link)
        if q is not None:
            return q
        alone = solver.ik(target, seed_q=seed, patience=patience, link=link)
    except NotFoundError as error:
        raise MoveGroupError(ErrorCode.INVALID_LINK_NAME, str(error)) from error
    if validity is not None and alone is not None:
        text = (
            f"inverse kinematics finds only configurations that are no good: {validity.why(alone)}"
        )
    else:
        x, y, z = target[:3, 3]
        text = f"inverse kinematics finds nothing that brings '{link or solver.tip_link}' to "
        text += f"({x:.3f}, {y:.3f}, {z:.3f}) m in '{problem.scene.robot.frame}' "
        text += "(out of reach, or beyond the joint limits)"
    raise MoveGroupError(ErrorCode.NO_IK_SOLUTION, text)


class _Anything:
    """A `Validity` that allows everything: constraints alone decide."""

    def is_valid(self, q: FloatArray) -> bool:
        return True

    def motion_is_valid(self, q0: FloatArray, q1: FloatArray, step: float) -> bool:
        return True

    def why(self, q: FloatArray) -> str:
        return ""


def _fk(context: MoveGroupContext, request: Any) -> Any:
    response: Any = service_type(_FK).Response()
    try:
        monitor = context.monitor
        scene = apply_robot_state(monitor.scene, request.robot_state, monitor.frame_of)
        frame = request.header.frame_id.lstrip("/") or context.robot.frame
        for link in request.fk_link_names:
            pose = context.pose_in_frame(scene, _frame_pose(scene, link), frame)
            response.pose_stamped.append(_stamped(context, pose, frame))
            response.fk_link_names.append(link)
        if not len(request.fk_link_names):
            text = "No links specified for FK request"
            raise MoveGroupError(ErrorCode.INVALID_LINK_NAME, text)
        response.error_code = code_message(ErrorCode.SUCCESS)
    except MoveGroupError as error:
        context.tell("compute_fk", error)
        response.error_code = code_message(error.code, error.reason)
    return response


def _frame_pose(scene: PlanningScene, link: str) -> FloatArray:
    if link in scene.robot.links:
        return link_poses(scene.robot, scene.positions, [link])[link]
    try:
        return scene.pose_of(link).matrix()
    except NotFoundError as error:
        raise MoveGroupError(ErrorCode.INVALID_LINK_NAME, str(error)) from error


def _stamped(context: MoveGroupContext, pose: Pose, frame: str) -> Any:
    made: Any = message_type("geometry_msgs/msg/PoseStamped")()
    made.header.frame_id = frame
    now_ns = context.node.clock.now_ns()
    set_stamp(made.header.stamp, now_ns)
    made.pose = pose_message(pose)
    return made


def _validity(context: MoveGroupContext, request: Any) -> Any:
    response: Any = service_type(_VALIDITY).Response()
    monitor, group = context.monitor, request.group_name
    try:
        scene = apply_robot_state(monitor.scene, request.robot_state, monitor.frame_of)
        checker = context.maker.checker(scene, group)
        name = group or next(iter(context.robot.groups), "")
        problem = context.maker.problem(scene, name, monitor.frame_of)
        along = problem.constraints(request.constraints)
    except MoveGroupError as error:
        context.tell("check_state_validity", error)
        return response
    contacts = checker.contacts(problem.start_q if group else scene.positions)
    response.contacts = [_contact(context, item) for item in contacts]
    result = message_type("moveit_msgs/msg/ConstraintEvalResult")
    for item in along:
        distance = float(abs(item.excess(problem.start_q)).sum())
        response.constraint_result.append(result(result=not distance, distance=distance))
    response.valid = not contacts and all(row.result for row in response.constraint_result)
    return response


def _contact(context: MoveGroupContext, item: Any) -> Any:
    made: Any = message_type("moveit_msgs/msg/ContactInformation")()
    made.header.frame_id = context.robot.frame
    now_ns = context.node.clock.now_ns()
    set_stamp(made.header.stamp, now_ns)
    set_xyz(made.position, item.position_m)
    set_xyz(made.normal, item.normal)
    made.depth = item.depth_m
    made.contact_body_1, made.contact_body_2 = item.first.name, item.second.name
    made.body_type_1 = _CONTACT_KINDS[item.first.kind]
    made.body_type_2 = _CONTACT_KINDS[item.second.kind]
    return made
