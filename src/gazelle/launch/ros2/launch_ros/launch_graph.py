"""The launch on the graph: it carries the hub, and has a node for what its actions ask."""

from __future__ import annotations

import os
import threading
from typing import TYPE_CHECKING, Any

from gazelle.errors import GraphError
from gazelle.graph import Graph, Node
from gazelle.launch.ros2.event_handlers import OnShutdown

if TYPE_CHECKING:
    from gazelle.launch.ros2.launch_context import LaunchContext

__all__ = ["call_while_running", "carry_graph", "drop_graph", "launch_node"]

_NODE = "launch_ros_node"
_LOOK_S = 0.2
_CARRIED: list[Graph] = []


def carry_graph() -> Graph:
    """Let this process carry the graph for as long as it lives; calling twice does nothing."""
    known = next((one for one in _CARRIED if one in Graph._open), None)
    if known is None:
        known = Graph.open(role="hub")
        _CARRIED[:] = [known]
    return known


def drop_graph() -> None:
    """Carry the graph no longer; nothing happens where this process carries none."""
    while _CARRIED:
        _CARRIED.pop().close()


def launch_node(context: LaunchContext) -> Node:
    """Return the node of a launch, ``launch_ros_PID``; it ends with the launch."""
    node: Node | None = context.get_locals_as_dict().get(_NODE)
    if node is None:
        node = carry_graph().create_node(f"launch_ros_{os.getpid()}", is_ros2=True)
        context.extend_globals({_NODE: node})
        context.register_event_handler(OnShutdown(on_shutdown=lambda *_: _end(node)))
    return node


def call_while_running(context: LaunchContext, name: str, kind: Any, request: Any) -> Any:
    """Call a service, however late it appears; None when the launch ends before its answer.

    It waits, so it is for threads of the launch and not for its event loop.

    Raises:
        GraphError: the server failed.
    """
    client = launch_node(context).create_client(name, kind)
    while not client.wait_for_service(_LOOK_S):
        if context.is_shutdown:
            return None
    answer: list[Any] = []

    def call() -> None:
        try:
            answer.append(client.call(request))
        except GraphError as error:
            answer.append(error)

    thread = threading.Thread(target=call, daemon=True)
    thread.start()
    while thread.is_alive() and not context.is_shutdown:
        thread.join(_LOOK_S)
    client.unregister()
    if answer and isinstance(answer[0], GraphError):
        raise answer[0]
    return answer[0] if answer else None


def _end(node: Node) -> None:
    # Not in the event loop: it may wait for others.
    threading.Thread(target=node.shutdown, daemon=True).start()
