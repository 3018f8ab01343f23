"""``ros2 pkg list`` and ``ros2 pkg prefix``."""

from __future__ import annotations

import argparse
import sys

from gazelle.cli.tool import hint
from gazelle.errors import GazelleError
from gazelle.node_specs.registry import builtin_packages
from gazelle.workspace import Package, Workspace

__all__ = [
    "add_arguments_list",
    "add_arguments_prefix",
    "named_package",
    "run_list",
    "run_prefix",
]


def named_package(workspace: Workspace, name: str) -> Package:
    """Return a package by its name.

    Raises:
        GazelleError: ``Package not found``, with names that are spelled alike.
    """
    if name not in workspace.packages:
        raise GazelleError(f"Package '{name}' not found{hint(name, workspace.packages)}")
    return workspace.packages[name]


def add_arguments_list(_parser: argparse.ArgumentParser) -> None:
    """Add nothing: there are no options."""


def run_list(_options: argparse.Namespace) -> int:
    """Print the names of all packages, those with built-in nodes included."""
    names = {*Workspace.discover().packages, *builtin_packages()}
    print("\n".join(sorted(names)))
    return 0


def add_arguments_prefix(parser: argparse.ArgumentParser) -> None:
    """Add the options of the original."""
    parser.add_argument("package_name", help="The package name")
    parser.add_argument("--share", action="store_true", help="Show share directory for the package")


def run_prefix(options: argparse.Namespace) -> int:
    """Print the prefix, the source folder of a package that is not installed."""
    package = named_package(Workspace.discover(), options.package_name)
    if options.share:
        print(package.share)
        return 0
    print(package.prefix or package.path)
    if package.prefix is None and not package.is_builtin:
        text = f"'{package.name}' is not installed: this is its source folder"
        print(text, file=sys.stderr)
    return 0
