"""Parameters of ros_control: namespaces of the ROS 1 parameter store."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

from gazelle.diagnostics import SourceSpan

__all__ = ["ParameterSource", "StoreSource"]


class ParameterSource(Protocol):
    """Parameters of one controller manager and its controllers."""

    def controllers(self) -> tuple[str, ...]:
        """Return the names of the configured controllers: those that have a type."""
        ...

    def controller_type(self, controller: str) -> str | None:
        """Return the type a controller is configured with, None when there is none."""
        ...

    def tree(self, controller: str) -> Mapping[str, Any]:
        """Return a controller's parameters, nested or with dots; empty when there are none."""
        ...

    def manager_tree(self) -> Mapping[str, Any]:
        """Return the parameters of the controller manager itself."""
        ...

    def set(self, controller: str, key: str, value: Any) -> None:
        """Set a parameter of a controller; an empty name means the manager."""
        ...

    def full_name(self, controller: str, key: str) -> str:
        """Return the name a user knows a parameter by."""
        ...

    def span(self, controller: str, key: str) -> SourceSpan | None:
        """Return where a parameter stands, None when that is not known."""
        ...


class _Store(Protocol):
    def get(self, name: str, default: Any = ...) -> Any: ...
    def set(self, name: str, value: Any) -> None: ...


class StoreSource:
    """Reads ``<namespace>/<controller>/…`` of a parameter store.

    A ``ros__parameters`` level, as ROS 2 files have, is looked through.

    Args:
        store: the parameter store.
        namespace: of the controller manager, absolute, such as ``/mira``.
    """

    def __init__(self, store: _Store, namespace: str) -> None:
        self._store = store
        self.namespace = "/" + namespace.strip("/") if namespace.strip("/") else ""

    def controllers(self) -> tuple[str, ...]:
        """Return the names below the namespace that have a ``type``."""
        found = self._store.get(self.namespace or "/", {})
        # Below the root lie the namespaces of other robots too.
        depth = 1 if self.namespace else 0
        return tuple(_typed(found, "", depth)) if isinstance(found, Mapping) else ()

    def controller_type(self, controller: str) -> str | None:
        """Return ``<controller>/type``."""
        found = self.tree(controller).get("type")
        return None if found is None else str(found)

    def tree(self, controller: str) -> Mapping[str, Any]:
        """Return the controller's namespace."""
        found = self._store.get(f"{self.namespace}/{controller}", {})
        if not isinstance(found, Mapping):
            return {}
        inner = found.get("ros__parameters")
        return {**found, **inner} if isinstance(inner, Mapping) else found

    def manager_tree(self) -> Mapping[str, Any]:
        """Return ``<namespace>/controller_manager``."""
        return self.tree("controller_manager")

    def set(self, controller: str, key: str, value: Any) -> None:
        """Set a parameter."""
        self._store.set(self.full_name(controller or "controller_manager", key), value)

    def full_name(self, controller: str, key: str) -> str:
        """Return the global name."""
        return "/".join((f"{self.namespace}/{controller}", *key.split("."))).rstrip("/")

    def span(self, controller: str, key: str) -> SourceSpan | None:
        """Return None: the store does not know where its values come from."""
        return None


def _typed(tree: Mapping[str, Any], prefix: str, depth: int) -> list[str]:
    names = []
    for key, value in tree.items():
        if not isinstance(value, Mapping):
            continue
        name = f"{prefix}{key}"
        inner = value.get("ros__parameters")
        found = (inner if isinstance(inner, Mapping) else value).get("type")
        if isinstance(found, str):
            names.append(name)
        elif depth:
            names += _typed(value, f"{name}/", depth - 1)
    return names
