"""The node's life, names and parameters (rospy.client, rospy.core, rospy.names)."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from gazelle.compat.rospy.binary_params import as_binary, as_bytes
from gazelle.compat.rospy.exceptions import ROSException, ROSInterruptException
from gazelle.compat.rospy.names import (
    get_caller_id,
    get_name,
    get_namespace,
    remap_name,
    resolve_name,
)
from gazelle.compat.rospy.state import STATE
from gazelle.compat.rospy.topics import wait_for_message
from gazelle.compat.warn_once import warn_once
from gazelle.errors import GraphError
from gazelle.graph.names import parse_command_line

__all__ = [
    "TIMEOUT_READY",
    "MasterProxy",
    "delete_param",
    "get_caller_id",
    "get_master",
    "get_name",
    "get_namespace",
    "get_node_uri",
    "get_param",
    "get_param_cached",
    "get_param_names",
    "get_published_topics",
    "get_ros_root",
    "has_param",
    "init_node",
    "is_initialized",
    "is_shutdown",
    "is_shutdown_requested",
    "load_command_line_node_params",
    "myargv",
    "on_shutdown",
    "remap_name",
    "resolve_name",
    "search_param",
    "set_param",
    "signal_shutdown",
    "spin",
    "wait_for_message",
]

DEBUG, INFO, WARN, ERROR, FATAL = 1, 2, 4, 8, 16
# Seconds that rospy waits for a node's own address to be known.
TIMEOUT_READY = 15.0
_MISSING: Any = object()


def init_node(  # noqa: PLR0913, PLR0917 - rospy's signature
    name: str,
    argv: Sequence[str] | None = None,
    anonymous: bool = False,
    log_level: int | None = None,
    disable_rostime: bool = False,
    disable_rosout: bool = False,
    disable_signals: bool = False,
    xmlrpc_port: int = 0,
    tcpros_port: int = 0,
) -> None:
    """Become a node.

    Args:
        name: the last part of its global name.
        argv: its command line, the program's own when None.
        anonymous: add a number that makes the name unique.
        log_level: the least that is told, `rospy.INFO` when None.
        disable_rostime: stay on wall time whatever ``/use_sim_time`` says.
        disable_rosout: do not publish what is logged.
        disable_signals: leave signals to the program.
        xmlrpc_port: told once: this graph needs no ports of a node's own.
        tcpros_port: likewise.

    Raises:
        ROSException: the name is not legal, or the graph cannot be joined.
    """
    for what, port in (("xmlrpc_port", xmlrpc_port), ("tcpros_port", tcpros_port)):
        if port:
            warn_once(f"init_node: nothing listens at {what} {port}; this graph has no such ports")
    if not name:
        raise ValueError("name must not be empty")
    STATE.init(
        name,
        argv,
        anonymous=anonymous,
        log_level=log_level,
        disable_rostime=disable_rostime,
        disable_rosout=disable_rosout,
        disable_signals=disable_signals,
    )


def is_initialized() -> bool:
    """Return whether `init_node` was called."""
    return STATE.node is not None


def is_shutdown() -> bool:
    """Return whether the node is shut down."""
    return STATE.is_over()


def is_shutdown_requested() -> bool:
    """Return whether the node is shut down or about to be."""
    return STATE.requested.is_set()


def signal_shutdown(reason: str) -> None:
    """Shut the node down."""
    STATE.shut_down(str(reason))


def on_shutdown(h: Callable[[], Any]) -> None:
    """Run a function without arguments when the node is shut down.

    Raises:
        TypeError: `h` is not callable.
    """
    if not callable(h):
        raise TypeError(f"shutdown hook [{h}] must be a function or callable object")
    STATE.add_hook(h)


def spin() -> None:
    """Wait until the node is shut down.

    Raises:
        ROSInitException: `init_node` has not been called.
    """
    STATE.require("spin()")
    try:
        while not STATE.stopping.wait(0.5):
            continue
    except KeyboardInterrupt:
        STATE.shut_down("keyboard interrupt")
    STATE.is_over()


def myargv(argv: Sequence[str] | None = None) -> list[str]:
    """Return the arguments without ROS's remaps."""
    return parse_command_line(sys.argv if argv is None else argv).rest


def get_node_uri() -> str | None:
    """Return a name for the node's process on this graph; None before `init_node`."""
    node = STATE.node
    return None if node is None else f"zenoh://127.0.0.1:{node.graph.port}/{node.graph.zid}"


def get_ros_root(required: bool = False, env: Mapping[str, str] | None = None) -> str | None:
    """Return ``ROS_ROOT``, None where it is not set.

    Raises:
        ROSException: it is not set, and is required.
    """
    found = (os.environ if env is None else env).get("ROS_ROOT")
    if required and not found:
        raise ROSException("ROS_ROOT is not set")
    return found


