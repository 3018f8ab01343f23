"""Namespaces of nodes, and how often a node's name is used."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = [
    "add_node_name",
    "get_node_name_count",
    "is_namespace_absolute",
    "is_root_namespace",
    "make_namespace_absolute",
    "prefix_namespace",
]

_NAMES = "unique_ros_node_names"


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
