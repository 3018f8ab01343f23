"""``rosservice list`` and ``rosservice find``."""

from __future__ import annotations

from gazelle.cli.ros_types import shown_type, wanted_type
from gazelle.cli.tool import add_flag, global_name, joined, option_parser

__all__ = ["find", "run"]


def run(words: list[str]) -> int:
    """Print the names of services, with ``-n`` the nodes that answer them."""
    parser = option_parser("rosservice", "list [/namespace]")
    add_flag(parser, "-n", "--nodes", dest="nodes", text="print nodes that provide service(s)")
    options, args = parser.parse_args(words)
    if len(args) > 1:
        parser.error("you may only specify one input namespace")
    own = global_name(args[0], "rosservice") if args else "/"
    start = own.rstrip("/") + "/"
    with joined() as graph:
        for one in graph.services():
            if one.name == own or one.name.startswith(start):
                print(f"{one.name} {','.join(one.servers)}" if options.nodes else one.name)
    return 0


def find(words: list[str]) -> int:
    """Print the services of a type."""
    wanted = wanted_type("rosservice", words)
    with joined() as graph:
        names = [one.name for one in graph.services() if shown_type(one.type_name) == wanted]
        print("\n".join(names))
    return 0
