"""The pages that look through a Studio: who is there, what they are told first, what they show."""

from __future__ import annotations

import threading
from typing import Any, Literal, Protocol, TypedDict

from gazelle._version import __version__
from gazelle.diagnostics.documentation import pages_address
from gazelle.graph import Node
from gazelle.studio.json_text import json_text

__all__ = ["GraphPlace", "Hello", "Page", "Pages", "Show"]

_ROSOUT = "/rosout"


class GraphPlace(TypedDict):
    """The graph that is looked at."""

    port: int
    domain: int


class Hello(TypedDict):
    """The server's first words.

    Attributes:
        node: the server's own on the graph.
        panels: those that commands asked for.
        docs: where the pages of this release are; empty where that is not known.
        is_idle: whether nothing runs on the graph.
    """

    op: Literal["hello"]
    version: str
    session: str
    node: str
    graph: GraphPlace
    panels: list[str]
    docs: str
    is_idle: bool


class Show(TypedDict):
    """A command asks for a panel."""

    op: Literal["show"]
    panel: str
    params: dict[str, Any]


class Page(Protocol):
    """An open page."""

    def post(self, data: str | bytes) -> None:
        """Send a frame; from any thread."""


class Pages:
    """The open pages; their number is `len`."""

    def __init__(self, node: Node) -> None:
        """Wait for pages that look through a node."""
        self._node = node
        self._lock = threading.Lock()
        self._open: set[Page] = set()
        self._panels: list[tuple[str, dict[str, Any]]] = []
        # A simulator says the time at every step, and without a page nobody wants to know.
        node.clock.leave(node)

    def __len__(self) -> int:
        return len(self._open)

    def hello(self) -> list[Hello | Show]:
        """Return the first messages of a page; panels that waited are shown there."""
        with self._lock:
            waiting, self._panels = self._panels, []
        graph = self._node.graph
        first: Hello = {
            "op": "hello",
            "version": __version__,
            "session": f"{graph.zid}-{self._node.entity.node_id}",
            "node": self._node.name,
            "graph": {"port": graph.port, "domain": graph.domain},
            "panels": [name for name, _ in waiting],
            "docs": pages_address(),
            "is_idle": self._is_idle(),
        }
        return [first, *(_show(name, params) for name, params in waiting if params)]

    def enter(self, page: Page) -> None:
        """A page has come; while there is one, time is followed."""
        with self._lock:
            if not self._open:
                self._node.clock.follow(self._node)
            self._open.add(page)

    def leave(self, page: Page) -> None:
        """A page has gone; calling it twice does nothing."""
        with self._lock:
            if page in self._open and len(self._open) == 1:
                self._node.clock.leave(self._node)
            self._open.discard(page)

    def show(self, panel: str, params: dict[str, Any] | None = None) -> None:
        """Ask for a panel: on the pages that are open, else on the first that opens."""
        with self._lock:
            pages = tuple(self._open)
            if not pages:
                self._panels.append((panel, params or {}))
        for page in pages:
            page.post(json_text(_show(panel, params or {})))

    def _is_idle(self) -> bool:
        # Names that begin with an underscore are those of tools, and are not told.
        return set(self._node.graph.node_names()) <= {_ROSOUT}


def _show(panel: str, params: dict[str, Any]) -> Show:
    return {"op": "show", "panel": panel, "params": params}
