"""Planning groups that a person names by links, completed by what the robot suggests."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from gazelle.description.srdf import Chain, EndEffector, Group
from gazelle.diagnostics import nearest_names
from gazelle.errors import NotFoundError
from gazelle.motion.model import JointKind, RobotModel
from gazelle.motion.setup_assistant.kinematic_tree import KinematicTree, Limb
from gazelle.motion.setup_assistant.package_files import SetupAssistantError

__all__ = ["ChosenChain", "ChosenHand", "chosen_groups"]


class ChosenChain(NamedTuple):
    """A group of all joints between two links."""

    name: str
    base_link: str
    tip_link: str


class ChosenHand(NamedTuple):
    """A group of all joints below a link."""

    name: str
    link: str


def chosen_groups(
    robot: RobotModel, chains: Sequence[ChosenChain] = (), hands: Sequence[ChosenHand] = ()
) -> tuple[tuple[Group, ...], tuple[EndEffector, ...]]:
    """Return groups and end effectors; what is not named is as the kinematic tree suggests.

    Args:
        robot: the robot.
        chains: take the place of all suggested arms.
        hands: take the place of all suggested hands.

    Raises:
        NotFoundError: a link is not there.
        SetupAssistantError: no joint that moves is where the links say.
    """
    tree = KinematicTree(robot)
    suggested, effectors = tree.groups()
    if not chains and not hands:
        return suggested, effectors
    hand_names = {group.name for group in suggested if not group.chains}
    arms = [_chain(tree, chain) for chain in chains] or [
        group for group in suggested if group.name not in hand_names
    ]
    grippers: list[tuple[Group, str]] = []
    if hands:
        grippers = [(_hand(tree, hand), hand.link) for hand in hands]
    else:
        links = [limb.hand_link for limb in tree.limbs if limb.fingers]
        named = [group for group in suggested if group.name in hand_names]
        grippers = list(zip(named, links, strict=True))
    mounted = [
        found
        for group, link in grippers
        if (found := _mounted(tree, arms, group, link)) is not None
    ]
    return (*arms, *(group for group, _ in grippers)), tuple(mounted)


def _chain(tree: KinematicTree, chain: ChosenChain) -> Group:
    _check_links(tree.robot, (chain.base_link, chain.tip_link))
    joints = tree.chain_joints(chain.base_link, chain.tip_link)
    if not any(joint.is_active for joint in joints):
        raise SetupAssistantError(
            f"group '{chain.name}': no joint that moves is between link '{chain.base_link}' and "
            f"'{chain.tip_link}' below it"
        )
    return Group(chain.name, chains=(Chain(chain.base_link, chain.tip_link),))


def _hand(tree: KinematicTree, hand: ChosenHand) -> Group:
    _check_links(tree.robot, (hand.link,))
    below = tuple(
        joint for joint in tree.joints_below(hand.link) if joint.kind is not JointKind.FIXED
    )
    if not below:
        raise SetupAssistantError(
            f"end effector '{hand.name}': no joint that moves is below link '{hand.link}'"
        )
    return tree.hand_group(hand.name, Limb((), hand.link, hand.link, hand.link, below))


def _mounted(
    tree: KinematicTree, arms: Iterable[Group], hand: Group, link: str
) -> EndEffector | None:
    """Return the hand on the arm whose tip is nearest above it, or on the same rigid body."""
    above = tree.links_above(link)
    body = {name for name in (link, *above) if tree.is_rigid(name, link)}
    for arm in arms:
        for chain in arm.chains:
            tip = chain.tip_link
            if tip in above or any(tree.is_rigid(name, tip) for name in body):
                inside = tip == link or link in tree.links_above(tip)
                mount = tip if not inside or tip not in hand.links else above[0]
                return EndEffector(f"{hand.name}_ee", hand.name, mount, arm.name)
    return None


def _check_links(robot: RobotModel, links: Iterable[str]) -> None:
    for link in links:
        if link not in robot.joint_above:
            near = nearest_names(link, robot.links)
            hint = f"links of '{robot.name}': {', '.join(robot.links)}"
            raise NotFoundError("link", link, nearest=near, hint=hint)
