"""Which links of a robot description do not reach the simulation, and why."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from gazelle.description.sdformat_emulation.parser_urdf.console import Console
from gazelle.description.sdformat_emulation.parser_urdf.conversion import (
    Fate,
    Visit,
    accepted_robot,
    visits,
)
from gazelle.description.sdformat_emulation.parser_urdf.cpp_numbers import NumberCrashError
from gazelle.description.sdformat_emulation.parser_urdf.gazebo_extensions import (
    Extensions,
    read_extensions,
)
from gazelle.description.sdformat_emulation.parser_urdf.reduce_fixed_joints import (
    EndlessRobotError,
    lump_fixed_joints,
)
from gazelle.description.sdformat_emulation.parser_urdf.robot import Link, Robot
from gazelle.description.sdformat_emulation.release import Release
from gazelle.description.xml import Tag

__all__ = ["DroppedLink", "dropped_links", "lumped_links"]


class DroppedLink(NamedTuple):
    """A link that is not modelled, nor lumped into one that is.

    Attributes:
        name: the link.
        joint: the joint above it, which is not modelled either; empty for the root.
        reason: a clause such as "it has no <inertial>".
        because: the link that is to blame; the link itself, or one above it.
    """

    name: str
    joint: str
    reason: str
    because: str


class _Outcome(NamedTuple):
    robot: Robot
    extensions: Extensions
    ends: dict[str, str]


def lumped_links(root: Tag) -> Mapping[str, str]:
    """Return the links that disappear by fixed joints → the link each ends up in.

    Empty when the library refuses the description. Chains are followed to their end; what ends up
    in a link that is left out is lost with it, see `dropped_links`.
    """
    outcome = _outcome(root)
    return outcome.ends if outcome is not None else {}


def dropped_links(root: Tag) -> tuple[DroppedLink, ...]:
    """Return the links whose contents are lost, from the root down; none when all is refused.

    A link needs an ``<inertial>`` with more than 1e-6 kg after lumping. Everything that moves
    below one without it is left out too, even if the link itself is lumped into another one.
    """
    outcome = _outcome(root)
    if outcome is None:
        return ()
    robot, extensions, ends = outcome
    modelled = set()
    blamed: dict[str, Visit] = {}
    for visit in visits(robot, extensions):
        if visit.fate is Fate.MODELLED:
            modelled.add(visit.link.name)
        elif visit.fate is not Fate.LUMPED:
            for link in _from(visit.link):
                blamed.setdefault(link.name, visit)
    dropped = {}
    for link in _from(robot.root):
        if link.name in blamed and ends.get(link.name, link.name) not in modelled:
            dropped[link.name] = _dropped(link, blamed[link.name], ends.get(link.name))
    return tuple(dropped.values())


def _dropped(link: Link, blame: Visit, end: str | None) -> DroppedLink:
    lack = "has no <inertial>"
    if blame.fate is Fate.WITHOUT_MASS and blame.link.inertial is not None:
        lack = f"weighs {blame.link.inertial.mass_kg:g} kg, which counts as nothing"
    if end is not None:
        reason = f"it is lumped into '{end}', which is left out"
    elif blame.link is link:
        reason = f"it {lack}"
    else:
        reason = f"it hangs on '{blame.link.name}', which {lack}"
    joint = link.joint_above.name if link.joint_above is not None else ""
    return DroppedLink(link.name, joint, reason, blame.link.name)


def _outcome(root: Tag) -> _Outcome | None:
    robot = accepted_robot(root)
    if robot is None:
        return None
    console = Console(Release.V12)
    try:
        extensions = read_extensions(root, console)
        lumped = {link.name: link for link in lump_fixed_joints(robot, extensions, console)}
    except (NumberCrashError, EndlessRobotError):
        return None
    ends = {}
    for name, link in lumped.items():
        holder = link
        while holder.name in lumped and holder.parent is not None:
            holder = holder.parent
        ends[name] = holder.name
    return _Outcome(robot, extensions, ends)


def _from(top: Link) -> Iterator[Link]:
    """Yield a link and all below it, each once."""
    seen = set()
    waiting = [top]
    while waiting:
        link = waiting.pop()
        if link.name not in seen:
            seen.add(link.name)
            yield link
            waiting += link.children[::-1]
