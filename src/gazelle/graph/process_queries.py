"""What a process answers about itself: who it is, and requests to end a node.

Whoever is on the graph can send anything, so what arrives is read here and nowhere else: it is a
dictionary whose named entries are what they should be, or it is told in one sentence.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from gazelle.errors import GraphError
from gazelle.graph.callback_queue import CallbackQueue
from gazelle.graph.key_expressions import control_key
from gazelle.graph.parameter_tree import from_json, to_json

if TYPE_CHECKING:
    import zenoh

__all__ = [
    "Control",
    "answer_in",
    "ask_process",
    "read_query",
    "read_sample",
    "reply_to",
    "shut_down_node",
    "wait_for_processes",
]


_SHOWN = 60

_MAX_LENGTH = 4096

Kinds = Mapping[str, type | tuple[type, ...]]


def read_query(query: Any, kinds: Kinds) -> dict[str, Any]:
    """Return what a query asks.

    Args:
        query: a query of the transport.
        kinds: the entries that have to be of a type where they are there.

    Raises:
        GraphError: it is nothing that can be read.
    """
    return _read(query.payload, kinds)


def read_sample(sample: Any, kinds: Kinds) -> dict[str, Any]:
    """Return what a sample says, as `read_query` does.

    Raises:
        GraphError: it is nothing that can be read.
    """
    return _read(sample.payload, kinds)


def reply_to(query: Any, key: str, answer: dict[str, Any]) -> None:
    """Answer a query, and be done with it."""
    query.reply(key, to_json(answer))
    query.drop()


def answer_in(reply: Any) -> dict[str, Any] | None:
    """Return the answer of a reply; None for an error and for what is no answer."""
    if reply.ok is None:
        return None
    try:
        return _read(reply.ok.payload, {})
    except GraphError:
        return None


def _read(payload: Any, kinds: Kinds) -> dict[str, Any]:
    data = b"" if payload is None else payload.to_bytes()
    found = from_json(data)
    if not isinstance(found, dict):
        raise GraphError(f"a request is a dictionary, not {_shown(found)}")
    for name, kind in kinds.items():
        value = found.get(name)
        if name in found and (not isinstance(value, kind) or isinstance(value, bool)):
            raise GraphError(f"'{name}' of a request cannot be {_shown(value)}")
        if isinstance(value, str) and len(value) > _MAX_LENGTH:
            raise GraphError(f"'{name}' of a request is {len(value)} characters long")
    return found


def _shown(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= _SHOWN else f"{text[:_SHOWN]}…"


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
        self._callback_queue = CallbackQueue(self._answer, size=0, name="control")
        # Direct: zenoh's own callback threads would keep a process from ending.
        callback = zenoh.handlers.Callback(self._callback_queue.put, None, indirect=False)
        self._queryable: Any = session.declare_queryable(self._key, callback)

    def close(self) -> None:
        """Answer no more; whoever waits for an answer is let go."""
        self._queryable.undeclare()
        self._callback_queue.close()

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
