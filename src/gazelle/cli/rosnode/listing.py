"""``rosnode list`` and ``rosnode machine``."""

from __future__ import annotations

import socket

from gazelle.cli.node_processes import Processes
from gazelle.cli.tool import ToolError, add_flag, global_name, hint, joined, option_parser
from gazelle.graph import Graph

__all__ = ["machine", "run"]

_UNKNOWN = "unknown address"


def run(words: list[str]) -> int:
    """Print the names of nodes, with ``-u`` or ``-a`` their addresses."""
    parser = option_parser("rosnode", "list")
    add_flag(parser, "-u", dest="uris", text="list URIs")
    add_flag(parser, "-a", "--all", dest="all", text="list all information")
    options, args = parser.parse_args(words)
    if len(args) > 1:
        parser.error("invalid args: you may only specify one namespace")
    with joined() as graph:
        names = graph.node_names()
        if args:
            own = global_name(args[0], "rosnode")
            start = own.rstrip("/") + "/"
            names = tuple(name for name in names if name == own or name.startswith(start))
        lines = list(names)
        if options.all or options.uris:
            processes = Processes(graph)
            lines = [processes.uri(name) or _UNKNOWN for name in names]
            if options.all:
                lines = [f"{uri} \t{name}" for uri, name in zip(lines, names, strict=True)]
        print("\n".join(lines))
    return 0


def machine(words: list[str]) -> int:
    """Print the machines there are nodes on, or the nodes on one machine."""
    parser = option_parser("rosnode", "machine [machine-name]")
    _, args = parser.parse_args(words)
    if len(args) > 1:
        parser.error("please enter only one machine name")
    with joined() as graph:
        nodes = _nodes_by_machine(graph)
    if not args:
        print("\n".join(sorted(nodes)))
        return 0
    print("\n".join(sorted(nodes[_machine(args[0], list(nodes))])))
    return 0


def _machine(name: str, known: list[str]) -> str:
    if name in known:
        return name
    # The graph never leaves this machine, whatever name it goes by.
    if name in {"localhost", "127.0.0.1", "::1"} and socket.gethostname() in known:
        return socket.gethostname()
    raise ToolError(f"cannot resolve machine name [{name}] to address{hint(name, known)}")


def _nodes_by_machine(graph: Graph) -> dict[str, list[str]]:
    processes = Processes(graph)
    found: dict[str, list[str]] = {}
    for node in graph.node_names():
        _, host = processes.ask(node)
        if host:
            found.setdefault(host, []).append(node)
    return found
