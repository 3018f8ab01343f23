"""What an action server needs of a node; a graph's `Node` and a `LocalNode` both have it."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import Any, Protocol

__all__ = ["ActionNode"]


class ActionNode(Protocol):
    """A node of the graph, or the stand-in for one without a graph.

    A node with an attribute `clock` (see `gazelle.graph.Clock`) gives the server its time.
    """

    def announced_together(self) -> AbstractContextManager[None]:
        """Announce what is made in a ``with`` block at its end."""
        ...

    def create_publisher(self, topic: str, message_type: Any, *, latch: bool = ...) -> Any:
        """Offer a topic."""
        ...

    def create_subscription(
        self, topic: str, message_type: Any, callback: Callable[[Any], None], *, inline: bool = ...
    ) -> Any:
        """Receive a topic."""
        ...

    def create_service(self, name: str, service_type: Any, handler: Callable[[Any], Any]) -> Any:
        """Answer a service."""
        ...

    def resolve_name(self, name: str) -> str:
        """Return the name after remappings, absolute."""
        ...

    def log(self, level: Any, text: str) -> None:
        """Say something."""
        ...
