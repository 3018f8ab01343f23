"""`Srdf` to the text of an SRDF, in the order that MoveIt's Setup Assistant has."""

from __future__ import annotations

from collections.abc import Iterable
from xml.sax.saxutils import quoteattr

from gazelle.description.srdf.model import CollisionPair, Group, GroupState, Srdf
from gazelle.description.xml import Tag

__all__ = ["srdf_text"]

_HEADINGS = {
    "groups": "Groups: joints that are planned for together. A chain is all joints between two "
    "links; a link stands for the joint above it.",
    "states": "Group states: positions that have a name, rad or m.",
    "end_effectors": "End effectors: groups that are mounted on a link of another group.",
    "virtual_joints": "Virtual joints: how the robot's root is held by the world.",
    "passive_joints": "Passive joints: nothing drives them.",
    "disabled_pairs": "Pairs of links that are not checked for collision: they are neighbours, "
    "overlap when all joints are at their defaults, always overlap, or never meet.",
}


def srdf_text(srdf: Srdf, others: Iterable[Tag] = ()) -> str:
    """Return an SRDF's text; `read_srdf` makes the same description of it.

    Args:
        srdf: what it says.
        others: elements to be kept at its end.
    """
    parts = {
        "groups": [line for group in srdf.groups for line in _group(group)],
        "states": [line for state in srdf.states for line in _state(state)],
        "end_effectors": [
            _element(
                "end_effector",
                name=item.name,
                parent_link=item.parent_link,
                group=item.group,
                **({"parent_group": item.parent_group} if item.parent_group else {}),
            )
            for item in srdf.end_effectors
        ],
        "virtual_joints": [
            _element(
                "virtual_joint",
                name=item.name,
                type=item.type,
                parent_frame=item.parent_frame,
                child_link=item.child_link,
            )
            for item in srdf.virtual_joints
        ],
        "passive_joints": [_element("passive_joint", name=name) for name in srdf.passive_joints],
        "": _properties(srdf),
        "disabled_pairs": [
            *(_element("disable_default_collisions", link=it) for it in srdf.no_default_collisions),
            *(_pair("enable_collisions", item) for item in srdf.enabled_pairs),
            *(_pair("disable_collisions", item) for item in srdf.disabled_pairs),
        ],
    }
    lines = ['<?xml version="1.0" encoding="UTF-8"?>', f"<robot name={quoteattr(srdf.name)}>"]
    for key, inner in parts.items():
        if inner and key:
            lines.append(f"    <!-- {_HEADINGS[key]} -->")
        lines += [f"    {line}" for line in inner]
    lines += [tag.to_xml("    ") for tag in others]
    return "\n".join([*lines, "</robot>", ""])


def _group(group: Group) -> list[str]:
    inner = [_element("link", name=name) for name in group.links]
    inner += [_element("joint", name=name) for name in group.joints]
    inner += [
        _element("chain", base_link=it.base_link, tip_link=it.tip_link) for it in group.chains
    ]
    inner += [_element("group", name=name) for name in group.subgroups]
    return _nested("group", inner, name=group.name)


def _state(state: GroupState) -> list[str]:
    inner = [
        _element("joint", name=name, value=" ".join(f"{value:.10g}" for value in values))
        for name, values in state.values.items()
    ]
    return _nested("group_state", inner, name=state.name, group=state.group)


def _properties(srdf: Srdf) -> list[str]:
    lines = [
        _element("joint_property", joint_name=joint, property_name=name, value=value)
        for joint, values in srdf.joint_properties.items()
        for name, value in values.items()
    ]
    for item in srdf.spheres:
        inner = [
            _element("sphere", center=f"{x:.10g} {y:.10g} {z:.10g}", radius=f"{radius:.10g}")
            for x, y, z, radius in item.spheres_m
        ]
        lines += _nested("link_sphere_approximation", inner, link=item.link)
    return lines


def _pair(name: str, pair: CollisionPair) -> str:
    reason = {"reason": pair.reason} if pair.reason else {}
    return _element(name, link1=pair.link1, link2=pair.link2, **reason)


def _nested(element: str, inner: list[str], **attributes: str) -> list[str]:
    head = _element(element, **attributes)
    if not inner:
        return [head]
    return [f"{head[:-2]}>", *(f"    {line}" for line in inner), f"</{element}>"]


def _element(element: str, **attributes: str) -> str:
    written = "".join(f" {key}={quoteattr(value)}" for key, value in attributes.items())
    return f"<{element}{written}/>"
