"""What can go wrong on the graph, by kind."""

from __future__ import annotations

from gazelle.errors import GraphError

__all__ = [
    "IllegalNameError",
    "NoGraphError",
    "PortTakenError",
    "ServiceCallError",
    "ServiceTimeoutError",
    "ServiceUnavailableError",
    "TimeJumpError",
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


class TimeJumpError(GraphError):
    """Simulated time went backwards while somebody slept.

    Attributes:
        delta_ns: the jump in nanoseconds, negative.
    """

    def __init__(self, delta_ns: int) -> None:
        self.delta_ns = delta_ns
        super().__init__(f"time moved backwards by {-delta_ns / 1e9:.9f} s")
