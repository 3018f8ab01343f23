"""``rosnode kill``."""

from __future__ import annotations

import sys

from gazelle.cli.tool import ToolError, add_flag, global_name, hint, joined, option_parser
from gazelle.errors import NotFoundError
from gazelle.graph import Graph

__all__ = ["run"]


def run(words: list[str]) -> int:
    """Ask nodes to shut down."""
    parser = option_parser("rosnode", "kill [node]...")
    add_flag(parser, "-a", "--all", dest="all", text="kill all nodes")
    options, args = parser.parse_args(words)
    if options.all and args:
        parser.error("invalid arguments with kill all (-a) option")
    with joined() as graph:
        known = graph.node_names()
        names = list(known) if options.all else [global_name(arg, "rosnode") for arg in args]
        if not known and (options.all or not args):
            print("No nodes running", file=sys.stderr)
            return 0
        names = names or [_chosen(known)]
        unknown = [name for name in names if name not in known]
        if unknown:
            near = "".join(hint(name, known) for name in unknown)
            listed = "\n".join(f" * {name}" for name in unknown)
            raise ToolError(f"Unknown node(s):\n{listed}{near}")
        return _kill(graph, names)


def _kill(graph: Graph, names: list[str]) -> int:
    if len(names) > 1:
        print("killing:\n" + "\n".join(f" * {name}" for name in names))
    else:
        print(f"killing {names[0]}")
    failed = [name for name in names if not _asked(graph, name)]
    if failed:
        sys.stdout.flush()
        listed = "\n".join(f" * {name}" for name in failed)
        print(f"ERROR: Failed to kill:\n{listed}", file=sys.stderr)
        return 1
    print("killed")
    return 0


def _asked(graph: Graph, name: str) -> bool:
    """Return whether the node was told to end; one that ended with another one counts too."""
    try:
        return graph.kill_node(name)
    except NotFoundError:
        return True


def _chosen(names: tuple[str, ...]) -> str:
    """Let the person at the terminal choose."""
    print("\n".join(f"{place}. {name}" for place, name in enumerate(names, 1)))
    print("\nPlease enter the number of the node you wish to kill.\n> ", end="", flush=True)
    for line in sys.stdin:
        text = line.strip()
        if text.isdigit() and 0 < int(text) <= len(names):
            return names[int(text) - 1]
        if text:
            print("ERROR: invalid selection. Please enter a number (ctrl-C to cancel)", flush=True)
    raise ToolError("no node was chosen")
