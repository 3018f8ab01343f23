"""``rostopic info``, ``rostopic type`` and ``rostopic find``."""

from __future__ import annotations

import sys

from gazelle.cli.node_processes import Processes
from gazelle.cli.ros_types import shown_type, wanted_type
from gazelle.cli.rostopic.topics import find_topic
from gazelle.cli.text.fields import field_type
from gazelle.cli.tool import ToolError, global_name, hint, joined, option_parser

__all__ = ["find", "info", "show_type"]


def info(words: list[str]) -> int:
    """Print type, publishers and subscribers of a topic."""
    parser = option_parser("rostopic", "info /topic")
    _, args = parser.parse_args(words)
    if not args:
        parser.error("you must specify a topic name")
    if len(args) > 1:
        parser.error("you may only specify one topic name")
    name = global_name(args[0], "rostopic")
    with joined() as graph:
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


def show_type(words: list[str]) -> int:
    """Print the type of a topic, or of a field below it."""
    parser = option_parser("rostopic", "type /topic_or_field")
    _, args = parser.parse_args(words)
    if len(args) != 1:
        parser.error("topic must be specified" if not args else "you may only specify one topic")
    word = global_name(args[0], "rostopic")
    with joined() as graph:
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


def find(words: list[str]) -> int:
    """Print the topics of a type."""
    wanted = wanted_type("rostopic", words)
    with joined() as graph:
        print("\n".join(one.name for one in graph.topics() if shown_type(one.type_name) == wanted))
    return 0
