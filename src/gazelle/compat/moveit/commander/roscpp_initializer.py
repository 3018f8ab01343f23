"""The node that moveit_commander works with, and what is made once for all its objects."""

from __future__ import annotations

import itertools
import os
from collections.abc import Sequence
from functools import cache
from typing import Any

from gazelle.compat.moveit.move_group_client import MoveGroupClient
from gazelle.compat.moveit.robot_interface import RobotInterface
from gazelle.compat.rospy.state import STATE
from gazelle.errors import GazelleError
from gazelle.graph import Node
from gazelle.graph.names import CommandLine, parse_command_line
from gazelle.interfaces import convert, ros1_message_type

__all__ = ["client_of", "robot_of", "ros1", "roscpp_initialize", "roscpp_shutdown"]

_numbers = itertools.count()
_own: list[Node] = []
_line: list[CommandLine] = []


def roscpp_initialize(args: Sequence[str] | None = None) -> None:
    """Do what must come before `MoveGroupCommander`: join the graph.

    Args:
        args: a command line, whose ``a:=b`` count for a node of moveit_commander's own.
    """
    _line[:] = [parse_command_line([] if args is None else args)]
    STATE.open_graph()


def roscpp_shutdown() -> None:
    """Leave the graph with the node that moveit_commander made, if it made one."""
    while _own:
        _own.pop().shutdown()
    client_of.cache_clear()
    robot_of.cache_clear()


def node() -> Node:
    """Return rospy's node, or one of moveit_commander's own before ``init_node``."""
    if STATE.node is not None:
        return STATE.node
    if not _own:
        name = f"move_group_commander_wrappers_{os.getpid()}_{next(_numbers)}"
        given = _line[0] if _line else parse_command_line([])
        made = STATE.open_graph().create_node(
            name, namespace=given.namespace, remappings=given.remappings
        )
        _own.append(made)
    return _own[-1]


@cache
def client_of(namespace: str) -> MoveGroupClient:
    """Return the client of the move_group in a namespace."""
    return MoveGroupClient(node(), namespace)


@cache
def robot_of(description: str, namespace: str) -> RobotInterface:
    """Return the robot of a parameter.

    Raises:
        RuntimeError: there is none, as moveit_commander says it.
    """
    try:
        name = f"{namespace.rstrip('/')}/{description}" if namespace else description
        return RobotInterface.of_node(node(), name)
    except GazelleError as error:
        raise RuntimeError(str(error)) from error


def ros1(message: Any) -> Any:
    """Return a message in the form that ROS 1 programs know."""
    return convert(message, ros1_message_type(message.TYPE_NAME))
