"""Forward kinematics of a description: where links stand when joints are not at zero.

Also which links fixed joints make one body.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from gazelle.description.model import Frame, Joint, JointAxis, JointType, Link, Model
from gazelle.diagnostics import nearest_names
from gazelle.errors import NotFoundError
from gazelle.geometry import IDENTITY_POSE, Pose, quat_xyzw_about_axis

__all__ = ["fixed_groups", "fixed_heads", "movable_joints", "posed_model"]

_TURNING = frozenset(
    {
        JointType.REVOLUTE,
        JointType.CONTINUOUS,
        JointType.UNIVERSAL,
        JointType.REVOLUTE2,
        JointType.GEARBOX,
    }
)


def fixed_heads(model: Model) -> dict[str, str]:
    """Return for every link the first of those it is fixed to."""
    above = {joint.child: joint.parent for joint in model.joints if joint.type is JointType.FIXED}
    heads: dict[str, str] = {}
    for link in model.links:
        name, way = link.name, dict[str, None]()
        while name in above and name not in heads and name not in way:
            way[name] = None
            name = above[name]
        head = heads.get(name, name)
        heads[link.name] = head
        heads |= dict.fromkeys(way, head)
    return heads


def fixed_groups(model: Model) -> dict[str, tuple[str, ...]]:
    """Return the links of every body by its first link, that one included."""
    groups: dict[str, list[str]] = {}
    for name, head in fixed_heads(model).items():
        groups.setdefault(head, []).append(name)
    return {head: tuple(names) for head, names in groups.items()}


def movable_joints(model: Model) -> tuple[str, ...]:
    """Return the names of the joints that a position can be given for, in the file's order."""
    return tuple(joint.name for joint in model.joints if joint.axis is not None)


def posed_model(model: Model, positions: Mapping[str, float] | None = None) -> Model:
    """Return the model with its links, joints and frames where joint positions put them.

    The result is for looking at: its joints are at the positions, not at zero. Joints that are
    not named stand at their initial position, mimicking joints follow; limits are not applied.
    A second axis (``universal``, ``revolute2``) stays at zero.

    Args:
        model: with all joints at zero, as the readers give it.
        positions: rad, or m for prismatic joints, by joint name.

    Raises:
        NotFoundError: the model has no such joint, or nothing moves it.
    """
    given = dict(positions or {})
    for name in given:
        _check_joint(name, model)
    moved = _moves(model, _positions(model, given))
    return replace(
        model,
        links=tuple(_moved_link(link, moved) for link in model.links),
        joints=tuple(_moved_joint(joint, moved) for joint in model.joints),
        frames=tuple(_moved_frame(frame, moved) for frame in model.frames),
    )


def _check_joint(name: str, model: Model) -> None:
    names = movable_joints(model)
    if name not in names:
        hint = f"joints of '{model.name}' that move: {', '.join(names) or 'none'}"
        raise NotFoundError("movable joint", name, nearest=nearest_names(name, names), hint=hint)


def _positions(model: Model, given: Mapping[str, float]) -> dict[str, float]:
    joints = {joint.name: joint for joint in model.joints}

    def position(joint: Joint, depth: int = 0) -> float:
        if joint.name in given:
            return given[joint.name]
        leader = joints.get(joint.mimic.joint) if joint.mimic is not None else None
        # A ring of mimics has no leader; it is reported where descriptions are read.
        if joint.mimic is not None and leader is not None and depth <= len(joints):
            return joint.mimic.multiplier * position(leader, depth + 1) + joint.mimic.offset
        return 0.0 if joint.axis is None else joint.axis.position

    return {name: position(joint) for name, joint in joints.items()}


def _moves(model: Model, positions: Mapping[str, float]) -> dict[str, Pose]:
    """Return, by link, the motion in the model's frame that takes it from zero to its place."""
    moves: dict[str, Pose] = {}
    above: dict[str, Joint] = {}
    for joint in model.joints:
        above.setdefault(joint.child, joint)
    for link in model.links:
        chain: list[str] = []
        name = link.name
        while name in above and name not in moves and name not in chain:
            chain.append(name)
            name = above[name].parent
        for child in reversed(chain):
            joint = above[child]
            parent = moves.get(joint.parent, IDENTITY_POSE)
            moves[child] = parent @ _motion(joint, positions[joint.name])
    return moves


def _motion(joint: Joint, position: float) -> Pose:
    if joint.axis is None or position == 0.0:
        return IDENTITY_POSE
    step = _step(joint, joint.axis, position)
    return joint.T_model_joint @ step @ joint.T_model_joint.inverse()


def _step(joint: Joint, axis: JointAxis, position: float) -> Pose:
    x, y, z = axis.xyz
    turn = quat_xyzw_about_axis(axis.xyz, position)
    if joint.type in _TURNING:
        return Pose((0.0, 0.0, 0.0), turn)
    if joint.type is JointType.SCREW:
        slide = position / joint.thread_pitch_rad_m if joint.thread_pitch_rad_m else 0.0
        return Pose((x * slide, y * slide, z * slide), turn)
    if joint.type is JointType.PRISMATIC:
        return Pose((x * position, y * position, z * position))
    return IDENTITY_POSE


def _moved_link(link: Link, moves: Mapping[str, Pose]) -> Link:
    move = moves.get(link.name)
    return link if move is None else replace(link, T_model_link=move @ link.T_model_link)


def _moved_joint(joint: Joint, moves: Mapping[str, Pose]) -> Joint:
    move = moves.get(joint.child)
    return joint if move is None else replace(joint, T_model_joint=move @ joint.T_model_joint)


def _moved_frame(frame: Frame, moves: Mapping[str, Pose]) -> Frame:
    move = moves.get(frame.attached_to)
    return frame if move is None else replace(frame, T_model_frame=move @ frame.T_model_frame)
