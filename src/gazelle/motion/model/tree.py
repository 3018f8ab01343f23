"""Links and joints of a description in the order MoveIt gives them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from gazelle.description.model import Joint, JointType, Model
from gazelle.description.moveit import JointLimit
from gazelle.description.srdf import Srdf, VirtualJoint
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import IDENTITY_POSE, Pose
from gazelle.motion.model.joints import JointKind, MimicRule, RobotJoint, VariableLimit
from gazelle.motion.model.limits import limit_of_joint, overridden

__all__ = ["joints_of", "root_of"]

_KINDS = {
    JointType.REVOLUTE: JointKind.TURNING,
    JointType.CONTINUOUS: JointKind.TURNING,
    JointType.PRISMATIC: JointKind.SLIDING,
    JointType.FIXED: JointKind.FIXED,
    JointType.PLANAR: JointKind.PLANAR,
    JointType.FLOATING: JointKind.FLOATING,
}
_PARTS = {
    JointKind.PLANAR: ("x", "y", "theta"),
    JointKind.FLOATING: ("trans_x", "trans_y", "trans_z", "rot_x", "rot_y", "rot_z", "rot_w"),
}
_ROOT_JOINT = "ASSUMED_FIXED_ROOT_JOINT"
_WORLD = "world"


def root_of(model: Model) -> str:
    """Return the link that no joint carries; the first one when there are several.

    A root link called ``world`` is not among a model's links; here it is a link as in MoveIt.
    """
    if model.link(_WORLD) is None and any(joint.parent == _WORLD for joint in model.joints):
        return _WORLD
    carried = {joint.child for joint in model.joints}
    names = [link.name for link in model.links]
    return next((name for name in names if name not in carried), names[0] if names else "")


def joints_of(
    model: Model, srdf: Srdf, limits: Mapping[str, JointLimit], diagnostics: Diagnostics
) -> tuple[RobotJoint, ...]:
    """Return all joints, the root's first, each before those of the links below it.

    Joints of one link come in the order of their names, as urdfdom hands them to MoveIt; that
    makes the order of variables in groups the same.

    Args:
        model: the robot.
        srdf: its virtual joint and passive joints.
        limits: what joint_limits.yaml changes.
        diagnostics: receives what cannot be planned for.
    """
    below: dict[str, list[Joint]] = {}
    for joint in sorted(model.joints, key=lambda item: item.name):
        below.setdefault(joint.parent, []).append(joint)
    root = root_of(model)
    found = [_root_joint(root, srdf)]
    waiting = list(reversed(below.get(root, [])))
    seen = {root}
    while waiting:
        joint = waiting.pop()
        if joint.child in seen:
            message = f"joint '{joint.name}' closes a loop; motion is planned without it"
            diagnostics.report("motion.loop", message, joint.span)
            continue
        seen.add(joint.child)
        found.append(_robot_joint(joint, model, diagnostics))
        waiting.extend(reversed(below.get(joint.child, [])))
    return _numbered(found, srdf, limits, diagnostics)


def _root_joint(root: str, srdf: Srdf) -> RobotJoint:
    virtual = next((joint for joint in srdf.virtual_joints if joint.child_link == root), None)
    if virtual is None:
        return RobotJoint(_ROOT_JOINT, JointKind.FIXED, "", root)
    return _with_variables(RobotJoint(virtual.name, _virtual_kind(virtual), "", root))


def _virtual_kind(joint: VirtualJoint) -> JointKind:
    return JointKind(joint.type)


def _robot_joint(joint: Joint, model: Model, diagnostics: Diagnostics) -> RobotJoint:
    kind = _KINDS.get(joint.type)
    if kind is None:
        message = f"joint '{joint.name}' is of type {joint.type.value}, which MoveIt does not know;"
        message += " it stays at 0 in every plan"
        diagnostics.report("motion.joint-type", message, joint.span)
        kind = JointKind.FIXED
    mimic = joint.mimic
    found = RobotJoint(
        joint.name,
        kind,
        joint.parent,
        joint.child,
        _link_pose(model, joint.parent).inverse() @ joint.T_model_joint,
        joint.T_model_joint.inverse() @ _link_pose(model, joint.child),
        (0.0, 0.0, 1.0) if joint.axis is None else joint.axis.xyz,
    )
    if mimic is not None:
        found = replace(found, mimic=MimicRule(mimic.joint, mimic.multiplier, mimic.offset))
    found = _with_variables(found)
    if kind in (JointKind.TURNING, JointKind.SLIDING):
        found = replace(found, limits=(limit_of_joint(joint, diagnostics),))
    return found


def _link_pose(model: Model, name: str) -> Pose:
    link = model.link(name)
    return IDENTITY_POSE if link is None else link.T_model_link


def _with_variables(joint: RobotJoint) -> RobotJoint:
    """Name the variables; turning and sliding joints have one of the joint's name."""
    if joint.kind is JointKind.FIXED:
        return replace(joint, mimic=None)
    parts = _PARTS.get(joint.kind)
    if parts is None:
        return replace(joint, variables=(joint.name,), limits=(VariableLimit(),))
    names = tuple(f"{joint.name}/{part}" for part in parts)
    limits = tuple(_part_limit(part) for part in parts)
    return replace(joint, variables=names, limits=limits, mimic=None)


def _part_limit(part: str) -> VariableLimit:
    if part == "theta":
        return VariableLimit(continuous=True)
    return VariableLimit(-1.0, 1.0) if part.startswith("rot_") else VariableLimit()


def _numbered(
    joints: list[RobotJoint],
    srdf: Srdf,
    limits: Mapping[str, JointLimit],
    diagnostics: Diagnostics,
) -> tuple[RobotJoint, ...]:
    found: list[RobotJoint] = []
    first = 0
    leaders = {joint.name: joint for joint in joints}
    for joint in joints:
        changed = tuple(
            overridden(limit, limits.get(name), name, diagnostics)
            for name, limit in zip(joint.variables, joint.limits, strict=True)
        )
        mimic = joint.mimic if joint.mimic and joint.mimic.joint in leaders else None
        passive = joint.name in srdf.passive_joints
        found.append(replace(joint, first=first, limits=changed, mimic=mimic, is_passive=passive))
        first += len(joint.variables)
    return tuple(found)
