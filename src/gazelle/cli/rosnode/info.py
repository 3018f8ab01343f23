"""``rosnode info``."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator

from gazelle.cli.node_processes import Processes
from gazelle.cli.ros_types import shown_type
from gazelle.cli.tool import add_flag, global_name, hint, joined, option_parser
from gazelle.graph import Endpoint, Entity, Graph, Kind, NodeInfo
from gazelle.graph.graph_info import node_info, nodes_of

__all__ = ["run"]


def run(words: list[str]) -> int:
    """Print topics, services and connections of nodes."""
    parser = option_parser("rosnode", "info [options] node1 [node2...]")
    add_flag(parser, "-q", "--quiet", dest="quiet", text="print only topics and services")
    options, args = parser.parse_args(words)
    if not args:
        parser.error("You must specify at least one node name")
    with joined() as graph:
        for arg in args:
            _print_node(graph, global_name(arg, "rosnode"), quiet=options.quiet)
    return 0


def _print_node(graph: Graph, name: str, *, quiet: bool) -> None:
    entities = graph.entities()
    node = node_info(entities, name)
    print("-" * 80)
    print(_description(name, node))
    if node is None:
        sys.stdout.flush()
        near = hint(name, nodes_of(entities))
        print(f"cannot contact [{name}]: unknown node{near}", file=sys.stderr)
        return
    if quiet:
        return
    processes = Processes(graph, entities)
    uri = processes.uri(name)
    print(f"\ncontacting node {uri or name} ...")
    if not uri:
        sys.stdout.flush()
        print(f"ERROR: Communication with node[{name}] failed!", file=sys.stderr)
        return
    connections = list(_connections(entities, node, processes))
    print(f"Pid: {processes.ask(name)[0]}")
    print("\n".join(["Connections:", *connections, ""] if connections else [""]))


def _description(name: str, node: NodeInfo | None) -> str:
    publications = node.publications if node else ()
    subscriptions = node.subscriptions if node else ()
    services = node.services if node else ()
    return (
        f"Node [{name}]"
        + _block("Publications", [_topic(one) for one in publications])
        + _block("Subscriptions", [_topic(one) for one in subscriptions])
        + _block("Services", [one.name for one in services])
    )


def _block(title: str, items: list[str]) -> str:
    if not items:
        return f"\n{title}: None\n"
    return f"\n{title}: \n" + "\n".join(f" * {item}" for item in items) + "\n"


def _topic(one: Endpoint) -> str:
    return f"{one.name} [{shown_type(one.type_name)}]"


def _connections(entities: Iterable[Entity], node: NodeInfo, processes: Processes) -> Iterator[str]:
    """Yield a block per topic and other end, as the graph shows them."""
    wanted = {
        **{(Kind.SUBSCRIPTION, one.name): "outbound" for one in node.publications},
        **{(Kind.PUBLISHER, one.name): "inbound" for one in node.subscriptions},
    }
    ends = {(one.kind, one.name, one.node): one.zid for one in entities}
    order = {"outbound": 0, "inbound": 1}
    found = [
        (wanted[kind, topic], topic, other, zid)
        for (kind, topic, other), zid in ends.items()
        if (kind, topic) in wanted and other != node.name
    ]
    for direction, topic, other, zid in sorted(found, key=lambda one: (order[one[0]], *one[1:])):
        transport = "INTRAPROCESS" if zid == node.zid else "ZENOH"
        uri = f" ({processes.uri(other)})" if direction == "inbound" else ""
        yield (
            f" * topic: {topic}\n    * to: {other}{uri}\n"
            f"    * direction: {direction}\n    * transport: {transport}"
        )
