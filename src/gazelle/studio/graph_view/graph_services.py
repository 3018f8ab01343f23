"""What methods and streams of the graph work on."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import dataclass

from gazelle.graph import Node
from gazelle.studio.frames import Frames
from gazelle.studio.graph_view.publishers import Publishers
from gazelle.studio.graph_view.publishing import Outbox
from gazelle.studio.graph_view.reconfigure import DynamicClients
from gazelle.studio.graph_view.rosout import Console
from gazelle.studio.graph_view.topology import Topology
from gazelle.studio.lazy import Once, closed_with
from gazelle.studio.pages import Pages
from gazelle.studio.subscriptions import Taps

__all__ = ["GraphParts", "graph_parts"]


@dataclass(frozen=True)
class GraphParts:
    """A graph as pages look at it.

    Attributes:
        node: who looks and calls.
        taps: topics that are listened to.
        frames: where frames are.
        outbox: publishers of single messages.
        clients: those of dynamic_reconfigure.
        topology: who speaks with whom; followed from the first look on.
        console: what nodes say; kept from the first look on.
        publishers: those that go on by themselves.
    """

    node: Node
    taps: Taps
    frames: Frames
    outbox: Outbox
    clients: DynamicClients
    topology: Once[Topology]
    console: Once[Console]
    publishers: Once[Publishers]


def graph_parts(taps: Taps, frames: Frames, pages: Pages, ending: ExitStack) -> GraphParts:
    """Return the parts that end with others."""
    node = taps.node
    return GraphParts(
        node,
        taps,
        frames,
        Outbox(node),
        DynamicClients(node),
        topology=Once(lambda: closed_with(ending, Topology(node.graph))),
        console=Once(lambda: closed_with(ending, Console(taps))),
        publishers=Once(lambda: closed_with(ending, Publishers(node, pages))),
    )
