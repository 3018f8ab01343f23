"""Planning groups that a robot's kinematic tree suggests: arms, hands, their end effectors."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

from gazelle.description.srdf import Chain, EndEffector, Group
from gazelle.motion.model import JointKind, RobotJoint, RobotModel

__all__ = ["KinematicTree", "Limb", "is_named_wheel"]

_FINGER = re.compile(r"finger|gripper|jaw|knuckle|claw|pinch|thumb", re.IGNORECASE)
_HAND = re.compile(r"hand", re.IGNORECASE)
_WHEEL = re.compile(r"wheel|caster|track|rotor|propeller", re.IGNORECASE)
_TOOL = re.compile(r"(^|_)(tool0?|tcp|ee|eef|tool_?frame|grasp|end_?effector)(_|$|link)", re.I)
_NAMED = ("torso", "head", "neck", "lift", "leg")
_SIDES = {"left": re.compile(r"(^|[_/])(left|l)([_/]|$)", re.I),
          "right": re.compile(r"(^|[_/])(right|r)([_/]|$)", re.I)}  # fmt: skip
_ARM_JOINTS = 3
_FINGER_JOINTS = 3


@dataclass(frozen=True, slots=True)
class Limb:
    """A row of joints that hang on each other.

    Attributes:
        joints: that move, mimicking ones left out, the nearest to the root first.
        base_link: the link above the first.
        tip_link: the last link; a tool's frame where there is one.
        hand_link: the link that carries the fingers; empty without a hand.
        fingers: joints of the hand, mimicking ones included.
    """

    joints: tuple[RobotJoint, ...]
    base_link: str
    tip_link: str
    hand_link: str = ""
    fingers: tuple[RobotJoint, ...] = ()


class KinematicTree:
    """A robot's links as rigid bodies with the moving joints between them."""

    def __init__(self, robot: RobotModel) -> None:
        self.robot = robot
        self._above = robot.joint_above
        self._solid = {link.name for link in robot.description.links if link.collisions}
        self._below: dict[str, list[RobotJoint]] = {link: [] for link in robot.links}
        for joint in robot.joints[1:]:
            self._below[joint.parent].append(joint)

    @cached_property
    def limbs(self) -> tuple[Limb, ...]:
        """Arms and other rows of joints; a hand that nothing moves is a limb without joints."""
        return tuple(self._limbs_from(self.robot.root_link))

    @cached_property
    def has_wheels(self) -> bool:
        """Whether the robot seems to drive."""
        return any(_is_wheel(joint, self._moving(joint.child)) for joint in self.robot.joints[1:])

    def groups(self) -> tuple[tuple[Group, ...], tuple[EndEffector, ...]]:
        """Return a group for each arm and each hand, and the hands as end effectors."""
        limbs = [limb for limb in self.limbs if limb.fingers or _known_name(limb) or _is_arm(limb)]
        named = _limb_names(limbs)
        several = sum(bool(limb.fingers) for limb in limbs) > 1
        groups: list[Group] = []
        effectors: list[EndEffector] = []
        for limb, name in zip(limbs, named, strict=True):
            if limb.joints:
                groups.append(Group(name, chains=(Chain(limb.base_link, limb.tip_link),)))
            if limb.fingers:
                side = f"{name.split('_')[0]}_" if several and name.count("_") else ""
                hand = _unique(side + self._hand_name(limb), [group.name for group in groups])
                groups.append(self.hand_group(hand, limb))
                if limb.joints:
                    link = self._mount(limb)
                    effectors.append(EndEffector(f"{hand}_ee", hand, link, name))
        return tuple(groups), tuple(effectors)

    def hand_group(self, name: str, limb: Limb) -> Group:
        """Return the group of a limb's hand: the link that carries the fingers, and their joints.

        Args:
            name: of the group.
            limb: a limb with fingers.
        """
        carried = self._above[limb.hand_link]
        is_own = carried.kind is JointKind.FIXED and bool(carried.parent)
        links = (limb.hand_link,) if is_own else ()
        return Group(name, links=links, joints=tuple(joint.name for joint in limb.fingers))

    def chain_joints(self, base_link: str, tip_link: str) -> tuple[RobotJoint, ...]:
        """Return the joints from a link down to another; none where it is not below."""
        found: list[RobotJoint] = []
        link = tip_link
        while link != base_link:
            joint = self._above.get(link)
            if joint is None or not joint.parent:
                return ()
            found.append(joint)
            link = joint.parent
        return tuple(reversed(found))

    def joints_below(self, link: str) -> tuple[RobotJoint, ...]:
        """Return all joints that hang below a link, fixed ones included."""
        return tuple(
            found
            for joint in self._below[link]
            for found in (joint, *self.joints_below(joint.child))
        )

    def links_above(self, link: str) -> tuple[str, ...]:
        """Return the links above a link, the nearest first."""
        return tuple(reversed(self._path(link)[:-1]))

    def is_rigid(self, link: str, other: str) -> bool:
        """Return whether nothing moves between two links."""
        return self._head(link) == self._head(other)

    def _head(self, link: str) -> str:
        joint = self._above[link]
        is_fixed = joint.kind is JointKind.FIXED and bool(joint.parent)
        return self._head(joint.parent) if is_fixed else link

    def _limbs_from(self, link: str) -> Iterable[Limb]:
        """Return the limbs that begin at the rigid body of a link."""
        edges = self._moving(link)
        arms = [joint for joint in edges if not _is_wheel(joint, self._moving(joint.child))]
        if arms and self._is_hand(link, arms):
            yield self._limb((), arms[0].parent, link, arms)
            return
        for joint in arms:
            yield from self._limb_along(joint)

    def _limb_along(self, first: RobotJoint) -> Iterable[Limb]:
        joints = [first]
        while True:
            link = joints[-1].child
            below = self._moving(link)
            if below and self._is_hand(link, below):
                yield self._limb(joints, first.parent, link, below)
                return
            if len(below) != 1:
                yield self._limb(joints, first.parent, link, ())
                if below:
                    yield from self._limbs_from(link)
                return
            joints.append(below[0])

    def _limb(
        self, joints: Sequence[RobotJoint], base: str, link: str, fingers: Sequence[RobotJoint]
    ) -> Limb:
        """Return the limb whose last rigid body is that of `link`."""
        active = tuple(joint for joint in joints if joint.is_active)
        hand = self._hand_link(link, fingers) if fingers else ""
        all_fingers = [
            joint for root in fingers for joint in (root, *self.joints_below(root.child))
        ]
        moving = tuple(joint for joint in all_fingers if joint.kind is not JointKind.FIXED)
        return Limb(active, base, self._tip(link, hand), hand, moving)

    def _is_hand(self, link: str, below: Sequence[RobotJoint]) -> bool:
        depths = [self._depth(joint) for joint in below]
        if max(depths) > _FINGER_JOINTS:
            return False
        words = [name for joint in below for name in (joint.name, joint.child)]
        if all(_FINGER.search(name) for name in words[::2]) or all(
            _FINGER.search(name) for name in words[1::2]
        ):
            return True
        return link != self.robot.root_link and len(below) > 1 and self._is_end(link)

    def _is_end(self, link: str) -> bool:
        """Whether enough joints are above for what hangs here to be fingers."""
        count = 0
        while (joint := self._above[link]).parent:
            count += joint.is_active
            link = joint.parent
        return count >= _ARM_JOINTS

    def _depth(self, joint: RobotJoint) -> int:
        return 1 + max((self._depth(inner) for inner in self._moving(joint.child)), default=0)

    def _moving(self, link: str) -> list[RobotJoint]:
        """Moving joints that hang on the rigid body of a link, below the link."""
        found: list[RobotJoint] = []
        for joint in self._below[link]:
            if joint.kind is JointKind.FIXED:
                found += self._moving(joint.child)
            else:
                found.append(joint)
        return found

    def _rigid(self, link: str) -> list[str]:
        """Links of the rigid body, `link` first."""
        inner = [joint for joint in self._below[link] if joint.kind is JointKind.FIXED]
        return [link, *(name for joint in inner for name in self._rigid(joint.child))]

    def _hand_link(self, link: str, fingers: Sequence[RobotJoint]) -> str:
        """The lowest link that carries all fingers."""
        paths = [[*self._path(joint.parent)] for joint in fingers]
        shared = [row[0] for row in zip(*paths, strict=False) if len(set(row)) == 1]
        return shared[-1] if shared else link

    def _path(self, link: str) -> list[str]:
        joint = self._above[link]
        return [*(self._path(joint.parent) if joint.parent else ()), link]

    def _tip(self, link: str, hand: str) -> str:
        rigid = self._rigid(link)
        tools = [
            name for name in rigid
            if name not in self._solid and _TOOL.search(name) and not self._below[name]
        ]  # fmt: skip
        if tools:
            return tools[-1]
        if hand:
            above = self._above[hand].parent
            return above if above in rigid else link
        while True:
            below = [joint for joint in self._below[link] if joint.kind is JointKind.FIXED]
            if len(below) != 1 or len(self._below[link]) != 1:
                return link
            link = below[0].child

    def _mount(self, limb: Limb) -> str:
        """The link that a hand is mounted on: the arm's tip, if it is not one of the hand's."""
        inside = {joint.child for joint in limb.fingers} | {limb.hand_link}
        return limb.joints[-1].child if limb.tip_link in inside else limb.tip_link

    def _hand_name(self, limb: Limb) -> str:
        names = (limb.hand_link, *(joint.name for joint in limb.fingers))
        return "hand" if any(_HAND.search(name) for name in names) else "gripper"


