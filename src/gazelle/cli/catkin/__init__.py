"""``catkin``: the verbs of catkin tools, for Python and data packages."""

from __future__ import annotations

import sys
from importlib import import_module

from gazelle.diagnostics import did_you_mean

__all__ = ["main"]

# Each module has ``run(words) -> int``; the first word is the verb.
_VERBS = {
    "build": ("gazelle.cli.catkin.build", "Builds a catkin workspace"),
    "clean": ("gazelle.cli.catkin.clean", "Deletes what a build has made"),
    "config": ("gazelle.cli.catkin.config", "Configures a catkin workspace"),
    "create": ("gazelle.cli.catkin.create", "Creates a catkin package"),
    "init": ("gazelle.cli.catkin.config", "Makes a folder a catkin workspace"),
    "list": ("gazelle.cli.catkin.listing", "Lists catkin packages"),
    "locate": ("gazelle.cli.catkin.listing", "Gets the path of a package or space"),
}


def main(argv: list[str]) -> int:
    """Run ``catkin VERB …``."""
    name = argv[0] if argv else ""
    if name in {"", "-h", "--help"}:
        lines = [f"  {verb:<8}{text}" for verb, (_, text) in _VERBS.items()]
        print("\n".join(["usage: catkin VERB ...", "", "catkin verbs:", *lines]))
        return 0 if name else 1
    if name not in _VERBS:
        hint = did_you_mean(name, _VERBS) or f"choose from {', '.join(map(repr, _VERBS))}"
        print(f"catkin: error: invalid choice: '{name}' ({hint})", file=sys.stderr)
        return 2
    return int(import_module(_VERBS[name][0]).run(argv))
