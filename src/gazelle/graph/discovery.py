"""What is on the graph right now, and telling it of what this process has."""

from __future__ import annotations

import threading
import time
from collections import OrderedDict
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from gazelle.errors import GraphError
from gazelle.graph.hub import hub_tokens, port_taken
from gazelle.graph.key_expressions import Entity, Kind, entity_gid, token_selector
from gazelle.graph.sessions import liveliness_tokens
from gazelle.process_lifetime import called_by_library

if TYPE_CHECKING:
    import zenoh

__all__ = ["Announcement", "Announcements", "Discovery"]

_ASK_S = 2.0
# A node's parts come one after the other; on a machine with much to do they take their time.
_QUIET_S = 1.0
_MAX_DURATION_S = 10.0
# Between two questions about what came again after it had gone; so many must lack it.
_DOUBT_S = 1.0
_MISSED_LIMIT = 3
_GONE_LIMIT = 4096
_LAST_QUESTION_S = 2.0


class Announcement:
    """What others see of one entity: a liveliness token, declared now or with others later."""

    def __init__(self, session: zenoh.Session, text: str) -> None:
        """Prepare it; use `Announcements.announce`."""
        self._session = session
        self._text = text
        self._token: Any = None
        self._withdrawn = False
        self._lock = threading.Lock()

    def declare(self) -> None:
        """Let others see the entity, unless it was withdrawn meanwhile."""
        with self._lock:
            if self._token is None and not self._withdrawn:
                self._token = self._session.liveliness().declare_token(self._text)

    def undeclare(self) -> None:
        """Let others see it no more, or never."""
        with self._lock:
            self._withdrawn = True
            token, self._token = self._token, None
        if token is not None:
            token.undeclare()


class Announcements:
    """Announces the entities of one session.

    Making a node's services takes a while, on a machine with much to do seconds, and whoever looks
    meanwhile sees a part. Within `together` all is made first and told afterwards in one go; what
    is told works from that moment on.
    """

    def __init__(self, session: zenoh.Session) -> None:
        self._session = session
        self._here = threading.local()

    def announce(self, text: str) -> Announcement:
        """Announce an entity by its token, at the end of the thread's `together` if there is one.

        Args:
            text: see `gazelle.graph.key_expressions.token`.
        """
        made = Announcement(self._session, text)
        waiting: list[Announcement] | None = getattr(self._here, "waiting", None)
        if waiting is None:
            made.declare()
        else:
            waiting.append(made)
        return made

    @contextmanager
    def together(self) -> Iterator[None]:
        """Announce what this thread makes in a ``with`` block at its end.

        Blocks may lie in one another: the outermost one counts. Nothing in a block may wait for
        others to see what it makes. What was made before an error is announced too, for its owner
        is the one to take it back.
        """
        if getattr(self._here, "waiting", None) is not None:
            yield
            return
        waiting: list[Announcement] = []
        self._here.waiting = waiting
        try:
            yield
        finally:
            self._here.waiting = None
            for one in waiting:
                one.declare()


