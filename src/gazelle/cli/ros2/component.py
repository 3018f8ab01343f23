"""``ros2 component``: components of C++ in containers."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from typing import Any

from gazelle.cli.ros2.graph import call_service, cli_node, graph_of_ros2, nodes_offering
from gazelle.cli.ros2.verbs import (
    Command,
    Verb,
    add_direct_arguments,
    add_strategy_arguments,
    fail,
    run_command,
)
from gazelle.cli.ros_tool import ToolError, hint
from gazelle.cli.text.fill_message import yaml_words
from gazelle.errors import GraphError
from gazelle.graph import Graph, Node
from gazelle.graph.ros2_parameter_values import value_message
from gazelle.interfaces import message_type, service_type
from gazelle.node_specs.registry import builtin_executables, executable_of_component
from gazelle.workspace import Workspace

__all__ = [
    "add_arguments_list",
    "add_arguments_load",
    "add_arguments_standalone",
    "add_arguments_types",
    "add_arguments_unload",
    "add_component_arguments",
    "instead_of",
    "main",
    "run_list",
    "run_load",
    "run_standalone",
    "run_types",
    "run_unload",
]

_INDEX = "share/ament_index/resource_index/rclcpp_components"
_KINDS = {
    "_container/load_node": "composition_interfaces/srv/LoadNode",
    "_container/unload_node": "composition_interfaces/srv/UnloadNode",
    "_container/list_nodes": "composition_interfaces/srv/ListNodes",
}
_NO_CONTAINERS = "\n  there is none; start one: ros2 run rclcpp_components component_container"
_Parser = argparse.ArgumentParser
_VERBS = {
    "list": Verb("Output a list of running containers and components", __name__),
    "load": Verb("Load a component into a container node", __name__),
    "standalone": Verb("Run a component into its own standalone container node", __name__),
    "types": Verb("Output a list of components registered in the ament index", __name__),
    "unload": Verb("Unload a component from a container node", __name__),
}


def main(argv: list[str]) -> int:
    """Run a verb of ``ros2 component``."""
    about = "Various component related sub-commands"
    return run_command(Command("component", about, _VERBS), argv)


def add_arguments_types(parser: argparse.ArgumentParser) -> None:
    """Add what ``types`` takes."""
    text = "Package name to look for registered components in"
    parser.add_argument("package_name", nargs="?", help=text)


def run_types(options: argparse.Namespace) -> int:
    """Print the components that installed packages register."""
    registered = _registered()
    package = options.package_name
    if package is not None:
        packages = [*Workspace.discover().packages, *registered]
        if package not in packages:
            return fail(f"Unable to find package '{package}'{hint(package, packages)}")
        print("\n".join(registered.get(package, [])))
    else:
        for name, types in sorted(registered.items()):
            print("\n".join([name, *(f"  {one}" for one in types)]))
    if not registered:
        print(
            "no prefix of AMENT_PREFIX_PATH registers components",
            file=sys.stderr,
        )
    return 0


def add_component_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options that say which component, and how it is loaded."""
    add = parser.add_argument
    add("package_name", help="Name of the package where the component is to be found")
    add("plugin_name", help="Type name of the component to be loaded")
    add("-n", "--node-name", default="", help="Component node name")
    add("--node-namespace", default="", help="Component node namespace")
    add("--log-level", type=int, default=0, help="Component node log level")
    text = "Component node remapping rules, in the 'from:=to' form"
    add("-r", "--remap-rule", action="append", dest="remap_rules", default=[], help=text)
    text = "Component node parameters, in the 'name:=value' form"
    add("-p", "--parameter", action="append", dest="parameters", default=[], help=text)
    text = "Extra arguments for the container, in the 'name:=value' form"
    add("-e", "--extra-argument", action="append", dest="extra_arguments", default=[], help=text)


def add_arguments_standalone(parser: argparse.ArgumentParser) -> None:
    """Add what ``standalone`` takes."""
    add_direct_arguments(parser)
    add_component_arguments(parser)
    text = "Name of the standalone container node to be run"
    parser.add_argument("-c", "--container-node-name", default="standalone_container", help=text)


def run_standalone(options: argparse.Namespace) -> int:
    """Say what does the component's work, or how a container of its own is started."""
    return fail(
        f"Failed to load component: '{options.plugin_name}' of package '{options.package_name}' "
        "needs a container of its own"
        + instead_of(options.package_name, options.plugin_name, _words(options))
        + "\n  ros2 run rclcpp_components component_container --ros-args "
        f"-r __node:={options.container_node_name}"
        + f"\n  ros2 component load /{options.container_node_name} "
        f"{options.package_name} {options.plugin_name}"
    )


def instead_of(package: str, plugin: str, arguments: str = "") -> str:
    """Return lines that name the built-in node of a component's work, or what there is."""
    found, types = executable_of_component(package, plugin), builtin_executables(package)
    if found:
        return f"\n  the built-in node does the same: ros2 run {package} {found}{arguments}"
    if types:
        return f"\n  built-in nodes of the package: {', '.join(types)}"
    return ""


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
        answer = _load(
            node,
            name,
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


def _words(options: argparse.Namespace) -> str:
    """What of the options ``ros2 run`` takes."""
    tokens = [f"-r {rule}" for rule in options.remap_rules]
    tokens += [f"-r __node:={options.node_name}"] if options.node_name else []
    tokens += [f"-r __ns:={options.node_namespace}"] if options.node_namespace else []
    tokens += [f"-p {one}" for one in options.parameters]
    return f" --ros-args {' '.join(tokens)}" if tokens else ""


def _registered() -> dict[str, list[str]]:
    """Return components by package, from the index of every installed prefix."""
    found: dict[str, list[str]] = {}
    for prefix in filter(None, os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)):
        folder = Path(prefix) / _INDEX
        for file in sorted(folder.iterdir()) if folder.is_dir() else ():
            lines = file.read_text(encoding="utf-8", errors="replace").splitlines()
            types = [line.partition(";")[0] for line in lines if line.strip()]
            found.setdefault(file.name, types)
    return found


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


def _load(node: Node, container: str, **fields: Any) -> Any:
    """Have a container load a component, however long it takes to compile it."""
    short = "_container/load_node"
    kind = service_type(_KINDS[short])
    try:
        return node.create_client(f"{container}/{short}", kind).call(kind.Request(**fields))
    except GraphError as error:
        raise ToolError(str(error)) from None


def _call(node: Node, container: str, name: str, **fields: Any) -> Any:
    short = f"_container/{name}"
    return call_service(node, f"{container}/{short}", _KINDS[short], **fields)


def _parameters(assignments: list[str]) -> list[Any]:
    kind = message_type("rcl_interfaces/msg/Parameter")
    pairs = (word.partition(":=") for word in assignments)
    return [kind(name=name, value=value_message(yaml_words([text])[0])) for name, _, text in pairs]
