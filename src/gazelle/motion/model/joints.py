"""Joints as motion sees them: variables with limits, between two links, in the order of MoveIt.

Limits are the URDF's, with what joint_limits.yaml changes.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import Enum

from gazelle.description.model import Joint, JointType, Model
from gazelle.description.moveit import JointLimit
from gazelle.description.srdf import Srdf, VirtualJoint
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import IDENTITY_POSE, Pose

__all__ = [
    "JointKind",
    "MimicRule",
    "RobotJoint",
    "VariableLimit",
    "joints_of",
    "limit_of_joint",
    "overridden",
    "root_of",
]


_INFINITE = math.inf


class JointKind(Enum):
    """How a joint moves; fixed, planar and floating are the words of virtual joints as well."""

    FIXED = "fixed"
    REVOLUTE = "revolute"
    PRISMATIC = "prismatic"
    PLANAR = "planar"
    FLOATING = "floating"


@dataclass(frozen=True, slots=True)
class MimicRule:
    """``position = multiplier · position(joint) + offset``."""

    joint: str
    multiplier: float
    offset: float


@dataclass(frozen=True, slots=True)
class VariableLimit:
    """Limits of one variable: rad or m, and per s, s² and s³; infinite where there is none.

    Attributes:
        continuous: an angle without limits, equal every 2 pi.
    """

    lower: float = -_INFINITE
    upper: float = _INFINITE
    continuous: bool = False
    velocity: float = _INFINITE
    acceleration: float = _INFINITE
    jerk: float = _INFINITE


@dataclass(frozen=True, slots=True)
class RobotJoint:
    """A joint and the link it carries.

    ``T_parent_child = T_parent_joint · motion(variables) · T_joint_child``.

    Attributes:
        name: of the joint.
        kind: how it moves.
        parent: name of the link above; empty for the joint that holds the root.
        child: name of the link it carries.
        axis: unit vector in the joint's frame, of turning and sliding joints.
        variables: names of its variables: its own name, or ``name/x``, ``name/y``, ``name/theta``
            of planar and ``name/trans_x`` … ``name/rot_w`` of floating joints, as in MoveIt.
        first: place of its first variable in a robot's positions.
        limits: of each variable.
        mimic: what it follows, or None.
        is_passive: nothing drives it.
    """

    name: str
    kind: JointKind
    parent: str
    child: str
    T_parent_joint: Pose = IDENTITY_POSE
    T_joint_child: Pose = IDENTITY_POSE
    axis: tuple[float, float, float] = (0.0, 0.0, 1.0)
    variables: tuple[str, ...] = ()
    first: int = 0
    limits: tuple[VariableLimit, ...] = ()
    mimic: MimicRule | None = None
    is_passive: bool = False

    @property
    def is_active(self) -> bool:
        """Whether it has variables of its own."""
        return bool(self.variables) and self.mimic is None


def limit_of_joint(joint: Joint, diagnostics: Diagnostics) -> VariableLimit:
    """Return the limits that a URDF gives a joint with one variable.

    Soft limits of ``<safety_controller>`` narrow the range, as MoveIt has it.
    """
    axis = joint.axis
    if axis is None:
        return VariableLimit()
    velocity = axis.velocity if axis.velocity > 0 else _INFINITE
    if joint.type is JointType.CONTINUOUS:
        return VariableLimit(continuous=True, velocity=velocity)
    lower, upper = axis.lower, axis.upper
    safety = joint.safety
    if safety is not None:
        soft = max(lower, safety.soft_lower_limit), min(upper, safety.soft_upper_limit)
        if soft[0] < soft[1]:
            lower, upper = soft
        else:
            message = f"the soft limits of joint '{joint.name}' leave it no room"
            message += f" ({safety.soft_lower_limit:g} to {safety.soft_upper_limit:g}); they are"
            message += " ignored, MoveIt would plan no motion of it"
            diagnostics.report("motion.no-room", message, joint.span)
    return VariableLimit(lower, upper, velocity=velocity)


def overridden(
    limit: VariableLimit, change: JointLimit | None, name: str, diagnostics: Diagnostics
) -> VariableLimit:
    """Return limits with the changes of joint_limits.yaml.

    Args:
        limit: the URDF's.
        change: the file's entry for this variable, None when it has none.
        name: of the variable, for messages.
        diagnostics: receives ``motion.no-room`` and ``motion.continuous-limit``.
    """
    if change is None:
        return limit
    lower, upper = limit.lower, limit.upper
    given = change.min_position is not None or change.max_position is not None
    if given and limit.continuous:
        message = f"joint '{name}' turns without end; its position limits of joint_limits.yaml"
        message += " have no effect, as in MoveIt"
        diagnostics.report("motion.continuous-limit", message, change.span)
    elif given:
        lower = limit.lower if change.min_position is None else change.min_position
        upper = limit.upper if change.max_position is None else change.max_position
    if lower > upper:
        message = f"the limits of joint '{name}' in joint_limits.yaml leave it no room together"
        message += f" with the URDF's ({lower:g} to {upper:g}); the URDF's stay"
        diagnostics.report("motion.no-room", message, change.span)
        lower, upper = limit.lower, limit.upper
    return VariableLimit(
        lower,
        upper,
        limit.continuous,
        _value(change.has_velocity, change.max_velocity, limit.velocity),
        _value(change.has_acceleration, change.max_acceleration, limit.acceleration),
        _value(change.has_jerk, change.max_jerk, limit.jerk),
    )


def _value(flag: bool | None, value: float | None, old: float) -> float:
    if flag is None:
        return old
    return value if flag and value is not None else _INFINITE


_KINDS = {
    JointType.REVOLUTE: JointKind.REVOLUTE,
    JointType.CONTINUOUS: JointKind.REVOLUTE,
    JointType.PRISMATIC: JointKind.PRISMATIC,
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
    if kind in (JointKind.REVOLUTE, JointKind.PRISMATIC):
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
