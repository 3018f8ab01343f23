"""``ros2 lifecycle``: states of managed nodes."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from gazelle.cli.ros2.graph import absolute, call_service, cli_node, graph_of_ros2, nodes_offering
from gazelle.cli.ros2.verbs import Command, Verb, add_strategy_arguments, fail, run_command
from gazelle.cli.ros_tool import ToolError, hint
from gazelle.graph import Entity, Node

__all__ = ["add_arguments_get", "add_arguments_list", "add_arguments_nodes", "add_arguments_set"]
__all__ += ["main", "run_get", "run_list", "run_nodes", "run_set"]

_VERBS = {
    "get": Verb("Get lifecycle state for one or more nodes", __name__),
    "list": Verb("Output a list of available transitions", __name__),
    "nodes": Verb("Output a list of nodes with lifecycle", __name__),
    "set": Verb("Trigger lifecycle state transition", __name__),
}
_STATE = {"get_state": "lifecycle_msgs/srv/GetState"}
_TRANSITIONS = "lifecycle_msgs/srv/GetAvailableTransitions"
_Parser = argparse.ArgumentParser


def main(argv: list[str]) -> int:
    """Run a verb of ``ros2 lifecycle``."""
    about = "Various lifecycle related sub-commands"
    return run_command(Command("lifecycle", about, _VERBS), argv)


def add_arguments_nodes(parser: _Parser) -> None:
    """Add what ``nodes`` takes."""
    add_strategy_arguments(parser)
    add = parser.add_argument
    add("-a", "--all", action="store_true", help="Display all nodes even hidden ones")
    text = "Only display the number of nodes discovered"
    add("-c", "--count-nodes", action="store_true", help=text)


def run_nodes(options: argparse.Namespace) -> int:
    """Print the names of the managed nodes."""
    with graph_of_ros2() as graph:
        names = nodes_offering(graph.entities(), _STATE, include_hidden=options.all)
    if options.count_nodes:
        print(len(names))
        return 0
    for name in names:
        print(name)
    return 0


def add_arguments_get(parser: _Parser) -> None:
    """Add what ``get`` takes."""
    _add_common(parser)
    text = "Name of the ROS node. If no name is provided, then get the state for all nodes."
    parser.add_argument("node_name", nargs="?", help=text)


def run_get(options: argparse.Namespace) -> int:
    """Print the state of one node, or of all."""
    failed = 0
    with graph_of_ros2() as graph:
        names = _names(graph.entities(), options)
        node, _ = cli_node(graph, options)
        for name in names:
            try:
                state = call_service(node, f"{name}/get_state", *_STATE.values()).current_state
            except ToolError as error:
                fail(f"Exception while calling service of node '{name}': {error}")
                failed = int(bool(options.node_name))
                continue
            prefix = "" if options.node_name else f"{name}: "
            print(f"{prefix}{state.label} [{state.id}]")
    return failed


def add_arguments_list(parser: _Parser) -> None:
    """Add what ``list`` takes."""
    _add_common(parser)
    parser.add_argument("node_name", help="Name of the ROS node")
    text = "Display all existing transitions"
    parser.add_argument("-a", "--all", action="store_true", help=text)


def run_list(options: argparse.Namespace) -> int:
    """Print the transitions that a node can make now, or all it knows."""
    service = "get_transition_graph" if options.all else "get_available_transitions"
    with graph_of_ros2() as graph:
        (name,) = _names(graph.entities(), options)
        node, _ = cli_node(graph, options)
        for one in _transitions(node, name, service):
            print(
                f"- {one.transition.label} [{one.transition.id}]\n"
                f"\tStart: {one.start_state.label}\n\tGoal: {one.goal_state.label}"
            )
    return 0


def add_arguments_set(parser: _Parser) -> None:
    """Add what ``set`` takes."""
    _add_common(parser)
    parser.add_argument("node_name", help="Name of the ROS node")
    parser.add_argument("transition", help="The lifecycle transition")


def run_set(options: argparse.Namespace) -> int:
    """Let a node make a transition, named by its label or number."""
    with graph_of_ros2() as graph:
        (name,) = _names(graph.entities(), options)
        node, _ = cli_node(graph, options)
        rows = [one.transition for one in _transitions(node, name, "get_available_transitions")]
        wanted = options.transition
        found = [one for one in rows if one.label == wanted]
        found += [one for one in rows if str(one.id) == wanted]
        if not found:
            known = "".join(f"\n- {one.label} [{one.id}]" for one in rows)
            return fail(f"Unknown transition requested, available ones are:{known}")
        service, kind = f"{name}/change_state", "lifecycle_msgs/srv/ChangeState"
        try:
            answer = call_service(node, service, kind, transition=found[0])
        except ToolError as error:
            fail(f"Exception while calling service of node '{name}': {error}")
            return 0
    if answer.success:
        print("Transitioning successful")
    else:
        print("Transitioning failed", file=sys.stderr)
    return 0


def _names(entities: tuple[Entity, ...], options: argparse.Namespace) -> list[str]:
    """Return the managed node that is meant, or all."""
    there = nodes_offering(entities, _STATE, include_hidden=options.include_hidden_nodes)
    if not options.node_name:
        return there
    name = absolute(options.node_name)
    if name not in there:
        known = {one.node for one in entities}
        why = "\n  the node is there and has no lifecycle" if name in known else ""
        raise ToolError(f"Node not found{why or hint(name, there)}")
    return [name]


def _transitions(node: Node, name: str, service: str) -> list[Any]:
    try:
        answer = call_service(node, f"{name}/{service}", _TRANSITIONS)
    except ToolError as error:
        raise ToolError(f"Exception while calling service of node '{name}': {error}") from None
    return list(answer.available_transitions)


def _add_common(parser: _Parser) -> None:
    add_strategy_arguments(parser)
    text = "Consider hidden nodes as well"
    parser.add_argument("--include-hidden-nodes", action="store_true", help=text)
