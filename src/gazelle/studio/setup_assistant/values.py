"""What the page is told of a config package that is being made."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypedDict

from gazelle.studio.motion.robot import MotionRobot

if TYPE_CHECKING:
    from gazelle.motion.model import RobotModel
    from gazelle.motion.setup_assistant import SetupAssistantConfig

__all__ = [
    "AssistantChain",
    "AssistantController",
    "AssistantEffector",
    "AssistantFile",
    "AssistantGroup",
    "AssistantInterface",
    "AssistantLink",
    "AssistantPair",
    "AssistantStart",
    "AssistantState",
    "AssistantValue",
    "AssistantVirtualJoint",
    "AssistantWritten",
    "config_value",
    "link_values",
]


class AssistantStart(TypedDict):
    """What the page may begin with: robots' files, and config packages that are there."""

    robots: list[str]
    packages: list[str]
    folder: str


class AssistantLink(TypedDict):
    """A link below another one."""

    name: str
    parent: str
    joint: str
    kind: str
    is_solid: bool


class AssistantPair(TypedDict):
    """Two links; the reason is empty where they are checked for collision."""

    link1: str
    link2: str
    reason: str


class AssistantVirtualJoint(TypedDict):
    """What holds the root."""

    name: str
    type: str
    parent_frame: str
    child_link: str


class AssistantChain(TypedDict):
    """All joints between two links."""

    base_link: str
    tip_link: str


class AssistantGroup(TypedDict):
    """A planning group as it is written, and the solver of its inverse kinematics."""

    name: str
    chains: list[AssistantChain]
    links: list[str]
    joints: list[str]
    subgroups: list[str]
    solver: str


class AssistantState(TypedDict):
    """A named pose, rad or m by joint."""

    name: str
    group: str
    values: dict[str, float]


class AssistantEffector(TypedDict):
    """A group that is mounted on another."""

    name: str
    group: str
    parent_link: str
    parent_group: str


class AssistantController(TypedDict):
    """A controller that trajectories are sent to."""

    name: str
    type: str
    plugin: str
    action_ns: str
    joints: list[str]


class AssistantInterface(TypedDict):
    """What a joint is commanded by, and whether the package adds that to the robot."""

    joint: str
    kinds: list[str]
    is_added: bool


class AssistantFile(TypedDict):
    """A file that is to be written: new, same, changed or edited."""

    path: str
    state: str


class AssistantWritten(TypedDict):
    """What was written, what was edited and kept, and what to type next."""

    written: list[str]
    kept: list[str]
    next: list[str]


class AssistantConfig(TypedDict):
    """A config package as it is chosen so far."""

    package_name: str
    ros_version: int
    file: str
    author_name: str
    author_email: str
    trials: int
    pairs: list[AssistantPair]
    virtual_joints: list[AssistantVirtualJoint]
    groups: list[AssistantGroup]
    states: list[AssistantState]
    end_effectors: list[AssistantEffector]
    passive_joints: list[str]
    controllers: list[AssistantController]
    interfaces: list[AssistantInterface]
    state_interfaces: list[str]


class AssistantValue(AssistantConfig):
    """A session: the config package and its robot."""

    session: int
    folder: str
    links: list[AssistantLink]
    robot: MotionRobot


def config_value(config: SetupAssistantConfig, pairs: list[AssistantPair]) -> AssistantConfig:
    """Return a configuration as the page takes it.

    Args:
        config: what was chosen.
        pairs: all pairs of links with shapes, also those that are checked.
    """
    srdf = config.srdf
    return {
        "package_name": config.package_name,
        "ros_version": config.ros_version,
        "file": str(config.source.file),
        "author_name": config.author.name,
        "author_email": config.author.email,
        "trials": config.collision_trials,
        "pairs": pairs,
        "virtual_joints": [
            {
                "name": item.name,
                "type": item.type,
                "parent_frame": item.parent_frame,
                "child_link": item.child_link,
            }
            for item in srdf.virtual_joints
        ],
        "groups": [
            {
                "name": group.name,
                "chains": [
                    {"base_link": chain.base_link, "tip_link": chain.tip_link}
                    for chain in group.chains
                ],
                "links": list(group.links),
                "joints": list(group.joints),
                "subgroups": list(group.subgroups),
                "solver": config.kinematics[group.name].solver
                if group.name in config.kinematics
                else "",
            }
            for group in srdf.groups
        ],
        "states": [
            {
                "name": state.name,
                "group": state.group,
                "values": {joint: values[0] for joint, values in state.values.items()},
            }
            for state in srdf.states
        ],
        "end_effectors": [
            {
                "name": item.name,
                "group": item.group,
                "parent_link": item.parent_link,
                "parent_group": item.parent_group,
            }
            for item in srdf.end_effectors
        ],
        "passive_joints": list(srdf.passive_joints),
        "controllers": [
            {
                "name": item.name,
                "type": item.type,
                "plugin": item.plugin,
                "action_ns": item.action_ns,
                "joints": list(item.joints),
            }
            for item in config.controllers
        ],
        "interfaces": [
            {"joint": joint, "kinds": list(kinds), "is_added": joint in config.added_joints}
            for joint, kinds in config.command_interfaces.items()
        ],
        "state_interfaces": list(config.state_interfaces),
    }


def link_values(robot: RobotModel) -> list[AssistantLink]:
    """Return a robot's links, each after the one above it."""
    solid = {link.name for link in robot.description.links if link.collisions}
    return [
        {
            "name": joint.child,
            "parent": joint.parent,
            "joint": joint.name if joint.parent else "",
            "kind": joint.kind.value,
            "is_solid": joint.child in solid,
        }
        for joint in robot.joints
    ]
