"""``ros2 component list``, ``load`` and ``unload``: what containers on the graph do."""

from __future__ import annotations

import argparse
from typing import Any

from gazelle.cli.ros2.calls import call_service, nodes_offering
from gazelle.cli.ros2.component.types import add_component_arguments, instead_of
from gazelle.cli.ros2.graph import cli_node, graph_of_ros2
from gazelle.cli.ros2.verbs import add_strategy_arguments, fail
from gazelle.cli.text.fill_message import yaml_words
from gazelle.cli.tool import ToolError, hint
from gazelle.graph import Graph, Node
from gazelle.graph.ros2_parameter_values import value_message
from gazelle.interfaces import message_type

__all__ = ["add_arguments_list", "add_arguments_load", "add_arguments_unload"]
__all__ += ["run_list", "run_load", "run_unload"]

_KINDS = {
    "_container/load_node": "composition_interfaces/srv/LoadNode",
    "_container/unload_node": "composition_interfaces/srv/UnloadNode",
    "_container/list_nodes": "composition_interfaces/srv/ListNodes",
}
_NO_CONTAINERS = "\n  there is none; start one: ros2 run rclcpp_components component_container"
_Parser = argparse.ArgumentParser


def add_arguments_list(parser: _Parser) -> None:
    """Add what ``list`` takes."""
    add_strategy_arguments(parser)
    text = "Name of the container node to list components from"
    parser.add_argument("container_node_name", nargs="?", help=text)
    text = "List found containers nodes only"
    parser.add_argument("--containers-only", action="store_true", help=text)


def run_list(options: argparse.Namespace) -> int:
    """Print the containers and the components in them."""
    with graph_of_ros2() as graph:
        chosen = options.container_node_name
        names = [_container(graph, chosen)] if chosen else _containers(graph)
        node, _ = cli_node(graph, options)
        for name in names:
            if not chosen:
                print(name)
            for row in () if options.containers_only else _components(node, name):
                print(row if chosen else f"  {row}")
    return 0


def add_arguments_load(parser: _Parser) -> None:
    """Add what ``load`` takes."""
    add_strategy_arguments(parser)
    parser.add_argument("container_node_name", help="Container node name to load component into")
    add_component_arguments(parser)
    text = "Only print component unique IDs and names"
    parser.add_argument("-q", "--quiet", action="store_true", help=text)


def run_load(options: argparse.Namespace) -> int:
    """Load a component into a container."""
    with graph_of_ros2() as graph:
        try:
            name = _container(graph, options.container_node_name)
        except ToolError as error:
            return fail(f"{error}{instead_of(options.package_name, options.plugin_name)}")
        node, _ = cli_node(graph, options)
        answer = _call(
            node,
            name,
            "load_node",
            package_name=options.package_name,
            plugin_name=options.plugin_name,
            node_name=options.node_name,
            node_namespace=options.node_namespace,
            log_level=options.log_level,
            remap_rules=options.remap_rules,
            parameters=_parameters(options.parameters),
            extra_arguments=_parameters(options.extra_arguments),
        )
    if not answer.success:
        return fail(f"Failed to load component: {answer.error_message.capitalize()}")
    if options.quiet:
        print(f"{answer.unique_id}  {answer.full_node_name}")
    else:
        print(
            f"Loaded component {answer.unique_id} into '{name}' container node as "
            f"'{answer.full_node_name}'"
        )
    return 0


def add_arguments_unload(parser: _Parser) -> None:
    """Add what ``unload`` takes."""
    add_strategy_arguments(parser)
    add = parser.add_argument
    add("container_node_name", help="Container node name to unload component from")
    text = "Unique ID of the component to be unloaded"
    add("component_uid", type=int, nargs="+", help=text)
    add("-q", "--quiet", action="store_true", help="Only print component unique IDs")


def run_unload(options: argparse.Namespace) -> int:
    """Take components out of a container."""
    with graph_of_ros2() as graph:
        name = _container(graph, options.container_node_name)
        node, _ = cli_node(graph, options)
        for uid in options.component_uid:
            answer = _call(node, name, "unload_node", unique_id=uid)
            if not answer.success:
                return fail(
                    f"Failed to unload component {uid} from '{name}' container node\n"
                    f"    {answer.error_message.capitalize()}"
                )
            text = f"Unloaded component {uid} from '{name}' container node"
            print(uid if options.quiet else text)
    return 0


def _containers(graph: Graph) -> list[str]:
    return nodes_offering(graph.entities(), _KINDS)


def _container(graph: Graph, name: str) -> str:
    there = _containers(graph)
    if name not in there:
        why = hint(name, there) if there else _NO_CONTAINERS
        raise ToolError(f"Unable to find container node '{name}'{why}")
    return name


def _components(node: Node, container: str) -> list[str]:
    answer = _call(node, container, "list_nodes")
    pairs = zip(answer.unique_ids, answer.full_node_names, strict=False)
    return [f"{uid}  {name}" for uid, name in pairs]


def _call(node: Node, container: str, name: str, **fields: Any) -> Any:
    short = f"_container/{name}"
    return call_service(node, f"{container}/{short}", _KINDS[short], **fields)


def _parameters(words: list[str]) -> list[Any]:
    kind = message_type("rcl_interfaces/msg/Parameter")
    pairs = (word.partition(":=") for word in words)
    return [kind(name=name, value=value_message(yaml_words([text])[0])) for name, _, text in pairs]
