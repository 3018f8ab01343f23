"""Telling the graph what there is: one entity at a time, or all of a node's at once."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import zenoh

__all__ = ["Announcement", "Announcements"]


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
