"""``ros2 node``: the nodes of the graph."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable

from gazelle.cli.ros2.graph import graph_of_ros2, types_by_name
from gazelle.cli.ros2.verbs import Command, Verb, add_strategy_arguments, fail, run_command
from gazelle.cli.ros_tool import hint
from gazelle.graph import Kind
from gazelle.graph.actions.action_info import ActionInfo, actions_of
from gazelle.graph.names import is_hidden

__all__ = ["add_arguments_info", "add_arguments_list", "main", "run_info", "run_list"]

_VERBS = {
    "info": Verb("Output information about a node", __name__),
    "list": Verb("Output a list of available nodes", __name__),
}
_BLOCKS = (
    ("Subscribers", Kind.SUBSCRIPTION),
    ("Publishers", Kind.PUBLISHER),
    ("Service Servers", Kind.SERVICE),
    ("Service Clients", Kind.CLIENT),
)


def main(argv: list[str]) -> int:
    """Run a verb of ``ros2 node``."""
    return run_command(Command("node", "Various node related sub-commands", _VERBS), argv)


def add_arguments_list(parser: argparse.ArgumentParser) -> None:
    """Add what ``list`` takes."""
    add_strategy_arguments(parser)
    add = parser.add_argument
    add("-a", "--all", action="store_true", help="Display all nodes even hidden ones")
    text = "Only display the number of nodes discovered"
    add("-c", "--count-nodes", action="store_true", help=text)


def run_list(options: argparse.Namespace) -> int:
    """Print the names of the nodes."""
    with graph_of_ros2() as graph:
        nodes = [one.node for one in graph.entities() if one.kind is Kind.NODE]
    names = sorted(name for name in nodes if options.all or not is_hidden(name))
    if options.count_nodes:
        print(len(names))
        return 0
    if len(set(names)) < len(names):
        print(
            "WARNING: Be aware that there are nodes in the graph that share an exact name, which "
            "can have unintended side effects.",
            file=sys.stderr,
        )
    for name in names:
        print(name)
    return 0


def add_arguments_info(parser: argparse.ArgumentParser) -> None:
    """Add what ``info`` takes."""
    add_strategy_arguments(parser)
    parser.add_argument("node_name", help="Fully qualified node name to request information")
    parser.add_argument(
        "--include-hidden",
        action="store_true",
        help="Display hidden topics, services, and actions as well",
    )


def run_info(options: argparse.Namespace) -> int:
    """Print what a node offers and uses."""
    name, hidden = options.node_name, options.include_hidden
    with graph_of_ros2() as graph:
        entities = graph.entities()
    nodes = [one.node for one in entities if one.kind is Kind.NODE]
    shown = [node for node in nodes if hidden or not is_hidden(node)]
    if name not in shown:
        return fail(f"Unable to find node '{name}'{hint(name, shown)}")
    if shown.count(name) > 1:
        print(
            f'There are {shown.count(name)} nodes in the graph with the exact name "{name}". '
            "You are seeing information about only one of them.",
            file=sys.stderr,
        )
    own = [one for one in entities if one.node == name]
    print(name)
    for title, kind in _BLOCKS:
        print(f"  {title}:")
        _print_types(types_by_name(own, (kind,), include_hidden=hidden))
    actions = [one for one in actions_of(entities) if hidden or not is_hidden(one.name)]
    print("  Action Servers:")
    _print_types(_actions_of(name, ((one, one.servers) for one in actions)))
    print("  Action Clients:")
    _print_types(_actions_of(name, ((one, one.clients) for one in actions)))
    return 0


def _actions_of(
    node: str, ends: Iterable[tuple[ActionInfo, tuple[str, ...]]]
) -> dict[str, tuple[str, ...]]:
    return {one.name: (one.type_name,) for one, nodes in ends if node in nodes}


def _print_types(types: dict[str, tuple[str, ...]]) -> None:
    """An empty block is an empty line, as in the original."""
    print("\n".join(f"    {name}: {', '.join(type_names)}" for name, type_names in types.items()))
