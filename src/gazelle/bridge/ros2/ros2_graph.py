"""What there is in ROS, as its half reports it."""

from __future__ import annotations

from typing import Any, NamedTuple

__all__ = ["NOTHING", "RosEndpoint", "RosService", "RosState"]


class RosEndpoint(NamedTuple):
    """A publisher or a subscription of a node in ROS.

    Attributes:
        node: global name.
        topic: global name.
        type_name: ``pkg/msg/Name``.
        reliable: quality of service, as offered or asked for.
        latched: ``TRANSIENT_LOCAL``, as offered or asked for.
        number: of a publisher, as its messages tell it.
    """

    node: str
    topic: str
    type_name: str
    reliable: bool
    latched: bool
    number: int = 0


class RosService(NamedTuple):
    """A service of a node in ROS."""

    node: str
    name: str
    type_name: str


class RosState(NamedTuple):
    """All nodes, topics and services of ROS but the bridge's own."""

    nodes: tuple[str, ...]
    publishers: tuple[RosEndpoint, ...]
    subscriptions: tuple[RosEndpoint, ...]
    services: tuple[RosService, ...]

    @classmethod
    def from_report(cls, report: dict[str, Any]) -> RosState:
        """Read a report."""
        return cls(
            tuple(row[0] for row in report["nodes"]),
            tuple(RosEndpoint(*row) for row in report["publishers"]),
            tuple(RosEndpoint(*row) for row in report["subscriptions"]),
            tuple(RosService(*row) for row in report["services"]),
        )

    def without(self, names: frozenset[str]) -> RosState:
        """Return what there is besides some nodes."""
        return RosState(
            tuple(name for name in self.nodes if name not in names),
            tuple(one for one in self.publishers if one.node not in names),
            tuple(one for one in self.subscriptions if one.node not in names),
            tuple(one for one in self.services if one.node not in names),
        )


NOTHING = RosState((), (), (), ())
