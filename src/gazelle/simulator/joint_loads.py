"""What joints carry, with the parts that the engine leaves out for things that cannot move."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Model
from gazelle.geometry import IDENTITY_POSE, Pose, cross

if TYPE_CHECKING:
    from gazelle.engine import Engine
    from gazelle.sensors import JointLoad

__all__ = ["joint_load"]

Array = NDArray[np.float64]
# Where it acts, force and torque, (3,) each, world frame.
_Load = tuple[Array, Array, Array]


def joint_load(engine: Engine, joint_name: str) -> JointLoad:
    """Return what the parent of a ``model::joint`` exerted on its child in the last step."""
    from gazelle.sensors import JointLoad

    joint, model_name = engine.joint(joint_name).joint, joint_name.split("::", 1)[0]
    child = engine.link(f"{model_name}::{joint.child}")
    T_world_joint = _joint_pose(engine, joint_name)
    if child.is_static:
        point = np.array(T_world_joint.position_m)
        force, torque = _static_load(engine, model_name, joint.child, point)
    else:
        force, torque = engine.joint(joint_name).reaction_wrench()
    parent_name = f"{model_name}::{joint.parent}"
    has_parent = parent_name in engine.link_names
    T_world_parent = engine.link(parent_name).T_world_link() if has_parent else IDENTITY_POSE
    return JointLoad(force, torque, T_world_joint, T_world_parent, child.T_world_link())


def _joint_pose(engine: Engine, joint_name: str) -> Pose:
    joint = engine.joint(joint_name).joint
    child = engine.link(f"{joint_name.split('::', 1)[0]}::{joint.child}")
    return child.T_world_link() @ child.link.T_model_link.inverse() @ joint.T_model_joint


def _static_load(
    engine: Engine, model_name: str, link_name: str, point_m: Array
) -> tuple[Array, Array]:
    """Return what holds the static links from one outwards, force and torque about a point.

    MuJoCo computes no forces inside of what cannot move: they are its weight, what presses on it
    and what hangs on it.
    """
    model = engine.world.model(model_name)
    assert model is not None
    names = {f"{model_name}::{name}" for name in _outwards(model, link_name)}
    names = {name for name in names if engine.link(name).is_static}
    gravity = np.array(engine.gravity_m_s2)
    loads = [
        *_weights(engine, sorted(names), gravity),
        *_contacts(engine, names),
        *_hanging(engine, model, names),
    ]
    force, torque = np.zeros(3), np.zeros(3)
    for place_m, pull_n, turn_nm in loads:
        force -= pull_n
        torque -= turn_nm + cross(place_m - point_m, pull_n)
    return force, torque


def _weights(engine: Engine, names: list[str], gravity: Array) -> Iterator[_Load]:
    for name in names:
        link = engine.link(name)
        # The engine gives static links no mass; the file does.
        inertial = link.link.inertial
        if inertial is not None:
            com = link.T_world_link().transform(np.array(inertial.T_link_com.position_m))
            yield com, inertial.mass_kg * gravity, np.zeros(3)


def _contacts(engine: Engine, names: set[str]) -> Iterator[_Load]:
    for contact in engine.contacts():
        pair = (contact.collision1, contact.collision2)
        first, second = (name.rsplit("::", 1)[0] in names for name in pair)
        # A contact inside the part that is held does not reach the joint.
        sign = float(first) - float(second)
        for place_m, force, torque in zip(
            contact.points_m, contact.forces_n, contact.torques_nm, strict=True
        ):
            yield place_m, sign * force, sign * torque


def _hanging(engine: Engine, model: Model, names: set[str]) -> Iterator[_Load]:
    for joint in model.joints:
        ends = [f"{model.name}::{end}" for end in (joint.parent, joint.child)]
        if ends[0] in names and ends[1] not in names:
            name = f"{model.name}::{joint.name}"
            force, torque = engine.joint(name).reaction_wrench()
            # What the joint does to its child, the child does to the part, the other way round.
            yield np.array(_joint_pose(engine, name).position_m), -force, -torque


def _outwards(model: Model, link_name: str) -> list[str]:
    found, waiting = [], [link_name]
    while waiting:
        name = waiting.pop()
        if name not in found:
            found.append(name)
            waiting += [joint.child for joint in model.joints if joint.parent == name]
    return found
