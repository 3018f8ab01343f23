"""Fixed joints dissolved: what the link below has goes to the link above."""

from __future__ import annotations

from collections.abc import Iterator

from gazelle.description.sdformat_emulation.element import SdfElement
from gazelle.description.sdformat_emulation.ignition_math import chained
from gazelle.description.sdformat_emulation.parser_urdf.blobs import move_extensions
from gazelle.description.sdformat_emulation.parser_urdf.console import Console
from gazelle.description.sdformat_emulation.parser_urdf.extensions import (
    Blob,
    Extension,
    Extensions,
)
from gazelle.description.sdformat_emulation.parser_urdf.inertia import lump_inertia
from gazelle.description.sdformat_emulation.parser_urdf.link_elements import pose_text
from gazelle.description.sdformat_emulation.parser_urdf.robot import Joint, Link, Robot
from gazelle.description.sdformat_emulation.release import Release

__all__ = ["EndlessRobotError", "is_lumped", "is_reduced", "lump_fixed_joints"]

# A link, its depth, and whether all that is fixed to it was seen.
_Step = tuple[Link, int, bool]

_WORLD = "world"

# A link with two parents is visited under both, with all below it.
_MAX_REPEATS = 100_000


class EndlessRobotError(ValueError):
    """The library would recur until its stack is full, and crash."""


def is_reduced(joint: Joint, extensions: Extensions) -> bool:
    """Tell whether a joint is fixed and nothing asks for it to stay."""
    kept = joint.name in extensions.kept_revolute or joint.name in extensions.kept_fixed
    return joint.kind == "fixed" and not kept


def is_lumped(link: Link, extensions: Extensions) -> bool:
    """Tell whether a link disappears in its parent; what is fixed to ``world`` does not."""
    if link.parent is None or link.joint_above is None or link.parent.name == _WORLD:
        return False
    return is_reduced(link.joint_above, extensions)


def lump_fixed_joints(robot: Robot, extensions: Extensions, console: Console) -> list[Link]:
    """Move the contents of every link on a reduced joint to its parent, the lowest ones first.

    Returns:
        The links that were lumped, in that order.

    Raises:
        EndlessRobotError: joints form a loop below the root, or links with several parents are
            visited far too often.
    """
    lumped = []
    for link in _bottom_up(robot, extensions):
        if is_lumped(link, extensions):
            _lump(link, extensions, console)
            lumped.append(link)
    return lumped


def _bottom_up(robot: Robot, extensions: Extensions) -> Iterator[Link]:
    """Yield links: those on reduced joints before their parent, the others after it."""
    waiting: list[_Step] = [(robot.root, 0, False)]
    visits = 0
    while waiting:
        link, depth, is_ready = waiting.pop()
        if is_ready:
            yield link
            continue
        visits += 1
        if depth > len(robot.links) or visits > len(robot.links) + _MAX_REPEATS:
            raise EndlessRobotError(link.name)
        first: list[_Step] = []
        later: list[_Step] = []
        for child in link.children:
            reduced = child.joint_above is not None and is_reduced(child.joint_above, extensions)
            (first if reduced else later).append((child, depth + 1, False))
        waiting += [*later[::-1], (link, depth, True), *first[::-1]]


def _lump(link: Link, extensions: Extensions, console: Console) -> None:
    parent, joint = link.parent, link.joint_above
    assert parent is not None and joint is not None
    if console.release is Release.V14:
        _remember(link, parent, joint, extensions)
    move_extensions(link.name, parent.name, joint.T_parent_joint, extensions, console)
    lump_inertia(link, parent, joint.T_parent_joint)
    _move_parts(link, parent, "visual", console)
    _move_parts(link, parent, "collision", console)
    for child in link.children:
        _hang_higher(child, link, extensions)


def _remember(link: Link, parent: Link, joint: Joint, extensions: Extensions) -> None:
    """Leave frames of the joint's and the link's names, as sdformat does since 14."""
    origin = joint.T_parent_joint
    for name, holder, pose in (
        (joint.name, parent.name, pose_text(origin)),
        (link.name, joint.name, "0 0 0 0 0 0"),
    ):
        frame = SdfElement("frame", {"name": name, "attached_to": holder})
        frame.add("pose", pose)
        kept = Extension(blobs=[Blob(frame)])
        extensions.by_reference.setdefault("", []).append(kept)


def _move_parts(link: Link, parent: Link, kind: str, console: Console) -> None:
    assert link.joint_above is not None
    is_visual = kind == "visual"
    parts = parent.visuals if is_visual else parent.collisions
    held = {id(part) for part in parts}
    for part in link.visuals if is_visual else link.collisions:
        part.name = part.name or link.name
        part.origin = chained(link.joint_above.T_parent_joint, part.origin)
        if id(part) not in held:
            parts.append(part)
            continue
        console.warning(
            f"{kind} twice",
            f"attempted to add {kind} [{part.name}] to link [{parent.name}], but it already "
            f"exists in {kind}_array under name [{part.name}]",
        )


def _hang_higher(child: Link, link: Link, extensions: Extensions) -> None:
    """Hang a moving child on the nearest link above that stays."""
    joint = child.joint_above
    if joint is None or is_reduced(joint, extensions):
        return
    holder = link
    while is_lumped(holder, extensions):
        assert holder.joint_above is not None and holder.parent is not None
        joint.T_parent_joint = chained(holder.joint_above.T_parent_joint, joint.T_parent_joint)
        holder = holder.parent
    child.parent = holder
    joint.parent = holder.name
