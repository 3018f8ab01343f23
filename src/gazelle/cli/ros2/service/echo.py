"""``ros2 service echo``."""

from __future__ import annotations

import argparse

from gazelle.cli.ros2.graph import graph_of_ros2
from gazelle.cli.ros2.verbs import add_strategy_arguments, fail
from gazelle.cli.tool import hint

__all__ = ["add_arguments", "run"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what ``echo`` takes."""
    add_strategy_arguments(parser)
    parser.add_argument("service_name", help="Name of the ROS service to echo")
    parser.add_argument("service_type", nargs="?", help="Type of the ROS service")


def run(options: argparse.Namespace) -> int:
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
