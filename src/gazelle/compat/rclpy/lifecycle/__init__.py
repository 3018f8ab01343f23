"""Lifecycle nodes (rclpy.lifecycle)."""

from __future__ import annotations

from gazelle.compat.rclpy.lifecycle.entities import (
    LifecyclePublisher,
    ManagedEntity,
    SimpleManagedEntity,
)
from gazelle.compat.rclpy.lifecycle.node import LifecycleNode, LifecycleNodeMixin
from gazelle.compat.rclpy.lifecycle.states import LifecycleState, TransitionCallbackReturn

__all__ = [
    "LifecycleNode",
    "LifecycleNodeMixin",
    "LifecyclePublisher",
    "LifecycleState",
    "ManagedEntity",
    "Node",
    "NodeMixin",
    "Publisher",
    "SimpleManagedEntity",
    "State",
    "TransitionCallbackReturn",
]

Node = LifecycleNode
NodeMixin = LifecycleNodeMixin
Publisher = LifecyclePublisher
State = LifecycleState
