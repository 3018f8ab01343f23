"""Links and joints as a tree: one root, no loops, every name known, and the frames it gives."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from gazelle.description.model import Link
from gazelle.description.read_context import ReadContext
from gazelle.description.urdf_reader.joints import ReadJoint
from gazelle.diagnostics import did_you_mean
from gazelle.geometry import IDENTITY_POSE, Pose

__all__ = ["check_tree", "poses_of", "without_second_parents"]

_MISSING = {"parent": "urdf.parent-missing", "child": "urdf.child-missing"}


def check_tree(
    links: Mapping[str, Link], joints: Sequence[ReadJoint], context: ReadContext, *, whole: bool
) -> str | None:
    """Return the root link's name; None when the links form no tree, every reason reported.

    Args:
        links: links by name.
        joints: joints with both ends named.
        context: where to report.
        whole: no joint was left out for a mistake of its own; otherwise loose links are no news.
    """
    known = _ends_exist(links, joints, context)
    children = {item.joint.child for item in joints}
    roots = [name for name in links if name not in children]
    if not known or not whole:
        return None
    if len(roots) > 1:
        _report_roots(roots, links, joints, context)
        return None
    reached = set(_below(roots[0], joints)) if roots else set()
    unreachable = [name for name in links if name not in reached]
    if unreachable:
        names = ", ".join(f"'{name}'" for name in unreachable)
        start = "no root link found" if not roots else f"not all links hang on '{roots[0]}'"
        message = f"{start}: the joints of {names} form a loop"
        joint = next(item for item in joints if item.joint.child == unreachable[0])
        own = [item for item in joints if item.joint.parent == item.joint.child]
        fix = ""
        if own and roots:
            joint = own[0]
            message += f"; '{joint.joint.child}' is its own parent"
            fix = f'write <parent link="{roots[0]}"/>, or another link that it hangs on'
        context.diagnostics.report("urdf.loop", message, joint.tag.span, fix=fix)
        return None
    return roots[0]


def poses_of(root: str, joints: Sequence[ReadJoint]) -> dict[str, Pose]:
    """Return the pose of every link's frame in the root's frame with all joints at zero."""
    poses = {root: IDENTITY_POSE}
    above = {item.joint.child: item for item in joints}
    for name in _below(root, joints)[1:]:
        poses[name] = poses[above[name].joint.parent] @ above[name].T_parent_joint
    return poses


def without_second_parents(
    joints: Mapping[str, ReadJoint], context: ReadContext
) -> dict[str, ReadJoint]:
    """Return the joints with one above each link: the last by name, as urdfdom keeps it.

    Args:
        joints: joints by name.
        context: hears of the joints that are left out.
    """
    above: dict[str, list[str]] = {}
    for name, item in joints.items():
        above.setdefault(item.joint.child, []).append(name)
    dropped: set[str] = set()
    for child, names in above.items():
        if len(names) == 1:
            continue
        kept = max(names)
        others = [name for name in names if name != kept]
        dropped.update(others)
        message = (
            f"link '{child}' has two parents: it is the child of joint '{names[0]}' and of joint "
            f"'{names[1]}'; '{kept}' counts, the last by name, and "
            f"{' and '.join(map(repr, others))} {'are' if len(others) > 1 else 'is'} left out"
        )
        context.diagnostics.report("urdf.two-parents", message, joints[names[1]].tag.span)
    return {name: item for name, item in joints.items() if name not in dropped}


def _below(root: str, joints: Sequence[ReadJoint]) -> list[str]:
    children: dict[str, list[str]] = {}
    for item in joints:
        children.setdefault(item.joint.parent, []).append(item.joint.child)
    order = [root]
    seen = {root}
    for name in order:
        for child in children.get(name, ()):
            if child not in seen:
                seen.add(child)
                order.append(child)
    return order


def _ends_exist(
    links: Mapping[str, Link], joints: Sequence[ReadJoint], context: ReadContext
) -> bool:
    good = True
    for item in joints:
        joint = item.joint
        for which, name in (("parent", joint.parent), ("child", joint.child)):
            if name in links:
                continue
            good = False
            end = item.tag.find(which) or item.tag
            hint = did_you_mean(name, links) or f'add <link name="{name}"/> or remove the joint'
            message = f"{which} link '{name}' of joint '{joint.name}' not found"
            context.diagnostics.report(_MISSING[which], message, end.span, fix=hint)
    return good


def _report_roots(
    roots: Sequence[str],
    links: Mapping[str, Link],
    joints: Sequence[ReadJoint],
    context: ReadContext,
) -> None:
    parents = {item.joint.parent for item in joints}
    loose = [name for name in roots if name not in parents] or list(roots[1:])
    names = " and ".join(f"'{name}'" for name in roots)
    message = f"{'two' if len(roots) == 2 else len(roots)} root links found: {names}"
    fix = f"join {', '.join(repr(name) for name in loose[:5])} to the robot with a joint"
    context.diagnostics.report("urdf.two-roots", message, links[roots[1]].span, fix=fix)
