"""A simulation on a graph of its own with a Studio beside it, for those who look at it."""

from __future__ import annotations

import time
from contextlib import ExitStack
from typing import TYPE_CHECKING

from gazelle.graph.isolated_graph import open_graph
from gazelle.simulator.gazebo_ros.api import offer_gazebo_ros
from gazelle.simulator.gui import offer_views
from gazelle.simulator.intra_process_node import LocalNode
from gazelle.studio import Server, Studio

if TYPE_CHECKING:
    from gazelle.graph import Graph
    from gazelle.simulator import Simulation

__all__ = ["LiveWorld"]

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
        self._ending = ExitStack()
        with ExitStack() as undo:
            undo.push(self._ending)
            self.server = self._ending.enter_context(Server(Studio(self._joined()), port=0))
            undo.pop_all()

    @property
    def watchers(self) -> int:
        """How many pages look."""
        return len(self.server.studio.pages)

    def close(self) -> None:
        """Close the pages' connections, the server and the graph."""
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
            count = min(left, max(1, round(_SLICE_S * real_time_factor / step_s)))
            self._sim.step(count)
            left -= count
            done_s += count * step_s / real_time_factor
            ahead_s = begin_s + done_s - time.monotonic()
            if ahead_s > 0:
                time.sleep(ahead_s)
            elif ahead_s < -_MAX_BEHIND_S:
                # What could not be done in time is not made up for by haste.
                begin_s -= ahead_s

    def _joined(self) -> Graph:
        """Return the graph that the simulation is on, one of its own where it is on none."""
        server = self._sim.server
        node = server.node
        if not isinstance(node, LocalNode):
            offer_views(server)
            return node.graph  # type: ignore[attr-defined, no-any-return]
        graph = self._ending.enter_context(open_graph())
        gazebo = graph.create_node("gazebo", rosout=False)
        self._ending.callback(gazebo.shutdown, "the view was closed")
        if not node.has_views:
            offer_gazebo_ros(server)
            offer_views(server)
            node.has_views = True
        node.join(gazebo)
        self._ending.callback(node.leave)
        return graph
