"""What is on the graph right now: every node, topic and service of every process."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from gazelle.ending import called_by_library
from gazelle.errors import GraphError
from gazelle.graph.keys import Entity, Kind, entity_gid, token_selector

if TYPE_CHECKING:
    import zenoh

__all__ = ["Discovery"]

_ASK_S = 2.0
_MOST_REPLIES = 1 << 20
# A node's parts come one after the other; on a machine with much to do they take their time.
_QUIET_S = 1.0
_LONGEST_S = 10.0


class Discovery:
    """Keeps the entities of a domain current, from liveliness tokens.

    A token disappears with its process, also after ``kill -9``.
    """

    def __init__(self, session: zenoh.Session, domain: int) -> None:
        self._session = session
        self._selector = token_selector(domain)
        self._entities: dict[str, Entity] = {}
        self._by_gid: dict[bytes, Entity] = {}
        self._changed = threading.Condition()
        self._changed_s = time.monotonic()
        self._listeners: list[Callable[[Entity, bool], None]] = []
        self._subscriber: Any = None

    def start(self) -> None:
        """Follow changes from now on; what is there already counts as a change."""
        import zenoh

        callback = zenoh.handlers.Callback(self._on_token, None, indirect=False)
        self._subscriber = self._session.liveliness().declare_subscriber(
            self._selector, callback, history=True
        )

    def close(self) -> None:
        """Follow changes no more."""
        if self._subscriber is not None:
            self._subscriber.undeclare()
            self._subscriber = None

    def ask(self) -> tuple[Entity, ...]:
        """Return all entities, asking the graph afresh; complete also just after joining.

        Raises:
            GraphError: the graph is closed.
        """
        import zenoh

        found: dict[str, Entity] = {}
        # What this session knows is answered before get() returns: a channel of zenoh's usual
        # 256 places would fill up and nobody could ever empty it.
        channel: Any = zenoh.handlers.FifoChannel(_MOST_REPLIES)
        try:
            replies = self._session.liveliness().get(self._selector, channel, timeout=_ASK_S)
        except zenoh.ZError as error:
            raise GraphError("the graph is closed") from error
        for reply in replies:
            if reply.ok is not None:
                _read_token(str(reply.ok.key_expr), found)
        # The hub's last word can cut those answers short; they are among the entities known.
        with self._changed:
            return tuple((self._entities | found).values())

    def known(self) -> tuple[Entity, ...]:
        """Return the entities seen so far, without asking."""
        with self._changed:
            return tuple(self._entities.values())

    def count(self, kind: Kind, name: str) -> int:
        """Return how many publishers, subscriptions … of a name are known."""
        with self._changed:
            return sum(one.kind is kind and one.name == name for one in self._entities.values())

    def with_gid(self, gid: bytes) -> Entity | None:
        """Return the entity that an attachment names, None when it is not known (any more)."""
        return self._by_gid.get(gid)

    def listen(self, listener: Callable[[Entity, bool], None]) -> None:
        """Call `listener(entity, is_there)` for every entity that comes or goes."""
        with self._changed:
            self._listeners.append(listener)

    def ignore(self, listener: Callable[[Entity, bool], None]) -> None:
        """Call a listener no more."""
        with self._changed:
            self._listeners = [one for one in self._listeners if one != listener]

    def wait_for(
        self, condition: Callable[[Iterable[Entity]], bool], timeout_s: float | None
    ) -> bool:
        """Wait until a condition on the known entities holds; False when time is up."""
        deadline = None if timeout_s is None else time.monotonic() + timeout_s
        with self._changed:
            while not condition(self._entities.values()):
                left = None if deadline is None else deadline - time.monotonic()
                if left is not None and left <= 0:
                    return False
                self._changed.wait(left)
        return True

    def settles(
        self, condition: Callable[[Iterable[Entity]], bool], *, quiet_s: float = _QUIET_S
    ) -> bool:
        """Tell whether a condition on the known entities holds once nothing comes any more.

        What is not there yet may be on its way, as long as other things come: so a program that
        acts upon something's absence asks this.

        Args:
            condition: looked at after every change; when it holds, that is the answer.
            quiet_s: nothing has come or gone for so long; ten seconds are waited at most.
        """
        deadline = time.monotonic() + _LONGEST_S
        with self._changed:
            while not condition(self._entities.values()):
                now = time.monotonic()
                left = min(self._changed_s + quiet_s, deadline) - now
                if left <= 0:
                    return False
                self._changed.wait(left)
        return True

    @called_by_library
    def _on_token(self, sample: Any) -> None:
        import zenoh

        key = str(sample.key_expr)
        entity = Entity.from_token(key)
        if entity is None:
            return
        is_there = sample.kind == zenoh.SampleKind.PUT
        with self._changed:
            self._changed_s = time.monotonic()
            if is_there:
                self._entities[key] = self._by_gid[entity_gid(key)] = entity
            else:
                self._entities.pop(key, None)
                self._by_gid.pop(entity_gid(key), None)
            self._changed.notify_all()
            listeners = tuple(self._listeners)
        for listener in listeners:
            listener(entity, is_there)


def _read_token(key: str, into: dict[str, Entity]) -> None:
    entity = Entity.from_token(key)
    if entity is not None:
        into[key] = entity
