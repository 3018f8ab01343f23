"""``ros2 service list``, ``type``, ``find`` and ``info``."""

from __future__ import annotations

import argparse
import sys

from gazelle.cli.ros2.graph import graph_of_ros2, types_by_name
from gazelle.cli.ros2.verbs import add_strategy_arguments, fail
from gazelle.cli.tool import hint
from gazelle.graph import Entity, Kind

__all__ = ["add_arguments_find", "add_arguments_info", "add_arguments_list", "add_arguments_type"]
__all__ += ["run_find", "run_info", "run_list", "run_type"]

_Parser = argparse.ArgumentParser


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
