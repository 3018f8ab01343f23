"""A simulation on a graph of its own with a Studio beside it, for those who look at it."""

from __future__ import annotations

import time
from contextlib import ExitStack
from typing import TYPE_CHECKING
from weakref import WeakSet

from gazelle.graph.isolated_graph import open_graph
from gazelle.simulator.gazebo_ros.api import offer_gazebo_ros
from gazelle.simulator.gui import offer_views
from gazelle.simulator.intra_process_node import LocalNode
from gazelle.studio import Server, Studio

if TYPE_CHECKING:
    from gazelle.graph import Graph
    from gazelle.simulator import Simulation
    from gazelle.simulator.world_server import WorldServer
    from gazelle.studio.server import Frame

__all__ = ["LiveWorld"]

_offering: WeakSet[WorldServer] = WeakSet()
"""Worlds that have topics and services for viewers; they keep them when a view ends."""

_SLICE_S = 0.02
_MAX_BEHIND_S = 0.2


class LiveWorld:
    """What a simulation needs to be looked at: a graph, a Studio, a server on 127.0.0.1.

    Attributes:
        server: of the page.
    """

    def __init__(self, sim: Simulation) -> None:
        """Open everything; the simulation itself changes in nothing.

        Args:
            sim: to look at; one that was loaded with a graph's node stays on that graph.

        Raises:
            GazelleError: there is no free port, or the user's secret cannot be read.
        """
        self._sim = sim
        self._views = 0
        self._is_closed = False
        self._ending = ExitStack()
        with ExitStack() as undo:
            undo.push(self._ending)
            self.server = self._ending.enter_context(Server(Studio(self._joined()), port=0))
            undo.pop_all()

    @property
    def watchers(self) -> int:
        """How many pages look."""
        return 0 if self._is_closed else len(self.server.studio.pages)

    @property
    def is_closed(self) -> bool:
        """Whether the last view has ended; the next one needs another of these."""
        return self._is_closed

    def open_frame(self, origin: str | None) -> Frame:
        """Begin a view; see `Server.open_frame`."""
        self._views += 1
        return self.server.open_frame(origin)

    def close_frame(self, frame: Frame) -> None:
        """End a view, and with the last one everything."""
        self.server.close_frame(frame)
        self._views -= 1
        if not self._views:
            self.close()

    def close(self) -> None:
        """Close the pages' connections, the server and the graph; twice does nothing."""
        self._is_closed = True
        self._ending.close()

    def run(self, steps: int, real_time_factor: float | None) -> None:
        """Take steps, while somebody looks not faster than so many times real time.

        Raises:
            SimulationDivergedError: the state became non-finite.
        """
        step_s, left = self._sim.step_s, steps
        begin_s, done_s = time.monotonic(), 0.0
        while left > 0:
            if not real_time_factor or not self.watchers:
                self._sim.step(left)
                return
            count = min(left, self._slice(round(_SLICE_S * real_time_factor / step_s)))
            self._sim.step(count)
            left -= count
            done_s += count * step_s / real_time_factor
            ahead_s = begin_s + done_s - time.monotonic()
            if ahead_s > 0:
                time.sleep(ahead_s)
            elif ahead_s < -_MAX_BEHIND_S:
                # What could not be done in time is not made up for by haste.
                begin_s -= ahead_s

    def _slice(self, wanted: int) -> int:
        """Return about so many steps, up to where the world cuts its steps anyway."""
        server = self._sim.server
        until_due = server.scheduler.next_due() - server.engine.iteration
        return max(1, until_due if until_due <= 2 * wanted else wanted)

    def _joined(self) -> Graph:
        """Return the graph that the simulation is on, one of its own where it is on none."""
        server = self._sim.server
        node = server.node
        is_first = server not in _offering
        _offering.add(server)
        if not isinstance(node, LocalNode):
            if is_first:
                offer_views(server)
            return node.graph  # type: ignore[attr-defined, no-any-return]
        graph = self._ending.enter_context(open_graph())
        gazebo = graph.create_node("gazebo", rosout=False)
        self._ending.callback(gazebo.shutdown, "the view was closed")
        if is_first:
            offer_gazebo_ros(server)
            offer_views(server)
            # No step is to be cut for what nobody asks for: motors tell that in the last digits.
            server.scheduler.rest()
        node.join(gazebo)
        self._ending.callback(node.leave)
        return graph
