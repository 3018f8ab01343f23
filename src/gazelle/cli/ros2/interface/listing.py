"""``ros2 interface list``, ``package`` and ``packages``."""

from __future__ import annotations

import argparse

from gazelle.cli.ros2.interface.names import PARTS, interfaces
from gazelle.cli.ros2.verbs import fail
from gazelle.cli.tool import hint
from gazelle.workspace import Workspace

__all__ = ["add_arguments", "run_list", "run_package", "run_packages"]
__all__ += ["add_arguments_package"]

_OPTIONS = (
    ("-m", "--only-msgs", "message", "msg"),
    ("-s", "--only-srvs", "service", "srv"),
    ("-a", "--only-actions", "action", "action"),
)
_TITLES = {"msg": "Messages", "srv": "Services", "action": "Actions"}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what ``list`` and ``packages`` take."""
    for short, long, word, _ in _OPTIONS:
        text = f"Print out only the {word} types"
        parser.add_argument(short, long, action="store_true", help=text)


def add_arguments_package(parser: argparse.ArgumentParser) -> None:
    """Add what ``package`` takes."""
    add_arguments(parser)
    parser.add_argument("package_name", help="Name of the ROS package (e.g. 'example_interfaces')")


def run_list(options: argparse.Namespace) -> int:
    """Print all types, messages, services and actions apart."""
    for part in _chosen(options):
        print(f"{_TITLES[part]}:")
        for name in interfaces(part):
            print(f"    {name}")
    return 0


def run_package(options: argparse.Namespace) -> int:
    """Print the types of a package."""
    package = options.package_name
    found = [name for part in _chosen(options) for name in interfaces(part, package)]
    if not found and not _has_types(package):
        packages = Workspace.discover().packages
        if package not in packages:
            known = {name.split("/")[0] for part in PARTS for name in interfaces(part)}
            return fail(f"Unknown package '{package}'{hint(package, [*known, *packages])}")
    for name in sorted(found):
        print(name)
    return 0


def run_packages(options: argparse.Namespace) -> int:
    """Print the packages that define types; of several options the first counts."""
    parts = _chosen(options)
    if len(parts) < len(PARTS):
        parts = parts[:1]
    for name in sorted({name.split("/")[0] for part in parts for name in interfaces(part)}):
        print(name)
    return 0


def _chosen(options: argparse.Namespace) -> list[str]:
    given = [part for _, long, _, part in _OPTIONS if getattr(options, long[2:].replace("-", "_"))]
    return given or list(PARTS)


def _has_types(package: str) -> bool:
    return any(interfaces(part, package) for part in PARTS)
