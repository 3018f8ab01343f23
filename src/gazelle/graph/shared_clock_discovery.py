"""Who shares simulated time on a page of memory, and who finds it there.

A simulator publishes ``/clock`` a thousand times a second. To take a message costs a process a
tenth of a millisecond, so each node would spend a tenth of a core on knowing the time. So who
publishes it shows it on a page (`gazelle.graph.shared_memory_clock`) as well, and tells of that by
a liveliness token. Processes on the same machine look there when they want to know and let no
messages come. Everybody else (another machine or user, other programs, two clocks at once) goes
on with messages.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from gazelle.graph.callback_queue import CallbackQueue
from gazelle.graph.key_expressions import Entity, Kind, clock_key
from gazelle.graph.shared_memory_clock import ClockPage, PageView, machine_name
from gazelle.process_lifetime import called_by_library

if TYPE_CHECKING:
    from gazelle.graph.graph import Graph
    from gazelle.graph.publisher import Publisher
    from gazelle.graph.subscription import Subscription

__all__ = ["ClockFinder", "SharedClock", "share_clock"]

# Time that stood still for so long comes as a surprise to those who wait for it.
_STILL_S = 0.05


def share_clock(publisher: Publisher) -> SharedClock | None:
    """Prepare to show what is published on a clock's topic; None where no page can be made."""
    try:
        return SharedClock(publisher)
    except OSError:
        return None


class SharedClock:
    """Shows the time of one publisher of ``/clock`` while it is switched on and used.

    What is published must be shown first, and by the same thread: so no message ever comes from a
    time that its reader has not reached.
    """

    def __init__(self, publisher: Publisher) -> None:
        """Make the page and tell nobody; use `share_clock`.

        Raises:
            OSError: there is no place for a page.
        """
        graph = publisher.graph
        self._graph = graph
        self._topic = publisher.topic
        self._page = ClockPage()
        own = clock_key(graph.domain, graph.zid)
        parts = (publisher.gid, bytes.fromhex(machine_name()), self._page.secret)
        path = self._page.path.encode()
        self._token_key = "/".join([own, *(part.hex() for part in (*parts, path))])
        self._token: Any = None
        self._surprise_key = own
        self._shown_s = 0.0
        self._users: set[Entity] = set()
        self._is_on = True
        self._closed = False
        graph.discovery.listen(self._on_entity)
        for one in graph.discovery.known():
            self._on_entity(one, True)

    @property
    def is_used(self) -> bool:
        """True while another process has a subscription of the clock; cheap to ask."""
        return bool(self._users)

    @property
    def is_on(self) -> bool:
        """True while `show` should be called."""
        return self._is_on

    def turn(self, *, on: bool) -> None:
        """Switch on, or off: then everybody goes by messages. It is on at first."""
        self._is_on = on
        if not on:
            self._hide()

    def show(self, now_ns: int) -> None:
        """Show a time, and tell that it is shown."""
        if self._closed:
            return
        is_jump = self._page.show(now_ns)
        last_s, self._shown_s = self._shown_s, time.monotonic()
        if self._token is None or is_jump or self._shown_s - last_s > _STILL_S:
            self._say()

    def close(self) -> None:
        """Show nothing any more; calling it twice does nothing."""
        if not self._closed:
            self._closed = True
            self._graph.discovery.ignore(self._on_entity)
            self._hide()
            self._page.close()

    def _say(self) -> None:
        """Tell of the page, or that it shows what nobody can have expected."""
        import zenoh

        session = self._graph.session
        # The graph may be left at this very moment.
        with contextlib.suppress(zenoh.ZError):
            if self._token is None:
                self._token = session.liveliness().declare_token(self._token_key)
            else:
                session.put(self._surprise_key, b"")

    def _hide(self) -> None:
        token, self._token = self._token, None
        if token is not None:
            token.undeclare()

    def _on_entity(self, entity: Entity, is_there: bool) -> None:
        if entity.kind is Kind.SUBSCRIPTION and entity.name == self._topic:
            if is_there and entity.zid != self._graph.zid:
                self._users.add(entity)
            else:
                self._users.discard(entity)


class _Offer(NamedTuple):
    """A page that somebody tells of: whose it is, on which machine, and where it lies there."""

    gid: bytes
    machine: str
    secret: bytes
    path: str


