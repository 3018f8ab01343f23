"""Verbs of nodes: making them, their names, the arguments of the process."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gazelle.cpp.host.context import HostNode
from gazelle.cpp.verbs import verb
from gazelle.graph.names import anonymous_name, parse_command_line, resolve, split

if TYPE_CHECKING:
    from gazelle.cpp.host.context import HostContext
    from gazelle.graph import Node
    from gazelle.graph.ros2_arguments import RosArguments

__all__: list[str] = []

_ROS2 = 2
_ARGUMENTS = "node/arguments"


@verb("node/arguments")
def keep_arguments(host: HostContext, request: dict[str, Any]) -> list[str]:
    """Keep the arguments of the process for nodes made later; return those that are not ROS's."""
    words: list[str] = request["arguments"]
    host.state[_ARGUMENTS] = words
    if request["ros_version"] == _ROS2:
        return _ros2_arguments(words).rest
    return parse_command_line(words).rest


@verb("node/create")
def create(host: HostContext, request: dict[str, Any]) -> Any:
    """Make a node."""
    if host.adopted is not None:
        return _adopted(host, request)
    is_ros2 = request["ros_version"] == _ROS2
    node, details = _ros2_node(host, request) if is_ros2 else _ros1_node(host, request)
    number = host.add_node(HostNode(node, request["core"]))
    space, name = split(node.name)
    return {
        "handle": number,
        "name": name,
        "namespace": space,
        "full_name": node.name,
        **details,
    }


@verb("node/shutdown")
def shutdown(host: HostContext, request: dict[str, Any]) -> None:
    """Take a node off the graph."""
    host.drop_node(request["node"])


@verb("node/resolve")
def resolve_name(host: HostContext, request: dict[str, Any]) -> str:
    """Return the global name of a name that a node uses."""
    node = host.node(request["node"]).node
    if request.get("remap", True):
        return str(node.resolve_name(request["name"]))
    return resolve(request["name"], node.namespace, node=node.name)


@verb("node/console")
def console(host: HostContext, request: dict[str, Any]) -> None:
    """Print what a node says, or leave that to C++, and in which layout."""
    one = host.node(request["node"])
    one.console = bool(request.get("print", True))
    one.padded = bool(request.get("padded", True))


@verb("names/anonymous")
def anonymous(host: HostContext, request: dict[str, Any]) -> str:
    """Return a name made unique with host, process and time."""
    del host
    return anonymous_name(request["name"])


def _ros1_node(host: HostContext, request: dict[str, Any]) -> tuple[Node, dict[str, Any]]:
    from gazelle.graph.log_output import keep_log

    line = parse_command_line([*_given(host, request), *request["arguments"]])
    remappings = {**line.remappings, **dict(request.get("remappings", ()))}
    name, space = line.name or request["name"], request["namespace"] or line.namespace
    if name.startswith("/"):
        space, name = split(name)
    node = host.graph.create_node(
        name,
        namespace=space or None,
        remappings=remappings,
        anonymous=request["anonymous"] and line.name is None,
        rosout=request["rosout"],
    )
    node.outlives = True
    # C++ decides what is said.
    own = parse_command_line(host.state.get("argv", ())).special
    keep_log(node, {**own, **line.special}.get("__log", ""))
    for key, value in line.params.items():
        node.parameters.set(f"~{key}", value)
    return node, {"parameters": line.params, "special": line.special, "log_path": node.log_path}


def _ros2_node(host: HostContext, request: dict[str, Any]) -> tuple[Node, dict[str, Any]]:
    given, own = _ros2_arguments(_given(host, request)), _ros2_arguments(request["arguments"])
    first: str = request["name"]
    name = own.node_name(given.node_name(first))
    space = own.namespace(first) or given.namespace(first) or request["namespace"] or ""
    node = host.graph.create_node(
        name,
        namespace=resolve(space or "/"),
        remappings={**given.remappings(name), **own.remappings(name)},
        rosout=request["rosout"],
        is_ros2=True,
    )
    node.outlives = True
    node.console = _print_ros2()
    overrides = {**given.parameters(node.name), **own.parameters(node.name)}
    return node, {
        "parameters": overrides,
        "log_levels": {**given.log_levels, **own.log_levels},
        "remappings": {**given.remappings(name), **own.remappings(name)},
    }


def _print_ros2() -> Any:
    from gazelle.graph.log_output import print_ros2

    return print_ros2


def _given(host: HostContext, request: dict[str, Any]) -> list[str]:
    words: list[str] = host.state.get(_ARGUMENTS, [])
    return words if request.get("use_global_arguments", True) else []


def _ros2_arguments(words: list[str]) -> RosArguments:
    from gazelle.graph.ros2_arguments import parse_ros_arguments

    return parse_ros_arguments(words)


def _adopted(host: HostContext, request: dict[str, Any]) -> Any:
    """Give C++ the node that this process has for it."""
    node = host.adopted
    full = getattr(node, "name", "") or f"/{request['name']}"
    number = host.add_node(HostNode(node, request["core"]))
    space, name = split(full)
    return {
        "handle": number,
        "name": name,
        "namespace": space,
        "full_name": full,
        "parameters": {},
        "log_path": "",
    }
