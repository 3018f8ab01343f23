"""Who is on the graph, told by the hub: it alone is linked to every process.

A process that has heard of one to which it has no link is cut off from it without knowing; see
`relink`.
"""

from __future__ import annotations

import json
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.ending import called_by_library
from gazelle.graph.keys import MEMBERS_KEY

if TYPE_CHECKING:
    import zenoh

__all__ = ["MembersTeller", "hear_of_members"]

# Of many who join at once one list is told.
_TELL_AFTER_S = 0.5


class MembersTeller:
    """Tells every process who is linked to the hub, whenever that changes."""

    def __init__(self, hub: zenoh.Session) -> None:
        """Tell from now on.

        Args:
            hub: the session in router mode.
        """
        import zenoh

        self._hub = hub
        self._changed = threading.Event()
        self._ended = threading.Event()
        callback = zenoh.handlers.Callback(self._on_transport, None, indirect=False)
        self._listener: Any = hub.info.declare_transport_events_listener(callback, history=False)
        threading.Thread(target=self._tell, name="gazelle-members", daemon=True).start()

    def close(self) -> None:
        """Tell nothing more; before the hub's session is closed."""
        self._ended.set()
        self._changed.set()
        self._listener.undeclare()

    @called_by_library
    def _on_transport(self, _event: Any) -> None:
        self._changed.set()

    def _tell(self) -> None:
        import zenoh

        while True:
            self._changed.wait()
            if self._ended.wait(_TELL_AFTER_S):
                return
            self._changed.clear()
            try:
                members = sorted(str(zid) for zid in self._hub.info.peers_zid())
                self._hub.put(MEMBERS_KEY, json.dumps(members))
            except zenoh.ZError:
                # The session has been closed meanwhile.
                return


def hear_of_members(session: zenoh.Session, tell: Callable[[frozenset[str]], None]) -> Any:
    """Call a function with the names of all other sessions of nodes, whenever they change.

    Args:
        session: a process' own.
        tell: called in a thread of the transport; it must be short.

    Returns:
        what is to be kept as long as it is to be called.
    """
    import zenoh

    own = str(session.zid())

    @called_by_library
    def hear(sample: Any) -> None:
        members = _read(sample.payload.to_bytes())
        if own in members:
            tell(members - {own})

    callback = zenoh.handlers.Callback(hear, None, indirect=False)
    return session.declare_subscriber(MEMBERS_KEY, callback)


def _read(payload: bytes) -> frozenset[str]:
    """Return what a list says; nothing where it is none."""
    try:
        found = json.loads(payload)
    except (ValueError, RecursionError):
        return frozenset()
    named = isinstance(found, list) and all(isinstance(one, str) for one in found)
    return frozenset(found) if named else frozenset()
