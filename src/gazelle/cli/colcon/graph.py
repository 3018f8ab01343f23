"""``colcon graph``: who needs whom."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from gazelle.cli.colcon.package_selection import add_package_options, chosen_packages, parser_for
from gazelle.workspace.building.packages import SourcePackage, needed_by

__all__ = ["run"]

_LEGEND = """\
+ marks when the package in this row can be processed
* marks a direct dependency from the package indicated by the + in the same column to the package \
in this row
. marks a transitive dependency
"""
_COLOURS = {"build": "blue", "run": "red", "test": "tan"}


def run(words: list[str], _log_base: Path) -> int:
    """Print the graph as text, or as dot."""
    parser = parser_for("graph", "Generate a visual representation of the dependency graph.")
    parser.add_argument("--legend", action="store_true", help="print a legend before the graph")
    parser.add_argument("--dot", action="store_true", help="print it for Graphviz' dot")
    add_package_options(parser)
    options = parser.parse_args(words[1:])
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
