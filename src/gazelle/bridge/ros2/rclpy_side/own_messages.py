"""Which messages of a topic this process has published itself.

They must not go back to where they came from. Newer ``rclpy`` (Kilted) tells each message's
publisher; with an older one a message is known by its bytes.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from typing import Any

__all__ = ["OwnMessages", "RosPublishers"]

_ALIVE_S = 5.0
_MAX = 1000
_HEAD = 4


class RosPublishers:
    """The publishers of all topics by their gid; safe to use from many threads.

    Attributes:
        news: set when one is heard of by its messages first.
    """

    def __init__(self, node: Any, own_names: set[str]) -> None:
        """Know nobody yet.

        Args:
            node: asked for what it knows.
            own_names: global names of the nodes of this process.
        """
        self._node = node
        self._own_names = own_names
        self.news = threading.Event()
        self._lock = threading.Lock()
        self._own: set[bytes] = set()
        self._numbers: dict[bytes, int] = {}
        self._next = 1

    def learn(self, topic: str) -> list[tuple[Any, int]]:
        """Return the publishers of a topic and their numbers, 0 for those of this process."""
        found = []
        for one in self._node.get_publishers_info_by_topic(topic):
            found.append((one, self._enter(one)))
        return found

    def number_of(self, topic: str, gid: bytes) -> int:
        """Return the number of the publisher with a gid, 0 when it is of this process."""
        found = self._known(gid)
        if found < 0:
            self.news.set()
            self.learn(topic)
            found = self._known(gid)
        return found if found >= 0 else self._number(gid)

    def _known(self, gid: bytes) -> int:
        with self._lock:
            return 0 if gid in self._own else self._numbers.get(gid, -1)

    def _enter(self, one: Any) -> int:
        gid = bytes(one.endpoint_gid)
        if f"{one.node_namespace.rstrip('/')}/{one.node_name}" in self._own_names:
            with self._lock:
                self._own.add(gid)
            return 0
        with self._lock:
            # While two nodes had one name, the other's publishers were taken for ours.
            self._own.discard(gid)
        return self._number(gid)

    def _number(self, gid: bytes) -> int:
        with self._lock:
            if gid not in self._numbers:
                self._numbers[gid] = self._next
                self._next += 1
            return self._numbers[gid]


class OwnMessages:
    """What this process has published on one topic and may hear again; many threads may ask."""

    def __init__(self, *, for_ever: bool = False) -> None:
        """Expect nothing.

        Args:
            for_ever: what was published long ago may still come: the topic is latched.
        """
        self._alive_s = float("inf") if for_ever else _ALIVE_S
        self._lock = threading.Lock()
        self._sent: deque[tuple[int, float]] = deque(maxlen=_MAX)

    def note(self, data: bytes) -> None:
        """Remember a message that is about to be published."""
        with self._lock:
            self._sent.append((_key(data), time.monotonic()))

    def is_echo(self, data: bytes) -> bool:
        """Return whether a message is one of those; each counts once."""
        with self._lock:
            now = time.monotonic()
            # What was lost on its way must not swallow somebody else's message later.
            while self._sent and now - self._sent[0][1] > self._alive_s:
                self._sent.popleft()
            key = _key(data)
            for place, (sent, _) in enumerate(self._sent):
                if sent == key:
                    del self._sent[place]
                    return True
            return False


def _key(data: bytes) -> int:
    """Without the head and the padding behind it, which transports may write anew."""
    return hash(data[_HEAD:].rstrip(b"\0"))
