"""``ros2 component types`` and ``standalone``: which components there are."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path

from gazelle.cli.ros2.verbs import add_direct_arguments, fail
from gazelle.cli.tool import hint
from gazelle.node_specs.registry import builtin_executables, executable_of_component
from gazelle.workspace import Workspace

__all__ = ["add_arguments_standalone", "add_arguments_types", "add_component_arguments"]
__all__ += ["instead_of", "run_standalone", "run_types"]

_INDEX = "share/ament_index/resource_index/rclcpp_components"


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
            "no prefix of AMENT_PREFIX_PATH registers components; Gazelle runs nodes as processes",
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
    """Say what does the component's work: compiled code cannot be loaded here."""
    return fail(
        f"Failed to load component: '{options.plugin_name}' of package '{options.package_name}' "
        "is compiled code, and Gazelle has no container that loads it"
        + instead_of(options.package_name, options.plugin_name, _words(options))
    )


def instead_of(package: str, plugin: str, words: str = "") -> str:
    """Return lines that name the built-in node of a component's work, or what there is."""
    found, types = executable_of_component(package, plugin), builtin_executables(package)
    if found:
        return f"\n  the built-in node does the same: ros2 run {package} {found}{words}"
    if types:
        return f"\n  built-in nodes of the package: {', '.join(types)}"
    return "\n  write the node in Python and start it with ros2 run"


def _words(options: argparse.Namespace) -> str:
    """What of the options ``ros2 run`` takes."""
    words = [f"-r {rule}" for rule in options.remap_rules]
    words += [f"-r __node:={options.node_name}"] if options.node_name else []
    words += [f"-r __ns:={options.node_namespace}"] if options.node_namespace else []
    words += [f"-p {one}" for one in options.parameters]
    return f" --ros-args {' '.join(words)}" if words else ""


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
