"""``catkin create pkg``."""

from __future__ import annotations

import argparse
import sys

from gazelle.cli.catkin_create_pkg import main as create

__all__ = ["run"]


def run(words: list[str]) -> int:
    """Write packages with the options of ``catkin_create_pkg``."""
    if words[1:2] != ["pkg"]:
        print("usage: catkin create pkg PKG_NAME [--catkin-deps DEP ...]", file=sys.stderr)
        return 2
    parser = argparse.ArgumentParser(prog="catkin create pkg")
    parser.add_argument("name", metavar="PKG_NAME")
    parser.add_argument("-c", "--catkin-deps", nargs="*", default=[], metavar="DEP")
    options, rest = parser.parse_known_args(words[2:])
    return create([options.name, *options.catkin_deps, *rest])
