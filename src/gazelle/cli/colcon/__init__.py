"""``colcon``: building and listing the packages of a workspace, without compilers."""

from __future__ import annotations

import argparse
import sys
from importlib import import_module
from pathlib import Path

from gazelle.diagnostics import did_you_mean

__all__ = ["main"]

# Each function takes the words, the verb first, and the folder of logs.
_VERBS = {
    "build": ("gazelle.cli.colcon.build:run", "Build a set of packages"),
    "graph": ("gazelle.cli.colcon.list:graph", "Generate a visual representation of the graph"),
    "info": ("gazelle.cli.colcon.list:list_or_info", "Package information"),
    "list": (
        "gazelle.cli.colcon.list:list_or_info",
        "List packages, optionally in topological ordering",
    ),
    "test": ("gazelle.cli.colcon.test:run", "Test a set of packages"),
    "test-result": ("gazelle.cli.colcon.test:run", "Show a summary of test results"),
}


def main(argv: list[str]) -> int:
    """Run ``colcon [--log-base PATH] VERB …``."""
    parser = argparse.ArgumentParser(prog="colcon", add_help=False, usage=_usage())
    parser.add_argument("-h", "--help", action="store_true")
    parser.add_argument("--log-base", type=Path, default=Path("log"))
    parser.add_argument("verb", nargs="?", default="")
    # argparse would take options of the verb for its own.
    index = next((n for n, word in enumerate(argv) if word in _VERBS), len(argv))
    options, rest = parser.parse_known_args(argv[: index + 1])
    if options.help or not options.verb:
        print(_usage())
        return 0
    if options.verb not in _VERBS or rest:
        wrong = options.verb if options.verb not in _VERBS else rest[0]
        hint = did_you_mean(wrong, _VERBS) or f"choose from {', '.join(map(repr, _VERBS))}"
        print(f"colcon: error: invalid choice: '{wrong}' ({hint})", file=sys.stderr)
        return 2
    module, _, function = _VERBS[options.verb][0].partition(":")
    return int(getattr(import_module(module), function)(argv[index:], options.log_base))


def _usage() -> str:
    lines = [f"  {name:<13}{text}" for name, (_, text) in _VERBS.items()]
    head = "usage: colcon [-h] [--log-base LOG_BASE] {build,graph,info,list,test,test-result} ..."
    return "\n".join([head, "", "colcon verbs:", *lines])
