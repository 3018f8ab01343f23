"""``rosnode ping`` and ``rosnode cleanup``."""

from __future__ import annotations

import sys
import threading
import time

from gazelle.cli.node_processes import Processes
from gazelle.cli.tool import add_flag, global_name, hint, joined, option_parser
from gazelle.graph import Graph

__all__ = ["cleanup", "run"]

_PERIOD_S = 1.0
_TIMEOUT_S = 2.0  # what the graph waits for a process


def run(words: list[str]) -> int:
    """Ask nodes whether they are alive, one again and again, or all of them once."""
    parser = option_parser("rosnode", "ping [options] <node>")
    add_flag(parser, "--all", "-a", dest="all", text="ping all nodes")
    parser.add_option(
        "-c",
        dest="count",
        type="int",
        metavar="COUNT",
        help="number of pings to send. Not available with --all",
    )
    options, args = parser.parse_args(words)
    if options.all and args:
        parser.error(f"Invalid arguments '{' '.join(args)}' used with --all")
    if options.all and options.count:
        parser.error("-c may not be used with --all")
    if len(args) > 1:
        parser.error("you may only specify one input node")
    with joined() as graph:
        if options.all:
            _ping_all(graph)
            return 0
        if not args:
            names = "\n".join(graph.node_names())
            parser.error(f"Please enter a node to ping. Available nodes are:\n{names}")
        name = global_name(args[0], "rosnode")
        print(f"rosnode: node is [{name}]")
        _ping(graph, name, options.count)
    return 0


def cleanup(words: list[str]) -> int:
    """Look for nodes that do not answer; what has ended leaves the graph by itself."""
    parser = option_parser("rosnode", "cleanup")
    parser.parse_args(words)
    with joined() as graph:
        silent = [name for name in graph.node_names() if not Processes(graph).uri(name)]
    if silent:
        print("Unable to contact the following nodes:")
        print("\n".join(f" * {name}" for name in silent))
        print("Their processes are there and do not answer, so they stay: stopped, or very busy.")
    return 0


def _ping_all(graph: Graph) -> None:
    names = graph.node_names()
    print("Will ping the following nodes: \n" + "".join(f" * {name}\n" for name in names))
    for name in names:
        _ping(graph, name, 1)


def _ping(graph: Graph, name: str, most: int | None) -> bool:
    """Ping a node until it was often enough, or Ctrl-C; return whether it answered."""
    times_ms: list[float] = []
    print(f"pinging {name} with a timeout of {_TIMEOUT_S}s", flush=True)
    pause = threading.Event()
    try:
        while True:
            if not _ping_once(graph, name, times_ms):
                return False
            if most and len(times_ms) >= most:
                break
            pause.wait(_PERIOD_S)
    except KeyboardInterrupt:
        print()
    if len(times_ms) > 1:
        print(f"ping average: {sum(times_ms) / len(times_ms):f}ms")
    return True


def _ping_once(graph: Graph, name: str, times_ms: list[float]) -> bool:
    processes = Processes(graph)
    if name not in processes.zid_of:
        near = hint(name, list(processes.zid_of))
        print(f"cannot ping [{name}]: unknown node{near}", file=sys.stderr)
        return False
    start_s = time.perf_counter()
    uri = processes.uri(name)
    if not uri:
        print(f"connection to [{name}] timed out", file=sys.stderr)
        return False
    times_ms.append((time.perf_counter() - start_s) * 1e3)
    print(f"reply from {uri}\ttime={times_ms[-1]:f}ms", flush=True)
    return True
