"""launch_ros.events.matchers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

__all__ = ["matches_node_name"]


def matches_node_name(node_name: str) -> Callable[[Any], bool]:
    """Return a matcher for actions of the node with a name, absolute or below the root."""
    full = node_name if node_name.startswith("/") else f"/{node_name}"
    return lambda action: getattr(action, "node_name", None) == full
