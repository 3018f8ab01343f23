"""The hub every process finds the others through, and who carries it when its process ends.

A process that was stopped (Ctrl-Z) while messages waited for it loses its direct link: whoever
sent them must go on. Both stay linked to the hub, which tells where peers are only when one joins
it. So the one that finds itself without a peer that still lives joins the hub once more.
"""

from __future__ import annotations

import contextlib
import os
import random
import socket
import stat
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from gazelle.errors import GraphError
from gazelle.graph.errors import PortTakenError, coded
from gazelle.graph.locators import (
    claim_hub,
    hub_endpoint,
    is_hub,
    name_of_hub,
    share,
    somebody_listens,
    sweep_sockets,
)
from gazelle.graph.sessions import client_config, close_session, hub_config, liveliness_tokens
from gazelle.process_lifetime import called_by_library

if TYPE_CHECKING:
    import zenoh

__all__ = ["HubKeeper", "Reconnection", "hub_knows", "hub_tokens", "port_taken"]

_RECONNECT_PAUSE_S = (0.3, 0.6)
_ASK_S = 1.0
# A hub on a machine with much to do leaves a question open for seconds.
_PATIENCE_S = 10.0
_LAST_QUESTION_S = 2.0
_DESCRIPTORS = 1024
_PAUSE_S = 0.05
_RETRY_S = 0.2
_CHECK_S = 0.5


class Reconnection:
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
        self._ended.wait(random.uniform(*_RECONNECT_PAUSE_S))
        with self._asking:
            if not self._ended.is_set() and zid not in self._linked and self._lives(zid):
                _cut(self._port)

    def _lives(self, zid: str) -> bool:
        return hub_knows(self._port, f"@ros2_lv/*/{zid}/**")


def hub_knows(port: int, selector: str) -> bool:
    """Tell whether the hub answers, and knows of a liveliness token that a selector fits."""
    return bool(hub_tokens(port, selector))


def hub_tokens(port: int, selector: str, patience_s: float = _PATIENCE_S) -> frozenset[str] | None:
    """Ask the hub for liveliness tokens, as a client: peers know only whom they have a link to.

    The answer is whole, as a session's that follows changes is not: what such a one knows already
    can be left out.

    Args:
        port: the hub's port.
        selector: of the tokens.
        patience_s: for how long a question that is left open is asked again.

    Returns:
        Their key expressions; None when there is no hub, or it does not answer.
    """
    deadline = time.monotonic() + patience_s
    while somebody_listens(port):
        found = _tokens_now(port, selector)
        if found is not None or time.monotonic() > deadline:
            return found
    return None


def port_taken(port: int) -> PortTakenError:
    """Return the error that says of a hub that it does not answer."""
    return PortTakenError(
        coded(
            "graph.port-taken",
            f"the graph on port {port} does not answer: who listens at {name_of_hub(port)} is "
            "stopped, or no Gazelle graph",
            fix=f"end that program (fuser {name_of_hub(port)} shows it), or choose another port "
            f"for all shells: export GAZELLE_PORT={port + 1}",
        )
    )


def _tokens_now(port: int, selector: str) -> frozenset[str] | None:
    import zenoh

    try:
        session: Any = zenoh.open(client_config(port, _ASK_S))
    except zenoh.ZError:
        return None
    found = liveliness_tokens(session, selector, _ASK_S)
    close_session(session)
    return found


