"""Joints of several axes as chains of joints of one axis each, the only ones URDF has.

A link that is only there to carry the next axis gets a thousandth of the mass and inertia of the
link that the chain moves, taken from it, so that the whole keeps its mass, its centre of mass and
its inertia where all joints are at zero.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

from gazelle.description.model import Inertial, Joint, JointAxis, JointType, Link, Mimic, Model
from gazelle.description.writers.unscoped_names import free_name, part_names
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose

__all__ = ["CARRIER_SHARE", "carried", "with_single_axes"]

CARRIER_SHARE = 1e-3
"""Share of a link's mass that each link that carries an axis before it gets."""

_SAYABLE = frozenset(
    {
        JointType.REVOLUTE,
        JointType.CONTINUOUS,
        JointType.PRISMATIC,
        JointType.FIXED,
        JointType.FLOATING,
        JointType.PLANAR,
    }
)
_X, _Y, _Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


class _Step(NamedTuple):
    """One joint of a chain: what is added to the name, its type, axis and mimic."""

    suffix: str
    kind: JointType
    axis: JointAxis
    mimic: Mimic | None = None


def with_single_axes(model: Model, diagnostics: Diagnostics) -> Model:
    """Return the model without ball, universal, revolute2, screw and gearbox joints.

    A ball joint becomes three continuous joints about x, y and z, universal and revolute2 joints
    become two, a screw joint becomes one that turns and one that slides and mimics it, and a
    gearbox becomes a mimic between the joints that hold its two links.

    Args:
        model: any.
        diagnostics: receives ``convert.approximated`` and ``convert.left-out``.
    """
    for joint in model.joints:
        if joint.type in _SAYABLE:
            continue
        if joint.type is JointType.GEARBOX:
            model = _without_gearbox(model, joint, diagnostics)
            continue
        steps = _CHAINS[joint.type](joint)
        model = _chained(model, joint, steps)
        names = ", ".join(f"'{joint.name}{step.suffix}'" for step in steps)
        message = (
            f"joint '{joint.name}' is of type {joint.type.value}, which URDF does not have; it is "
            f"written as {names}"
        )
        diagnostics.report("convert.approximated", message, joint.span)
    return model


def carried(link: Link, name: str, T_model_carrier: Pose, count: int) -> tuple[Link, Link]:
    """Return a link that carries an axis before `link`, and the link without what that takes.

    Args:
        link: what the chain moves, of its full mass.
        name: the carrier's name.
        T_model_carrier: the carrier's frame.
        count: how many carriers the chain has in all.
    """
    inertial = link.inertial
    if inertial is None:
        return Link(name, T_model_carrier, span=link.span), link
    T_carrier_com = T_model_carrier.inverse() @ link.T_model_link @ inertial.T_link_com
    share = replace(_scaled(inertial, CARRIER_SHARE), T_link_com=T_carrier_com)
    kept = _scaled(inertial, 1.0 - CARRIER_SHARE * count)
    return Link(name, T_model_carrier, share, span=link.span), replace(link, inertial=kept)


def _scaled(inertial: Inertial, factor: float) -> Inertial:
    a, b, c, d, e, f = (value * factor for value in inertial.inertia_kg_m2)
    return replace(inertial, mass_kg=inertial.mass_kg * factor, inertia_kg_m2=(a, b, c, d, e, f))


def _ball(joint: Joint) -> tuple[_Step, ...]:
    words = (("_x", _X), ("_y", _Y), ("", _Z))
    return tuple(_Step(word, JointType.CONTINUOUS, JointAxis(xyz)) for word, xyz in words)


def _two_axes(joint: Joint) -> tuple[_Step, ...]:
    first, second = joint.axis or JointAxis(), joint.axis2 or JointAxis(_X)
    return (
        _Step("", JointType.REVOLUTE, first),
        _Step("_axis2", JointType.REVOLUTE, second),
    )