def is_named_wheel(joint: str, child: str) -> bool:
    """Return whether the name of a joint or of the link it carries is a wheel's."""
    return bool(_WHEEL.search(joint) or _WHEEL.search(child))


def _is_wheel(joint: RobotJoint, below: Sequence[RobotJoint]) -> bool:
    if is_named_wheel(joint.name, joint.child):
        return True
    turns = bool(joint.limits) and joint.limits[0].continuous
    return turns and bool(below) and all(_WHEEL.search(inner.name) for inner in below)


def _limb_names(limbs: Sequence[Limb]) -> list[str]:
    several = sum(_is_arm(limb) for limb in limbs) > 1
    found: list[str] = []
    for limb in limbs:
        plain = _known_name(limb) or "arm"
        side = _side(limb) if several or plain != "arm" else ""
        found.append(_unique(f"{side}_{plain}" if side else plain, found))
    return found


def _known_name(limb: Limb) -> str:
    """Return what a limb's names say it is; an arm may well have a joint called lift."""
    words = " ".join(name for joint in limb.joints for name in (joint.name, joint.child)).lower()
    names = ("leg",) if len(limb.joints) >= _ARM_JOINTS else _NAMED
    return next((word for word in names if word in words), "")


def _is_arm(limb: Limb) -> bool:
    return len(limb.joints) >= _ARM_JOINTS


def _side(limb: Limb) -> str:
    names = [joint.child for joint in limb.joints]
    return next(
        (side for side, form in _SIDES.items() if names and all(form.search(it) for it in names)),
        "",
    )


def _unique(name: str, taken: Sequence[str]) -> str:
    number, found = 2, name
    while found in taken:
        found, number = f"{name}_{number}", number + 1
    return found
