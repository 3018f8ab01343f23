"""A page that shows a panel: it gets changes together, and of a widget's values only the last."""

from __future__ import annotations

import itertools
import threading
from typing import TYPE_CHECKING, Any, TypedDict

if TYPE_CHECKING:
    from gazelle.studio.streams import Channel

__all__ = ["Follower", "PanelEvent"]

_GATHER_S = 0.05
_REPLACED = ("set", "widget", "error", "state")


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
