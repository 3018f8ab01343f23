"""``ros2 service``: services of the graph, and calls of them."""

from __future__ import annotations

import argparse
import sys
import threading
import time

from gazelle.cli.ros2.graph import cli_node, full_name, graph_of_ros2, types_by_name
from gazelle.cli.ros2.verbs import (
    Command,
    Verb,
    add_strategy_arguments,
    fail,
    positive_float,
    run_command,
)
from gazelle.cli.ros_tool import ToolError, hint
from gazelle.cli.ros_types import ros2_service_class
from gazelle.errors import GraphError
from gazelle.graph import Entity, Graph, Kind, ServiceClient
from gazelle.interfaces import Message

__all__ = [
    "add_arguments_call",
    "add_arguments_echo",
    "add_arguments_find",
    "add_arguments_info",
    "add_arguments_list",
    "add_arguments_type",
    "main",
    "run_call",
    "run_echo",
]

__all__ += ["run_find", "run_info", "run_list", "run_type"]
_Parser = argparse.ArgumentParser
_LOOK_S = 0.5
_VERBS = {
    "call": Verb("Call a service", __name__),
    "echo": Verb("Echo a service", __name__),
    "find": Verb("Output a list of available services of a given type", __name__),
    "info": Verb("Print information about a service", __name__),
    "list": Verb("Output a list of available services", __name__),
    "type": Verb("Output a service's type", __name__),
}


def main(argv: list[str]) -> int:
    """Run a verb of ``ros2 service``."""
    about = "Various service related sub-commands"
    return run_command(Command("service", about, _VERBS, _add_arguments), argv)


def add_arguments_list(parser: _Parser) -> None:
    """Add what ``list`` takes."""
    add_strategy_arguments(parser)
    text = "Additionally show the service type"
    parser.add_argument("-t", "--show-types", action="store_true", help=text)
    _add_count_and_hidden(parser)


def run_list(options: argparse.Namespace) -> int:
    """Print the names of the services."""
    services = _services(hidden=options.include_hidden_services)[0]
    if options.count_services:
        print(len(services))
        return 0
    for name, types in services.items():
        print(f"{name} [{', '.join(types)}]" if options.show_types else name)
    return 0


def add_arguments_type(parser: _Parser) -> None:
    """Add what ``type`` takes."""
    add_strategy_arguments(parser)
    parser.add_argument(
        "service_name", help="Name of the ROS service to get type (e.g. '/add_two_ints')"
    )


def run_type(options: argparse.Namespace) -> int:
    """Print the types of a service."""
    services = _services(hidden=True)[0]
    for one in services.get(options.service_name, ()):
        print(one)
    if options.service_name in services:
        return 0
    near = hint(options.service_name, services).strip()
    print(f"there is no service '{options.service_name}'; {near}".rstrip("; "), file=sys.stderr)
    return 1


def add_arguments_find(parser: _Parser) -> None:
    """Add what ``find`` takes."""
    add_strategy_arguments(parser)
    parser.add_argument(
        "service_type",
        help="Name of the ROS service type to filter for (e.g. 'std_srvs/srv/Empty')",
    )
    _add_count_and_hidden(parser)


def run_find(options: argparse.Namespace) -> int:
    """Print the services of a type."""
    services = _services(hidden=options.include_hidden_services)[0]
    found = [name for name, types in services.items() if options.service_type in types]
    if options.count_services:
        print(len(found))
        return 0
    for name in found:
        print(name)
    if not found:
        near = hint(options.service_type, {one for types in services.values() for one in types})
        text = f"no service has the type '{options.service_type}'; {near.strip()}"
        print(text.rstrip("; "), file=sys.stderr)
    return 0


def add_arguments_info(parser: _Parser) -> None:
    """Add what ``info`` takes."""
    add_strategy_arguments(parser)
    parser.add_argument(
        "service_name", help="Name of the ROS service to get info (e.g. '/add_two_ints')"
    )


def run_info(options: argparse.Namespace) -> int:
    """Print a service's type, and how many call and offer it."""
    services, entities = _services(hidden=True)
    name = options.service_name
    types = services.get(name)
    if types is None:
        return fail(f"Unknown service '{name}'{hint(name, services)}")
    print(f"Type: {types[0] if len(types) == 1 else list(types)}")
    for word, kind in (("Clients", Kind.CLIENT), ("Services", Kind.SERVICE)):
        print(f"{word} count: {sum(one.kind is kind and one.name == name for one in entities)}")
    return 0


