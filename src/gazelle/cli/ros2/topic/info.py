"""``ros2 topic info``."""

from __future__ import annotations

import argparse

from gazelle.cli.ros2.graph import graph_of_ros2, types_by_name
from gazelle.cli.ros2.verbs import add_strategy_arguments, fail
from gazelle.cli.tool import hint
from gazelle.graph import Entity, Graph, Kind
from gazelle.graph.key_expressions import entity_gid, token
from gazelle.graph.names import split

__all__ = ["add_arguments", "run"]

_WORDS = {Kind.PUBLISHER: "Publisher", Kind.SUBSCRIPTION: "Subscription"}
_NO_HASH = "INVALID"


def add_arguments(parser: argparse.ArgumentParser) -> None:
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


def run(options: argparse.Namespace) -> int:
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
