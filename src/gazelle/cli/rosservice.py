"""``rosservice``: which services there are, and calling them."""

from __future__ import annotations

import sys
from collections.abc import Collection, Iterable
from optparse import Values
from typing import Any

from gazelle.cli.node_processes import Processes
from gazelle.cli.ros_tool import (
    Tool,
    ToolError,
    add_flag,
    global_name,
    hint,
    join_graph,
    option_parser,
    run_tool,
)
from gazelle.cli.ros_types import service_class, shown_type, wanted_type
from gazelle.cli.text.fill_message import documents, fill_from_words, printable_args, yaml_words
from gazelle.graph import Graph, ServiceClient, ServiceInfo
from gazelle.graph.gazebo_names import other_version_hint
from gazelle.graph.names import is_hidden
from gazelle.interfaces import Ros1Service

__all__ = [
    "args",
    "call",
    "find",
    "find_service",
    "info",
    "list_services",
    "main",
    "node",
    "service_hint",
    "show_type",
    "uri",
]

_LOOK_S = 1.0
_USAGE = """Commands:
\trosservice args\tprint service arguments
\trosservice call\tcall the service with the provided args
\trosservice find\tfind services by service type
\trosservice info\tprint information about service
\trosservice list\tlist active services
\trosservice type\tprint service type
\trosservice uri\tprint service ROSRPC uri

Type rosservice <command> -h for more detailed usage, e.g. 'rosservice call -h'
"""


def main(argv: list[str]) -> int:
    """Run a subcommand of ``rosservice``."""
    return run_tool(_TOOL, argv)


def list_services(argv: list[str]) -> int:
    """Print the names of services, with ``-n`` the nodes that answer them."""
    parser = option_parser("rosservice", "list [/namespace]")
    add_flag(parser, "-n", "--nodes", dest="nodes", text="print nodes that provide service(s)")
    options, args = parser.parse_args(argv)
    if len(args) > 1:
        parser.error("you may only specify one input namespace")
    own = global_name(args[0], "rosservice") if args else "/"
    start = own.rstrip("/") + "/"
    with join_graph() as graph:
        for one in graph.services():
            if one.name == own or one.name.startswith(start):
                print(f"{one.name} {','.join(one.servers)}" if options.nodes else one.name)
    return 0


def find(argv: list[str]) -> int:
    """Print the services of a type."""
    wanted = wanted_type("rosservice", argv)
    with join_graph() as graph:
        names = [one.name for one in graph.services() if shown_type(one.type_name) == wanted]
        print("\n".join(names))
    return 0


def find_service(graph: Graph, name: str) -> ServiceInfo | None:
    """Return the service of this global name, None when nobody offers it."""
    services = graph.services(include_hidden=True)
    return next((one for one in services if one.name == name), None)


def service_hint(name: str, offered: Collection[str]) -> str:
    """Return a line with what does a service of ROS 1 here, or services spelled alike."""
    other = other_version_hint(name, offered)
    if other:
        return f"\n  {other}"
    return hint(name, [one for one in offered if is_hidden(name) or not is_hidden(one)])


def info(argv: list[str]) -> int:
    """Print node, address, type and arguments of a service."""
    name = _name(argv, "info")
    with join_graph() as graph:
        service = find_service(graph, name)
        if service is None:
            print(f"ERROR: unknown service{_near_services(graph, name)}", file=sys.stderr)
            return 1
        print(f"Node: {service.servers[0]}")
        print(f"URI: {Processes(graph).uri(service.servers[0])}")
        print(f"Type: {shown_type(service.type_name)}")
        print(f"Args: {_args(service)}")
    return 0


def show_type(argv: list[str]) -> int:
    """Print the type of a service."""
    name = _name(argv, "type")
    with join_graph() as graph:
        service = find_service(graph, name)
        if service is None:
            print(f"Unknown service [{name}]{_near_services(graph, name)}", file=sys.stderr)
            return 1
        print(shown_type(service.type_name))
    return 0


def args(argv: list[str]) -> int:
    """Print the names of the fields of a service's request."""
    name = _name(argv, "args")
    with join_graph() as graph:
        service = find_service(graph, name)
        if service is None:
            near = _near_services(graph, name)
            raise ToolError(f"Service [{name}] is not available.{near}")
        print(_args(service))
    return 0