class Discovery:
    """Keeps the entities of a domain current, from liveliness tokens.

    A token disappears with its process, also after ``kill -9``.

    An answer to a question can come after the question is over. Zenoh takes it for a new token
    then, and nothing ever takes such a token back: an entity that had ended meanwhile would be
    there for ever. So what comes after its going is asked for again, and dropped when fresh
    answers lack it; a lost link that is back brings the same tokens again, and these are found.
    """

    def __init__(self, session: zenoh.Session, domain: int, port: int, zid: str) -> None:
        self._session = session
        self._port = port
        self._zid = zid
        self._selector = token_selector(domain)
        self._entities: dict[str, Entity] = {}
        self._by_gid: dict[bytes, Entity] = {}
        self._changed = threading.Condition()
        self._changed_s = time.monotonic()
        self._listeners: list[Callable[[Entity, bool], None]] = []
        self._subscriber: Any = None
        self._gone: OrderedDict[str, None] = OrderedDict()
        self._missed: dict[str, int] = {}
        self._is_asking = False
        self._asking: threading.Thread | None = None
        self._is_whole = False
        self._closed = threading.Event()

    def start(self) -> None:
        """Follow changes from now on; what is there already counts as a change."""
        import zenoh

        callback = zenoh.handlers.Callback(self._on_token, None, indirect=False)
        self._subscriber = self._session.liveliness().declare_subscriber(
            self._selector, callback, history=True
        )

    def close(self) -> None:
        """Follow changes no more; a question that is under way is waited for."""
        with self._changed:
            self._closed.set()
            asking = self._asking
        if asking is not None and asking is not threading.current_thread():
            asking.join(_LAST_QUESTION_S)
        if self._subscriber is not None:
            self._subscriber.undeclare()
            self._subscriber = None

    def ask(self) -> tuple[Entity, ...]:
        """Return all entities, asking the graph afresh; complete also just after joining.

        Raises:
            PortTakenError: nothing is known of others, and the hub does not answer.
            GraphError: the graph is closed.
        """
        found = self._answers()
        # What this session was told before is left out of answers: it is among those known.
        with self._changed:
            return tuple((self._entities | found).values())

    def _answers(self) -> dict[str, Entity]:
        """Return what the graph answers; with what is known already it is all there is.

        A machine with much to do can leave a question open for seconds. So the first one is
        asked until it is answered: the hub answers in order, so then it has told, too, what was
        there when this session began to follow changes. Where others are known and it is quiet,
        that is taken for all there is.
        """
        import zenoh

        deadline = time.monotonic() + _MAX_DURATION_S
        while True:
            asked_s = time.monotonic()
            try:
                keys = liveliness_tokens(self._session, self._selector, _ASK_S)
            except zenoh.ZError as error:
                raise GraphError("the graph is closed") from error
            knows_others = any(one.zid != self._zid for one in self.known())
            is_late = time.monotonic() > deadline
            if keys is not None or (knows_others and (is_late or self._changed_s < asked_s)):
                self._is_whole = True
            if self._is_whole:
                return _entities_of(keys or ())
            if is_late:
                raise port_taken(self._port)

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

        Raises:
            PortTakenError: nothing is known of others, and the hub does not answer.
            GraphError: the graph is closed.
        """
        if self._is_settled(condition, quiet_s):
            return True
        # It is as quiet while the hub has yet to tell what there is.
        return not self._is_whole and condition(self.ask())

    def _is_settled(self, condition: Callable[[Iterable[Entity]], bool], quiet_s: float) -> bool:
        deadline = time.monotonic() + _MAX_DURATION_S
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
            self._note(key, entity, is_there)
            if self._missed and not self._is_asking and not self._closed.is_set():
                self._is_asking = True
                self._asking = threading.Thread(
                    target=self._ask_again, name="discovery", daemon=True
                )
                self._asking.start()
            listeners = tuple(self._listeners)
        for listener in listeners:
            listener(entity, is_there)

    def _note(self, key: str, entity: Entity, is_there: bool) -> None:
        self._changed_s = time.monotonic()
        if is_there:
            self._entities[key] = self._by_gid[entity_gid(key)] = entity
            if key in self._gone:
                del self._gone[key]
                self._missed[key] = 0
        else:
            self._entities.pop(key, None)
            self._by_gid.pop(entity_gid(key), None)
            self._missed.pop(key, None)
            self._gone[key] = None
            if len(self._gone) > _GONE_LIMIT:
                self._gone.popitem(last=False)
        self._changed.notify_all()

    def _drop_missed(self, found: dict[str, Entity]) -> None:
        """Look in fresh answers for what came again after its going."""
        dropped = []
        with self._changed:
            for key, missed in list(self._missed.items()):
                if key in found:
                    del self._missed[key]
                elif missed + 1 < _MISSED_LIMIT:
                    self._missed[key] = missed + 1
                else:
                    dropped.append(self._entities[key])
                    self._note(key, self._entities[key], False)
            listeners = tuple(self._listeners)
        for entity in dropped:
            for listener in listeners:
                listener(entity, False)

    def _ask_again(self) -> None:
        while not self._closed.wait(_DOUBT_S):
            try:
                found = hub_tokens(self._port, self._selector, 0)
            except GraphError:
                return
            if found is not None:
                self._drop_missed(_entities_of(found))
            with self._changed:
                self._is_asking = bool(self._missed)
                if not self._is_asking:
                    return


def _entities_of(keys: Iterable[str]) -> dict[str, Entity]:
    read = ((key, Entity.from_token(key)) for key in keys)
    return {key: entity for key, entity in read if entity is not None}
