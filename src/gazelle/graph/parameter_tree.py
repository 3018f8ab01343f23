"""The ROS 1 parameter tree: nested dictionaries addressed by names, without any transport."""

from __future__ import annotations

import base64
import datetime as dt
import json
import threading
from collections.abc import Mapping
from typing import Any

from gazelle.errors import GraphError
from gazelle.graph.names import join, namespace_of, resolve
from gazelle.parameters.trees import leaves_at, values_only

__all__ = ["ParameterTree", "from_json", "to_json"]

_MARK = "$"
_MAX_DEPTH = 100


class ParameterTree:
    """Parameters by global name; a namespace is a dictionary. Safe to use from many threads.

    Semantics are those of the ROS 1 master: setting a dictionary replaces the whole namespace,
    setting a name below a plain value turns that value into a namespace.
    """

    def __init__(self, root: Mapping[str, Any] | None = None) -> None:
        self._root: dict[str, Any] = _tidy(root or {}, "/")
        self._lock = threading.RLock()
        self.revision = 0

    def get(self, name: str) -> Any:
        """Return a copy of the value, a dictionary for a namespace.

        Raises:
            KeyError: it is not set.
        """
        with self._lock:
            value: Any = self._root
            for part in _parts(name):
                if not isinstance(value, dict) or part not in value:
                    raise KeyError(name)
                value = value[part]
            return _copy(value)

    def has(self, name: str) -> bool:
        """Return whether the parameter or namespace is there."""
        try:
            self.get(name)
        except KeyError:
            return False
        return True

    def set(self, name: str, value: Any) -> int:
        """Set a parameter or, with a dictionary, a whole namespace; return the new revision.

        Raises:
            GraphError: the value has a type parameters cannot have, or ``/`` is not a dictionary.
        """
        parts = _parts(name)
        tidy = _tidy(value, name, len(parts))
        with self._lock:
            if not parts:
                if not isinstance(tidy, dict):
                    raise GraphError("cannot set root of parameter tree to non-dictionary")
                self._root = tidy
            else:
                self._namespace(parts[:-1])[parts[-1]] = tidy
            self.revision += 1
            return self.revision

    def delete(self, name: str) -> int:
        """Delete a parameter or namespace; return the new revision.

        Raises:
            KeyError: it is not set.
            GraphError: the name is ``/``.
        """
        parts = _parts(name)
        if not parts:
            raise GraphError("cannot delete root of parameter tree")
        with self._lock:
            parent = self._root
            for part in parts[:-1]:
                parent = parent.get(part) if isinstance(parent, dict) else None  # type: ignore[assignment]
            if not isinstance(parent, dict) or parts[-1] not in parent:
                raise KeyError(name)
            del parent[parts[-1]]
            self.revision += 1
            return self.revision

    def search(self, name: str, start: str) -> str | None:
        """Return the global name of the closest parameter, None when there is none.

        Looks in `start` (a namespace's global name) and then in each namespace above it. As in ROS,
        only the first part of the name decides where it is found.
        """
        if name.startswith("/"):
            return name if self.has(name) else None
        first = name.split("/", maxsplit=1)[0]
        namespace = start
        while True:
            if self.has(join(namespace, first)):
                return resolve(name, namespace)
            if namespace == "/":
                return None
            namespace = namespace_of(namespace)

    def names(self) -> list[str]:
        """Return the names of all values (not of namespaces), in the order they were set."""
        with self._lock:
            return [name for name, _ in values_only(leaves_at("/", self._root))]

    def replace(self, root: Mapping[str, Any], revision: int) -> None:
        """Become a copy of another tree."""
        with self._lock:
            self._root = _tidy(root, "/")
            self.revision = revision

    def _namespace(self, parts: list[str]) -> dict[str, Any]:
        namespace = self._root
        for part in parts:
            below = namespace.get(part)
            if not isinstance(below, dict):
                below = namespace[part] = {}
            namespace = below
        return namespace


def _encode(value: Any) -> Any:
    """Return the value in types JSON keeps apart exactly (int and float stay what they are).

    Bytes and dates become a one-entry dictionary whose key starts with ``$``.
    """
    if isinstance(value, bytes):
        return {"$bytes": base64.b64encode(value).decode()}
    if isinstance(value, dt.datetime):
        return {"$datetime": value.isoformat()}
    if isinstance(value, dt.date):
        return {"$date": value.isoformat()}
    if isinstance(value, list):
        return [_encode(item) for item in value]
    if isinstance(value, dict):
        inside = {str(key): _encode(item) for key, item in value.items()}
        return {"$dict": inside} if any(key.startswith(_MARK) for key in inside) else inside
    return value


def _decode(value: Any, depth: int = 0) -> Any:
    """Undo `_encode`; what is deeper than anybody can use is refused before it is too deep."""
    if depth > _MAX_DEPTH:
        raise ValueError(f"it is more than {_MAX_DEPTH} levels deep")
    if isinstance(value, list):
        return [_decode(item, depth + 1) for item in value]
    if not isinstance(value, dict):
        return value
    if len(value) == 1:
        key, inside = next(iter(value.items()))
        if key == "$bytes":
            return base64.b64decode(inside)
        if key == "$datetime":
            return dt.datetime.fromisoformat(inside)
        if key == "$date":
            return dt.date.fromisoformat(inside)
        if key == "$dict":
            value = dict(inside)
    return {key: _decode(item, depth + 1) for key, item in value.items()}


def _tidy(value: Any, name: str, depth: int = 0) -> Any:
    """Return a private copy in the types parameters can have, numpy scalars and tuples included."""
    if depth > _MAX_DEPTH:
        raise GraphError(f"parameter '{name[:60]}…' is more than {_MAX_DEPTH} levels deep")
    if isinstance(value, bool | int | float | str | bytes | dt.date):
        return value
    if isinstance(value, Mapping):
        return {
            str(key): _tidy(item, join(name, str(key)), depth + 1) for key, item in value.items()
        }
    if isinstance(value, list | tuple):
        return [_tidy(item, name, depth + 1) for item in value]
    if isinstance(value, bytearray | memoryview):
        return bytes(value)
    if value is None:
        return ""
    if hasattr(value, "tolist"):
        return _tidy(value.tolist(), name, depth)
    raise GraphError(
        f"parameter '{name}' cannot be a {type(value).__name__}\n"
        "  fix: use int, float, bool, str, bytes, dates, or lists and dictionaries of them"
    )


def _copy(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _copy(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_copy(item) for item in value]
    return value


def _parts(name: str) -> list[str]:
    return [part for part in name.split("/") if part]


def to_json(value: Any) -> bytes:
    """Write any parameter value."""
    return json.dumps(_encode(value)).encode()


def from_json(data: bytes) -> Any:
    """Read what `to_json` wrote.

    Raises:
        GraphError: it is something else; whoever is on the graph may send anything.
    """
    try:
        return _decode(json.loads(data))
    except (ValueError, TypeError, RecursionError) as error:
        raise GraphError(f"this cannot be read: {error}") from None
