"""Names and namespaces of nodes: which are legal, how they join, how often one is used."""

from __future__ import annotations

import re
from collections import Counter
from typing import TYPE_CHECKING

from gazelle.errors import LaunchError

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "InvalidNamespaceError",
    "InvalidNodeNameError",
    "add_node_name",
    "check_name",
    "check_namespace",
    "get_node_name_count",
    "is_namespace_absolute",
    "is_root_namespace",
    "make_namespace_absolute",
    "prefix_namespace",
]

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_WRONG = re.compile(r"[^A-Za-z0-9_]")
_NAMES = "unique_ros_node_names"


class InvalidNodeNameError(LaunchError):
    """A node cannot have this name."""


class InvalidNamespaceError(LaunchError):
    """A namespace cannot have this name."""


def check_name(name: str) -> None:
    """See that a node may have a name.

    Raises:
        InvalidNodeNameError: it may not; the message says why and what to write.
    """
    if not _NAME.fullmatch(name):
        raise InvalidNodeNameError(f"Invalid node name: {_why(name, 'node name')}")


def check_namespace(namespace: str) -> None:
    """See that an absolute namespace is legal.

    Raises:
        InvalidNamespaceError: it is not.
    """
    if namespace == "/":
        return
    for part in namespace.split("/")[1:]:
        if not _NAME.fullmatch(part):
            why = _why(part, "namespace") if part else "it has an empty part"
            raise InvalidNamespaceError(f"Invalid namespace: {why} ('{namespace}')")


def is_root_namespace(ns: str) -> bool:
    """Return whether a namespace is ``/``."""
    return ns == "/"


def is_namespace_absolute(ns: str) -> bool:
    """Return whether a namespace starts with ``/``."""
    return ns.startswith("/")


def prefix_namespace(base_ns: str | None, ns: str | None) -> str | None:
    """Return `ns` below `base_ns`, or as it is when it is absolute; None for two None."""
    if ns is None:
        found = base_ns
    elif not base_ns or is_namespace_absolute(ns):
        found = ns
    else:
        found = f"{'' if is_root_namespace(base_ns) else base_ns}/{ns}"
    if found is None or is_root_namespace(found):
        return found
    return found.rstrip("/")


def make_namespace_absolute(ns: str | None) -> str | None:
    """Return a namespace with a ``/`` before it; None stays None."""
    return ns if ns is None or is_namespace_absolute(ns) else f"/{ns}"


def add_node_name(context: LaunchContext, node_name: str) -> None:
    """Count one more node of a name in this launch."""
    names = context.get_locals_as_dict().get(_NAMES)
    if names is None:
        names = Counter[str]()
        context.extend_globals({_NAMES: names})
    names[node_name] += 1


def get_node_name_count(context: LaunchContext, node_name: str) -> int:
    """Return how many nodes of a name this launch has started."""
    names: Counter[str] = context.get_locals_as_dict().get(_NAMES, Counter())
    return names[node_name]


def _why(name: str, what: str) -> str:
    if not name:
        return f"{what} must not be empty"
    if name[0].isdigit():
        return f"'{name}': {what} must not start with a number"
    if what == "node name" and "/" in name:
        return f"'{name}': {what} must not contain '/'; give the namespace as namespace="
    instead = _WRONG.sub("_", name)
    return (
        f"'{name}': {what} must not contain characters other than alphanumerics or '_'; "
        f"'{instead}' would do"
    )