def add_arguments_call(parser: argparse.ArgumentParser) -> None:
    """Add what ``call`` takes."""
    add = parser.add_argument
    add("service_name", help="Name of the ROS service to call to (e.g. '/add_two_ints')")
    add("service_type", help="Type of the ROS service (e.g. 'std_srvs/srv/Empty')")
    group = parser.add_mutually_exclusive_group()
    text = "Values to fill the service request with in YAML format (e.g. '{a: 1, b: 2}')"
    group.add_argument("values", nargs="?", default="{}", help=text)
    group.add_argument("--stdin", action="store_true", help="Read values from standard input")
    text = "Repeat the call at a specific rate in Hz"
    add("-r", "--rate", metavar="N", type=positive_float, help=text)


def run_call(options: argparse.Namespace) -> int:
    """Call a service and print what it answers."""
    # Verbs that only list need no YAML and no arrays.
    from gazelle.cli.text.fill_message import filled, yaml_values

    kind = ros2_service_class(options.service_type)
    values = yaml_values(sys.stdin.read() if options.stdin else options.values)
    request = filled(kind.Request, values, time.time_ns())
    with graph_of_ros2() as graph:
        node, ended = cli_node(graph, options)
        client = node.create_client(full_name(options.service_name), kind)
        _wait(graph, client, kind.name, ended)
        while not ended.is_set():
            start_s = time.monotonic()
            try:
                _call(client, request)
            except ToolError:
                # Who ends the command in the midst of a call does not want to hear of that.
                if ended.is_set() or node.closed:
                    break
                raise
            if options.rate is None:
                break
            ended.wait(max(0.0, start_s + 1.0 / options.rate - time.monotonic()))
    return 0


def add_arguments_echo(parser: argparse.ArgumentParser) -> None:
    """Add what ``echo`` takes."""
    add_strategy_arguments(parser)
    parser.add_argument("service_name", help="Name of the ROS service to echo")
    parser.add_argument("service_type", nargs="?", help="Type of the ROS service")


def run_echo(options: argparse.Namespace) -> int:
    """Say that services cannot be listened to: no node offers ``<service>/_service_event``."""
    name = options.service_name
    with graph_of_ros2() as graph:
        services = {one.name: one.type_name for one in graph.services(include_hidden=True)}
    if name not in services:
        return fail(f"Could not determine the type for the passed service{hint(name, services)}")
    return fail(
        f"service introspection is not enabled for '{name}' ({services[name]}): its node does not "
        f"publish {name}/_service_event\n"
        "  nodes of Gazelle have no service introspection; in ROS 2 a node switches it on with "
        "configure_introspection()"
    )


def _services(*, hidden: bool) -> tuple[dict[str, tuple[str, ...]], tuple[Entity, ...]]:
    with graph_of_ros2() as graph:
        entities = graph.entities()
    return types_by_name(entities, (Kind.SERVICE,), include_hidden=hidden), entities


def _add_count_and_hidden(parser: _Parser) -> None:
    add = parser.add_argument
    text = "Only display the number of services discovered"
    add("-c", "--count-services", action="store_true", help=text)
    # The command has the option too; what stands in front of the verb must survive.
    add(
        "--include-hidden-services",
        action="store_true",
        default=argparse.SUPPRESS,
        help="Consider hidden services as well",
    )


def _call(client: ServiceClient, request: Message) -> None:
    from gazelle.cli.text.ros2_text import message_repr

    print(f"requester: making request: {message_repr(request)}\n", flush=True)
    try:
        response = client.call(request)
    except GraphError as error:
        raise ToolError(f"Exception while calling service: {error}") from None
    print(f"response:\n{message_repr(response)}\n", flush=True)


def _wait(graph: Graph, client: ServiceClient, type_name: str, ended: threading.Event) -> None:
    """Wait until the service is there; say what is there instead."""
    services = {one.name: one.type_name for one in graph.services(include_hidden=True)}
    other = services.get(client.name, type_name)
    if other != type_name:
        raise ToolError(
            f"service {client.name} has the type {other}, not {type_name}\n"
            "  ROS 2 would wait for ever for one of the other type"
        )
    if client.name in services:
        return
    print("waiting for service to become available...", flush=True)
    from gazelle.cli.rosservice import service_hint

    near = service_hint(client.name, services).strip("\n")
    if near:
        print(near, file=sys.stderr, flush=True)
    while not ended.is_set() and not client.wait_for_service(_LOOK_S):
        continue


def _add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--include-hidden-services", action="store_true", help="Consider hidden services as well"
    )
