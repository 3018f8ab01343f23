"""One life of ROS's half, and what both sides have of each other in it."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.bridge.ros2.from_ros import FromRos
from gazelle.bridge.ros2.mirror_plan import graph_entities_of
from gazelle.bridge.ros2.rclpy_process import About, Outcome, RclpyLink, RclpyProcess
from gazelle.bridge.ros2.ros2_graph import NOTHING, RosState
from gazelle.bridge.ros2.to_ros import ToRos
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
        process: RclpyProcess,
        notice: Callable[[str], None],
        on_change: Callable[[], None],
        ghosts: frozenset[str] = frozenset(),
    ) -> None:
        """Begin with nothing on either side.

        Args:
            graph: the graph.
            node: the bridge's own.
            process: ROS's half.
            notice: told of what goes wrong.
            on_change: called when it is time to settle.
            ghosts: names in ROS that an earlier half had. If it was killed, ROS believes for a
                while that they are still there.
        """
        self.about: About = process.about
        self.is_over = False
        self._graph = graph
        self._process = process
        self._notice = notice
        self._on_change = on_change
        self._ghosts = ghosts
        self._ghosts_until_s = time.monotonic() + _GHOSTS_S
        self._state = NOTHING
        self._book = TypeBook(notice, process.about.prefixes, process.about.distro)
        self._link = RclpyLink(process.pipes, self)
        self._to_ros = ToRos(graph, node, self._link, self._book, notice)
        self._from_ros = FromRos(graph, node, self._link, self._book, notice)
        self._link.start()

    @property
    def exit_text(self) -> str:
        """How ROS's half ended."""
        return self._process.exit_text

    @property
    def nodes(self) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """Names of the graph's nodes in ROS, and of ROS's nodes on the graph."""
        return self._to_ros.names, self._from_ros.names

    def settle(self) -> None:
        """Show each side what the other has now."""
        state = self._state
        if time.monotonic() < self._ghosts_until_s:
            state = state.without(self._ghosts)
        entities = [one for one in self._graph.discovery.known() if one.zid != self._graph.zid]
        graph_entities = graph_entities_of(entities, state)
        self._to_ros.settle(graph_entities, state)
        self._from_ros.settle(graph_entities, state)

    def close(self) -> None:
        """End ROS's half and take everything off both sides."""
        self._to_ros.close()
        self._link.fail_calls(None, "the bridge to ROS 2 has ended")
        self._process.close()
        self._from_ros.close()

    def on_state(self, state: dict[str, Any]) -> None:
        """See `LinkListener`."""
        self._state = RosState.from_report(state)
        self._on_change()

    def on_done(self, channel: int, outcome: Outcome) -> None:
        """See `LinkListener`."""
        error = outcome.error
        owner = self._to_ros.owner_of(channel) or self._from_ros.owner_of(channel)
        if not error:
            if owner is None or self._book.agrees(owner[1], owner[0], outcome.type_hash):
                self._to_ros.channel_is_ready(channel)
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
        """See `LinkListener`."""
        self._from_ros.take_message(channel, number, cdr)

    def on_request(self, channel: int, number: int, cdr: bytes) -> None:
        """See `LinkListener`."""
        self._to_ros.take_request(channel, number, cdr)

    def on_end(self) -> None:
        """See `LinkListener`."""
        self.is_over = True
        self._on_change()
