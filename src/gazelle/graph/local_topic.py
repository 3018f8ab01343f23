"""The publishers and subscriptions of one topic that live in this process."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gazelle.graph.publisher import Publisher
    from gazelle.graph.subscription import Subscription

__all__ = ["LocalTopic", "LocalTopics"]


class LocalTopic:
    """One topic's ends in this process; the tuples are replaced, never changed.

    Attributes:
        lock: held while the tuples change and while a latched message is handed over.
        transport: held while one of the publishers uses the transport.
        publishers: of this process.
        subscriptions: of this process.
        sent_s: when a reliable message last went to other processes, by `time.monotonic`.
        watchers: called when the subscriptions have changed.
    """

    __slots__ = ("lock", "publishers", "sent_s", "subscriptions", "transport", "watchers")

    def __init__(self) -> None:
        self.lock = threading.RLock()
        # zenoh stamps what it sends with the time and the session; a subscription that also asks
        # for latched messages drops those of a session that are older than one it has. So two
        # threads must not send on one topic at once: the later stamp could be on its way first.
        # It also refuses to undeclare what another thread is just using.
        self.transport = threading.Lock()
        self.publishers: tuple[Publisher, ...] = ()
        self.subscriptions: tuple[Subscription, ...] = ()
        self.sent_s = -math.inf
        self.watchers: tuple[Callable[[], None], ...] = ()

    def add_publisher(self, publisher: Publisher) -> None:
        """Add a publisher."""
        with self.lock:
            self.publishers = (*self.publishers, publisher)

    def remove_publisher(self, publisher: Publisher) -> None:
        """Remove a publisher, if it is there."""
        with self.lock:
            self.publishers = tuple(one for one in self.publishers if one is not publisher)

    def add_subscription(self, subscription: Subscription, *, latched: bool) -> None:
        """Add a subscription and, if `latched`, hand it what publishers of this process latched."""
        with self.lock:
            for publisher in self.publishers if latched else ():
                publisher.hand_latched(subscription)
            self.subscriptions = (*self.subscriptions, subscription)
        self._tell()

    def remove_subscription(self, subscription: Subscription) -> None:
        """Remove a subscription, if it is there."""
        with self.lock:
            self.subscriptions = tuple(one for one in self.subscriptions if one is not subscription)
        self._tell()

    def _tell(self) -> None:
        for act in self.watchers:
            act()


class LocalTopics:
    """All topics of this process by global name, and the names of its publishers."""

    def __init__(self) -> None:
        self._topics: dict[str, LocalTopic] = {}
        self._lock = threading.Lock()
        self.gids: set[bytes] = set()

    def topic(self, name: str) -> LocalTopic:
        """Return the topic, made when it is new."""
        with self._lock:
            return self._topics.setdefault(name, LocalTopic())

    def sent_since(self, monotonic_s: float) -> frozenset[str]:
        """Return the topics of which reliable messages went to other processes since then."""
        with self._lock:
            return frozenset(
                name for name, topic in self._topics.items() if topic.sent_s >= monotonic_s
            )
