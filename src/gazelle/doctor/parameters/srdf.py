"""SRDF: groups and states of MoveIt, and the names in them."""

from __future__ import annotations

from collections.abc import Collection

from gazelle.description.xml import Tag
from gazelle.diagnostics import Diagnostics, did_you_mean

__all__ = ["check_srdf", "group_names", "srdf_names"]

# element: attributes that name links, joints
_LINKS = {
    "chain": ("base_link", "tip_link"),
    "disable_collisions": ("link1", "link2"),
    "enable_collisions": ("link1", "link2"),
    "disable_default_collisions": ("link",),
    "end_effector": ("parent_link",),
    "link": ("name",),
    "link_sphere_approximation": ("link",),
    "virtual_joint": ("child_link",),
}
_JOINTS = {"joint": ("name",), "passive_joint": ("name",)}
_GROUPS = {"group_state": ("group",), "end_effector": ("group", "parent_group")}


def group_names(root: Tag) -> tuple[str, ...]:
    """Return the groups an SRDF defines."""
    return tuple(tag.attributes.get("name", "") for tag in root.find_all("group"))


def srdf_names(root: Tag) -> tuple[set[str], set[str]]:
    """Return the links and the joints that an SRDF names."""
    links: set[str] = set()
    joints: set[str] = set()
    for tag in root.walk():
        links |= {tag.attributes[key] for key in _LINKS.get(tag.name, ()) if key in tag.attributes}
        joints |= {
            tag.attributes[key] for key in _JOINTS.get(tag.name, ()) if key in tag.attributes
        }
    return links, joints


def check_srdf(
    root: Tag,
    links: Collection[str],
    joints: Collection[str],
    diagnostics: Diagnostics,
) -> None:
    """Report names of an SRDF that the robot, or the SRDF itself, does not have.

    Args:
        root: its ``<robot>``.
        links: of the robot.
        joints: of the robot.
        diagnostics: receives the findings.
    """
    groups = group_names(root)
    virtual = {tag.attributes.get("name", "") for tag in root.find_all("virtual_joint")}
    known_joints = {*joints, *virtual}
    for tag in root.walk():
        for key in _LINKS.get(tag.name, ()):
            _check(tag, key, "link", links, diagnostics)
        for key in _JOINTS.get(tag.name, ()):
            _check(tag, key, "joint", known_joints, diagnostics)
        for key in _GROUPS.get(tag.name, ()):
            _check(tag, key, "group", groups, diagnostics)
    for group in root.find_all("group"):
        for inner in group.find_all("group"):
            _check(inner, "name", "group", groups, diagnostics)


def _check(tag: Tag, key: str, kind: str, known: Collection[str], diagnostics: Diagnostics) -> None:
    name = tag.attributes.get(key, "")
    if not name or name in known or "$" in name:
        return
    words = {
        "link": f"Link '{name}' is not known to URDF",
        "joint": f"Joint '{name}' is not known to the URDF",
        "group": f"Group '{name}' not found",
    }
    owner = "the SRDF has" if kind == "group" else "the robot has"
    text = f"<{tag.name} {key}=\"{name}\">: {owner} no {kind} '{name}' ({words[kind]}); MoveIt "
    text += "leaves the element out"
    hint = did_you_mean(name, known)
    diagnostics.report("parameters.srdf-name", text, tag.span, fix=hint)
