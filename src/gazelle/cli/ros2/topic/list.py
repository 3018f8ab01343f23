"""``ros2 topic list``, ``info``, ``type`` and ``find``."""

from __future__ import annotations

import argparse
import sys

from gazelle.cli.ros2.graph import graph_of_ros2, types_by_name
from gazelle.cli.ros2.verbs import add_strategy_arguments, fail
from gazelle.cli.ros_tool import hint
from gazelle.graph import Entity, Graph, Kind
from gazelle.graph.key_expressions import entity_gid, token
from gazelle.graph.names import split
from gazelle.interfaces import wire_type

__all__ = [
    "add_arguments_find",
    "add_arguments_info",
    "add_arguments_list",
    "add_arguments_type",
    "run_info",
]

_WORDS = {Kind.PUBLISHER: "Publisher", Kind.SUBSCRIPTION: "Subscription"}
_NO_HASH = "INVALID"
__all__ += ["run_find", "run_list", "run_type"]
_ENDS = (Kind.PUBLISHER, Kind.SUBSCRIPTION)
_Parser = argparse.ArgumentParser


def add_arguments_info(parser: argparse.ArgumentParser) -> None:
    """Add what ``info`` takes."""
    add_strategy_arguments(parser)
    parser.add_argument("topic_name", help="Name of the ROS topic to get info (e.g. '/chatter')")
    parser.add_argument(
        "--verbose",
        "-v",
        action="store_true",
        help="Prints detailed information like the node name, node namespace, topic type, "
        "topic type hash, GUID, and QoS Profile of the publishers and subscribers to this topic",
    )


def run_info(options: argparse.Namespace) -> int:
    """Print a topic's type, and how many publish and subscribe it, or who."""
    with graph_of_ros2() as graph:
        entities = graph.entities()
        topics = types_by_name(entities, _WORDS)
        types = topics.get(options.topic_name)
        if types is None:
            near = hint(options.topic_name, topics)
            return fail(f"Unknown topic '{options.topic_name}'{near}")
        end = "\n\n" if options.verbose else "\n"
        print(f"Type: {types[0] if len(types) == 1 else list(types)}", end=end)
        for kind, word in _WORDS.items():
            own = [one for one in entities if one.kind is kind and one.name == options.topic_name]
            print(f"{word} count: {len(own)}", end=end)
            for one in own if options.verbose else ():
                print(_block(graph, one), end=end)
    return 0


def add_arguments_list(parser: _Parser) -> None:
    """Add what ``list`` takes."""
    add_strategy_arguments(parser)
    add = parser.add_argument
    add("-t", "--show-types", action="store_true", help="Additionally show the topic type")
    _add_count_and_hidden(parser)
    add("-v", "--verbose", action="store_true", help="List full details about each topic")


def run_list(options: argparse.Namespace) -> int:
    """Print the names of the topics."""
    with graph_of_ros2() as graph:
        entities = graph.entities()
    topics = types_by_name(entities, _ENDS, include_hidden=options.include_hidden_topics)
    if options.count_topics:
        print(len(topics))
    elif options.verbose and topics:
        print(_uses(entities, topics, Kind.PUBLISHER))
        print(_uses(entities, topics, Kind.SUBSCRIPTION))
    else:
        for name, types in topics.items():
            print(f"{name} [{', '.join(types)}]" if options.show_types else name)
    return 0


def add_arguments_type(parser: _Parser) -> None:
    """Add what ``type`` takes."""
    add_strategy_arguments(parser)
    parser.add_argument("topic_name", help="Name of the ROS topic to get type (e.g. '/chatter')")


def run_type(options: argparse.Namespace) -> int:
    """Print the types of a topic."""
    with graph_of_ros2() as graph:
        topics = _all_topics(graph)
    for one in topics.get(options.topic_name, ()):
        print(one)
    if options.topic_name in topics:
        return 0
    near = hint(options.topic_name, topics).strip()
    print(f"there is no topic '{options.topic_name}'; {near}".rstrip("; "), file=sys.stderr)
    return 1


