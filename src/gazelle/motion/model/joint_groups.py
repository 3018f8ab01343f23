"""Planning groups: which joints and links the words of an SRDF mean."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from gazelle.description.srdf import Chain, EndEffector, Group, Srdf
from gazelle.motion.joint_space import FloatArray, JointSpace
from gazelle.motion.model.joints import JointKind, RobotJoint

__all__ = ["JointGroup", "groups_of"]


@dataclass(frozen=True, eq=False)
class JointGroup:
    """A planning group.

    Attributes:
        name: of the group.
        joints: all its joints, fixed and mimicking ones included, in the robot's order.
        active_joints: those with variables of their own.
        links: children of its joints.
        moved_links: links that its joints move, those of other groups included.
        variables: names of the variables of its active joints: what a configuration of the group
            is made of.
        indices: (n,), their places in the robot's positions.
        space: the variables with their limits.
        is_chain: every joint hangs on the one before.
        base_link: link above the first joint; the SRDF's ``base_link`` where the group has one
            chain.
        tip_links: last links of its branches; a chain has one.
        subgroups: names of groups within it.
        end_effectors: names of end effectors that are mounted on it.
        states: named positions of its variables.
    """

    name: str
    joints: tuple[str, ...]
    active_joints: tuple[str, ...]
    links: tuple[str, ...]
    moved_links: tuple[str, ...]
    variables: tuple[str, ...]
    indices: NDArray[np.intp]
    space: JointSpace
    is_chain: bool
    base_link: str
    tip_links: tuple[str, ...]
    subgroups: tuple[str, ...] = ()
    end_effectors: tuple[str, ...] = ()
    states: Mapping[str, dict[str, float]] = field(default_factory=dict)

    @property
    def tip_link(self) -> str:
        """The only tip; empty when there are several."""
        return self.tip_links[0] if len(self.tip_links) == 1 else ""

    def take(self, positions: FloatArray) -> FloatArray:
        """Return the group's part (n,) of a robot's positions (v,)."""
        return np.asarray(positions[self.indices])


def groups_of(joints: tuple[RobotJoint, ...], srdf: Srdf) -> dict[str, JointGroup]:
    """Return the groups of an SRDF by name, those without a joint left out.

    Args:
        joints: of the robot, in its order.
        srdf: groups, states and end effectors.
    """
    resolver = _Resolver(joints, srdf)
    found = {group.name: resolver.group(group) for group in srdf.groups}
    return {name: group for name, group in found.items() if group is not None}


class _Resolver:
    def __init__(self, joints: tuple[RobotJoint, ...], srdf: Srdf) -> None:
        self._joints = joints
        self._srdf = srdf
        self._by_name = {joint.name: joint for joint in joints}
        self._above = {joint.child: joint for joint in joints}
        self._members: dict[str, frozenset[str]] = {}

    def group(self, written: Group) -> JointGroup | None:
        members = self._joints_of(written)
        joints = tuple(joint for joint in self._joints if joint.name in members)
        active = tuple(joint for joint in joints if joint.is_active)
        if not active:
            return None
        links = tuple(joint.child for joint in joints)
        tips = self._tips(written, joints)
        return JointGroup(
            written.name,
            tuple(joint.name for joint in joints),
            tuple(joint.name for joint in active),
            links,
            self._moved(active, members),
            tuple(name for joint in active for name in joint.variables),
            np.array([i for joint in active for i in _places(joint)], dtype=np.intp),
            _space(active),
            self._is_chain(joints),
            self._base(written, joints),
            tips,
            self._subgroups(written, members),
            self._end_effectors(written.name, links),
            self._states(written.name, active),
        )

    def _joints_of(self, group: Group) -> frozenset[str]:
        if group.name not in self._members:
            found = {name for name in group.joints if name in self._by_name}
            found |= {self._above[link].name for link in group.links if link in self._above}
            for chain in group.chains:
                found |= self._chain(chain)
            for name in group.subgroups:
                inner = self._srdf.group(name)
                found |= self._joints_of(inner) if inner is not None else frozenset()
            self._members[group.name] = frozenset(found)
        return self._members[group.name]

    def _chain(self, chain: Chain) -> set[str]:
        """Joints above the tip and not above the base, and the other way round."""
        tip, base = self._joints_above(chain.tip_link), self._joints_above(chain.base_link)
        return set(tip) ^ set(base)

    def _joints_above(self, link: str) -> list[str]:
        found: list[str] = []
        while link in self._above:
            found.append(self._above[link].name)
            link = self._above[link].parent
        return found

    def _moved(self, active: Iterable[RobotJoint], members: frozenset[str]) -> tuple[str, ...]:
        names = {joint.name for joint in active}
        # A joint outside the group that mimics one of the group moves as well.
        names |= {item.name for item in self._joints if item.mimic and item.mimic.joint in names}
        moved = {joint.child for joint in self._joints if joint.name in names}
        for joint in self._joints:
            if joint.parent in moved:
                moved.add(joint.child)
        return tuple(joint.child for joint in self._joints if joint.child in moved)

    def _base(self, written: Group, joints: tuple[RobotJoint, ...]) -> str:
        if _is_one_chain(written) and self._below(written.chains[0]):
            return written.chains[0].base_link
        return joints[0].parent

    def _tips(self, written: Group, joints: tuple[RobotJoint, ...]) -> tuple[str, ...]:
        if _is_one_chain(written) and self._below(written.chains[0]):
            return (written.chains[0].tip_link,)
        parents = {joint.parent for joint in joints}
        return tuple(joint.child for joint in joints if joint.child not in parents)

    def _below(self, chain: Chain) -> bool:
        link = chain.tip_link
        while link != chain.base_link and link in self._above:
            link = self._above[link].parent
        return link == chain.base_link

    def _is_chain(self, joints: tuple[RobotJoint, ...]) -> bool:
        return all(self._hangs_on(b, a) for a, b in pairwise(joints))

    def _hangs_on(self, joint: RobotJoint, above: RobotJoint) -> bool:
        link = joint.parent
        while link in self._above:
            found = self._above[link]
            if found.name == above.name:
                return True
            if found.kind is not JointKind.FIXED:
                return False
            link = found.parent
        return False

    def _subgroups(self, group: Group, members: frozenset[str]) -> tuple[str, ...]:
        """Groups whose joints all belong to this one: MoveIt does not ask how it is written."""
        others = (item for item in self._srdf.groups if item.name != group.name)
        return tuple(item.name for item in others if self._is_within(item, members))

    def _is_within(self, group: Group, members: frozenset[str]) -> bool:
        inner = self._joints_of(group)
        return bool(inner) and inner < members

    def _end_effectors(self, group: str, links: tuple[str, ...]) -> tuple[str, ...]:
        found = (item for item in self._srdf.end_effectors if self._carries(item, group, links))
        return tuple(item.name for item in found)

    def _carries(self, effector: EndEffector, group: str, links: tuple[str, ...]) -> bool:
        if effector.parent_group:
            return effector.parent_group == group
        inner = self._srdf.group(effector.group)
        own = self._joints_of(inner) if inner is not None else frozenset()
        return effector.parent_link in links and self._above[effector.parent_link].name not in own

    def _states(self, group: str, active: tuple[RobotJoint, ...]) -> dict[str, dict[str, float]]:
        found: dict[str, dict[str, float]] = {}
        for state in self._srdf.states_of(group):
            values: dict[str, float] = {}
            for joint in active:
                numbers = state.values.get(joint.name, ())
                if len(numbers) == len(joint.variables):
                    values |= dict(zip(joint.variables, numbers, strict=True))
            found[state.name] = values
        return found


def _is_one_chain(group: Group) -> bool:
    others = group.links or group.joints or group.subgroups
    return len(group.chains) == 1 and not others


def _places(joint: RobotJoint) -> range:
    return range(joint.first, joint.first + len(joint.variables))


def _space(active: tuple[RobotJoint, ...]) -> JointSpace:
    limits = [limit for joint in active for limit in joint.limits]
    return JointSpace(
        tuple(name for joint in active for name in joint.variables),
        np.array([limit.lower for limit in limits]),
        np.array([limit.upper for limit in limits]),
        np.array([limit.continuous for limit in limits]),
        np.array([limit.velocity for limit in limits]),
        np.array([limit.acceleration for limit in limits]),
        np.array([limit.jerk for limit in limits]),
    )
