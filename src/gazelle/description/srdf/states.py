"""``<group_state>`` elements: named positions, checked against joints and limits."""

from __future__ import annotations

from gazelle.description.model import Joint, JointType
from gazelle.description.srdf.model import GroupState, VirtualJoint
from gazelle.description.srdf.names import Names
from gazelle.description.urdf.attributes import check_vocabulary
from gazelle.description.xml import Tag, attribute_span, floats_from

__all__ = ["read_states"]

_COUNTS = {JointType.PLANAR: 3, JointType.FLOATING: 7, JointType.FIXED: 0}
_VIRTUAL_COUNTS = {"planar": 3, "floating": 7, "fixed": 0}
_TOLERANCE = 1e-9


def read_states(
    root: Tag, names: Names, virtual_joints: tuple[VirtualJoint, ...]
) -> tuple[GroupState, ...]:
    """Return the group states; values that no joint can have are reported.

    Args:
        root: the ``<robot>``.
        names: what there is.
        virtual_joints: joints besides those of the robot.
    """
    counts = {joint.name: _VIRTUAL_COUNTS[joint.type] for joint in virtual_joints}
    counts |= {name: _COUNTS.get(joint.type, 1) for name, joint in names.joints.items()}
    states: dict[tuple[str, str], GroupState] = {}
    for tag in root.find_all("group_state"):
        check_vocabulary(tag, names.diagnostics, attributes=("name", "group"), children=("joint",))
        name, group = names.required(tag, "name"), names.group(tag, "group")
        if not name or not group:
            continue
        if (group, name) in states:
            message = f"group '{group}' has a second state '{name}'; the last one counts"
            names.diagnostics.report("srdf.double-name", message, tag.span)
        values: dict[str, tuple[float, ...]] = {}
        for child in tag.find_all("joint"):
            joint, value = _read_value(child, names, counts)
            if joint:
                values[joint] = value
        states[group, name] = GroupState(name, group, values, tag.span)
    return tuple(states.values())


def _read_value(tag: Tag, names: Names, counts: dict[str, int]) -> tuple[str, tuple[float, ...]]:
    check_vocabulary(tag, names.diagnostics, attributes=("name", "value"))
    joint = names.joint(tag, "name")
    text = names.required(tag, "value") if joint else ""
    if text and counts.get(joint) == 0:
        message = f"joint '{joint}' is fixed and has no position; its value has no effect"
        names.diagnostics.report("srdf.fixed-state", message, tag.span)
        return "", ()
    if not text:
        return "", ()
    value = floats_from(
        text,
        counts.get(joint, len(text.split())),
        (),
        what="<joint value>",
        span=tag.span,
        diagnostics=names.diagnostics,
        attribute="value",
    )
    if not value:
        return "", ()
    robot_joint = names.joints.get(joint)
    if robot_joint is not None:
        _check_limits(tag, robot_joint, value, names)
    return joint, value


def _check_limits(tag: Tag, joint: Joint, value: tuple[float, ...], names: Names) -> None:
    axis = joint.axis
    if axis is None or joint.type not in (JointType.REVOLUTE, JointType.PRISMATIC):
        return
    if axis.lower - _TOLERANCE <= value[0] <= axis.upper + _TOLERANCE:
        return
    state = f"joint '{joint.name}' is at {value[0]:g}, its limits are {axis.lower:g} and"
    message = f"{state} {axis.upper:g}; no plan can reach this state"
    span = attribute_span(tag.span, "value")
    names.diagnostics.report("srdf.state-outside-limits", message, span)
