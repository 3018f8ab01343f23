"""A node without a graph that remembers what was asked of it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from gazelle.graph.names import remap, resolve
from gazelle.simulator.local_node import (
    LocalNode,
    LocalPublisher,
    LocalService,
    LocalSubscription,
)

__all__ = ["DryNode"]


class DryNode(LocalNode):
    """A `LocalNode` with a name and remappings, as a launched simulator has them.

    Attributes:
        name: without namespace.
        namespace: absolute.
        offered: types of the topics published, by global name.
        heard: types of the topics listened to, by global name; empty for any type.
        remapped: names before remapping that a remapping was of use for.
        asked: all names before remapping.
        said: levels and texts of the log.
    """

    def __init__(
        self,
        name: str = "gazebo",
        namespace: str = "/",
        remappings: Mapping[str, str] | None = None,
    ) -> None:
        super().__init__()
        self.name = name
        self.namespace = namespace.rstrip("/") or "/"
        self.full_name = resolve(name, self.namespace)
        self._rules = remap(remappings or {}, self.namespace, node=self.full_name)
        self.offered: dict[str, str] = {}
        self.heard: dict[str, str] = {}
        self.remapped: set[str] = set()
        self.asked: set[str] = set()
        self.said: list[tuple[str, str]] = []

    def resolve_name(self, name: str) -> str:
        """Return the global name after remapping."""
        plain = resolve(name, self.namespace, node=self.full_name)
        self.asked.add(plain)
        if plain in self._rules:
            self.remapped.add(plain)
        return self._rules.get(plain, plain)

    def create_publisher(self, topic: str, message_type: Any, **options: Any) -> LocalPublisher:
        """Offer a topic under its remapped name."""
        name = self.resolve_name(topic)
        self.offered[name] = str(getattr(message_type, "TYPE_NAME", ""))
        return super().create_publisher(name, message_type, **options)

    def create_subscription(
        self, topic: str, message_type: Any, callback: Callable[[Any], None], **options: Any
    ) -> LocalSubscription:
        """Receive a topic under its remapped name."""
        name = self.resolve_name(topic)
        announced = str(options.get("announced") or getattr(message_type, "TYPE_NAME", ""))
        self.heard.setdefault(name, announced)
        return super().create_subscription(name, message_type, callback, **options)

    def create_service(
        self, name: str, service_type: Any, handler: Callable[..., Any], **options: Any
    ) -> LocalService:
        """Offer a service under its remapped name."""
        return super().create_service(self.resolve_name(name), service_type, handler, **options)

    def log(self, level: Any, text: str) -> None:
        """Remember what is said."""
        self.said.append((str(level).lower(), text))
