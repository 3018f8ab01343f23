"""What a process answers about itself: who it is, and requests to end a node."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from gazelle.errors import GraphError
from gazelle.graph.delivery import Mailbox
from gazelle.graph.keys import control_key
from gazelle.graph.parameter_tree import to_json
from gazelle.graph.requests import answer_in, read_query, reply_to

if TYPE_CHECKING:
    import zenoh

__all__ = ["Control", "ask_process", "shut_down_node", "wait_for_processes"]

_ASK_S = 2.0
_KINDS: dict[str, Any] = {"op": str, "node": str, "reason": str, "since_ns": (int, type(None))}


class Control:
    """Answers at this process' control key."""

    def __init__(
        self,
        session: zenoh.Session,
        domain: int,
        zid: str,
        shut_down: Callable[[str, str, int | None], bool],
    ) -> None:
        """Start to answer.

        Args:
            session: the process' session.
            domain: the graph's domain.
            zid: the session's name.
            shut_down: ends a node by name and reason, and tells whether there was one; the number
                is the time at which another one claimed the name, if that is why.
        """
        import zenoh

        self._key = control_key(domain, zid)
        self._shut_down = shut_down
        self._mailbox = Mailbox(self._answer, size=0, name="control")
        # Direct: zenoh's own callback threads would keep a process from ending.
        callback = zenoh.handlers.Callback(self._mailbox.put, None, indirect=False)
        self._queryable: Any = session.declare_queryable(self._key, callback)

    def close(self) -> None:
        """Answer no more; whoever waits for an answer is let go."""
        self._queryable.undeclare()
        self._mailbox.close()

    def _answer(self, query: Any) -> None:
        try:
            answer = self._do(read_query(query, _KINDS))
        except GraphError as error:
            answer = {"error": str(error)}
        reply_to(query, self._key, answer)

    def _do(self, request: dict[str, Any]) -> dict[str, Any]:
        op = request.get("op")
        if op not in ("info", "shutdown"):
            return {"error": f"unknown request '{op}'"}
        if op == "shutdown":
            # The node's end can take a while and ends what answers here too.
            asked = (request.get("node", ""), request.get("reason", ""), request.get("since_ns"))
            threading.Thread(target=self._shut_down, args=asked, daemon=True).start()
        return {"pid": os.getpid(), "host": _host()}


def ask_process(session: zenoh.Session, domain: int, zid: str) -> tuple[int, str]:
    """Return process number and host of a session, (0, "") when it does not answer."""
    answer = _ask(session, domain, zid, {"op": "info"})
    return int(answer.get("pid", 0)), str(answer.get("host", ""))


def wait_for_processes(
    session: zenoh.Session, domain: int, zids: Iterable[str], within_s: float
) -> None:
    """Wait until processes have what they were sent: a question comes after it on the same way.

    Args:
        session: of this process.
        domain: of the graph.
        zids: the processes, asked all at once; those that are gone are not waited for.
        within_s: to wait at most, in the time of the wall.
    """
    asked = [
        session.get(control_key(domain, zid), payload=to_json({"op": "info"}), timeout=within_s)
        for zid in zids
    ]
    for replies in asked:
        for _ in replies:
            pass


def shut_down_node(
    session: zenoh.Session,
    domain: int,
    zid: str,
    node: str,
    reason: str,
    *,
    since_ns: int | None = None,
) -> bool:
    """Ask a process to end one of its nodes; return whether it answered.

    Args:
        session: of this process.
        domain: of the graph.
        zid: the process.
        node: the node's full name.
        reason: what is logged.
        since_ns: when another node claimed the name: a younger one goes on.
    """
    request = {"op": "shutdown", "node": node, "reason": reason, "since_ns": since_ns}
    return bool(_ask(session, domain, zid, request))


def _ask(session: zenoh.Session, domain: int, zid: str, request: dict[str, Any]) -> dict[str, Any]:
    import zenoh

    key = control_key(domain, zid)
    try:
        replies = session.get(key, payload=to_json(request), timeout=_ASK_S)
    except zenoh.ZError:
        # The graph was left meanwhile: a thread may ask that was begun before.
        return {}
    for reply in replies:
        answer = answer_in(reply)
        if answer is not None:
            return answer
    return {}


def _host() -> str:
    import socket

    return socket.gethostname()
