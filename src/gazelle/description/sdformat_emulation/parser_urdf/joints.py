"""Joints as SDF."""

from __future__ import annotations

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.parser_urdf.console import Console
from gazelle.description.sdformat_emulation.parser_urdf.cpp_numbers import exact_text
from gazelle.description.sdformat_emulation.parser_urdf.elements import copied, set_value
from gazelle.description.sdformat_emulation.parser_urdf.gazebo_extensions import (
    Extension,
    Extensions,
)
from gazelle.description.sdformat_emulation.parser_urdf.link_elements import pose_text
from gazelle.description.sdformat_emulation.parser_urdf.reduce_fixed_joints import is_lumped
from gazelle.description.sdformat_emulation.parser_urdf.robot import Joint, Limits, Link, Mimic
from gazelle.description.sdformat_emulation.release import Release

__all__ = ["add_joint"]

# Floating and planar joints have no counterpart and are left out.
_TYPES = {
    "continuous": "revolute",
    "fixed": "fixed",
    "prismatic": "prismatic",
    "revolute": "revolute",
}
_WORLD = "world"


def add_joint(model: SdfElement, link: Link, extensions: Extensions, console: Console) -> None:
    """Append the joint above a link, if it has one that SDF knows."""
    joint, parent = link.joint_above, link.parent
    if joint is None or parent is None or is_lumped(link, extensions):
        return
    kind = _TYPES.get(joint.kind)
    if kind is None:
        return
    is_stiff = joint.kind == "fixed" and joint.name in extensions.kept_revolute
    element = SdfElement("joint", {"type": "revolute" if is_stiff else kind, "name": joint.name})
    pose = element.add("pose", pose_text(joint.T_parent_joint))
    pose.attributes["relative_to"] = "__model__" if parent.name == _WORLD else parent.name
    element.add("parent", parent.name)
    element.add("child", link.name)
    if is_stiff:
        _add_stiff_axis(element)
    elif joint.kind != "fixed":
        _add_axis(element, joint, console)
    for extension in extensions.by_reference.get(joint.name, ()):
        _extend(element, extension, console)
    model.children.append(element)


def _add_stiff_axis(owner: SdfElement) -> None:
    axis = owner.add("axis")
    limit, dynamics = axis.add("limit"), axis.add("dynamics")
    limit.add("lower", "0")
    limit.add("upper", "0")
    dynamics.add("damping", "0")
    dynamics.add("friction", "0")


def _add_axis(owner: SdfElement, joint: Joint, console: Console) -> None:
    axis = owner.add("axis")
    axis.add("xyz", exact_text(joint.axis))
    limit = axis.add("limit")
    if joint.limits is not None:
        _add_limits(limit, joint, joint.limits, console)
    if joint.mimic is not None and console.release is Release.V14:
        axis.children.insert(1, _mimic_of(joint.mimic))
    dynamics = axis.add("dynamics")
    if joint.dynamics is not None:
        dynamics.add("damping", exact_text(joint.dynamics[:1]))
        dynamics.add("friction", exact_text(joint.dynamics[1:]))


def _mimic_of(mimic: Mimic) -> SdfElement:
    element = SdfElement("mimic", {"joint": mimic.joint})
    element.add("multiplier", exact_text([mimic.multiplier]))
    element.add("offset", exact_text([mimic.offset]))
    return element


def _add_limits(owner: SdfElement, joint: Joint, limits: Limits, console: Console) -> None:
    if joint.kind != "continuous":
        if limits.lower > limits.upper:
            _swap(joint, limits, console)
        owner.add("lower", exact_text([limits.lower]))
        owner.add("upper", exact_text([limits.upper]))
    elif console.release is Release.V9:
        return
    owner.add("effort", exact_text([limits.effort]))
    owner.add("velocity", exact_text([limits.velocity]))


def _swap(joint: Joint, limits: Limits, console: Console) -> None:
    console.warning(
        "limits swapped",
        f"urdf2sdf: revolute joint [{joint.name}] with limits: lowStop[{limits.lower:g}] > "
        f"highStop[{limits.upper:g}], switching the two.",
    )
    limits.lower, limits.upper = limits.upper, limits.lower


def _extend(joint: SdfElement, extension: Extension, console: Console) -> None:
    """Add what one block says; elements that are empty then are added too."""
    physics = joint.find("physics") or SdfElement("physics")
    ode = physics.find("ode") or SdfElement("ode")
    limit = ode.find("limit") or SdfElement("limit")
    axis = joint.find("axis") or SdfElement("axis")
    dynamics = axis.find("dynamics") or SdfElement("dynamics")
    _set_number(limit, "cfm", extension, "stopCfm", console)
    _set_number(limit, "erp", extension, "stopErp", console)
    _set_number(dynamics, "spring_reference", extension, "springReference", console)
    _set_number(dynamics, "spring_stiffness", extension, "springStiffness", console)
    _set_switch((physics, ode), ("provide_feedback",), extension, "provideFeedback", console)
    damping = ("implicit_spring_damper", "cfm_damping")
    _set_switch((ode,), damping, extension, "implicitSpringDamper", console)
    _set_number(ode, "fudge_factor", extension, "fudgeFactor", console)
    nested = ((axis, dynamics), (joint, axis), (ode, limit), (physics, ode), (joint, physics))
    for owner, child in nested:
        if not any(item is child for item in owner.children):
            owner.children.append(child)
    joint.children += [copied(blob.element) for blob in extension.blobs]


def _set_number(
    owner: SdfElement, name: str, extension: Extension, word: str, console: Console
) -> None:
    if word in extension.numbers:
        set_value(owner, name, exact_text([extension.numbers[word]]), console)


def _set_switch(
    owners: tuple[SdfElement, ...],
    names: tuple[str, ...],
    extension: Extension,
    word: str,
    console: Console,
) -> None:
    if word not in extension.switches:
        return
    text = "true" if extension.switches[word] else "false"
    for owner in owners:
        for name in names:
            set_value(owner, name, text, console)
