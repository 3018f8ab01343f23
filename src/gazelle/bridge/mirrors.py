"""All nodes of real ROS that the graph shows."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Generic

from gazelle.bridge.node_mirrors import M, Mirror, S, Traits
from gazelle.graph import Kind, Publisher
from gazelle.graph.names import is_legal, is_legal_base, split

if TYPE_CHECKING:
    from gazelle.graph import Graph, Node

__all__ = ["Mirrors"]


class Mirrors(Generic[M, S]):
    """Makes and ends mirrors; safe to use from many threads."""

    def __init__(
        self,
        graph: Graph,
        node: Node,
        answer: Callable[[str, S, Any], Any],
        on_kill: Callable[[str, str], None],
    ) -> None:
        """Start with none.

        Args:
            graph: where.
            node: the bridge's own, which stands for nodes that cannot have their own name.
            answer: (service, type, request) → response, asked of ROS.
            on_kill: (node, reason), called when somebody on the graph ends a node of ROS.
        """
        self._graph = graph
        self._node = node
        self._answer = answer
        self._on_kill = on_kill
        self._lock = threading.RLock()
        self._mirrors: dict[str, Mirror[M, S]] = {}

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the nodes in ROS, sorted."""
        with self._lock:
            return tuple(sorted(self._mirrors))

    def settle(self, traits: dict[str, Traits[M, S]]) -> None:
        """Show these nodes, with what they offer and want, and no others."""
        with self._lock:
            gone = [self._mirrors.pop(name) for name in set(self._mirrors) - set(traits)]
            for name, mirror in list(self._mirrors.items()):
                if mirror.shares and not self._must_share(name):
                    gone.append(self._mirrors.pop(name))
        for mirror in gone:
            mirror.close()
        for name, one in traits.items():
            self._mirror(name).settle(one)

    def voice(self, name: str, topic: str, kind: M, latched: bool) -> Publisher | None:
        """Return what publishes on a topic for a node of ROS, see `Mirror.voice`."""
        return self._mirror(name).voice(topic, kind, latched)

    def forget_latched(self, topic: str) -> None:
        """Drop what nodes have latched on a topic that nobody takes over the bridge any more."""
        with self._lock:
            mirrors = tuple(self._mirrors.values())
        for mirror in mirrors:
            mirror.forget_latched(topic)

    def close(self) -> None:
        """Show none."""
        self.settle({})

    def _mirror(self, name: str) -> Mirror[M, S]:
        with self._lock:
            known = self._mirrors.get(name)
            if known is not None:
                return known
            shares = self._must_share(name)
            node = self._node if shares else self._make_node(name)
            made: Mirror[M, S] = Mirror(self._graph, name, node, self._answer, shares=shares)
            self._mirrors[name] = made
            return made

    def _must_share(self, name: str) -> bool:
        """Whether the name is illegal here, or ours or another's whom a second one would end."""
        if name == self._node.name or not is_legal(name) or not is_legal_base(split(name)[1]):
            return True
        own = self._graph.zid
        return any(
            one.kind is Kind.NODE and one.node == name and one.zid != own
            for one in self._graph.entities()
        )

    def _make_node(self, name: str) -> Node:
        namespace, base = split(name)
        node = self._graph.create_node(base, namespace=namespace, rosout=False)
        node.on_shutdown(lambda reason: self._on_shutdown(name, node, reason))
        return node

    def _on_shutdown(self, name: str, node: Node, reason: str) -> None:
        with self._lock:
            mirror = self._mirrors.get(name)
        # One that we let go is no longer among them.
        if mirror is not None and mirror.speaks_through(node):
            self._on_kill(name, reason)
