"""Keeps the graph's parameters and those of a master that ROS 1 runs the same."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.bridge.ros1.master_parameters import plain_value
from gazelle.bridge.ros1.xmlrpc_call import RemoteError
from gazelle.errors import GraphError
from gazelle.graph import ParameterStore
from gazelle.graph.callback_queue import CallbackQueue
from gazelle.graph.parameter_tree import ParameterTree

__all__ = ["ParameterSync"]

_ROOT = "/"
_RUN_ID = "/run_id"
_MISSING: Any = object()


class ParameterSync:
    """Passes changes on, each once: what came from one side is not sent back to it."""

    def __init__(
        self,
        store: ParameterStore,
        ask: Callable[..., Any],
        name: str,
        notice: Callable[[str], None],
    ) -> None:
        """Wait for `start`.

        Args:
            store: the graph's parameters by global names.
            ask: calls the master.
            name: of the node that is told of changes.
            notice: told of what goes wrong.
        """
        self._store = store
        self._ask = ask
        self._name = name
        self._notice = notice
        self._known = ParameterTree()
        self._listens = False
        self._uri = ""
        # Listeners of the store must not wait for another process.
        self._callback_queue = CallbackQueue(
            lambda job: job[0](*job[1:]), size=0, name="ros1 parameters"
        )

    def start(self, uri: str) -> None:
        """Bring both together; where both have a value the master's counts.

        The master's ``/run_id`` comes last: a launch sets its own parameters when it sees that,
        and nothing of the master's may arrive behind them. Ours is not told: a master without one
        has a roscore that is about to set it, and that ends where it finds another.

        Args:
            uri: slave server that is told of changes.

        Raises:
            RemoteError: the master does not answer.
        """
        self._uri = uri
        theirs = self._ask("subscribeParam", self._name, uri, _ROOT)
        self._known.replace(theirs if isinstance(theirs, dict) else {}, 0)
        ours = ParameterTree(self._store.get(_ROOT, {}))
        for name in self._known.names():
            if name != _RUN_ID:
                self._store_value(name, self._known.get(name))
        for name in ours.names():
            if name != _RUN_ID and not self._known.has(name):
                self._send(name)
        if not self._listens:
            self._listens = True
            self._store.on_change(lambda name: self._callback_queue.put((self._send, name)))
        if self._known.has(_RUN_ID):
            self._store_value(_RUN_ID, self._known.get(_RUN_ID))

    def changed(self, name: str, value: Any) -> None:
        """Take a change that the master tells of; an empty dictionary means it was deleted."""
        self._callback_queue.put((self._receive, name.rstrip("/") or _ROOT, value))

    def close(self, *, is_lost: bool = False) -> None:
        """Pass on nothing more.

        Args:
            is_lost: the master does not answer, so it is not asked.

        Raises:
            RemoteError: the master does not answer any more.
        """
        self._callback_queue.close()
        if self._uri and not is_lost:
            self._ask("unsubscribeParam", self._name, self._uri, _ROOT)

    def _receive(self, name: str, value: Any) -> None:
        if value == {} and name != _ROOT:
            if self._known.has(name):
                self._known.delete(name)
            if self._store.has(name):
                self._store.delete(name)
            return
        self._known.set(name, value)
        self._store_value(name, value)

    def _store_value(self, name: str, value: Any) -> None:
        if plain_value(self._store.get(name, _MISSING)) != value:
            self._store.set(name, value)

    def _send(self, name: str) -> None:
        value = plain_value(self._store.get(name, _MISSING))
        known = self._known.get(name) if self._known.has(name) else _MISSING
        if value is known or value == known:
            return
        try:
            if value is _MISSING:
                self._known.delete(name)
                self._ask("deleteParam", self._name, name)
            elif name == _ROOT:
                for key in value:
                    self._send(f"/{key}")
            else:
                self._known.set(name, value)
                self._ask("setParam", self._name, name, value)
        except (RemoteError, GraphError) as error:
            self._notice(f"parameter {name} does not reach the master: {error}")
