"""``rostopic list``, ``info``, ``type`` and ``find``."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from functools import partial
from typing import NamedTuple

from gazelle.cli.node_processes import Processes
from gazelle.cli.ros_tool import ToolError, add_flag, global_name, hint, join_graph, option_parser
from gazelle.cli.ros_types import shown_type, wanted_type
from gazelle.cli.rostopic.topics import find_topic
from gazelle.cli.text.fields import field_type
from gazelle.graph import Graph, TopicInfo

__all__ = ["find", "info", "run", "show_type"]


class _Use(NamedTuple):
    """A topic as publishers, or as subscribers, see it: name, type and nodes, each once."""

    name: str
    type_name: str
    nodes: tuple[str, ...]


def info(argv: list[str]) -> int:
    """Print type, publishers and subscribers of a topic."""
    parser = option_parser("rostopic", "info /topic")
    _, args = parser.parse_args(argv)
    if not args:
        parser.error("you must specify a topic name")
    if len(args) > 1:
        parser.error("you may only specify one topic name")
    name = global_name(args[0], "rostopic")
    with join_graph() as graph:
        topics = {one.name: one for one in graph.topics(include_hidden=True)}
        topic = topics.get(name)
        if topic is None:
            raise ToolError(f"Unknown topic {name}{hint(name, list(topics))}")
        processes = Processes(graph)
        print(f"Type: {shown_type(topic.type_name)}\n")
        for title, nodes in (
            ("Publishers", topic.publishers),
            ("Subscribers", topic.subscriptions),
        ):
            print(f"{title}: " if nodes else f"{title}: None")
            for node in dict.fromkeys(nodes):
                print(f" * {node} ({processes.uri(node) or f'unknown address {node}'})")
            print()
        print()
    return 0


def show_type(argv: list[str]) -> int:
    """Print the type of a topic, or of a field below it."""
    parser = option_parser("rostopic", "type /topic_or_field")
    _, args = parser.parse_args(argv)
    if len(args) != 1:
        parser.error("topic must be specified" if not args else "you may only specify one topic")
    word = global_name(args[0], "rostopic")
    with join_graph() as graph:
        entities = graph.entities()
        found = find_topic(entities, word)
        if found is None:
            names = [one.name for one in graph.topics()]
            print(f"unknown topic type [{word}]{hint(word, names)}", file=sys.stderr)
            return 1
        if not found.steps:
            print(found.type_name)
            return 0
        field = word[len(found.name) + 1 :]
        print(f"{found.type_name} {field} {field_type(found.type_name, found.steps)}")
    return 0


def find(argv: list[str]) -> int:
    """Print the topics of a type."""
    wanted = wanted_type("rostopic", argv)
    with join_graph() as graph:
        print("\n".join(one.name for one in graph.topics() if shown_type(one.type_name) == wanted))
    return 0


def run(argv: list[str]) -> int:
    """Print the names of topics, or with ``-v`` their types and how many nodes use them."""
    parser = option_parser("rostopic", "list [/namespace]")
    add, flag = parser.add_option, partial(add_flag, parser)
    add("-b", "--bag", dest="bag", metavar="BAGFILE", help="list topics in .bag file")
    flag("-v", "--verbose", dest="verbose", text="list full details about each topic")
    flag("-p", dest="publishers", text="list only publishers")
    flag("-s", dest="subscribers", text="list only subscribers")
    flag("--host", dest="host", text="group by host name")
    options, args = parser.parse_args(argv)
    if len(args) > 1:
        parser.error("you may only specify one input topic")
    if options.publishers and options.subscribers:
        parser.error("you may only specify one of -p, -s")
    if options.bag:
        from gazelle.cli.rostopic.bag import list_bag

        return list_bag(options.bag, global_name(args[0], "rostopic") if args else "")
    with join_graph() as graph:
        topics = graph.topics()
        if args:
            topics = _below(topics, global_name(args[0], "rostopic"))
        published = [] if options.subscribers else _uses(topics, "publishers")
        subscribed = [] if options.publishers else _uses(topics, "subscriptions")
        shown = (not options.subscribers, not options.publishers)
        if options.host:
            _print_by_host(graph, published, subscribed, shown, verbose=options.verbose)
        else:
            _print(published, subscribed, shown, verbose=options.verbose)
    return 0


def _below(topics: Iterable[TopicInfo], namespace: str) -> tuple[TopicInfo, ...]:
    start = namespace.rstrip("/") + "/"
    return tuple(one for one in topics if one.name == namespace or one.name.startswith(start))


def _uses(topics: Iterable[TopicInfo], end: str) -> list[_Use]:
    found = []
    for one in topics:
        nodes = tuple(dict.fromkeys(getattr(one, end)))
        if nodes:
            found.append(_Use(one.name, shown_type(one.type_name), nodes))
    return found


def _print(
    published: list[_Use],
    subscribed: list[_Use],
    shown: tuple[bool, bool],
    *,
    verbose: bool,
    indent: str = "",
) -> None:
    if not verbose:
        names = sorted({one.name for one in (*published, *subscribed)})
        print("\n".join(indent + name for name in names))
        return
    if shown[0]:
        print(f"\n{indent}Published topics:")
        _print_uses(published, "publisher", indent)
    if shown[1]:
        print(f"{indent}\n{indent}Subscribed topics:")
        _print_uses(subscribed, "subscriber", indent)
    print()


def _print_uses(uses: list[_Use], word: str, indent: str) -> None:
    for one in uses:
        count = len(one.nodes)
        plural = "s" if count > 1 else ""
        print(f"{indent} * {one.name} [{one.type_name}] {count} {word}{plural}")


def _print_by_host(
    graph: Graph,
    published: list[_Use],
    subscribed: list[_Use],
    shown: tuple[bool, bool],
    *,
    verbose: bool,
) -> None:
    processes = Processes(graph)
    nodes = {node for one in (*published, *subscribed) for node in one.nodes}
    for host in sorted({processes.ask(node)[1] or "unknown address" for node in nodes}):
        here = {node for node in nodes if (processes.ask(node)[1] or "unknown address") == host}
        print(f"Host [{host}]:")
        _print(
            _of_nodes(published, here),
            _of_nodes(subscribed, here),
            shown,
            verbose=verbose,
            indent="  ",
        )


def _of_nodes(uses: list[_Use], nodes: set[str]) -> list[_Use]:
    kept = (one._replace(nodes=tuple(node for node in one.nodes if node in nodes)) for one in uses)
    return [one for one in kept if one.nodes]
