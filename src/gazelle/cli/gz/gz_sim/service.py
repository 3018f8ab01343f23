"""``gz service``: services of the graph, and those of a world in the new Gazebo."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from gazelle.cli.gz.gz_sim.message_types import message_of, text_fields
from gazelle.cli.gz.gz_sim.world_services import WORLD_SERVICES
from gazelle.cli.gz.options import GzCommand, GzError, GzOption, number
from gazelle.cli.gz.protobuf_text import protobuf_text, read_protobuf_text
from gazelle.cli.gz.world_link import WorldLink, world_link
from gazelle.cli.node_processes import Processes
from gazelle.cli.ros_types import learn_workspace_types
from gazelle.diagnostics import did_you_mean
from gazelle.graph import ServiceInfo
from gazelle.graph.gazebo_names import offered_name
from gazelle.graph.names import is_hidden
from gazelle.interfaces import service_type, to_plain

__all__ = ["COMMAND", "run"]

COMMAND = GzCommand(
    "service",
    "Print information about services, or call one: the services of ROS, and a\n\tworld's "
    "/world/NAME/" + ", ".join(WORLD_SERVICES) + ".",
    (
        GzOption("service", "s", "Name of a service.", takes=True),
        GzOption("list", "l", "List all services."),
        GzOption("info", "i", "Get info about a service (-s)."),
        GzOption("req", "r", "Call with this request, in protobuf's text format.", takes=True),
        GzOption("reqtype", "", "Type of the request.", takes=True),
        GzOption("reptype", "", "Type of the response.", takes=True),
        GzOption("timeout", "", "Timeout in milliseconds.", takes=True),
    ),
)
_OF_WORLD = re.compile(r"/world/([^/]+)/(\w+)")
_CALL_MS = 60_000.0


def run(options: Mapping[str, str]) -> int:
    """List services, show one or call one.

    Raises:
        GzError: options do not go together, the service is unknown or refuses.
    """
    name = options.get("service", "")
    if "list" not in options and not name:
        raise GzError("-s SERVICE names the service; see gz help service")
    if "list" not in options and not {"info", "req"} & options.keys():
        raise GzError("-i or --req says what to do with the service")
    with world_link() as link:
        learn_workspace_types()
        if "list" in options:
            names = [one.name for one in link.graph.services() if not is_hidden(one.name)]
            print("\n".join(sorted({*names, *_of_worlds(link)})))
        elif "info" in options:
            _info(link, name)
        else:
            _call(link, name, options)
    return 0


def _of_worlds(link: WorldLink) -> list[str]:
    """A world answers to any name; the list has the one that its topics have."""
    if not link.graph.has_service(offered_name(link.graph, "/gazebo/control_world")):
        return []
    topics = (_OF_WORLD.match(one.name) for one in link.graph.topics())
    world = next((found.group(1) for found in topics if found), "default")
    return [f"/world/{world}/{name}" for name in WORLD_SERVICES]


def _info(link: WorldLink, name: str) -> None:
    part = _part_of_world(name)
    if part in WORLD_SERVICES:
        _print_info("/gazebo", f"gz.msgs.{WORLD_SERVICES[part].request}", "gz.msgs.Boolean")
        return
    service = _find(link, name)
    processes = Processes(link.graph)
    for node in service.servers:
        kind = service.type_name
        _print_info(f"{processes.uri(node)} {node}", f"{kind}_Request", f"{kind}_Response")


def _print_info(address: str, request: str, response: str) -> None:
    print("Service providers [Address, Request Message Type, Response Message Type]:")
    print(f"  {address}, {request}, {response}")


def _call(link: WorldLink, name: str, options: Mapping[str, str]) -> None:
    fields = read_protobuf_text(options["req"])
    part = _part_of_world(name)
    if part in WORLD_SERVICES:
        own = WORLD_SERVICES[part]
        own.check_type(options.get("reqtype", ""))
        own.call(link, fields)
        print("data: true\n")
        return
    type_name = _find(link, name).type_name
    kind: Any = service_type(type_name)
    request = message_of(f"{type_name}_Request", fields)
    client = link.node.create_client(name, kind)
    response = client.call(request, number(options, "timeout", _CALL_MS) / 1e3)
    print(protobuf_text(text_fields(to_plain(response))))


def _part_of_world(name: str) -> str:
    found = _OF_WORLD.fullmatch(name)
    return found.group(2) if found else ""


def _find(link: WorldLink, name: str) -> ServiceInfo:
    """Return a service of the graph.

    Raises:
        GzError: there is none of the name.
    """
    services = {one.name: one for one in link.graph.services(include_hidden=True)}
    if name in services:
        return services[name]
    if _part_of_world(name):
        hint = f"of a world's services there are {', '.join(WORLD_SERVICES)}"
    else:
        hint = did_you_mean(name, services) or "gz service -l names those there are"
    raise GzError(f"no service providers on service [{name}]; {hint}")
