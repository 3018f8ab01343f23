"""``rosservice info``, ``type``, ``args``, ``uri`` and ``node``."""

from __future__ import annotations

import sys

from gazelle.cli.node_processes import Processes
from gazelle.cli.ros_types import service_class, shown_type
from gazelle.cli.rosservice.services import find_service, near_services
from gazelle.cli.text.fill_message import printable_args
from gazelle.cli.tool import ToolError, global_name, joined, option_parser
from gazelle.graph import Graph, ServiceInfo

__all__ = ["args", "info", "node", "show_type", "uri"]


def info(words: list[str]) -> int:
    """Print node, address, type and arguments of a service."""
    name = _name(words, "info")
    with joined() as graph:
        service = find_service(graph, name)
        if service is None:
            print(f"ERROR: unknown service{near_services(graph, name)}", file=sys.stderr)
            return 1
        print(f"Node: {service.servers[0]}")
        print(f"URI: {Processes(graph).uri(service.servers[0])}")
        print(f"Type: {shown_type(service.type_name)}")
        print(f"Args: {_args(service)}")
    return 0


def show_type(words: list[str]) -> int:
    """Print the type of a service."""
    name = _name(words, "type")
    with joined() as graph:
        service = find_service(graph, name)
        if service is None:
            print(f"Unknown service [{name}]{near_services(graph, name)}", file=sys.stderr)
            return 1
        print(shown_type(service.type_name))
    return 0


def args(words: list[str]) -> int:
    """Print the names of the fields of a service's request."""
    name = _name(words, "args")
    with joined() as graph:
        service = find_service(graph, name)
        if service is None:
            near = near_services(graph, name)
            raise ToolError(f"Service [{name}] is not available.{near}")
        print(_args(service))
    return 0


def uri(words: list[str]) -> int:
    """Print the address of the process that answers a service."""
    name = _name(words, "uri")
    with joined() as graph:
        service = find_service(graph, name)
        if service is None:
            return _unknown(graph, name)
        print(Processes(graph).uri(service.servers[0]))
    return 0


def node(words: list[str]) -> int:
    """Print the node that answers a service."""
    name = _name(words, "node")
    with joined() as graph:
        service = find_service(graph, name)
        if service is None:
            return _unknown(graph, name)
        print(service.servers[0])
    return 0


def _name(words: list[str], command: str) -> str:
    parser = option_parser("rosservice", f"{command} /service")
    _, found = parser.parse_args(words)
    if len(found) != 1:
        parser.error(
            "you may only specify one input service" if found else "service must be specified"
        )
    return global_name(found[0], "rosservice")


def _args(service: ServiceInfo) -> str:
    return printable_args(service_class(service.type_name)._request_class())


def _unknown(graph: Graph, name: str) -> int:
    print(f"Unknown service: {name}{near_services(graph, name)}", file=sys.stderr)
    return 1
