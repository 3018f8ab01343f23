"""The kinematic tree of a model: MuJoCo wants a tree, files describe graphs."""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.description.model import Joint, JointType, Link, Model
from gazelle.diagnostics import nearest_names
from gazelle.errors import NotFoundError

__all__ = ["WORLD", "KinematicTree", "TreeLink", "kinematic_tree"]

WORLD = "world"


@dataclass(frozen=True, slots=True)
class TreeLink:
    """A link with the joint that holds it.

    Attributes:
        link: the link.
        parent: name of the parent link, None when it hangs on the world.
        joint: the joint to the parent or the world, None for a link that floats freely.
    """

    link: Link
    parent: str | None
    joint: Joint | None


@dataclass(frozen=True, slots=True)
class KinematicTree:
    """Links with parents before children, and the joints that close loops."""

    links: tuple[TreeLink, ...]
    loops: tuple[Joint, ...]


def kinematic_tree(model: Model) -> KinematicTree:
    """Choose a spanning tree of a model's joints, in the order of the file.

    The first joint that names a link as its child holds it; every later one closes a loop, as
    does a joint that would make a link its own ancestor, and every gearbox (it constrains two
    joints and holds nothing).

    Raises:
        NotFoundError: a joint names a link that the model does not have.
    """
    holders: dict[str, Joint] = {}
    loops: list[Joint] = []
    names = {link.name for link in model.links}
    for joint in model.joints:
        _check_links(joint, names)
        closes = joint.child in holders or joint.child not in names
        if joint.type is JointType.GEARBOX or closes or _is_above(joint, holders):
            loops.append(joint)
        else:
            holders[joint.child] = joint
    return KinematicTree(_ordered(model, holders, names), tuple(loops))


def _check_links(joint: Joint, names: set[str]) -> None:
    for role, name in (("parent", joint.parent), ("child", joint.child)):
        if name not in names and name not in (WORLD, ""):
            place = f" ({joint.span})" if joint.span else ""
            raise NotFoundError(
                "link",
                name,
                nearest=nearest_names(name, names),
                hint=f"joint '{joint.name}' names it as its {role}{place}",
            )


def _is_above(joint: Joint, holders: dict[str, Joint]) -> bool:
    """Whether the child is an ancestor of the parent already."""
    name = joint.parent
    while name != joint.child:
        holder = holders.get(name)
        if holder is None:
            return False
        name = holder.parent
    return True


def _ordered(model: Model, holders: dict[str, Joint], names: set[str]) -> tuple[TreeLink, ...]:
    children: dict[str | None, list[TreeLink]] = {}
    for link in model.links:
        joint = holders.get(link.name)
        parent = joint.parent if joint is not None and joint.parent in names else None
        children.setdefault(parent, []).append(TreeLink(link, parent, joint))
    ordered: list[TreeLink] = []
    stack = list(reversed(children.get(None, [])))
    while stack:
        entry = stack.pop()
        ordered.append(entry)
        stack.extend(reversed(children.get(entry.link.name, [])))
    return tuple(ordered)
