"""``colcon list``, ``colcon info`` and ``colcon graph``: packages, and who needs whom."""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from pathlib import Path

from gazelle.cli.colcon.package_selection import add_package_options, chosen_packages, parser_for
from gazelle.diagnostics import did_you_mean
from gazelle.workspace.building.packages import BuildError, SourcePackage, needed_by

__all__ = ["graph", "list_or_info"]

_LEGEND = """\
+ marks when the package in this row can be processed
* marks a direct dependency from the package indicated by the + in the same column to the package \
in this row
. marks a transitive dependency
"""
_COLOURS = {"build": "blue", "run": "red", "test": "tan"}


def graph(argv: list[str], _log_base: Path) -> int:
    """Print the graph as text, or as dot."""
    parser = parser_for("graph", "Generate a visual representation of the dependency graph.")
    parser.add_argument("--legend", action="store_true", help="print a legend before the graph")
    parser.add_argument("--dot", action="store_true", help="print it for Graphviz' dot")
    add_package_options(parser)
    options = parser.parse_args(argv[1:])
    everything, chosen = chosen_packages(options)
    if options.dot:
        print("\n".join(_dot(chosen)))
        return 0
    if options.legend:
        print(_LEGEND)
    width = max((len(item.name) for item in chosen), default=0)
    for row in chosen:
        marks = "".join(_mark(row, column, everything) for column in chosen)
        print(f"{row.name:<{width}}  {marks}")
    return 0


def list_or_info(argv: list[str], _log_base: Path) -> int:
    """Run the verb that the first word names."""
    return _list(argv[1:]) if argv[0] == "list" else _info(argv[1:])


def _mark(row: SourcePackage, column: SourcePackage, packages: Sequence[SourcePackage]) -> str:
    if row is column:
        return "+"
    if row.name in column.depends():
        return "*"
    return "." if row.name in needed_by([column.name], packages) else " "


def _dot(packages: Sequence[SourcePackage]) -> list[str]:
    names = {item.name for item in packages}
    lines = ["digraph graphname {"]
    lines += [f'  "{item.name}";' for item in packages]
    for item in packages:
        for role, colour in _COLOURS.items():
            lines += [
                f'  "{item.name}" -> "{need}" [color="{colour}"];'
                for need in sorted(item.depends(role) & names - {item.name})
            ]
    return [*lines, "}"]


def _list(argv: list[str]) -> int:
    parser = parser_for("list", "List packages, optionally in topological ordering.")
    add_package_options(parser)
    parser.add_argument("--topological-order", "-t", action="store_true")
    only = parser.add_mutually_exclusive_group()
    only.add_argument("--names-only", "-n", action="store_true")
    only.add_argument("--paths-only", "-p", action="store_true")
    options = parser.parse_args(argv)
    _, chosen = chosen_packages(options)
    shown = list(chosen)
    if not options.topological_order:
        shown.sort(key=lambda item: item.name)
    lines = [_line(item, options) for item in shown]
    print("\n".join(lines if options.topological_order else sorted(lines)))
    return 0


def _line(package: SourcePackage, options: argparse.Namespace) -> str:
    if options.names_only:
        return package.name
    path = os.path.relpath(package.path)
    if options.paths_only:
        return path
    return f"{package.name}\t{path}\t(ros.{package.build_type})"


def _info(argv: list[str]) -> int:
    parser = parser_for("info", "Detailed information about packages.")
    parser.add_argument("package_names", nargs="*", metavar="PKG_NAME")
    add_package_options(parser)
    options = parser.parse_args(argv)
    everything, chosen = chosen_packages(options)
    known = {item.name: item for item in everything}
    missing = [name for name in options.package_names if name not in known]
    if missing:
        hints = (did_you_mean(name, known) for name in missing)
        listed = ", ".join(f"'{name}'" for name in missing)
        raise BuildError(f"no package {listed} in this workspace {' '.join(hints)}".rstrip())
    wanted = [known[name] for name in options.package_names] or chosen
    for package in sorted(wanted, key=lambda item: item.name):
        print("\n".join(_details(package)))
    return 0


def _details(package: SourcePackage) -> list[str]:
    lines = [
        f"path: {os.path.relpath(package.path)}",
        f"  type: ros.{package.build_type}",
        f"  name: {package.name}",
        "  dependencies:",
    ]
    for role in ("build", "run", "test"):
        lines.append(f"    {role}: {' '.join(sorted(package.depends(role)))}")
    lines.append("  metadata:")
    lines.append(f"    maintainers: {list(package.manifest.maintainers)}")
    lines.append(f"    version: {package.manifest.version}")
    return lines