def _screw(joint: Joint) -> tuple[_Step, ...]:
    axis = joint.axis or JointAxis()
    pitch = joint.thread_pitch_rad_m
    factor = 1.0 / pitch if math.isfinite(pitch) and pitch else 0.0
    slide = JointAxis(axis.xyz, lower=axis.lower * abs(factor), upper=axis.upper * abs(factor))
    if factor < 0:
        slide = replace(slide, lower=axis.upper * factor, upper=axis.lower * factor)
    return (
        _Step("", JointType.REVOLUTE, axis),
        _Step("_slide", JointType.PRISMATIC, slide, Mimic(joint.name, factor)),
    )


_CHAINS: dict[JointType, Callable[[Joint], tuple[_Step, ...]]] = {
    JointType.BALL: _ball,
    JointType.UNIVERSAL: _two_axes,
    JointType.REVOLUTE2: _two_axes,
    JointType.SCREW: _screw,
}


def _chained(model: Model, joint: Joint, steps: tuple[_Step, ...]) -> Model:
    """Return the model with a joint replaced by a chain between the same links."""
    child = model.link(joint.child)
    links, taken = list(model.links), set(part_names(model))
    chain: list[Joint] = []
    parent = joint.parent
    for step in steps:
        is_last = step is steps[-1]
        name = joint.child
        if not is_last:
            name = free_name(f"{joint.name}_carrier{step.suffix}", taken)
            taken.add(name)
        chain.append(
            replace(
                joint,
                name=f"{joint.name}{step.suffix}",
                type=step.kind,
                parent=parent,
                child=name,
                axis=step.axis,
                axis2=None,
                mimic=step.mimic,
                sensors=joint.sensors if is_last else (),
            )
        )
        if not is_last and child is not None:
            carrier, lighter = carried(child, name, joint.T_model_joint, len(steps) - 1)
            index = next(i for i, item in enumerate(links) if item.name == child.name)
            links[index] = lighter
            links.append(carrier)
        parent = name
    joints = [new for old in model.joints for new in (chain if old is joint else [old])]
    return replace(model, links=tuple(links), joints=tuple(joints))


def _without_gearbox(model: Model, gearbox: Joint, diagnostics: Diagnostics) -> Model:
    """Return the model with ``θ(child) = −ratio · θ(parent)`` as a mimic of the holding joints."""
    rest = tuple(joint for joint in model.joints if joint is not gearbox)
    ends = [
        next((joint for joint in rest if joint.child == name and joint.type.is_hinge), None)
        for name in (gearbox.parent, gearbox.child)
    ]
    leader, follower = ends
    if leader is None or follower is None or follower.mimic is not None:
        message = (
            f"gearbox '{gearbox.name}' has no turning joints of its own links to tie together; "
            "it is left out"
        )
        diagnostics.report("convert.left-out", message, gearbox.span)
        return replace(model, joints=rest)
    signs = _sign(gearbox, gearbox.axis, leader) * _sign(
        gearbox, gearbox.axis2 or gearbox.axis, follower
    )
    ratio = -gearbox.gearbox_ratio * signs
    message = (
        f"gearbox '{gearbox.name}' is written as joint '{follower.name}' mimicking "
        f"'{leader.name}' {ratio:g} times"
    )
    diagnostics.report("convert.approximated", message, gearbox.span)
    mimic = Mimic(leader.name, ratio)
    joints = tuple(replace(item, mimic=mimic) if item is follower else item for item in rest)
    return replace(model, joints=joints)


def _sign(gearbox: Joint, axis: JointAxis | None, hinge: Joint) -> float:
    own = gearbox.T_model_joint.rotate((axis or JointAxis()).xyz)
    other = hinge.T_model_joint.rotate((hinge.axis or JointAxis()).xyz)
    return 1.0 if sum(a * b for a, b in zip(own, other, strict=True)) >= 0 else -1.0
