"""The row of a built-in node, and the records that say what it has on a graph."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from importlib import import_module
from typing import Any, NamedTuple

__all__ = [
    "ROS_1",
    "ROS_2",
    "ROS_BOTH",
    "Direction",
    "FrameRow",
    "Interface",
    "NodeName",
    "NodeRole",
    "NodeSpec",
    "calls",
    "listens",
    "offers",
    "publishes",
    "resolved",
]

ROS_1 = (1,)
ROS_2 = (2,)
ROS_BOTH = (1, 2)

# Python 3.11 fails now and then to parse two modules at once, which a host of several nodes would
# ask of it where modules are parsed anew, as pytest does.
_IMPORTING = threading.RLock()


class NodeName(NamedTuple):
    """A name that a node answers to.

    Attributes:
        package: of ROS.
        executable: ROS 1's ``type``.
        ros: versions of ROS that have it under this name.
    """

    package: str
    executable: str
    ros: tuple[int, ...] = ROS_BOTH


class NodeRole(Enum):
    """What a node is to a launch: who starts first, who ends by itself, who is looked at."""

    SIMULATOR = "simulator"
    MODEL_SPAWNER = "spawns a model"
    ENTITY_SPAWNER = "spawns an entity"
    CONTROLLER_SPAWNER = "starts controllers"
    STATE_PUBLISHER = "joint states to tf"
    JOINT_STATES = "joint states"
    STATIC_TRANSFORM = "static transform"
    RELAY = "passes messages on"
    VIEW = "view"
    OTHER = "built in"


class Direction(Enum):
    """Which side of a topic, service or action a node is."""

    GIVES = "publishes, or answers"
    TAKES = "listens, or calls"


class Interface(NamedTuple):
    """A topic, a service or an action of a node.

    Attributes:
        name: as its code says it: ``/global``, ``relative`` or ``~private``. What stands in braces
            comes from a parameter, with its default: ``{~scan_topic|scan}``.
        type: such as ``sensor_msgs/msg/LaserScan``; empty for any.
        direction: which side the node is.
        when: the parameter that must be true for it, with its default: ``~publish_tf|true``; after
            a ``!`` it must be false. Empty for always.
        remark: what else is to be known.
    """

    name: str
    type: str
    direction: Direction
    when: str = ""
    remark: str = ""


class FrameRow(NamedTuple):
    """A transform that a node sends.

    Attributes:
        parent, child: frames, with parameters in braces as in `Interface`.
        when: as in `Interface`.
        remark: what else is to be known.
    """

    parent: str
    child: str
    when: str = ""
    remark: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class NodeSpec:
    """A node that Gazelle brings.

    Attributes:
        package, executable: its first name.
        ros: versions of ROS that have it under this name.
        entry: ``module:function``; the function takes `NodeArguments`, the graph and an event
            that tells it to stop, and returns an exit code.
        does: one line about it.
        is_light: it may share a process with other light ones.
        aliases: other names it answers to.
        name: what the node calls itself when nobody names it, its executable when empty.
        writes_at_end: it writes files when it is told to end, and must not be hurried.
        role: what it is to a launch.
        parameters: ``module:ATTRIBUTE`` of its table of parameters, None for none.
        topics, services, actions: what it has on a graph when it has come up.
        frames: transforms it sends; None when they cannot be told before it runs.
        joints: whose states it sends, with parameters in braces as in `Interface`; None when they
            cannot be told before it runs.
        namespaces: names of its code that stand before those of topics and are remapped first.
        is_complete: there are no other topics than `topics`.
    """

    package: str
    executable: str
    ros: tuple[int, ...] = ROS_BOTH
    entry: str
    does: str
    is_light: bool
    aliases: tuple[NodeName, ...] = ()
    name: str = ""
    writes_at_end: bool = False
    role: NodeRole = NodeRole.OTHER
    parameters: str | None = None
    topics: tuple[Interface, ...] = ()
    services: tuple[Interface, ...] = ()
    actions: tuple[Interface, ...] = ()
    frames: tuple[FrameRow, ...] | None = ()
    joints: tuple[str, ...] | None = ()
    namespaces: tuple[str, ...] = ()
    is_complete: bool = False

    @property
    def names(self) -> tuple[NodeName, ...]:
        """All names it answers to, the first one first."""
        return (NodeName(self.package, self.executable, self.ros), *self.aliases)

    def default_name(self, executable: str = "") -> str:
        """Return what the node calls itself when nobody names it.

        Args:
            executable: the name it was started by, the first one when empty.
        """
        return self.name or (executable or self.executable).partition(".")[0]

    def load(self) -> Callable[..., Any]:
        """Import and return the function."""
        return resolved(self.entry)  # type: ignore[no-any-return]


def resolved(reference: str) -> Any:
    """Import and return what ``module:ATTRIBUTE`` names."""
    module, _, attribute = reference.partition(":")
    with _IMPORTING:
        return getattr(import_module(module), attribute)


def publishes(name: str, type_name: str, when: str = "", remark: str = "") -> Interface:
    """Return a topic that a node publishes."""
    return Interface(name, type_name, Direction.GIVES, when, remark)


def listens(name: str, type_name: str, when: str = "", remark: str = "") -> Interface:
    """Return a topic that a node listens to."""
    return Interface(name, type_name, Direction.TAKES, when, remark)


def offers(name: str, type_name: str, when: str = "", remark: str = "") -> Interface:
    """Return a service or an action that a node answers."""
    return Interface(name, type_name, Direction.GIVES, when, remark)


def calls(name: str, type_name: str, when: str = "", remark: str = "") -> Interface:
    """Return a service or an action that a node calls."""
    return Interface(name, type_name, Direction.TAKES, when, remark)