def uri(argv: list[str]) -> int:
    """Print the address of the process that answers a service."""
    name = _name(argv, "uri")
    with join_graph() as graph:
        service = find_service(graph, name)
        if service is None:
            return _unknown(graph, name)
        print(Processes(graph).uri(service.servers[0]))
    return 0


def node(argv: list[str]) -> int:
    """Print the node that answers a service."""
    name = _name(argv, "node")
    with join_graph() as graph:
        service = find_service(graph, name)
        if service is None:
            return _unknown(graph, name)
        print(service.servers[0])
    return 0


def call(argv: list[str]) -> int:
    """Call a service and print what it answers."""
    parser = option_parser("rosservice", "call /service [args...]")
    add_flag(parser, "-v", dest="verbose", text="print verbose output")
    add_flag(parser, "--nostr", dest="nostr", text="exclude string fields")
    add_flag(parser, "--noarr", dest="noarr", text="exclude arrays")
    add_flag(parser, "--wait", dest="wait", text="wait for service to be advertised")
    options, args = parser.parse_args(argv)
    if not args:
        parser.error("service must be specified")
    values = yaml_words(args[1:])
    with join_graph() as graph:
        name = global_name(args[0], "rosservice")
        kind = _kind(graph, name, wait=options.wait)
        requests: Iterable[Any] = [values]
        if not values and kind._request_class._names:
            if sys.stdin.isatty():
                parser.error("Please specify service arguments")
            requests = documents(sys.stdin)
        _call(graph, name, kind, requests, options)
    return 0


def _near_services(graph: Graph, name: str) -> str:
    """Return a line with what may have been meant, empty when nothing is known."""
    return service_hint(name, [one.name for one in graph.services(include_hidden=True)])


def _name(argv: list[str], command: str) -> str:
    parser = option_parser("rosservice", f"{command} /service")
    _, found = parser.parse_args(argv)
    if len(found) != 1:
        parser.error(
            "you may only specify one input service" if found else "service must be specified"
        )
    return global_name(found[0], "rosservice")


def _args(service: ServiceInfo) -> str:
    return printable_args(service_class(service.type_name)._request_class())


def _unknown(graph: Graph, name: str) -> int:
    print(f"Unknown service: {name}{_near_services(graph, name)}", file=sys.stderr)
    return 1


def _call(
    graph: Graph, name: str, kind: type[Ros1Service], requests: Iterable[Any], options: Values
) -> None:
    node = graph.create_node("rosservice", anonymous=True)
    graph.clock.follow(node)
    client: ServiceClient = node.create_client(name, kind)
    for values in requests:
        request = kind._request_class()
        try:
            fill_from_words(request, values, graph.clock.now_ns())
        except ToolError as error:
            raise ToolError(_incompatible(error, values)) from None
        response = client.call(request)
        if options.nostr or options.noarr:
            from gazelle.cli.text.ros1_text import hidden

            response = hidden(response, strings=options.nostr, arrays=options.noarr)
        if options.verbose:
            print(f"{request}\n---")
        print(response, flush=True)


def _kind(graph: Graph, name: str, *, wait: bool) -> type[Ros1Service]:
    if wait:
        while not graph.wait_for_service(name, _LOOK_S):
            pass
    service = find_service(graph, name)
    if service is None:
        raise ToolError(f"Service [{name}] is not available.{_near_services(graph, name)}")
    return service_class(service.type_name)


def _incompatible(error: ToolError, values: Any) -> str:
    text = str(error)
    if text.startswith("Unable to send request"):
        return text
    reason, _, names = text.partition("\n\nArgs are: ")
    items = values if isinstance(values, list) else [values]
    given = "\n".join(f" * {item} (type {type(item).__name__})" for item in items)
    return (
        f"Incompatible arguments to call service:\n{reason}\nProvided arguments are:\n{given}\n\n"
        f"Service arguments are: {names}"
    )


_TOOL = Tool(
    "rosservice",
    {
        "args": args,
        "call": call,
        "find": find,
        "info": info,
        "list": list_services,
        "node": node,
        "type": show_type,
        "uri": uri,
    },
    _USAGE,
)
