"""Actions of ROS 2 (rclpy.action)."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gazelle.compat.rclpy.action.client import ActionClient, ClientGoalHandle
from gazelle.compat.rclpy.action.server import (
    ActionServer,
    CancelResponse,
    GoalResponse,
    ServerGoalHandle,
)
from gazelle.graph.actions import actions_of
from gazelle.graph.names import join

if TYPE_CHECKING:
    from gazelle.compat.rclpy.node import Node

__all__ = [
    "ActionClient",
    "ActionServer",
    "CancelResponse",
    "ClientGoalHandle",
    "GoalResponse",
    "ServerGoalHandle",
    "get_action_client_names_and_types_by_node",
    "get_action_names_and_types",
    "get_action_server_names_and_types_by_node",
]

NamesAndTypes = list[tuple[str, list[str]]]


def get_action_names_and_types(node: Node) -> NamesAndTypes:
    """Return all actions of ROS 2."""
    return node.get_action_names_and_types()


def get_action_server_names_and_types_by_node(
    node: Node, remote_node_name: str, remote_node_namespace: str
) -> NamesAndTypes:
    """Return the actions that a node serves."""
    full = join(remote_node_namespace or "/", remote_node_name)
    found = actions_of(node.graph_node.graph.entities())
    return [(one.name, [one.type_name]) for one in found if full in one.servers]


def get_action_client_names_and_types_by_node(
    node: Node, remote_node_name: str, remote_node_namespace: str
) -> NamesAndTypes:
    """Return the actions that a node sends goals to."""
    full = join(remote_node_namespace or "/", remote_node_name)
    found = actions_of(node.graph_node.graph.entities())
    return [(one.name, [one.type_name]) for one in found if full in one.clients]
