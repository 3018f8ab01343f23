"""The kinematic tree of a model: MuJoCo wants a tree, files describe graphs."""

from __future__ import annotations

from dataclasses import dataclass

from gazelle.description.model import Joint, JointType, Link, Model
from gazelle.diagnostics import nearest_names
from gazelle.documents import HOW_TO_RAISE, LimitError, scaled
from gazelle.errors import NotFoundError

__all__ = ["WORLD", "KinematicTree", "TreeLink", "kinematic_tree"]

WORLD = "world"
_MAX_CHAIN = 500
_MAX_DEPTH = 1000
"""MuJoCo's own bound on bodies below each other is a little higher."""


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
        LimitError: more joints move one after the other than anything real has.
    """
    holders: dict[str, Joint] = {}
    roots: dict[str, str] = {}
    loops: list[Joint] = []
    names = {link.name for link in model.links}
    for joint in model.joints:
        _check_links(joint, names)
        closes = joint.child in holders or joint.child not in names
        root = _root(joint.parent, roots)
        if joint.type is JointType.GEARBOX or closes or root == joint.child:
            loops.append(joint)
        else:
            holders[joint.child] = joint
            roots[joint.child] = root
    links = _ordered(model, holders, names)
    if not model.static:
        _check_depth(model, links)
    return KinematicTree(links, tuple(loops))


def _check_links(joint: Joint, names: set[str]) -> None:
    for role, name in (("parent", joint.parent), ("child", joint.child)):
        if name not in names and name not in (WORLD, ""):
            where = f" ({joint.span})" if joint.span else ""
            raise NotFoundError(
                "link",
                name,
                nearest=nearest_names(name, names),
                hint=f"joint '{joint.name}' names it as its {role}{where}",
            )


def _root(name: str, roots: dict[str, str]) -> str:
    """Return the link that a link hangs on in the end; the way there is kept short."""
    way = []
    while name in roots:
        way.append(name)
        name = roots[name]
    roots.update(dict.fromkeys(way, name))
    return name


def _check_depth(model: Model, links: tuple[TreeLink, ...]) -> None:
    """Refuse what takes hours: each joint of a chain is computed with all above it."""
    most = scaled(_MAX_CHAIN)
    depths: dict[str | None, tuple[int, int]] = {None: (0, 0)}
    for entry in links:
        joint = entry.joint
        links_above, moving = depths[entry.parent]
        moving += joint is not None and joint.type is not JointType.FIXED
        depths[entry.link.name] = (links_above + 1, moving)
        if joint is None or (moving <= most and links_above < _MAX_DEPTH):
            continue
        what, fix = f"{most} moving joints", f"\n  fix: {HOW_TO_RAISE}"
        if moving <= most:
            what, fix = f"{_MAX_DEPTH} links", "; MuJoCo builds none deeper"
        where = f" ({joint.span})" if joint.span else ""
        raise LimitError(
            f"model '{model.name}' has a chain of more than {what}, up to joint '{joint.name}'"
            f"{where}{fix}"
        )


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
