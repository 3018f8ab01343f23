"""``rosservice call``."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from optparse import Values
from typing import Any

from gazelle.cli.ros_types import service_class
from gazelle.cli.rosservice.services import find_service, near_services
from gazelle.cli.text.fill_message import documents, fill_from_words, yaml_words
from gazelle.cli.tool import ToolError, add_flag, global_name, joined, option_parser
from gazelle.graph import Graph, ServiceClient
from gazelle.interfaces import Ros1Service

__all__ = ["run"]

_LOOK_S = 1.0


def run(words: list[str]) -> int:
    """Call a service and print what it answers."""
    parser = option_parser("rosservice", "call /service [args...]")
    add_flag(parser, "-v", dest="verbose", text="print verbose output")
    add_flag(parser, "--nostr", dest="nostr", text="exclude string fields")
    add_flag(parser, "--noarr", dest="noarr", text="exclude arrays")
    add_flag(parser, "--wait", dest="wait", text="wait for service to be advertised")
    options, args = parser.parse_args(words)
    if not args:
        parser.error("service must be specified")
    values = yaml_words(args[1:])
    with joined() as graph:
        name = global_name(args[0], "rosservice")
        kind = _kind(graph, name, wait=options.wait)
        requests: Iterable[Any] = [values]
        if not values and kind._request_class._names:
            if sys.stdin.isatty():
                parser.error("Please specify service arguments")
            requests = documents(sys.stdin)
        _call(graph, name, kind, requests, options)
    return 0


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
        raise ToolError(f"Service [{name}] is not available.{near_services(graph, name)}")
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
