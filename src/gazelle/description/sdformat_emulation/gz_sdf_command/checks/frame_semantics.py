"""Sdformat's graphs of frames: vertices with names, directed edges, names seen from a scope."""

from __future__ import annotations

import enum
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from gazelle.geometry import Pose

__all__ = ["Edge", "Graph", "Kind", "Scope"]


class Kind(enum.Enum):
    """What a vertex stands for."""

    WORLD = enum.auto()
    MODEL = enum.auto()
    STATIC_MODEL = enum.auto()
    LINK = enum.auto()
    JOINT = enum.auto()
    FRAME = enum.auto()


class Edge(NamedTuple):
    """From vertex `tail` to vertex `head`; a weight of 0 marks two names of one frame."""

    tail: int
    head: int
    pose: Pose
    weight: int = 1


@dataclass(slots=True)
class Graph:
    """Vertices by number and edges in the order they were made.

    Attributes:
        names: full name of each vertex.
        kinds: what each one stands for.
        numbers: vertex of a full name; of two with one name the later.
        edges: in order.
    """

    names: list[str] = field(default_factory=list)
    kinds: list[Kind] = field(default_factory=list)
    numbers: dict[str, int] = field(default_factory=dict)
    edges: list[Edge] = field(default_factory=list)
    _into: dict[int, list[Edge]] = field(default_factory=dict)
    _out_of: dict[int, list[Edge]] = field(default_factory=dict)

    def add_edge(self, tail: int | None, head: int | None, pose: Pose, weight: int = 1) -> None:
        """Add an edge; nothing happens when an end is missing."""
        if tail is not None and head is not None:
            edge = Edge(tail, head, pose, weight)
            self.edges.append(edge)
            self._into.setdefault(head, []).append(edge)
            self._out_of.setdefault(tail, []).append(edge)

    def into(self, vertex: int) -> list[Edge]:
        """Return the edges that end at a vertex."""
        return self._into.get(vertex, [])

    def out_of(self, vertex: int) -> list[Edge]:
        """Return the edges that begin at a vertex."""
        return self._out_of.get(vertex, [])

    def to_dot(self) -> str:
        """Return the graph in Graphviz' language as Ignition Math prints it."""
        lines = [f'  {n} [label="{name} ({n})"];' for n, name in enumerate(self.names)]
        lines += [f"  {edge.tail} -> {edge.head} [label={edge.weight}];" for edge in self.edges]
        return "\n".join(["digraph {", *lines, "}"]) + "\n"


@dataclass(frozen=True, slots=True)
class Scope:
    """A view of a graph from inside a model or the world.

    Attributes:
        graph: the whole.
        prefix: what stands before the names of this scope.
        vertex: that of the scope itself; None before there is one.
        context: ``__model__`` or ``world``; empty before there is a vertex.
    """

    graph: Graph
    prefix: str = ""
    vertex: int | None = None
    context: str = ""

    def opened(self, prefix: str, name: str, context: str, kind: Kind) -> Scope:
        """Return a scope inside this one, with a new vertex for itself."""
        inner = Scope(self.graph, self._full(prefix) if prefix else self.prefix)
        return Scope(self.graph, inner.prefix, inner.add(name, kind), context)

    def child(self, model: str) -> Scope:
        """Return the scope of a model that is in the graph already."""
        inner = Scope(self.graph, self._full(model))
        return Scope(self.graph, inner.prefix, inner.number("__model__"), "__model__")

    def add(self, name: str, kind: Kind) -> int:
        """Add a vertex and return its number."""
        full = self._full(name)
        self.graph.names.append(full)
        self.graph.kinds.append(kind)
        self.graph.numbers[full] = len(self.graph.names) - 1
        return self.graph.numbers[full]

    def number(self, name: str) -> int | None:
        """Return the vertex of a name of this scope."""
        return self.graph.numbers.get(self._full(name))

    def has(self, name: str) -> bool:
        """Tell whether a name of this scope is in the graph."""
        return self.number(name) is not None

    def local(self, vertex: int) -> str:
        """Return a vertex's name as this scope says it; the full name outside of it."""
        return self._local(self.graph.names[vertex]) or self.graph.names[vertex]

    def names(self) -> Iterator[str]:
        """Yield all names of this scope in alphabetic order."""
        for full in sorted(self.graph.numbers):
            name = self._local(full)
            if name is not None:
                yield name

    def _full(self, name: str) -> str:
        return f"{self.prefix}::{name}" if self.prefix else name

    def _local(self, full: str) -> str | None:
        if not self.prefix:
            return full
        is_inside = full.startswith(self.prefix) and len(full) > len(self.prefix) + 2
        return full[len(self.prefix) + 2 :] if is_inside else None
