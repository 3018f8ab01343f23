"""What the simulator needs of a node; `gazelle.graph.Node` and `LocalNode` both have it."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from gazelle.graph import Qos

__all__ = ["NodePort", "ParameterPort", "PublisherPort", "ServicePort", "SubscriptionPort"]


class PublisherPort(Protocol):
    """Sends messages of one type on one topic."""

    @property
    def matched(self) -> bool:
        """True when somebody subscribes; cheap enough to ask at every tick."""
        ...

    def publish(self, message: Any) -> None:
        """Send one message."""
        ...

    def unregister(self) -> None:
        """Stop offering the topic."""
        ...


class SubscriptionPort(Protocol):
    """Receives messages of one topic."""

    def unregister(self) -> None:
        """Stop receiving."""
        ...


class ServicePort(Protocol):
    """Answers requests."""

    def unregister(self) -> None:
        """Stop answering."""
        ...


class ParameterPort(Protocol):
    """The ROS 1 parameter store."""

    def get(self, name: str, default: Any = ...) -> Any:
        """Return a parameter, or `default`."""
        ...

    def set(self, name: str, value: Any) -> None:
        """Set a parameter."""
        ...

    def has(self, name: str) -> bool:
        """Tell whether a parameter is there."""
        ...


class NodePort(Protocol):
    """A node of the graph, or the local stand-in for one."""

    @property
    def parameters(self) -> ParameterPort:
        """The parameter store."""
        ...

    def create_publisher(
        self,
        topic: str,
        message_type: Any,
        *,
        latch: bool = ...,
        reliable: bool = ...,
        queue_size: int = ...,
        qos: Qos | None = ...,
    ) -> PublisherPort:
        """Offer a topic."""
        ...

    def create_subscription(
        self,
        topic: str,
        message_type: Any,
        callback: Callable[[Any], None],
        *,
        queue_size: int = ...,
        inline: bool = ...,
        announced: str = ...,
    ) -> SubscriptionPort:
        """Receive a topic."""
        ...

    def create_service(
        self,
        name: str,
        service_type: Any,
        handler: Callable[..., Any],
        *,
        with_caller: bool = ...,
    ) -> ServicePort:
        """Offer a service."""
        ...

    def publisher_names(self, topic: str) -> tuple[str, ...]:
        """Return the nodes that publish a topic."""
        ...

    def announced_together(self) -> AbstractContextManager[None]:
        """Announce what is made in a ``with`` block at its end, all at once."""
        ...

    def resolve_name(self, name: str) -> str:
        """Return the name after remappings, absolute."""
        ...

    def log(self, level: Any, text: str) -> None:
        """Say something on the console and on ``/rosout``."""
        ...
