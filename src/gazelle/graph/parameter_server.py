"""The parameter store as every process sees it: one owner, copies everywhere.

The process that carries the hub owns the tree and answers at one key; it broadcasts each change.
Every other process with nodes keeps a copy, which answers cached reads without asking and becomes
the tree when that process takes the hub over. Command-line tools ask, and keep nothing.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.diagnostics import nearest_names
from gazelle.errors import GraphError
from gazelle.graph.callback_queue import CallbackQueue
from gazelle.graph.key_expressions import parameter_key
from gazelle.graph.names import resolve
from gazelle.graph.parameter_tree import ParameterTree, to_json
from gazelle.graph.process_queries import answer_in, read_query, read_sample, reply_to

if TYPE_CHECKING:
    import zenoh

__all__ = ["ParameterShare", "ParameterStore", "global_parameters"]

_REQUIRED: Any = object()
_NO_OWNER_S = 3.0
# A hub that closes keeps its place until the transport has ended, which takes ten seconds at most.
_TAKING_OVER_S = 15.0
# Longer than a machine needs on which sixty processes start at once.
_SLOW_OWNER_S = 120.0
_RETRY_S = 0.02
_ASK_S = 5.0
_KINDS = {"op": str, "name": str, "start": str, "revision": int}
_UPDATES = {
    "root": {"value", "revision"},
    "set": {"name", "value", "revision"},
    "delete": {"name", "revision"},
}

Listener = Callable[[str], None]


class ParameterShare:
    """One process' part in the store: the owner, a copy of it, or neither."""

    def __init__(self, session: zenoh.Session, *, may_own: bool = False) -> None:
        """Hold nothing yet.

        Args:
            session: the process' own.
            may_own: this process takes over the hub when it is lost, and the parameters with it.
        """
        self._session = session
        self._no_owner_s = _TAKING_OVER_S if may_own else _NO_OWNER_S
        self._key = parameter_key("store")
        self._update_key = parameter_key("update")
        self._tree = ParameterTree()
        self._lock = threading.RLock()
        self._owner = False
        self._copied = False
        self._waiting: list[dict[str, Any]] = []
        self._listeners: list[Listener] = []
        self._declared: list[Any] = []
        # Neither answering nor listening may hold up the thread that receives.
        self._callback_queue = CallbackQueue(lambda job: job[0](job[1]), size=0, name="parameters")

    def own(self) -> None:
        """Become the owner with what the copy holds, and tell everybody the whole tree."""
        with self._lock:
            if self._owner:
                return
            self._owner = True
            self._declared.append(
                self._session.declare_queryable(self._key, self._later(self._answer))
            )
            revision = self._tree.revision
            self._tell({"op": "root", "value": self._tree.get("/"), "revision": revision})

    def copy(self) -> None:
        """Start to keep a copy."""
        with self._lock:
            if self._owner or self._copied or self._declared:
                return
            subscriber = self._session.declare_subscriber(
                self._update_key, self._later(self._on_update)
            )
            self._declared.append(subscriber)
        answer = self.ask({"op": "root"})
        with self._lock:
            if not self._owner and not self._copied:
                self._tree.replace(answer["value"], answer["revision"])
                self._copied = True
            for update in self._waiting:
                self._apply(update)
            self._waiting.clear()

    def listen(self, listener: Listener) -> None:
        """Call the listener with the name of every parameter that changes from now on."""
        self._listeners.append(listener)
        self.copy()

    def cached(self, name: str) -> Any:
        """Return a value from the copy, without asking the owner.

        Raises:
            KeyError: it is not set.
        """
        self.copy()
        return self._tree.get(name)

    def ask(self, request: dict[str, Any]) -> dict[str, Any]:
        """Send a request to the owner and return its answer.

        Raises:
            GraphError: there is no owner, or it refused.
            KeyError: the parameter is not set.
        """
        answer = self._handle(request) if self._owner else self._ask_owner(request)
        if "missing" in answer:
            raise KeyError(answer["missing"])
        if "error" in answer:
            raise GraphError(answer["error"])
        return answer

    def answers(self, within_s: float) -> bool:
        """Tell whether the owner answers; what it was sent before has gone on from it by then.

        Args:
            within_s: to wait at most, in the time of the wall.

        Returns:
            False for a graph that was left, too.
        """
        import zenoh

        if self._owner:
            return True
        payload = to_json({"op": "has", "name": "/"})
        try:
            replies = self._session.get(self._key, payload=payload, timeout=within_s)
            return any(answer_in(reply) is not None for reply in replies)
        except zenoh.ZError:
            return False

    def close(self) -> None:
        """Stop answering and listening."""
        with self._lock:
            declared, self._declared = self._declared, []
        for one in declared:
            one.undeclare()
        self._callback_queue.close()

    def _later(self, handle: Callable[[Any], None]) -> Any:
        import zenoh

        return zenoh.handlers.Callback(
            lambda item: self._callback_queue.put((handle, item)), None, indirect=False
        )

    def _ask_owner(self, request: dict[str, Any]) -> dict[str, Any]:
        """Ask until the owner answers.

        The hub owns the parameters, a moment after it can be reached. While there is a hub, it
        may have much to do; without one, another process takes it over within a second, or this
        one as soon as it can.
        """
        import zenoh

        payload = to_json(request)
        longest = time.monotonic() + _SLOW_OWNER_S
        deadline = time.monotonic() + self._no_owner_s
        while True:
            try:
                replies = self._session.get(self._key, payload=payload, timeout=_ASK_S)
            except zenoh.ZError as error:
                raise GraphError("the graph is closed") from error
            for reply in replies:
                answer = answer_in(reply)
                if answer is not None:
                    self._apply_own(request, answer)
                    return answer
            if self._owner:
                return self._handle(request)
            now = time.monotonic()
            if self._session.info.routers_zid():
                deadline = now + self._no_owner_s
            if now > min(deadline, longest):
                raise GraphError(
                    "no process holds the parameters (Unable to communicate with master!)\n"
                    "  fix: start a launch, a simulator or `gazelle roscore`"
                )
            time.sleep(_RETRY_S)

    def _answer(self, query: Any) -> None:
        try:
            answer = self._handle(read_query(query, _KINDS))
        except GraphError as error:
            answer = {"error": str(error)}
        reply_to(query, self._key, answer)

    def _handle(self, request: dict[str, Any]) -> dict[str, Any]:
        try:
            with self._lock:
                return self._do(request)
        except KeyError as error:
            return {"missing": str(error.args[0])}
        except GraphError as error:
            return {"error": str(error)}

    def _do(self, request: dict[str, Any]) -> dict[str, Any]:
        tree, op, name = self._tree, request.get("op"), request.get("name", "/")
        if op == "get":
            return {"value": tree.get(name)}
        if op == "has":
            return {"value": tree.has(name)}
        if op == "names":
            return {"value": tree.names()}
        if op == "search":
            return {"value": tree.search(name, request.get("start", "/")) or ""}
        if op == "root":
            return {"value": tree.get("/"), "revision": tree.revision}
        if op == "set":
            revision = tree.set(name, request.get("value", ""))
        elif op == "delete":
            revision = tree.delete(name)
        else:
            return {"error": f"the parameter store does not know '{op}'"}
        self._tell({**request, "revision": revision})
        self._changed(name)
        return {"value": "", "revision": revision}

    def _apply_own(self, request: dict[str, Any], answer: dict[str, Any]) -> None:
        """Make this process' own change visible in its copy at once, if nothing is in between."""
        with self._lock:
            next_one = self._copied and answer.get("revision") == self._tree.revision + 1
            if next_one and request["op"] in ("set", "delete"):
                self._apply({**request, "revision": answer["revision"]})

    def _tell(self, update: dict[str, Any]) -> None:
        import zenoh

        self._session.put(
            self._update_key,
            to_json(update),
            congestion_control=zenoh.CongestionControl.BLOCK,
            allowed_destination=zenoh.Locality.REMOTE,
        )

    def _on_update(self, sample: Any) -> None:
        update = read_sample(sample, _KINDS)
        _check_update(update)
        with self._lock:
            if self._owner:
                return
            if self._copied:
                self._apply(update)
            else:
                self._waiting.append(update)

    def _apply(self, update: dict[str, Any]) -> None:
        revision, op = update["revision"], update["op"]
        if op == "root":
            self._tree.replace(update["value"], revision)
            self._changed("/")
            return
        if revision <= self._tree.revision:
            return
        if op == "set":
            self._tree.set(update["name"], update["value"])
        elif self._tree.has(update["name"]):
            self._tree.delete(update["name"])
        self._tree.revision = revision
        self._changed(update["name"])

    def _changed(self, name: str) -> None:
        for listener in tuple(self._listeners):
            listener(name)