def add_arguments_find(parser: _Parser) -> None:
    """Add what ``find`` takes."""
    add_strategy_arguments(parser)
    parser.add_argument(
        "topic_type", help="Name of the ROS topic type to filter for (e.g. 'std_msgs/msg/String')"
    )
    _add_count_and_hidden(parser)


def run_find(options: argparse.Namespace) -> int:
    """Print the topics of a type."""
    with graph_of_ros2() as graph:
        topics = types_by_name(
            graph.entities(), _ENDS, include_hidden=options.include_hidden_topics
        )
    found = [name for name, types in topics.items() if options.topic_type in types]
    if options.count_topics:
        print(len(found))
        return 0
    for name in found:
        print(name)
    if not found:
        _explain_none(options.topic_type, {one for types in topics.values() for one in types})
    return 0


def _block(graph: Graph, one: Entity) -> str:
    """What is known of one end, in the words of rclpy's ``TopicEndpointInfo``."""
    namespace, name = split(one.node)
    gid = entity_gid(token(graph.domain, one))
    qos = one.qos
    return "\n".join(
        [
            f"Node name: {name}",
            f"Node namespace: {namespace}",
            f"Topic type: {one.type_name}",
            f"Topic type hash: {one.type_hash if one.type_hash.startswith('RIHS') else _NO_HASH}",
            f"Endpoint type: {_WORDS[one.kind].upper()}",
            f"GID: {'.'.join(f'{byte:02x}' for byte in gid)}",
            "QoS profile:",
            f"  Reliability: {'RELIABLE' if qos.reliable else 'BEST_EFFORT'}",
            f"  History (Depth): {f'KEEP_LAST ({qos.depth})' if qos.depth else 'KEEP_ALL'}",
            f"  Durability: {'TRANSIENT_LOCAL' if qos.latched else 'VOLATILE'}",
            f"  Lifespan: {_limit(qos.lifespan_ns)}",
            f"  Deadline: {_limit(qos.deadline_ns)}",
            f"  Liveliness: {'MANUAL_BY_TOPIC' if qos.manual else 'AUTOMATIC'}",
            f"  Liveliness lease duration: {_limit(qos.lease_ns)}",
        ]
    )


def _limit(limit_ns: int) -> str:
    return f"{limit_ns} nanoseconds" if limit_ns else "Infinite"


def _explain_none(wanted: str, there: set[str]) -> None:
    full = wire_type(wanted) if wanted.count("/") == 1 else wanted
    near = f"the full name is '{full}'" if full in there else hint(wanted, there).strip()
    print(f"no topic has the type '{wanted}'; {near}".rstrip("; "), file=sys.stderr)


def _add_count_and_hidden(parser: _Parser) -> None:
    add = parser.add_argument
    add(
        "-c",
        "--count-topics",
        action="store_true",
        help="Only display the number of topics discovered",
    )
    # The command has the option too; what stands in front of the verb must survive.
    add(
        "--include-hidden-topics",
        action="store_true",
        default=argparse.SUPPRESS,
        help="Consider hidden topics as well",
    )


def _all_topics(graph: Graph) -> dict[str, tuple[str, ...]]:
    return types_by_name(graph.entities(), _ENDS)


def _uses(entities: tuple[Entity, ...], topics: dict[str, tuple[str, ...]], kind: Kind) -> str:
    word = "publisher" if kind is Kind.PUBLISHER else "subscriber"
    text = f"{'Published' if kind is Kind.PUBLISHER else 'Subscribed'} topics:\n"
    for name, types in topics.items():
        count = sum(one.kind is kind and one.name == name for one in entities)
        if count:
            plural = "s" if count > 1 else ""
            text += f" * {name} [{', '.join(types)}] {count} {word}{plural}\n"
    return text
