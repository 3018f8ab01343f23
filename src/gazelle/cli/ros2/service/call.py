"""``ros2 service call``."""

from __future__ import annotations

import argparse
import sys
import threading
import time

from gazelle.cli.ros2.graph import cli_node, full_name, graph_of_ros2
from gazelle.cli.ros2.types import ros2_service_class
from gazelle.cli.ros2.verbs import positive_float
from gazelle.cli.rosservice.services import service_hint
from gazelle.cli.text.ros2_filling import filled, yaml_values
from gazelle.cli.text.ros2_text import message_repr
from gazelle.cli.tool import ToolError
from gazelle.errors import GraphError
from gazelle.graph import Graph, ServiceClient
from gazelle.interfaces import Message

__all__ = ["add_arguments", "run"]

_LOOK_S = 0.5


def add_arguments(parser: argparse.ArgumentParser) -> None:
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


def run(options: argparse.Namespace) -> int:
    """Call a service and print what it answers."""
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


def _call(client: ServiceClient, request: Message) -> None:
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
    near = service_hint(client.name, services).strip("\n")
    if near:
        print(near, file=sys.stderr, flush=True)
    while not ended.is_set() and not client.wait_for_service(_LOOK_S):
        continue
