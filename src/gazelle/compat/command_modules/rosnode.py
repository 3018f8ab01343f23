"""rosnode's functions: names of nodes, pinging and ending them."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from gazelle.compat.rosgraph.masterapi import Master, MasterError
from gazelle.compat.rospy.state import STATE
from gazelle.errors import NotFoundError

__all__ = [
    "ID",
    "NAME",
    "ROSNodeException",
    "ROSNodeIOException",
    "get_api_uri",
    "get_machines_by_nodes",
    "get_node_names",
    "get_nodes_by_machine",
    "kill_nodes",
    "rosnode_ping",
    "rosnode_ping_all",
]


NAME = "rosnode"
ID = "/rosnode"


class ROSNodeException(Exception):  # noqa: N818 - rosnode's name
    """A question about a node has no answer."""


class ROSNodeIOException(ROSNodeException):
    """The graph cannot be reached."""


def get_node_names(namespace: str | None = None) -> list[str]:
    """Return the global names of all nodes, sorted, or of those below a namespace."""
    names = sorted(STATE.open_graph().node_names())
    if not namespace:
        return names
    start = STATE.resolved(namespace).rstrip("/")
    return [name for name in names if name == start or name.startswith(f"{start}/")]


def kill_nodes(node_names: Sequence[str]) -> tuple[list[str], list[str]]:
    """Ask nodes to end; return those that heard and those that did not."""
    heard: list[str] = []
    failed: list[str] = []
    for name in map(STATE.resolved, node_names):
        try:
            done = STATE.open_graph().kill_node(name)
        except NotFoundError:
            done = False
        (heard if done else failed).append(name)
    return heard, failed


def rosnode_ping(
    node_name: str, max_count: int | None = None, verbose: bool = False, skip_cache: bool = False
) -> bool:
    """Return whether a node is there: the graph forgets one within milliseconds of its end.

    Args:
        node_name: its name.
        max_count: without effect: one look is an answer.
        verbose: print it.
        skip_cache: without effect: nothing is kept.
    """
    full = STATE.resolved(node_name)
    is_there = full in STATE.open_graph().node_names()
    if verbose:
        _print(f"{full} is alive" if is_there else f"cannot ping [{full}]: unknown node")
    return is_there


def rosnode_ping_all(
    verbose: bool = False, skip_cache: bool = False
) -> tuple[list[str], list[str]]:
    """Return the nodes that answer and those that do not; nothing is kept to be skipped."""
    names = get_node_names()
    alive = [name for name in names if rosnode_ping(name, verbose=verbose)]
    return alive, [name for name in names if name not in alive]


def get_api_uri(master: Master, caller_id: str, skip_cache: bool = False) -> str | None:
    """Return a node's address, None when there is no such node; none is kept to be skipped."""
    try:
        return master.lookupNode(caller_id)
    except MasterError:
        return None


def get_machines_by_nodes() -> list[str]:
    """Return the names of the machines that nodes run on."""
    graph = STATE.open_graph()
    return sorted({graph.node_info(name).host for name in get_node_names()})


def get_nodes_by_machine(machine: str) -> list[str]:
    """Return the nodes of a machine."""
    graph = STATE.open_graph()
    return [name for name in get_node_names() if graph.node_info(name).host == machine]


def _print(text: str) -> None:
    sys.stdout.write(f"{text}\n")
