"""Panels that pages show: they begin with the first page and end some time after the last.

A page gets a panel's changes together, and of a widget's values only the last.
"""

from __future__ import annotations

import contextlib
import itertools
import threading
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, TypedDict

from gazelle.errors import GazelleError
from gazelle.graph import Graph
from gazelle.studio.errors import StudioError, unknown
from gazelle.studio.http_answers import Answer
from gazelle.studio.plugins.panel_sources import Source, all_sources, named_file
from gazelle.studio.plugins.running_panel import RunningPanel
from gazelle.studio.plugins.widget_values import picture_answer
from gazelle.studio.streams import Channel
from gazelle.workspace import Workspace

if TYPE_CHECKING:
    from gazelle.studio.streams import Channel

__all__ = ["Follower", "PanelEvent", "ShownPanel", "ShownPanels"]

_GATHER_S = 0.05
_REPLACED = ("set", "widget", "error", "state")
# A page that is loaded again finds its panels as they were.
_GRACE_S = 10.0
_PATIENCE_S = 10.0
_WATCH_S = 1.0


class PanelEvent(TypedDict):
    """What happened in a panel; `value` by `what`: docs/studio_protocol.md."""

    what: str
    name: str
    value: Any


class Follower:
    """Sends what happens in a panel to one page.

    Attributes:
        channel: of the stream ``plugin``.
    """

    def __init__(self, channel: Channel) -> None:
        """Wrap a channel."""
        self.channel = channel
        self._waiting: dict[tuple[str, str | int], PanelEvent] = {}
        self._numbers = itertools.count()
        self._lock = threading.Lock()
        self._sending = threading.Lock()

    def tell(self, what: str, name: str, value: Any) -> None:
        """Send an event soon; one that it makes superfluous is not sent."""
        event: PanelEvent = {"what": what, "name": name, "value": value}
        with self._lock:
            first = not self._waiting
            if what == "state":
                self._waiting.clear()
            key = (what, name if what in _REPLACED else next(self._numbers))
            # Behind what came since: a page takes events in order.
            self._waiting.pop(key, None)
            self._waiting[key] = event
        if first:
            self.channel.later(_GATHER_S, lambda: self.channel.work(self._flush))

    def _flush(self) -> None:
        with self._sending:
            with self._lock:
                events, self._waiting = self._waiting, {}
            if events and not self.channel.closed:
                self.channel.send(list(events.values()))