class HubKeeper:
    """Carries the hub when nobody else does, and takes it over when it is lost.

    The hub is a second session in router mode; only one process can listen at its place, which is
    what elects it. The others are told by their connection ending.
    """

    def __init__(self, port: int, *, eager: bool) -> None:
        """Start without carrying anything.

        Args:
            port: the hub's port.
            eager: try to take over at once; others wait a moment first.
        """
        self._port = port
        self._eager = eager
        self._on_gain: Callable[[], None] | None = None
        self._hub: zenoh.Session | None = None
        self._release: Callable[[], None] = _do_nothing
        self._connected = threading.Event()
        self._lost = threading.Event()
        self._ended = threading.Event()
        self._lock = threading.Lock()
        self._listener: Any = None
        self._watcher = threading.Thread(target=self._watch, name="gazelle-hub", daemon=True)
        self._relinker = Reconnection(port)

    @property
    def is_hub(self) -> bool:
        """True when this process carries the hub."""
        return self._hub is not None

    @property
    def connected(self) -> bool:
        """True while there is a hub."""
        return self._connected.is_set()

    @property
    def watches(self) -> bool:
        """True while this process would take a lost hub over."""
        return self._watcher.is_alive()

    def carry(self) -> bool:
        """Carry the hub if nobody does; return whether this process does now."""
        import zenoh

        release = claim_hub(self._port)
        if release is None:
            return False
        try:
            hub = zenoh.open(hub_config(self._port))
        except zenoh.ZError:
            release()
            return False
        share(hub_endpoint(self._port))
        sweep_sockets()
        with self._lock:
            carries = not self._ended.is_set()
            if carries:
                self._hub, self._release = hub, release
        if not carries:
            close_session(hub, release)
        elif self._on_gain is not None:
            self._on_gain()
        return carries

    def start(self, session: zenoh.Session, timeout_s: float, on_gain: Callable[[], None]) -> bool:
        """Watch for the hub; return whether there is one within the time.

        Args:
            session: the process' own session, which looks for the hub by itself.
            timeout_s: how long to wait for the hub of another process.
            on_gain: called when this process becomes the hub, now or later.
        """
        import zenoh

        callback = zenoh.handlers.Callback(self._on_transport, None, indirect=False)
        self._listener = session.info.declare_transport_events_listener(callback, history=True)
        self._on_gain = on_gain
        if self.is_hub:
            on_gain()
        deadline = time.monotonic() + timeout_s
        while not self._connected.wait(_RETRY_S):
            if time.monotonic() > deadline:
                return False
            if not self.is_hub:
                self.carry()
        self._watcher.start()
        return True

    def settle(self) -> None:
        """Ask for nobody and take no hub over any more: the process' own session is to end.

        Its end loses the hub too, which would be taken for the hub's own end.
        """
        with self._lock:
            self._ended.set()
        self._lost.set()
        self._relinker.close()

    def close(self) -> None:
        """Give the hub up; another process takes it over."""
        self.settle()
        with self._lock:
            hub, self._hub = self._hub, None
        if self._listener is not None:
            self._listener.undeclare()
        if hub is not None:
            close_session(hub, self._release)

    @called_by_library
    def _on_transport(self, event: Any) -> None:
        import zenoh

        is_there = event.kind == zenoh.SampleKind.PUT
        if str(event.transport.whatami) != "router":
            note = self._relinker.linked if is_there else self._relinker.lost
            note(str(event.transport.zid))
        elif is_there:
            self._connected.set()
            self._lost.clear()
        else:
            self._connected.clear()
            self._lost.set()

    def _watch(self) -> None:
        """Wait for the hub's loss, then race for its place until there is a hub again."""
        while not self._ended.is_set():
            self._lost.wait()
            if self._ended.is_set():
                return
            if not self._eager:
                time.sleep(random.uniform(_PAUSE_S, 2 * _PAUSE_S))
            if not self._connected.is_set() and not self.is_hub:
                # Without a folder for it nobody can; when there is one again somebody will.
                with contextlib.suppress(GraphError):
                    self.carry()
            if self._connected.wait(_CHECK_S):
                self._lost.clear()


def _cut(port: int) -> None:
    """End this process' connections to the hub; the session makes new ones by itself."""
    for number in range(_DESCRIPTORS):
        with suppress(OSError):
            if not stat.S_ISSOCK(os.fstat(number).st_mode):
                continue
            with socket.socket(fileno=os.dup(number)) as own:
                if is_hub(own.getpeername(), port):
                    own.shutdown(socket.SHUT_RDWR)


def _do_nothing() -> None:
    pass
