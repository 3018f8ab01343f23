"""``ros2 pkg executables``: files that run, and the nodes that Gazelle brings."""

from __future__ import annotations

import argparse
import sys

from gazelle.cli.ros2.pkg.listing import named_package
from gazelle.node_specs.registry import builtin_executables, builtin_packages
from gazelle.workspace import Package, Workspace

__all__ = ["add_arguments", "run"]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the options of the original."""
    parser.add_argument("package_name", nargs="?", help="The package name")
    parser.add_argument(
        "--full-path", action="store_true", help="Show full path of each executable"
    )


def run(options: argparse.Namespace) -> int:
    """Print a line for each executable."""
    workspace = Workspace.discover()
    if options.package_name is None:
        names = {*workspace.packages, *builtin_packages()}
    else:
        names = {options.package_name}
        if not builtin_executables(options.package_name):
            named_package(workspace, options.package_name)
    for name in sorted(names):
        package = workspace.packages.get(name)
        files = package.executable_names if package is not None else ()
        builtin = (
            () if package is not None and not package.is_builtin else builtin_executables(name)
        )
        if not options.full_path:
            for executable in sorted({*files, *builtin}):
                print(name, executable)
            continue
        for path in _paths(package, files):
            print(path)
        for executable in sorted(set(builtin) - set(files)):
            print(f"{name} {executable} comes with Gazelle and is no file", file=sys.stderr)
    return 0


def _paths(package: Package | None, names: tuple[str, ...]) -> list[str]:
    if package is None:
        return []
    found = [package.find_executables(name)[:1] for name in names]
    return sorted(str(path) for paths in found for path in paths)