def _check_update(update: dict[str, Any]) -> None:
    op = update.get("op")
    is_whole = op in _UPDATES and _UPDATES[op] <= update.keys()
    if not is_whole or (op == "root" and not isinstance(update["value"], dict)):
        raise GraphError(f"an update of the parameters ('{op}') is left out: it is not whole")


class ParameterStore:
    """Parameters by the names one node would use (or global names, for the graph itself)."""

    def __init__(self, share: ParameterShare, to_global: Callable[[str], str], start: str) -> None:
        """Wrap a share.

        Args:
            share: the process' part in the store.
            to_global: resolves a name.
            start: where `search` begins, a node's global name.
        """
        self._share = share
        self._to_global = to_global
        self._start = start

    def get(self, name: str, default: Any = _REQUIRED) -> Any:
        """Return a value, a dictionary for a namespace, `default` when it is not set.

        Raises:
            KeyError: it is not set and there is no default.
        """
        return self._default_on_missing(
            lambda: self._share.ask({"op": "get", "name": self._to_global(name)})["value"], default
        )

    def get_cached(self, name: str, default: Any = _REQUIRED) -> Any:
        """Return a value from this process' own copy, at the cost of a dictionary look-up.

        Raises:
            KeyError: it is not set and there is no default.
        """
        return self._default_on_missing(lambda: self._share.cached(self._to_global(name)), default)

    def set(self, name: str, value: Any) -> None:
        """Set a value; a dictionary replaces the whole namespace.

        Raises:
            GraphError: parameters cannot have values of this type.
        """
        self._share.ask({"op": "set", "name": self._to_global(name), "value": value})

    def has(self, name: str) -> bool:
        """Return whether the parameter or namespace is set."""
        return bool(self._share.ask({"op": "has", "name": self._to_global(name)})["value"])

    def settle(self, within_s: float) -> bool:
        """Wait for what others sent up to now: it goes through the hub, which is asked something.

        Args:
            within_s: to wait at most, in the time of the wall.

        Returns:
            False where no hub answers.
        """
        return self._share.answers(within_s)

    def delete(self, name: str) -> None:
        """Delete a parameter or a namespace.

        Raises:
            KeyError: it is not set.
        """
        self._share.ask({"op": "delete", "name": self._to_global(name)})

    def search(self, name: str) -> str | None:
        """Return the global name of the closest parameter, from the node's own name upwards."""
        request = {"op": "search", "name": name, "start": self._start}
        return self._share.ask(request)["value"] or None

    def names(self) -> list[str]:
        """Return the global names of all values."""
        found: list[str] = self._share.ask({"op": "names"})["value"]
        return found

    def nearest(self, name: str) -> tuple[str, ...]:
        """Return names of parameters that are spelled most like this one."""
        return tuple(nearest_names(self._to_global(name), self.names()))

    def on_change(self, listener: Listener) -> None:
        """Call `listener(global_name)` after every change, ``/`` when all may have changed."""
        self._share.listen(listener)

    def _default_on_missing(self, read: Callable[[], Any], default: Any) -> Any:
        try:
            return read()
        except KeyError:
            if default is _REQUIRED:
                raise
            return default


def global_parameters(share: ParameterShare) -> ParameterStore:
    """Return the store by global names."""
    return ParameterStore(share, resolve, "/")
