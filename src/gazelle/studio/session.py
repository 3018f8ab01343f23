"""What all pages of one server share: the graph, its listeners, and what was made for them."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypedDict, TypeVar

from gazelle._version import __version__
from gazelle.graph import Graph
from gazelle.studio.json_text import json_text
from gazelle.studio.taps import Taps
from gazelle.studio.workers import Workers

if TYPE_CHECKING:
    from gazelle.studio.connection import Connection

__all__ = ["GraphPlace", "Hello", "Show", "Studio"]

_WORKERS = 2
_T = TypeVar("_T")


class GraphPlace(TypedDict):
    """The graph that is looked at."""

    port: int
    domain: int


class Hello(TypedDict):
    """The server's first words.

    Attributes:
        node: the server's own on the graph.
        panels: those that commands asked for.
    """

    op: Literal["hello"]
    version: str
    session: str
    node: str
    graph: GraphPlace
    panels: list[str]


class Show(TypedDict):
    """A command asks for a panel."""

    op: Literal["show"]
    panel: str
    params: dict[str, Any]


class Studio:
    """One Studio: a node on the graph and the pages that look through it.

    Attributes:
        graph: the graph.
        node: the node that subscribes, publishes and calls for all pages.
        folder: pages write files below it, and nowhere else.
        taps: the topics listened to.
        workers: threads that make frames.
        pages: the open connections.
    """

    def __init__(self, graph: Graph, folder: Path | None = None) -> None:
        """Join as a node of a name of its own; the graph stays open when Studio is closed.

        Args:
            graph: what to look at.
            folder: where pages may write files, the current one when None.
        """
        self.graph = graph
        self.folder = (folder or Path.cwd()).absolute()
        self.node = graph.create_node("_studio", anonymous=True, rosout=False, is_ros2=True)
        # A simulator says the time at every step, and without a page nobody wants to know.
        graph.clock.leave(self.node)
        self.taps = Taps(self.node)
        self.workers = Workers(_WORKERS)
        self.pages: set[Connection] = set()
        self.session_name = f"{graph.zid}-{self.node.entity.node_id}"
        self._lock = threading.RLock()
        self._shared: dict[Any, Any] = {}
        self._closers: list[Callable[[], None]] = []
        self._panels: list[tuple[str, dict[str, Any]]] = []

    def hello(self) -> list[Hello | Show]:
        """Return the first messages of a connection; panels that waited are shown there."""
        with self._lock:
            waiting, self._panels = self._panels, []
        first: Hello = {
            "op": "hello",
            "version": __version__,
            "session": self.session_name,
            "node": self.node.name,
            "graph": {"port": self.graph.port, "domain": self.graph.domain},
            "panels": [name for name, _ in waiting],
        }
        return [first, *(_show(name, params) for name, params in waiting if params)]

    def enter(self, page: Connection) -> None:
        """A page has come; while there is one, time is followed."""
        with self._lock:
            if not self.pages:
                self.graph.clock.follow(self.node)
            self.pages.add(page)

    def leave(self, page: Connection) -> None:
        """A page has gone; calling it twice does nothing."""
        with self._lock:
            if page in self.pages and len(self.pages) == 1:
                self.graph.clock.leave(self.node)
            self.pages.discard(page)

    def show(self, panel: str, params: dict[str, Any] | None = None) -> None:
        """Ask for a panel: on the pages that are open, else on the first that opens."""
        pages = tuple(self.pages)
        if not pages:
            with self._lock:
                self._panels.append((panel, params or {}))
        for page in pages:
            page.post(json_text(_show(panel, params or {})))

    def shared(self, make: Callable[[Studio], _T]) -> _T:
        """Return what a function makes, made once for this Studio; parts keep their state so."""
        with self._lock:
            if make not in self._shared:
                self._shared[make] = make(self)
            found: _T = self._shared[make]
            return found

    def on_close(self, closer: Callable[[], None]) -> None:
        """Call something when Studio closes."""
        self._closers.append(closer)

    def close(self) -> None:
        """Leave the graph."""
        for closer in reversed(self._closers):
            closer()
        self.workers.close()
        self.node.shutdown("Studio was closed")


def _show(panel: str, params: dict[str, Any]) -> Show:
    return {"op": "show", "panel": panel, "params": params}
