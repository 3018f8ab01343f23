"""Checks of a running graph: the rules of ``roswtf`` and of its plug-in for tf."""

from __future__ import annotations

import threading
from collections import defaultdict

from gazelle.cli.node_processes import Processes
from gazelle.cli.roswtf.findings import Findings
from gazelle.graph import Entity, Graph, Kind
from gazelle.graph.tf import TransformBuffer, TransformListener

__all__ = ["look_at_graph"]

_LISTEN_S = 1.0
_OWN = "/roswtf"
_ANY = "*"
# They come and go with ROS itself; a clock that is missing has a rule of its own.
_NEVER_MISSED = ("/rosout", "/rosout_agg", "/parameter_events", "/clock")


def look_at_graph(graph: Graph, listen_s: float = _LISTEN_S) -> Findings:
    """Apply every rule; listens to tf for a moment.

    Args:
        graph: the graph.
        listen_s: how long.
    """
    found = Findings()
    entities = [one for one in graph.entities() if not one.node.startswith(_OWN)]
    _unconnected(entities, found)
    _simulated_time(graph, entities, found)
    _silent_nodes(graph, entities, found)
    _types(entities, found)
    _services(entities, found)
    _frames(graph, found, listen_s)
    return found


def _unconnected(entities: list[Entity], found: Findings) -> None:
    published = {one.name for one in entities if one.kind is Kind.PUBLISHER}
    by_node: dict[str, set[str]] = defaultdict(set)
    for one in entities:
        if one.kind is Kind.SUBSCRIPTION and one.name not in {*published, *_NEVER_MISSED}:
            by_node[one.node].add(one.name)
    lines = []
    for node, topics in sorted(by_node.items()):
        lines += [f" * {node}:", *(f"   * {topic}" for topic in sorted(topics))]
    found.warn("The following node subscriptions are unconnected:", lines)


def _simulated_time(graph: Graph, entities: list[Entity], found: Findings) -> None:
    is_simulated = graph.parameters.get("/use_sim_time", False) is True
    clocks = [one for one in entities if one.kind is Kind.PUBLISHER and one.name == "/clock"]
    if is_simulated and not clocks:
        found.warnings.append("/use_sim_time is set but no publisher of /clock is present")


def _silent_nodes(graph: Graph, entities: list[Entity], found: Findings) -> None:
    processes = Processes(graph, entities)
    silent = [name for name in sorted(processes.zid_of) if not processes.ask(name)[0]]
    title = "Could not contact the following nodes:"
    found.blame(title, [f" * {name}" for name in silent])


def _types(entities: list[Entity], found: Findings) -> None:
    types: dict[str, dict[str, set[str]]] = defaultdict(lambda: defaultdict(set))
    for one in entities:
        if one.kind in (Kind.PUBLISHER, Kind.SUBSCRIPTION) and one.type_name != _ANY:
            types[one.name][one.type_name].add(one.node)
    lines = [
        f" * topic [{topic}] is {kind} for {', '.join(sorted(nodes))}"
        for topic, kinds in sorted(types.items())
        if len(kinds) > 1
        for kind, nodes in sorted(kinds.items())
    ]
    found.blame("Nodes disagree about the types of topics, so they hear nothing:", lines)


def _services(entities: list[Entity], found: Findings) -> None:
    servers: dict[str, list[str]] = defaultdict(list)
    for one in entities:
        if one.kind is Kind.SERVICE:
            servers[one.name].append(one.node)
    lines = [
        f" * service [{name}] is provided by {', '.join(sorted(nodes))}"
        for name, nodes in sorted(servers.items())
        if len(nodes) > 1
    ]
    found.warn("The following services have several providers; one of them answers:", lines)


def _frames(graph: Graph, found: Findings, listen_s: float) -> None:
    node = graph.create_node(_OWN.strip("/"), anonymous=True, rosout=False)
    told: list[str] = []
    buffer = TransformBuffer(on_warning=told.append)
    listener = TransformListener(buffer, node)
    threading.Event().wait(listen_s)
    listener.close()
    found.blame("TF problems:", [f" * {text}" for text in told])
    roots = {one.parent for one in buffer.frames()} - {one.name for one in buffer.frames()}
    if len(roots) > 1:
        title = "TF: there are several trees, and no transforms between them; their roots:"
        found.warn(title, [f" * {name}" for name in sorted(roots)])
    node.shutdown()
