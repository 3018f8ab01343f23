"""``<group>`` elements, and which of them hold together."""

from __future__ import annotations

from collections.abc import Iterable

from gazelle.description.model import Joint, JointType, Model
from gazelle.description.srdf.model import Chain, Group, GroupState, VirtualJoint
from gazelle.description.srdf.names import Names
from gazelle.description.urdf_reader.attributes import check_vocabulary
from gazelle.description.xml import Tag, attribute_span, floats_from
from gazelle.diagnostics import Diagnostics

__all__ = ["read_groups", "read_states"]


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


def read_groups(root: Tag, names: Names) -> tuple[Group, ...]:
    """Return the groups that stand directly below the root, without those that cannot be."""
    found: dict[str, Group] = {}
    for tag in root.find_all("group"):
        name = names.required(tag, "name")
        if name in found:
            message = f"a second <group> is named '{name}'; the first one counts, as in MoveIt"
            names.diagnostics.report("srdf.double-name", message, tag.span)
        elif name:
            found[name] = _read_group(tag, name, names)
    return _satisfied(found, names.diagnostics)


def _read_group(tag: Tag, name: str, names: Names) -> Group:
    check_vocabulary(
        tag,
        names.diagnostics,
        attributes=("name",),
        children=("link", "joint", "chain", "group"),
    )
    chains = (_read_chain(child, name, names) for child in tag.find_all("chain"))
    group = Group(
        name,
        _filled(names.link(child, "name") for child in tag.find_all("link")),
        _filled(names.joint(child, "name") for child in tag.find_all("joint")),
        tuple(chain for chain in chains if chain is not None),
        _filled(names.group(child, "name") for child in tag.find_all("group")),
        tag.span,
    )
    if not (group.links or group.joints or group.chains or group.subgroups):
        message = f"group '{name}' has no link, joint, chain or group in it; nothing can be"
        message += " planned for it"
        names.diagnostics.report("srdf.empty-group", message, tag.span)
    return group


def _read_chain(tag: Tag, group: str, names: Names) -> Chain | None:
    check_vocabulary(tag, names.diagnostics, attributes=("base_link", "tip_link"))
    base, tip = names.link(tag, "base_link"), names.link(tag, "tip_link")
    if not base or not tip:
        return None
    if names.robot is not None and not _are_connected(base, tip, names.robot):
        message = f"no joints lead from '{base}' to '{tip}'; the chain is left out of group"
        message += f" '{group}' (Links '{base}' and '{tip}' do not form a chain)"
        names.diagnostics.report("srdf.no-chain", message, tag.span)
        return None
    return Chain(base, tip)


def _are_connected(base: str, tip: str, robot: Model) -> bool:
    parents = {joint.child: joint.parent for joint in robot.joints}

    def above(link: str) -> list[str]:
        found: list[str] = []
        while link and link not in found:
            found.append(link)
            link = parents.get(link, "")
        return found

    return bool(set(above(base)) & set(above(tip)))


def _satisfied(groups: dict[str, Group], diagnostics: Diagnostics) -> tuple[Group, ...]:
    """Leave out groups that hold themselves, by way of their subgroups."""
    known: set[str] = set()
    size = -1
    while len(known) > size:
        size = len(known)
        known |= {group.name for group in groups.values() if known.issuperset(group.subgroups)}
    for group in groups.values():
        if group.name not in known:
            message = f"group '{group.name}' holds itself by way of {', '.join(group.subgroups)};"
            message += f" it is left out (Group '{group.name}' has unsatisfied subgroups)"
            diagnostics.report("srdf.group-ring", message, group.span)
    return tuple(group for group in groups.values() if group.name in known)


def _filled(names: Iterable[str]) -> tuple[str, ...]:
    return tuple(name for name in names if name)
