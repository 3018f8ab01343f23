"""Finding back to a process that was cut off.

A process that was stopped (Ctrl-Z) while messages waited for it loses its direct link: whoever
sent them must go on. Both stay linked to the hub, which tells where peers are only when one joins
it. So the one that finds itself without a peer that still lives joins the hub once more.
"""

from __future__ import annotations

import os
import random
import socket
import stat
import threading
from contextlib import suppress
from typing import Any

from gazelle.graph.closing import close_session
from gazelle.graph.locators import is_hub
from gazelle.graph.sessions import client_config

__all__ = ["Relinker", "hub_knows"]

_PAUSE_S = (0.3, 0.6)
_ASK_S = 1.0
_LAST_QUESTION_S = 2.0
_DESCRIPTORS = 1024


class Relinker:
    """Watches one session's links to other processes."""

    def __init__(self, port: int) -> None:
        """Do nothing before the first loss.

        Args:
            port: the hub's port.
        """
        self._port = port
        self._ended = threading.Event()
        self._asking = threading.Lock()
        self._linked: set[str] = set()

    def linked(self, zid: str) -> None:
        """Note a link to another process."""
        self._linked.add(zid)

    def lost(self, zid: str) -> None:
        """Note a lost link; join the hub again if that process still lives."""
        self._linked.discard(zid)
        if self._ended.is_set():
            return
        threading.Thread(target=self._look_after, args=(zid,), daemon=True).start()

    def close(self) -> None:
        """Look after nothing more; a question that is under way is waited for."""
        self._ended.set()
        # Not beside the end of the session that it asks about.
        if self._asking.acquire(timeout=_LAST_QUESTION_S):
            self._asking.release()

    def _look_after(self, zid: str) -> None:
        self._ended.wait(random.uniform(*_PAUSE_S))
        with self._asking:
            if not self._ended.is_set() and zid not in self._linked and self._lives(zid):
                _cut(self._port)

    def _lives(self, zid: str) -> bool:
        return hub_knows(self._port, f"@ros2_lv/*/{zid}/**")


def hub_knows(port: int, selector: str) -> bool:
    """Ask the hub for liveliness tokens, as a client: peers know only whom they have a link to."""
    import zenoh

    try:
        session: Any = zenoh.open(client_config(port))
    except zenoh.ZError:
        return False
    replies = session.liveliness().get(selector, timeout=_ASK_S)
    # All of them are taken: one that finds the channel full would hold up the close.
    lives = sum(reply.ok is not None for reply in replies) > 0
    close_session(session)
    return lives


def _cut(port: int) -> None:
    """End this process' connections to the hub; the session makes new ones by itself."""
    for number in range(_DESCRIPTORS):
        with suppress(OSError):
            if not stat.S_ISSOCK(os.fstat(number).st_mode):
                continue
            with socket.socket(fileno=os.dup(number)) as own:
                if is_hub(own.getpeername(), port):
                    own.shutdown(socket.SHUT_RDWR)
