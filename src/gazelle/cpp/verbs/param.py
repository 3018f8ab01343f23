"""Verbs of ROS 1's parameter server; names are global.

Values are JSON's; bytes and dates are written as `gazelle.graph.parameter_tree.to_json` does:
``{"$bytes": base64}``, ``{"$datetime": …}``, ``{"$date": …}``.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from gazelle.cpp.verbs import verb
from gazelle.errors import GraphError
from gazelle.graph.names import join, namespace_of
from gazelle.graph.parameter_tree import from_json, to_json

if TYPE_CHECKING:
    from gazelle.cpp.host.context import HostContext

__all__: list[str] = []

_MISSING: Any = object()


@verb("param/get")
def get(host: HostContext, request: dict[str, Any]) -> Any:
    """Return a value or a namespace: ``{"found": bool, "value": …}``."""
    parameters: Any = host.parameters
    read = parameters.get
    if request.get("cached"):
        read = getattr(parameters, "get_cached", read)
    value = read(request["name"], _MISSING)
    if value is _MISSING:
        return {"found": False}
    return {"found": True, "value": json.loads(to_json(value))}


@verb("param/set")
def put(host: HostContext, request: dict[str, Any]) -> None:
    """Set a value or a namespace."""
    host.parameters.set(request["name"], from_json(json.dumps(request["value"]).encode()))


@verb("param/has")
def has(host: HostContext, request: dict[str, Any]) -> bool:
    """Tell whether there is a value or a namespace."""
    return host.parameters.has(request["name"])


@verb("param/delete")
def delete(host: HostContext, request: dict[str, Any]) -> bool:
    """Delete a value or a namespace; return whether it was there."""
    parameters: Any = host.parameters
    if not hasattr(parameters, "delete"):
        raise GraphError("this program's parameters cannot be deleted")
    try:
        parameters.delete(request["name"])
    except KeyError:
        return False
    return True


@verb("param/search")
def search(host: HostContext, request: dict[str, Any]) -> str | None:
    """Return the name of the closest parameter, from a namespace upwards."""
    parameters, name = host.parameters, request["name"]
    if name.startswith("/"):
        return name if parameters.has(name) else None
    # As the master does it: by the first part, wherever that is.
    first, space = name.split("/")[0], request["namespace"] or "/"
    while True:
        if parameters.has(join(space, first)):
            return join(space, name)
        if space == "/":
            return None
        space = namespace_of(space)


@verb("param/names")
def names(host: HostContext, request: dict[str, Any]) -> list[str]:
    """Return the names of all values."""
    del request
    return host.parameters.names()
