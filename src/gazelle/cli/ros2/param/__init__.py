"""``ros2 param``: parameters of running nodes."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from gazelle.cli.error_text import error_text
from gazelle.cli.ros2.verbs import add_verbs
from gazelle.cli.tool import ToolError

__all__ = ["main"]


def main(argv: list[str]) -> int:
    """Run a verb of ``ros2 param``."""
    from gazelle.cli.ros2.param import verbs

    parser = _parser()
    options = parser.parse_args(argv)
    if not options.verb:
        parser.print_help()
        return 0
    try:
        return int(getattr(verbs, f"run_{options.verb}")(options))
    except ToolError as error:
        print(error_text(error), file=sys.stderr)
        return 1


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="ros2 param",
        description="Various param related sub-commands",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    rows = (
        ("delete", "Delete parameter", ("node", "name")),
        ("describe", "Show descriptive information about declared parameters", ("node", "names")),
        ("dump", "Show all of the parameters of a node in a YAML file format", ("node",)),
        ("get", "Get parameter", ("node", "name")),
        ("list", "Output a list of available parameters", ("node?",)),
        ("load", "Load parameter file for a node", ("node", "file")),
        ("set", "Set parameter", ("node", "name", "value")),
    )
    choices = add_verbs(parser, {name: about for name, about, _ in rows})
    for name, _, arguments in rows:
        for argument in arguments:
            _add(choices[name], argument)
    choices["get"].add_argument("--hide-type", action="store_true", help="Hide the type")
    choices["list"].add_argument("--filter", help="Only list parameters matching this regex")
    choices["list"].add_argument("--param-prefixes", nargs="+", default=[], help="Only with these")
    choices["list"].add_argument("--param-type", action="store_true", help="Print the types")
    choices["dump"].add_argument("--output-dir", type=Path, help="Write <node>.yaml there")
    choices["load"].add_argument("--no-use-wildcard", action="store_true", help="Leave /** out")
    for verb in choices.values():
        verb.add_argument("--spin-time", help=argparse.SUPPRESS)
        verb.add_argument("--no-daemon", action="store_true", help=argparse.SUPPRESS)
        verb.add_argument("--include-hidden-nodes", action="store_true", help=argparse.SUPPRESS)
    return parser


def _add(verb: argparse.ArgumentParser, argument: str) -> None:
    about = {
        "node": "Name of the ROS node",
        "node?": "Name of the ROS node; all nodes when it is not given",
        "name": "Name of the parameter",
        "names": "Names of the parameters",
        "value": "Value of the parameter, in YAML",
        "file": "Parameter file",
    }[argument]
    count = {"names": "+", "node?": "?"}.get(argument)
    verb.add_argument(argument.rstrip("?"), nargs=count, help=about)