class ShownPanel:
    """One panel with the pages that show it.

    Attributes:
        source: its class.
        running: the object at work, None while no page shows it.
    """

    def __init__(self, graph: Graph, source: Source) -> None:
        self.source = source
        self.running: RunningPanel | None = None
        self._graph = graph
        self._followers: tuple[Follower, ...] = ()
        self._problem: dict[str, Any] | None = None
        self._stamp_ns = 0
        self._turn = threading.Lock()
        self._counting = threading.Lock()
        self._ending: threading.Timer | None = None
        self._over = threading.Event()

    def follow(self, channel: Channel) -> Callable[[], None]:
        """Show the panel on a page; returns what ends that.

        Raises:
            StudioError: the panel does not return from ``start``.
        """
        follower = Follower(channel)
        with self._taking_turns():
            if self.running is None:
                self._begin(again=False)
            with self._counting:
                self._followers += (follower,)
                if self._ending is not None:
                    self._ending.cancel()
            self._greet(follower)
        return lambda: self._leave(follower)

    def reload(self, source: Source) -> None:
        """Read the file again and begin anew.

        Raises:
            StudioError: the panel does not return from ``start``.
        """
        with self._taking_turns():
            self.source = source
            self._end()
            self._begin(again=True)
            for follower in self._followers:
                self._greet(follower)

    def close(self) -> None:
        """End the panel, also one that hangs."""
        self._over.set()
        with contextlib.suppress(StudioError), self._taking_turns():
            self._end()

    @contextlib.contextmanager
    def _taking_turns(self) -> Iterator[None]:
        if not self._turn.acquire(timeout=_PATIENCE_S):
            hint = "long work belongs into a thread of its own, or into small steps with every()"
            raise StudioError("the panel is busy: it has not returned from start()", hint=hint)
        try:
            yield
        finally:
            self._turn.release()

    def _begin(self, *, again: bool) -> None:
        self._problem = None
        self._over = threading.Event()
        self._stamp_ns = self._modified()
        running = self.running = RunningPanel(self._graph, self.source, self._tell_all)
        running.begin(again=again)
        watch = threading.Thread(target=self._watch, args=(self._over,), daemon=True)
        watch.start()

    def _end(self) -> None:
        self._over.set()
        running, self.running = self.running, None
        if running is not None:
            running.end()

    def _greet(self, follower: Follower) -> None:
        state = self.running.state if self.running is not None else None
        if state is not None:
            state.show_to(follower.tell)
        else:
            follower.tell("state", "", {"layout": [], "values": {}, "points": {}})
        follower.tell("error", "", self._problem)

    def _tell_all(self, what: str, name: str, value: Any) -> None:
        if what == "error":
            before = self._problem
            same = before is not None and before["text"] == value["text"]
            count = before["count"] + 1 if before is not None and same else 1
            value = self._problem = {**value, "count": count}
        for follower in self._followers:
            follower.tell(what, name, value)

    def _leave(self, follower: Follower) -> None:
        with self._counting:
            self._followers = tuple(one for one in self._followers if one is not follower)
            if not self._followers:
                self._ending = threading.Timer(_GRACE_S, self._end_unseen)
                self._ending.daemon = True
                self._ending.start()

    def _end_unseen(self) -> None:
        with contextlib.suppress(StudioError), self._taking_turns():
            if not self._followers:
                self._end()

    def _watch(self, over: threading.Event) -> None:
        """Tell once that the file is another one now."""
        while not over.wait(_WATCH_S):
            if self._modified() != self._stamp_ns:
                self._tell_all("changed", "", True)
                return

    def _modified(self) -> int:
        try:
            return self.source.file.stat().st_mtime_ns
        except OSError:
            return 0


class ShownPanels:
    """All panels of a graph's pages: those that could be opened, and those that are."""

    def __init__(self, graph: Graph) -> None:
        self._graph = graph
        self._named: dict[str, tuple[Source, ...]] = {}
        self._shown: dict[str, ShownPanel] = {}
        self._turn = threading.Lock()

    def name_file(self, argument: str) -> tuple[Source, ...]:
        """Add the panels of ``FILE.py[:Class]``.

        Raises:
            GazelleError: there are none.
        """
        self._named[argument] = named_file(argument)
        return self._named[argument]

    def sources(self) -> dict[str, Source]:
        """Return what could be opened, by name."""
        for argument in self._named:
            # A file that is just being written stays listed as it was.
            with contextlib.suppress(GazelleError):
                self._named[argument] = named_file(argument)
        named = [source for sources in self._named.values() for source in sources]
        return all_sources(named, Workspace.discover())

    def source(self, name: str) -> Source:
        """Return a panel's source.

        Raises:
            StudioError: there is none of this name, or it cannot be read.
        """
        known = self.sources()
        if name not in known:
            raise unknown("panel", name, known)
        if known[name].problem:
            raise StudioError(known[name].problem)
        return known[name]

    def show(self, name: str) -> ShownPanel:
        """Return a panel to be shown."""
        with self._turn:
            if name not in self._shown:
                self._shown[name] = ShownPanel(self._graph, self.source(name))
            return self._shown[name]

    def shown(self, name: str) -> ShownPanel:
        """Return a panel that a page shows.

        Raises:
            StudioError: none does.
        """
        found = self._shown.get(name)
        if found is None or found.running is None:
            raise StudioError(f"the panel '{name}' is not open", known=tuple(self._shown))
        return found

    def picture(self, name: str, widget: str) -> Answer | None:
        """Return what an image shows now."""
        shown = self._shown.get(name)
        state = shown.running.state if shown is not None and shown.running is not None else None
        value = state.values.get(widget) if state is not None else None
        return None if value is None else picture_answer(value)

    def close(self) -> None:
        """End all panels."""
        for shown in self._shown.values():
            shown.close()