class ClockFinder:
    """Finds the page of the clock that a subscription hears, and lets that rest meanwhile.

    A page counts while its publisher, of another process, is the only one of the topic. (What the
    own process publishes comes without a transport anyway.)
    """

    def __init__(
        self,
        graph: Graph,
        subscription: Subscription,
        use: Callable[[ClockFinder, PageView | None], None],
        look: Callable[[], None],
    ) -> None:
        """Do nothing before `start`.

        Args:
            graph: where to look.
            subscription: of the clock.
            use: takes the page that holds from now on, None when messages do; it may be called a
                last time while this is closed.
            look: called when the page shows what nobody can have expected: time went back, or
                goes on after it stood still.
        """
        self._graph = graph
        self._subscription = subscription
        self._use = use
        self._look = look
        self._offers: dict[str, _Offer] = {}
        self._chosen: _Offer | None = None
        self._prefers_messages = False
        self._closed = False
        # Subscriptions cannot be made and ended in the thread that receives.
        self._changes = CallbackQueue(lambda _one: self._choose(), size=1, name="clock")
        self._declared: list[Any] = []

    def start(self) -> None:
        """Begin to look for pages."""
        self._declared = self._declare()
        self._graph.discovery.listen(self._on_entity)
        self._changes.put(None)

    def prefer(self, *, messages: bool) -> None:
        """Let messages come although there is a page, or go back to that."""
        if messages != self._prefers_messages:
            self._prefers_messages = messages
            self._changes.put(None)

    def close(self) -> None:
        """Look no more; the page that is in use stays so."""
        self._closed = True
        self._graph.discovery.ignore(self._on_entity)
        for one in self._declared:
            one.undeclare()
        self._changes.close()

    def _declare(self) -> list[Any]:
        import zenoh

        session, every = self._graph.session, clock_key(self._graph.domain, "*")
        on_token = zenoh.handlers.Callback(self._on_token, None, indirect=False)
        on_surprise = zenoh.handlers.Callback(self._on_surprise, None, indirect=False)
        tokens = session.liveliness().declare_subscriber(f"{every}/**", on_token, history=True)
        return [tokens, session.declare_subscriber(every, on_surprise)]

    @called_by_library
    def _on_token(self, sample: Any) -> None:
        import zenoh

        key = str(sample.key_expr)
        if sample.kind == zenoh.SampleKind.PUT:
            offer = _read_offer(key)
            if offer is not None:
                self._offers[key] = offer
        else:
            self._offers.pop(key, None)
        self._changes.put(None)

    @called_by_library
    def _on_surprise(self, _sample: Any) -> None:
        self._look()

    def _on_entity(self, entity: Entity, _is_there: bool) -> None:
        if entity.kind is Kind.PUBLISHER and entity.name == self._subscription.topic:
            self._changes.put(None)

    def _choose(self) -> None:
        wanted = self._only_offer()
        if self._closed or wanted == self._chosen:
            return
        view = _opened(wanted)
        self._chosen = None if view is None else wanted
        # First the new way, then the old one's end: no time is missed.
        self._use(self, view)
        if view is None:
            self._subscription.resume()
        else:
            self._subscription.rest()

    def _only_offer(self) -> _Offer | None:
        """Return the page of the topic's only publisher, if there is one to be used."""
        if self._prefers_messages:
            return None
        discovery, topic = self._graph.discovery, self._subscription.topic
        publishers = [
            one for one in discovery.known() if one.kind is Kind.PUBLISHER and one.name == topic
        ]
        for offer in tuple(self._offers.values()):
            entity = discovery.with_gid(offer.gid)
            if publishers == [entity] and offer.machine == machine_name():
                return offer if publishers[0].zid != self._graph.zid else None
        return None


def _opened(offer: _Offer | None) -> PageView | None:
    if offer is None:
        return None
    try:
        return PageView(offer.path, offer.secret)
    except (OSError, ValueError):
        return None


def _read_offer(key: str) -> _Offer | None:
    try:
        gid, machine, secret, path = (bytes.fromhex(part) for part in key.split("/")[-4:])
        return _Offer(gid, machine.hex(), secret, path.decode())
    except ValueError:
        return None
