"""One life of ROS's half, and what both sides have of each other in it."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.bridge.ros2.from_ros import Inward
from gazelle.bridge.ros2.graph_state import wishes_of
from gazelle.bridge.ros2.rclpy_process import About, Link, Outcome, Side
from gazelle.bridge.ros2.ros_graph import NOTHING, RosState
from gazelle.bridge.ros2.to_ros import Outward
from gazelle.bridge.ros2.types import TypeBook

if TYPE_CHECKING:
    from gazelle.graph import Graph, Node

__all__ = ["Session"]

_GHOSTS_S = 30.0


class Session:
    """Hears what ROS's half says; `settle` brings both sides up to date.

    Attributes:
        about: ROS's half.
        is_over: it has ended by itself.
    """

    def __init__(
        self,
        graph: Graph,
        node: Node,
        side: Side,
        notice: Callable[[str], None],
        on_change: Callable[[], None],
        ghosts: frozenset[str] = frozenset(),
    ) -> None:
        """Begin with nothing on either side.

        Args:
            graph: the graph.
            node: the bridge's own.
            side: ROS's half.
            notice: told of what goes wrong.
            on_change: called when it is time to settle.
            ghosts: names in ROS that an earlier half had. If it was killed, ROS believes for a
                while that they are still there.
        """
        self.about: About = side.about
        self.is_over = False
        self._graph = graph
        self._side = side
        self._notice = notice
        self._on_change = on_change
        self._ghosts = ghosts
        self._ghosts_until_s = time.monotonic() + _GHOSTS_S
        self._state = NOTHING
        self._book = TypeBook(notice, side.about.prefixes, side.about.distro)
        self._link = Link(side.pipes, self)
        self._outward = Outward(graph, node, self._link, self._book, notice)
        self._inward = Inward(graph, node, self._link, self._book, notice)
        self._link.start()

    @property
    def exit_text(self) -> str:
        """How ROS's half ended."""
        return self._side.exit_text

    @property
    def nodes(self) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """Names of the graph's nodes in ROS, and of ROS's nodes on the graph."""
        return self._outward.names, self._inward.names

    def settle(self) -> None:
        """Show each side what the other has now."""
        state = self._state
        if time.monotonic() < self._ghosts_until_s:
            state = state.without(self._ghosts)
        entities = [one for one in self._graph.discovery.known() if one.zid != self._graph.zid]
        wishes = wishes_of(entities, state)
        self._outward.settle(wishes, state)
        self._inward.settle(wishes, state)

    def close(self) -> None:
        """End ROS's half and take everything off both sides."""
        self._outward.close()
        self._link.fail_calls(None, "the bridge to ROS 2 has ended")
        self._side.close()
        self._inward.close()

    def on_state(self, state: dict[str, Any]) -> None:
        """See `Hearer`."""
        self._state = RosState.from_report(state)
        self._on_change()

    def on_done(self, channel: int, outcome: Outcome) -> None:
        """See `Hearer`."""
        error = outcome.error
        owner = self._outward.owner_of(channel) or self._inward.owner_of(channel)
        if not error:
            if owner is None or self._book.agrees(owner[1], owner[0], outcome.type_hash):
                self._outward.channel_is_ready(channel)
            self._on_change()
        elif owner is None and not outcome.missing:
            self._notice(f"ROS 2 does not take a name of the graph: {error}")
        elif owner is None:
            # Given up already: the same type was missing elsewhere, and told.
            return
        elif outcome.missing:
            self._book.miss(owner[1], owner[0], error)
            self._on_change()
        else:
            self._notice(f"{owner[0]} does not cross the bridge to ROS 2: {error}")

    def on_message(self, channel: int, number: int, cdr: bytes) -> None:
        """See `Hearer`."""
        self._inward.take_message(channel, number, cdr)

    def on_request(self, channel: int, number: int, cdr: bytes) -> None:
        """See `Hearer`."""
        self._outward.take_request(channel, number, cdr)

    def on_end(self) -> None:
        """See `Hearer`."""
        self.is_over = True
        self._on_change()
