"""Which actions there are, found from the topics and services they consist of."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from gazelle.graph.key_expressions import Entity, Kind

__all__ = ["ActionInfo", "actions_of"]

_FOLDER = "/_action/"
_STATUS = "actionlib_msgs/msg/GoalStatusArray"


class ActionInfo(NamedTuple):
    """An action and who uses it.

    Attributes:
        name: global name.
        type_name: ``pkg/action/Name``; empty while only its parts' names are known.
        ros_version: 1 for actionlib, 2 for ROS 2.
        servers: global names of nodes, sorted.
        clients: global names of nodes, sorted.
    """

    name: str
    type_name: str
    ros_version: int
    servers: tuple[str, ...]
    clients: tuple[str, ...]


def actions_of(entities: Iterable[Entity]) -> tuple[ActionInfo, ...]:
    """Return the actions of both generations by name."""
    known = tuple(entities)
    return tuple(sorted([*_ros2_actions(known), *_actionlib_actions(known)]))


def _ros2_actions(entities: tuple[Entity, ...]) -> list[ActionInfo]:
    ends: dict[str, dict[Kind, set[str]]] = {}
    types: dict[str, str] = {}
    for one in entities:
        name, found, part = one.name.rpartition(_FOLDER)
        if not found or not one.type_name:
            continue
        if part == "send_goal" and one.kind in (Kind.SERVICE, Kind.CLIENT):
            ends.setdefault(name, {}).setdefault(one.kind, set()).add(one.node)
            types[name] = one.type_name.removesuffix("_SendGoal")
        elif part == "feedback" and one.type_name.endswith("_FeedbackMessage"):
            ends.setdefault(name, {})
            types.setdefault(name, one.type_name.removesuffix("_FeedbackMessage"))
    return [
        _info(name, types[name], 2, kinds.get(Kind.SERVICE, ()), kinds.get(Kind.CLIENT, ()))
        for name, kinds in ends.items()
    ]


def _actionlib_actions(entities: tuple[Entity, ...]) -> list[ActionInfo]:
    with_status = {
        (one.name.removesuffix("/status"), one.node)
        for one in entities
        if one.type_name == _STATUS and one.name.endswith("/status")
    }
    ends: dict[str, dict[Kind, set[str]]] = {}
    types: dict[str, str] = {}
    for one in entities:
        name = one.name.removesuffix("/goal")
        # A plain `rostopic echo` or `pub` of the goal topic is no end of the action.
        if name == one.name or (name, one.node) not in with_status:
            continue
        if one.type_name.endswith("ActionGoal"):
            ends.setdefault(name, {}).setdefault(one.kind, set()).add(one.node)
            package, _, bare = one.type_name.split("/")
            types[name] = f"{package}/action/{bare.removesuffix('ActionGoal')}"
    return [
        _info(name, types[name], 1, kinds.get(Kind.SUBSCRIPTION, ()), kinds.get(Kind.PUBLISHER, ()))
        for name, kinds in ends.items()
    ]


def _info(
    name: str, type_name: str, ros_version: int, servers: Iterable[str], clients: Iterable[str]
) -> ActionInfo:
    return ActionInfo(name, type_name, ros_version, tuple(sorted(servers)), tuple(sorted(clients)))
