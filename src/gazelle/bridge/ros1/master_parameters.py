"""ROS 1's parameter server over the graph's parameters.

Source: http://wiki.ros.org/ROS/Parameter%20Server%20API.
"""

from __future__ import annotations

import datetime as dt
from collections.abc import Callable
from typing import Any

from gazelle.bridge.ros1.master_registry import Registry, Replaced
from gazelle.errors import GraphError
from gazelle.graph import ParameterStore
from gazelle.graph.names import resolve

__all__ = ["ParameterApi", "plain_value"]

Answer = tuple[int, str, Any]
_MASTER = "/master"


class ParameterApi:
    """Answers for parameters and tells nodes of those they subscribed.

    Attributes:
        methods: Parameter Server API by name.
    """

    def __init__(
        self,
        store: ParameterStore,
        registry: Registry,
        tell: Callable[..., None],
        replace: Callable[[Replaced | None], None],
    ) -> None:
        """Listen to the store.

        Args:
            store: the graph's parameters by global names.
            registry: where subscriptions are kept.
            tell: calls (uri, method, *arguments) some time soon.
            replace: ends the node whose name was taken.
        """
        self._store = store
        self._registry = registry
        self._tell = tell
        self._replace = replace
        self._closed = False
        self._setting: dict[str, str] = {}
        self.methods: dict[str, Callable[..., Answer]] = {
            "deleteParam": self._delete,
            "setParam": self._set,
            "getParam": self._get,
            "searchParam": self._search,
            "subscribeParam": self._subscribe,
            "unsubscribeParam": self._unsubscribe,
            "hasParam": self._has,
            "getParamNames": self._names,
        }
        store.on_change(self._on_change)

    def close(self) -> None:
        """Tell of no more changes."""
        self._closed = True

    def _delete(self, caller: str, name: str) -> Answer:
        full = _full(caller, name)
        self._setting[full] = resolve(caller or "/")
        try:
            self._store.delete(full)
        except KeyError:
            del self._setting[full]
            return -1, f"parameter [{full}] is not set", 0
        return 1, f"parameter {full} deleted", 0

    def _set(self, caller: str, name: str, value: Any) -> Answer:
        full = _full(caller, name)
        self._setting[full] = resolve(caller or "/")
        try:
            self._store.set(full, value)
        except GraphError as error:
            del self._setting[full]
            return -1, str(error), 0
        return 1, f"parameter {full} set", 0

    def _get(self, caller: str, name: str) -> Answer:
        full = _full(caller, name)
        try:
            return 1, f"Parameter [{full}]", plain_value(self._store.get(full))
        except KeyError:
            return -1, f"Parameter [{full}] is not set", 0

    def _search(self, caller: str, name: str) -> Answer:
        found = _search(self._store, resolve(caller or "/"), name)
        return (1, "Found", found) if found else (-1, f"Cannot find parameter [{name}]", "")

    def _has(self, caller: str, name: str) -> Answer:
        full = _full(caller, name)
        return 1, full, self._store.has(full)

    def _names(self, _caller: str) -> Answer:
        return 1, "Parameter names", self._store.names()

    def _subscribe(self, caller: str, uri: str, name: str) -> Answer:
        full = _full(caller, name)
        self._replace(self._registry.add_parameter(resolve(caller), full, uri))
        value = self._store.get(full, {})
        return 1, f"Subscribed to parameter [{full}]", plain_value(value)

    def _unsubscribe(self, caller: str, uri: str, name: str) -> Answer:
        removed = self._registry.remove_parameter(resolve(caller), _full(caller, name), uri)
        return 1, "Unsubscribed" if removed else "was not subscribed", int(removed)

    def _on_change(self, changed: str) -> None:
        if self._closed:
            return
        # Who makes a change is not told of it: an echo could undo its next one.
        author = self._setting.pop(changed, "")
        for wanted, node, uri in self._registry.listeners(changed):
            if node == author:
                continue
            # A change above concerns all of what was asked for, one below only itself.
            name = changed if len(changed) > len(wanted) else wanted
            value = plain_value(self._store.get_cached(name, {}))
            self._tell(uri, "paramUpdate", _MASTER, f"{name.rstrip('/')}/", value)


def plain_value(value: Any) -> Any:
    """Return a value in the types that XMLRPC has; integers of more than 32 bits are floats."""
    if isinstance(value, dict):
        return {key: plain_value(item) for key, item in value.items()}
    if isinstance(value, list):
        return [plain_value(item) for item in value]
    if isinstance(value, dt.date) and not isinstance(value, dt.datetime):
        return dt.datetime.combine(value, dt.time())
    if isinstance(value, int) and not -(1 << 31) <= value < 1 << 31:
        return float(value)
    return value


def _full(caller: str, name: str) -> str:
    namespace = caller.rpartition("/")[0] if caller else ""
    return resolve(name, namespace or "/", node=caller)


def _search(store: ParameterStore, start: str, name: str) -> str:
    """Return the closest parameter's global name, from the caller's own name upwards."""
    if name.startswith("/"):
        return name if store.has(name) else ""
    first = name.split("/", maxsplit=1)[0]
    parts = [part for part in start.split("/") if part]
    for count in range(len(parts), -1, -1):
        namespace = "/" + "/".join(parts[:count])
        if store.has(resolve(first, namespace)):
            return resolve(name, namespace)
    return ""
