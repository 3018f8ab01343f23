"""Options that the verbs of colcon share: where packages are, and which ones are meant."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from gazelle.diagnostics import Diagnostics, render
from gazelle.workspace.building.packages import (
    Selection,
    SourcePackage,
    find_packages,
    in_order,
    select,
)

__all__ = ["add_package_options", "chosen_packages", "parser_for", "split_cmake_arguments"]

_LISTS = {
    "--packages-select": "only these packages",
    "--packages-up-to": "only these packages and what they need",
    "--packages-above": "only these packages and what needs them",
    "--packages-skip": "not these packages",
    "--packages-ignore": "as if these packages were not there",
}
_CMAKE_OPTIONS = ("--cmake-args", "--ament-cmake-args", "--catkin-cmake-args")


def parser_for(verb: str, description: str) -> argparse.ArgumentParser:
    """Return a verb's parser; abbreviations are no options, as in colcon."""
    return argparse.ArgumentParser(
        prog=f"colcon {verb}", description=description, allow_abbrev=False
    )


def add_package_options(parser: argparse.ArgumentParser) -> None:
    """Add the options that find and choose packages."""
    text = "where to look for packages"
    parser.add_argument(
        "--base-paths", "--paths", nargs="*", type=Path, default=[Path()], metavar="PATH", help=text
    )
    for name, text in _LISTS.items():
        parser.add_argument(name, nargs="*", default=[], metavar="NAME", help=text)


def chosen_packages(
    options: argparse.Namespace,
) -> tuple[tuple[SourcePackage, ...], tuple[SourcePackage, ...]]:
    """Return all packages in order, and those the options choose; warnings are printed.

    Raises:
        BuildError: the packages cannot be put in order.
    """
    diagnostics = Diagnostics()
    everything = in_order(find_packages(options.base_paths, diagnostics))
    if len(diagnostics):
        render(diagnostics)
    selection = Selection(
        tuple(options.packages_select),
        tuple(options.packages_up_to),
        tuple(options.packages_above),
        tuple(options.packages_skip),
        tuple(options.packages_ignore),
    )
    chosen, warnings = select(everything, selection)
    for warning in warnings:
        print(f"WARNING:colcon.colcon_core.package_selection:{warning}", file=sys.stderr)
    return everything, chosen


def split_cmake_arguments(
    parser: argparse.ArgumentParser, argv: Sequence[str]
) -> tuple[list[str], list[str]]:
    """Take the words after ``--cmake-args`` and its like, up to the next option of colcon.

    Returns:
        The other words, and the arguments for CMake.
    """
    rest: list[str] = []
    taken: list[str] = []
    inside = False
    for word in argv:
        name = word.partition("=")[0]
        if word in _CMAKE_OPTIONS:
            inside = True
        elif name in _CMAKE_OPTIONS:
            inside = True
            taken.append(word.partition("=")[2])
        elif inside and name not in parser._option_string_actions:
            taken.append(word.strip())
        else:
            inside = False
            rest.append(word)
    return rest, taken
