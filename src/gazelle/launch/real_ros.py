"""Real ROS beside the graph: what launches and simulators look for before they start.

What is seen is joined by a bridge, a process of its own (``gazelle bridge NAME``).
"""

from __future__ import annotations

import os
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING
from urllib.parse import urlsplit

from gazelle.errors import GraphError
from gazelle.graph import Graph, NoGraphError
from gazelle.process_lifetime import PARENT_VARIABLE

if TYPE_CHECKING:
    from gazelle.launch.console import Console
    from gazelle.launch.supervisor import Supervisor

__all__ = ["NodeNames", "RealRos", "join", "real_ros", "start_bridges"]

NodeNames = Callable[[], Collection[str]]

_VARIABLE = "GAZELLE_BRIDGE"
_NO = frozenset({"0", "no", "off", "false"})
_CONNECT_S = 0.5
# Who has taken the connection is there, and may have much else to do.
_ANSWER_S = 3.0
_JOIN_S = 60.0
_LOOK_AGAIN_S = 0.01
_CALLER = "/roslaunch"
_ROSOUT = "/rosout"


@dataclass(frozen=True, slots=True)
class RealRos:
    """A real ROS that was seen.

    Attributes:
        bridge: which bridge joins it, as in ``gazelle bridge NAME``.
        sign: what was seen, in words.
        run_id: its ``/run_id``, empty when it has none.
        has_rosout: its log is gathered by a node of its own.
    """

    bridge: str
    sign: str
    run_id: str = ""
    has_rosout: bool = False


def real_ros(environ: Mapping[str, str], node_names: NodeNames) -> list[RealRos]:
    """Return every real ROS that is there and that no bridge on the graph has joined.

    Costs a refused connection where there is none.

    Args:
        environ: the environment; ``GAZELLE_BRIDGE=no`` stops the looking.
        node_names: gives the names of the graph's nodes.
    """
    if environ.get(_VARIABLE, "").strip().lower() in _NO:
        return []
    found = [detect(environ, node_names) for detect in _DETECTORS]
    return [one for one in found if one is not None]


def start_bridges(environ: Mapping[str, str]) -> None:
    """Join what real ROS there is, for a simulator that no launch starts; they end with it."""
    for one in real_ros(environ, _names_on_graph):
        print(  # noqa: T201 - what a command says
            f"{one.sign}: gazelle bridge {one.bridge} joins it ({_VARIABLE}=no keeps apart)",
            file=sys.stderr,
        )
        subprocess.Popen(
            _bridge_argv(one.bridge),
            env={**environ, PARENT_VARIABLE: str(os.getpid())},
            start_new_session=True,
        )


def _names_on_graph() -> tuple[str, ...]:
    try:
        with Graph.open(role="client") as graph:
            return graph.node_names(include_hidden=True)
    except NoGraphError:
        return ()


def _bridge_argv(name: str) -> tuple[str, ...]:
    """Return what runs a bridge; it ends with the process that starts it."""
    return (sys.executable, "-m", "gazelle.cli", "bridge", name)


def join(seen: Sequence[RealRos], supervisor: Supervisor, graph: Graph, console: Console) -> None:
    """Start a bridge to each real ROS, as part of a launch, and wait for its parameters.

    They would take the place of those that the launch sets sooner.
    """
    # Only launches do: a simulator by itself looks for real ROS without importing them.
    from gazelle.launch.launch_config import NodeTag
    from gazelle.launch.node_commands import Executable

    for one in seen:
        console.plain(
            f"{one.sign}: gazelle bridge {one.bridge} joins it "
            f"(roslaunch --no-bridge or {_VARIABLE}=no keep apart)"
        )
        spec = NodeTag("gazelle", "bridge", f"{one.bridge}_bridge", output="screen")
        argv = _bridge_argv(one.bridge)
        supervisor.start(spec, Executable(argv, takes_ros_args=False), core=True)
        if not _is_joined(one, graph, partial(supervisor.runs, spec)):
            console.warning(f"the bridge to {one.bridge} is not ready; the launch goes on")


def _is_joined(one: RealRos, graph: Graph, goes_on: Callable[[], bool]) -> bool:
    """Wait until a bridge has brought parameters and nodes of a real ROS over.

    A launch that went on before a slow bridge would lose its parameters to it, so it is given all
    the time that a busy machine may need; one that has ended is not waited for.
    """
    deadline, pause = time.monotonic() + _JOIN_S, threading.Event()
    while not (_has_parameters(one, graph) and _has_rosout(one, graph)):
        if time.monotonic() > deadline or not goes_on():
            return False
        pause.wait(_LOOK_AGAIN_S)
    return True


def _has_parameters(one: RealRos, graph: Graph) -> bool:
    # The bridge brings this one last.
    store = graph.parameters
    return not one.run_id or (store.has("/run_id") and store.get("/run_id") == one.run_id)


def _has_rosout(one: RealRos, graph: Graph) -> bool:
    return not one.has_rosout or _ROSOUT in graph.node_names()


def _ros1_master(environ: Mapping[str, str], node_names: NodeNames) -> RealRos | None:
    """Look for the master that ``ROS_MASTER_URI`` names."""
    text = environ.get("ROS_MASTER_URI", "").strip()
    if not text or not _somebody_listens(text):
        return None
    from gazelle.bridge.ros1 import master_address
    from gazelle.bridge.ros1.graph_state import BRIDGE_NAME
    from gazelle.bridge.ros1.xmlrpc_call import RemoteError, call

    if BRIDGE_NAME in node_names():
        return None
    try:
        uri = master_address(environ).uri
        number = call(uri, "getPid", _CALLER, timeout_s=_ANSWER_S)
        state = call(uri, "getSystemState", _CALLER, timeout_s=_ANSWER_S)
    except (RemoteError, GraphError):
        # Something else has the port.
        return None
    try:
        run_id = str(call(uri, "getParam", _CALLER, "/run_id", timeout_s=_ANSWER_S))
    except RemoteError:
        # A master without roslaunch has none.
        run_id = ""
    has_rosout = any(_ROSOUT in nodes for entries in state for _topic, nodes in entries)
    return RealRos("ros1", f"a ROS 1 master runs at {uri} (pid {number})", run_id, has_rosout)


def _somebody_listens(uri: str) -> bool:
    try:
        parts = urlsplit(uri)
        place = (parts.hostname or "", parts.port or 0)
        socket.create_connection(place, _CONNECT_S).close()
    except (OSError, ValueError):
        return False
    return True


# One function for each kind of real ROS; a bridge of that name has to exist.
_DETECTORS: tuple[Callable[[Mapping[str, str], NodeNames], RealRos | None], ...] = (_ros1_master,)
