"""What the bridge and whatever serves the viewers expect of each other."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from enum import Enum
from typing import Any, NamedTuple, Protocol

__all__ = ["Allow", "Channel", "Connections", "Requests", "ServiceOffer", "ServiceSide", "Viewers"]


class Allow(Enum):
    """What viewers may do beside looking."""

    PUBLISH = "publish"
    SERVICES = "services"
    PARAMETERS = "parameters"


class Connections(NamedTuple):
    """Who publishes, subscribes and answers what: names of nodes by topic or service."""

    publishers: Mapping[str, tuple[str, ...]]
    subscribers: Mapping[str, tuple[str, ...]]
    servers: Mapping[str, tuple[str, ...]]


class ServiceSide(NamedTuple):
    """A request or a response: its type's name and ``ros2msg`` schema."""

    type_name: str
    schema: str


class ServiceOffer(NamedTuple):
    """A service that viewers may call.

    Attributes:
        name: global name.
        type_name: ``pkg/srv/Name``.
        request: what they send.
        response: what they get.
        answer: takes CDR bytes, returns CDR bytes; what it raises reaches the viewer as text.
    """

    name: str
    type_name: str
    request: ServiceSide
    response: ServiceSide
    answer: Callable[[bytes], bytes]


class Channel(Protocol):
    """A topic of one type, as viewers see it."""

    @property
    def number(self) -> int:
        """Its number among all channels."""
        ...

    def send(self, data: bytes, stamp_ns: int) -> None:
        """Send CDR bytes to all who subscribe; never waits for them."""
        ...

    def close(self) -> None:
        """Take the channel off the list."""
        ...


class Requests(Protocol):
    """What viewers ask for; called from threads of the server. Nothing here raises."""

    def subscribe(self, viewer: int, channel: int) -> None:
        """A viewer wants a channel."""

    def unsubscribe(self, viewer: int, channel: int) -> None:
        """A viewer wants a channel no more, or has gone."""

    def advertise(
        self, viewer: int, number: int, topic: str, type_name: str, encoding: str
    ) -> None:
        """A viewer will publish a topic; `encoding` says how its messages are encoded."""

    def unadvertise(self, viewer: int, number: int) -> None:
        """A viewer publishes a topic no more, or has gone."""

    def publish(self, viewer: int, number: int, data: bytes) -> None:
        """A viewer sends a message."""

    def get_parameters(self, names: Iterable[str]) -> dict[str, Any]:
        """Return parameters by name, all without names; those that are not set are left out."""
        ...

    def set_parameters(self, values: Mapping[str, Any]) -> dict[str, Any]:
        """Set parameters, delete those that are None; return what they are afterwards."""
        ...

    def read_asset(self, uri: str) -> bytes | None:
        """Return a file of a package or model, None when there is none."""
        ...


class Viewers(Protocol):
    """All viewers together. Nothing here waits for any of them."""

    @property
    def port(self) -> int:
        """Where they connect."""
        ...

    def add_channel(self, topic: str, type_name: str, schema: str) -> Channel:
        """Offer a topic whose type has this ``ros2msg`` schema."""
        ...

    def add_services(self, offers: Iterable[ServiceOffer]) -> None:
        """Offer services."""
        ...

    def remove_services(self, names: Iterable[str]) -> None:
        """Offer services no more."""
        ...

    def show_time(self, now_ns: int) -> None:
        """Tell the time."""
        ...

    def show_parameters(self, values: Mapping[str, Any]) -> None:
        """Tell values to those who follow them; None for what is not set any more."""
        ...

    def show_connections(self, connections: Connections) -> None:
        """Tell who is connected to whom."""
        ...

    def close(self) -> None:
        """End all connections."""
        ...
