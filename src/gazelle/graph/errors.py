"""What can go wrong on the graph, by kind."""

from __future__ import annotations

from gazelle.diagnostics.catalogue import entry_for
from gazelle.errors import GraphError

__all__ = [
    "IllegalNameError",
    "NoGraphError",
    "PortTakenError",
    "ServiceCallError",
    "ServiceRefusedError",
    "ServiceTimeoutError",
    "ServiceUnavailableError",
    "TimeJumpError",
    "coded",
]


class IllegalNameError(GraphError, ValueError):
    """A name breaks the rules of ROS graph names."""


class NoGraphError(GraphError):
    """A client found no graph to join (ROS 1: "Unable to communicate with master!")."""


class PortTakenError(GraphError):
    """The hub's port belongs to a program that is not part of a Gazelle graph."""


class ServiceUnavailableError(GraphError):
    """Nobody offers the service."""


class ServiceTimeoutError(GraphError):
    """The service did not answer in time."""


class ServiceCallError(GraphError):
    """The service's handler failed; the text is what it said."""


class ServiceRefusedError(GraphError):
    """Raised by a handler: its text reaches the caller as it is and is not logged."""


class TimeJumpError(GraphError):
    """Simulated time went backwards while somebody slept.

    Attributes:
        delta_ns: the jump in nanoseconds, negative.
    """

    def __init__(self, delta_ns: int) -> None:
        self.delta_ns = delta_ns
        super().__init__(f"time moved backwards by {-delta_ns / 1e9:.9f} s")


def coded(code: str, message: str, *, fix: str = "") -> str:
    """Return a message with its code, the remedy and ROS's own words from the catalogue.

    Args:
        code: a code of the catalogue.
        message: what is wrong here.
        fix: what to do here, the catalogue's general remedy when empty.
    """
    entry = entry_for(code)
    text = f"{message} [{code}]\n  fix: {fix or entry.fix}"
    return f"{text}\n  ROS says: {entry.phrase}" if entry.phrase else text
