"""What joints carry, with the parts that the engine leaves out for things that cannot move."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Model
from gazelle.geometry import IDENTITY_POSE

if TYPE_CHECKING:
    from gazelle.engine import Engine
    from gazelle.sensors import JointLoad

__all__ = ["joint_load"]

Array = NDArray[np.float64]


def joint_load(engine: Engine, joint_name: str) -> JointLoad:
    """Return what the parent of a ``model::joint`` exerted on its child in the last step."""
    from gazelle.sensors import JointLoad

    handle = engine.joint(joint_name)
    joint, model_name = handle.joint, joint_name.split("::", 1)[0]
    child = engine.link(f"{model_name}::{joint.child}")
    T_world_child = child.T_world_link()
    T_world_joint = T_world_child @ child.link.T_model_link.inverse() @ joint.T_model_joint
    force, torque = handle.reaction_wrench()
    if child.is_static:
        held = _static_load(engine, model_name, joint.child, np.array(T_world_joint.position_m))
        force, torque = force + held[0], torque + held[1]
    parent_name = f"{model_name}::{joint.parent}"
    has_parent = parent_name in engine.link_names
    T_world_parent = engine.link(parent_name).T_world_link() if has_parent else IDENTITY_POSE
    return JointLoad(force, torque, T_world_joint, T_world_parent, T_world_child)


def _static_load(
    engine: Engine, model_name: str, link_name: str, point_m: Array
) -> tuple[Array, Array]:
    """Return what holds the static links from one outwards: their weight and what presses on them.

    MuJoCo computes the forces inside a tree for bodies that can move, and hands theirs down to
    the static ones.
    """
    model = engine.world.model(model_name)
    assert model is not None
    names = {f"{model_name}::{name}" for name in _outwards(model, link_name)}
    names = {name for name in names if engine.link(name).is_static}
    force, torque = np.zeros(3), np.zeros(3)
    gravity = np.array(engine.gravity_m_s2)
    for name in sorted(names):
        link = engine.link(name)
        # The engine gives static links no mass; the file does.
        inertial = link.link.inertial
        if inertial is not None:
            weight = inertial.mass_kg * gravity
            com = link.T_world_link().transform(np.array(inertial.T_link_com.position_m))
            force -= weight
            torque -= np.cross(com - point_m, weight)
    for contact in engine.contacts():
        sides = [
            name.rsplit("::", 1)[0] in names for name in (contact.collision1, contact.collision2)
        ]
        # A contact inside the part that is held does not reach the joint.
        sign = float(sides[0]) - float(sides[1])
        if sign:
            moments = contact.torques_nm + np.cross(contact.points_m - point_m, contact.forces_n)
            force -= sign * contact.forces_n.sum(axis=0)
            torque -= sign * moments.sum(axis=0)
    return force, torque


def _outwards(model: Model, link_name: str) -> list[str]:
    found, waiting = [], [link_name]
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.append(name)
            waiting += [joint.child for joint in model.joints if joint.parent == name]
    return found
