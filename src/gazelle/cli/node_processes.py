"""Where nodes live: the addresses that the ROS commands show."""

from __future__ import annotations

from collections.abc import Iterable

from gazelle.graph import Entity, Graph, Kind
from gazelle.graph.process_queries import ask_process

__all__ = ["Processes"]


class Processes:
    """The processes of a graph; each is asked once."""

    def __init__(self, graph: Graph, entities: Iterable[Entity] | None = None) -> None:
        """Look at the graph as it is now."""
        self._graph = graph
        known = graph.entities() if entities is None else entities
        self.zid_of = {one.node: one.zid for one in known if one.kind is Kind.NODE}
        self._answers: dict[str, tuple[int, str]] = {}

    def ask(self, node: str) -> tuple[int, str]:
        """Return process number and machine of a node, (0, "") when its process is silent."""
        zid = self.zid_of.get(node, "")
        if not zid:
            return 0, ""
        if zid not in self._answers:
            self._answers[zid] = ask_process(self._graph.session, self._graph.domain, zid)
        return self._answers[zid]

    def uri(self, node: str) -> str:
        """Return an address, empty when the node's process does not answer.

        It stands where ROS 1 has the address of the node's XML-RPC server: machine, the graph's
        port, process number.
        """
        pid, host = self.ask(node)
        return f"gazelle://{host}:{self._graph.port}/{pid}" if pid else ""