def load_command_line_node_params(argv: Sequence[str]) -> None:
    """Set the parameters of a command line: ``_rate:=5`` is ``~rate``."""
    for key, value in parse_command_line(argv).params.items():
        set_param(f"~{key}", value)


def get_param(param_name: str, default: Any = _MISSING) -> Any:
    """Return a parameter; bytes are an ``xmlrpc.client.Binary``.

    Raises:
        KeyError: it is not set and there is no default.
    """
    return _get(param_name, default, cached=False)


def get_param_cached(param_name: str, default: Any = _MISSING) -> Any:
    """Return a parameter as last seen; changes arrive by themselves.

    Raises:
        KeyError: it is not set and there is no default.
    """
    return _get(param_name, default, cached=True)


def set_param(param_name: str, param_value: Any) -> None:
    """Set a parameter or, with a dict, a namespace of them.

    Raises:
        ROSException: the value has no form in the parameter store.
    """
    name = STATE.resolved(param_name)
    try:
        STATE.open_graph().parameters.set(name, as_bytes(param_value))
    except GraphError as error:
        raise ROSException(str(error)) from error


def has_param(param_name: str) -> bool:
    """Return whether a parameter is set."""
    return STATE.open_graph().parameters.has(STATE.resolved(param_name))


def delete_param(param_name: str) -> None:
    """Delete a parameter.

    Raises:
        KeyError: it is not set.
    """
    STATE.open_graph().parameters.delete(STATE.resolved(param_name))


def search_param(param_name: str) -> str | None:
    """Return the name of the nearest parameter of this name, going up from the node."""
    node = STATE.node
    store = STATE.open_graph().parameters if node is None else node.parameters
    return store.search(param_name)


def get_param_names() -> list[str]:
    """Return the names of all parameters."""
    return STATE.open_graph().parameters.names()


def get_published_topics(namespace: str = "/") -> list[list[str]]:
    """Return ``[topic, type]`` of all published topics below a namespace."""
    from gazelle.interfaces import ros1_type_of

    start = namespace.rstrip("/") + "/"
    topics = STATE.open_graph().topics()
    return [
        [one.name, ros1_type_of(one.type_name)]
        for one in topics
        if one.publishers and one.name.startswith(start)
    ]


def get_master(env: Any = None) -> MasterProxy:
    """Return what answers the questions that programs ask a ROS master.

    Args:
        env: without effect, as in rospy.
    """
    return MasterProxy()


class Master:
    """The three calls of the master that node programs make."""

    def getPid(self) -> tuple[int, str, int]:
        """Return success and this process's number."""
        import os

        STATE.open_graph()
        return 1, "", os.getpid()

    def getPublishedTopics(self, subgraph: str = "/") -> tuple[int, str, list[list[str]]]:
        """Return success and the published topics."""
        return 1, "current topics", get_published_topics(subgraph or "/")

    def getSystemState(self) -> tuple[int, str, list[Any]]:
        """Return success and publishers, subscribers, services by name."""
        graph = STATE.open_graph()
        topics = graph.topics()
        publishers = [[one.name, list(one.publishers)] for one in topics if one.publishers]
        subscribers = [[one.name, list(one.subscriptions)] for one in topics if one.subscriptions]
        services = [[one.name, list(one.servers)] for one in graph.services()]
        return 1, "current system state", [publishers, subscribers, services]


class MasterProxy(Master):
    """The master's answers, and the parameters as a mapping (rospy.msproxy).

    Args:
        uri: told once where it is not ``ROS_MASTER_URI``, whose graph it is in any case.
    """

    def __init__(self, uri: str = "") -> None:
        from gazelle.compat.rosgraph.rosenv import warn_of_master

        warn_of_master(uri)

    def __getitem__(self, key: str) -> Any:
        return get_param(key)

    def __setitem__(self, key: str, val: Any) -> None:
        set_param(key, val)

    def __delitem__(self, key: str) -> None:
        delete_param(key)

    def __contains__(self, key: str) -> bool:
        return has_param(key)

    def __iter__(self) -> Iterator[str]:
        return iter(get_param_names())

    def search_param(self, key: str) -> str | None:
        """Return the name of the nearest parameter of this name, going up from the node."""
        return search_param(key)

    def get_param_cached(self, key: str) -> Any:
        """Return a parameter as last seen."""
        return get_param_cached(key)


def _get(name: str, default: Any, *, cached: bool) -> Any:
    store = STATE.open_graph().parameters
    full = STATE.resolved(name)
    read = store.get_cached if cached else store.get
    try:
        return as_binary(read(full))
    except (KeyError, GraphError):
        if default is not _MISSING:
            return default
        raise KeyError(full) from None


def sleep_wall(seconds: float) -> None:
    """Sleep in real time, ended early by the shutdown.

    Raises:
        ROSInterruptException: the node is shut down.
    """
    deadline = time.monotonic() + seconds
    if STATE.stopping.wait(max(0.0, deadline - time.monotonic())):
        raise ROSInterruptException("ROS shutdown request")
