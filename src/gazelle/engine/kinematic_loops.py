"""Joints that close kinematic loops, as equality constraints."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.description.model import Joint, JointAxis, JointType, Model
from gazelle.diagnostics import Diagnostics
from gazelle.engine.kinematic_tree import WORLD, KinematicTree
from gazelle.engine.mjspec_joints import add_joint, couple, equality_solver
from gazelle.engine.mujoco_library import mujoco
from gazelle.engine.scoped_names import bridge, scoped
from gazelle.geometry import Pose

__all__ = ["add_loop", "add_world_joint"]

_LEVER_M = 0.1
# Light beside every link of a robot, and heavy enough to be computed with.
_BRIDGE_KG = 1e-3
_BRIDGE_KG_M2 = 1e-6


def add_loop(
    spec: Any,
    joint: Joint,
    model: Model,
    tree: KinematicTree,
    step_s: float,
    diagnostics: Diagnostics,
) -> None:
    """Add the constraint of a joint whose child is held by another joint already."""
    if joint.type is JointType.GEARBOX:
        _add_gearbox(spec, joint, model, tree, step_s, diagnostics)
        return
    links = {link.name: link.T_model_link for link in model.links}
    bodies = tuple(
        scoped(model.name, name) if name in links else WORLD for name in (joint.parent, joint.child)
    )
    base = model.T_world_model.inverse()
    poses = tuple(links.get(name, base) for name in (joint.parent, joint.child))
    _constrain(spec, joint, model.name, (bodies[0], bodies[1]), (poses[0], poses[1]), step_s)


def add_world_joint(
    spec: Any,
    joint: Joint,
    poses: dict[str, Pose],
    step_s: float,
) -> None:
    """Add a joint of the world between links of models (SDF 1.11).

    Args:
        spec: MuJoCo's spec.
        joint: with ``model::link`` names, its frame in the world.
        poses: ``T_world_link`` of every link, joints at zero.
        step_s: length of a step.
    """
    bodies = tuple(name if name in poses else WORLD for name in (joint.parent, joint.child))
    frames = tuple(poses.get(name, Pose()) for name in (joint.parent, joint.child))
    _constrain(spec, joint, WORLD, (bodies[0], bodies[1]), (frames[0], frames[1]), step_s)


def _constrain(
    spec: Any,
    joint: Joint,
    model: str,
    bodies: tuple[str, str],
    poses: tuple[Pose, Pose],
    step_s: float,
) -> None:
    T_parent_joint = poses[0].inverse() @ joint.T_model_joint
    match joint.type:
        case JointType.BALL:
            _connect(spec, bodies, T_parent_joint.position_m, step_s)
        case JointType.REVOLUTE | JointType.CONTINUOUS:
            axis = np.asarray(T_parent_joint.rotate((joint.axis or JointAxis()).xyz))
            for side in (-_LEVER_M, _LEVER_M):
                anchor = np.asarray(T_parent_joint.position_m) + side * axis
                _connect(spec, bodies, tuple(anchor.tolist()), step_s)
        case JointType.FIXED:
            _weld(spec, bodies, poses, step_s)
        case JointType.FLOATING:
            pass
        case _:
            _bridge(spec, joint, model, bodies, poses, step_s)


def _bridge(
    spec: Any,
    joint: Joint,
    model: str,
    bodies: tuple[str, str],
    poses: tuple[Pose, Pose],
    step_s: float,
) -> None:
    """Give the joint a light body of its own on the parent, and weld the child to that.

    MuJoCo has no constraints for slides, threads and crossed axes. The joint keeps its name, so it
    has a position, limits and motors as others have.
    """
    parent = spec.worldbody if bodies[0] == WORLD else spec.body(bodies[0])
    T_parent_child = poses[0].inverse() @ poses[1]
    name = bridge(scoped(model, joint.name))
    body = parent.add_body(name=name)
    body.pos = list(T_parent_child.position_m)
    body.quat = list(T_parent_child.quat_wxyz)
    body.explicitinertial = True
    body.mass = _BRIDGE_KG
    body.inertia = [_BRIDGE_KG_M2] * 3
    body.gravcomp = 1.0
    add_joint(spec, body, joint, model, poses[1].inverse() @ joint.T_model_joint, step_s)
    _weld(spec, (name, bodies[1]), (poses[1], poses[1]), step_s)


def _connect(
    spec: Any, bodies: tuple[str, str], anchor_m: tuple[float, ...], step_s: float
) -> None:
    first, second = bodies
    equality = spec.add_equality(
        type=mujoco.mjtEq.mjEQ_CONNECT, objtype=mujoco.mjtObj.mjOBJ_BODY, name1=first
    )
    equality.name2 = second
    equality.data = [*anchor_m, *([0.0] * 9)][: len(equality.data)]
    equality_solver(equality, step_s)


def _weld(spec: Any, bodies: tuple[str, str], poses: tuple[Pose, Pose], step_s: float) -> None:
    T_parent_child = poses[0].inverse() @ poses[1]
    equality = spec.add_equality(
        type=mujoco.mjtEq.mjEQ_WELD, objtype=mujoco.mjtObj.mjOBJ_BODY, name1=bodies[0]
    )
    equality.name2 = bodies[1]
    data = [0.0, 0.0, 0.0, *T_parent_child.position_m, *T_parent_child.quat_wxyz, 1.0, 0.0]
    equality.data = data[: len(equality.data)]
    equality_solver(equality, step_s)


def _add_gearbox(
    spec: Any,
    joint: Joint,
    model: Model,
    tree: KinematicTree,
    step_s: float,
    diagnostics: Diagnostics,
) -> None:
    """Constrain ``θ(child) = −ratio · θ(parent)``, both seen from the reference body (SDF)."""
    holders = {entry.link.name: entry for entry in tree.links}
    ends = []
    for name, axis in ((joint.parent, joint.axis), (joint.child, joint.axis2 or joint.axis)):
        entry = holders.get(name)
        hinge = entry.joint if entry is not None else None
        turns = hinge is not None and hinge.type.is_hinge
        if entry is None or hinge is None or not turns:
            _report_gearbox(joint, name, diagnostics)
            return
        if joint.gearbox_reference_body not in ("", entry.parent or WORLD):
            _report_gearbox(joint, name, diagnostics)
            return
        ends.append((scoped(model.name, hinge.name), _same_way(joint, axis, hinge)))
    (parent, parent_sign), (child, child_sign) = ends
    couple(spec, (child, parent), (0.0, -joint.gearbox_ratio * parent_sign * child_sign), step_s)


def _same_way(joint: Joint, axis: JointAxis | None, hinge: Joint) -> float:
    """Whether the gearbox's axis points along or against the hinge's."""
    own = joint.T_model_joint.rotate((axis or JointAxis()).xyz)
    other = hinge.T_model_joint.rotate((hinge.axis or JointAxis()).xyz)
    return 1.0 if sum(a * b for a, b in zip(own, other, strict=True)) >= 0 else -1.0


def _report_gearbox(joint: Joint, link: str, diagnostics: Diagnostics) -> None:
    reference = joint.gearbox_reference_body or WORLD
    diagnostics.report(
        "engine.gearbox",
        f"gearbox '{joint.name}' needs a revolute joint between its reference body '{reference}'"
        f" and link '{link}', and there is none; it has no effect",
        joint.span,
    )
