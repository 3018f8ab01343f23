"""``rosnode``: which nodes there are, what they do, and their end."""

from __future__ import annotations

import socket
import sys
import threading
import time
from collections.abc import Iterable, Iterator

from gazelle.cli.node_processes import Processes
from gazelle.cli.ros_tool import (
    Tool,
    ToolError,
    add_flag,
    global_name,
    hint,
    join_graph,
    option_parser,
    run_tool,
)
from gazelle.cli.ros_types import shown_type
from gazelle.errors import NotFoundError
from gazelle.graph import Endpoint, Entity, Graph, Kind, NodeInfo
from gazelle.graph.graph_info import node_info, nodes_of

__all__ = ["cleanup", "info", "kill", "list_nodes", "machine", "main", "ping"]

_UNKNOWN = "unknown address"
_PERIOD_S = 1.0
_TIMEOUT_S = 2.0  # what the graph waits for a process
_USAGE = """rosnode is a command-line tool for printing information about ROS Nodes.

Commands:
\trosnode ping\ttest connectivity to node
\trosnode list\tlist active nodes
\trosnode info\tprint information about node
\trosnode machine\tlist nodes running on a particular machine or list machines
\trosnode kill\tkill a running node
\trosnode cleanup\tpurge registration information of unreachable nodes

Type rosnode <command> -h for more detailed usage, e.g. 'rosnode ping -h'
"""


def main(argv: list[str]) -> int:
    """Run a subcommand of ``rosnode``."""
    return run_tool(_TOOL, argv)


def list_nodes(argv: list[str]) -> int:
    """Print the names of nodes, with ``-u`` or ``-a`` their addresses."""
    parser = option_parser("rosnode", "list")
    add_flag(parser, "-u", dest="uris", text="list URIs")
    add_flag(parser, "-a", "--all", dest="all", text="list all information")
    options, args = parser.parse_args(argv)
    if len(args) > 1:
        parser.error("invalid args: you may only specify one namespace")
    with join_graph() as graph:
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


def machine(argv: list[str]) -> int:
    """Print the machines there are nodes on, or the nodes on one machine."""
    parser = option_parser("rosnode", "machine [machine-name]")
    _, args = parser.parse_args(argv)
    if len(args) > 1:
        parser.error("please enter only one machine name")
    with join_graph() as graph:
        nodes = _nodes_by_machine(graph)
    if not args:
        print("\n".join(sorted(nodes)))
        return 0
    print("\n".join(sorted(nodes[_machine(args[0], list(nodes))])))
    return 0


def info(argv: list[str]) -> int:
    """Print topics, services and connections of nodes."""
    parser = option_parser("rosnode", "info [options] node1 [node2...]")
    add_flag(parser, "-q", "--quiet", dest="quiet", text="print only topics and services")
    options, args = parser.parse_args(argv)
    if not args:
        parser.error("You must specify at least one node name")
    with join_graph() as graph:
        for arg in args:
            _print_node(graph, global_name(arg, "rosnode"), quiet=options.quiet)
    return 0


def ping(argv: list[str]) -> int:
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
    options, args = parser.parse_args(argv)
    if options.all and args:
        parser.error(f"Invalid arguments '{' '.join(args)}' used with --all")
    if options.all and options.count:
        parser.error("-c may not be used with --all")
    if len(args) > 1:
        parser.error("you may only specify one input node")
    with join_graph() as graph:
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


def cleanup(argv: list[str]) -> int:
    """Look for nodes that do not answer; what has ended leaves the graph by itself."""
    parser = option_parser("rosnode", "cleanup")
    parser.parse_args(argv)
    with join_graph() as graph:
        silent = [name for name in graph.node_names() if not Processes(graph).uri(name)]
    if silent:
        print("Unable to contact the following nodes:")
        print("\n".join(f" * {name}" for name in silent))
        print("Their processes are there and do not answer, so they stay: stopped, or very busy.")
    return 0


def kill(argv: list[str]) -> int:
    """Ask nodes to shut down."""
    parser = option_parser("rosnode", "kill [node]...")
    add_flag(parser, "-a", "--all", dest="all", text="kill all nodes")
    options, args = parser.parse_args(argv)
    if options.all and args:
        parser.error("invalid arguments with kill all (-a) option")
    with join_graph() as graph:
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


def _print_node(graph: Graph, name: str, *, quiet: bool) -> None:
    entities = graph.entities()
    node = node_info(entities, name)
    print("-" * 80)
    print(_description(name, node))
    if node is None:
        sys.stdout.flush()
        near = hint(name, nodes_of(entities))
        print(f"cannot contact [{name}]: unknown node{near}", file=sys.stderr)
        return
    if quiet:
        return
    processes = Processes(graph, entities)
    uri = processes.uri(name)
    print(f"\ncontacting node {uri or name} ...")
    if not uri:
        sys.stdout.flush()
        print(f"ERROR: Communication with node[{name}] failed!", file=sys.stderr)
        return
    connections = list(_connections(entities, node, processes))
    print(f"Pid: {processes.ask(name)[0]}")
    print("\n".join(["Connections:", *connections, ""] if connections else [""]))


def _description(name: str, node: NodeInfo | None) -> str:
    publications = node.publications if node else ()
    subscriptions = node.subscriptions if node else ()
    services = node.services if node else ()
    return (
        f"Node [{name}]"
        + _block("Publications", [_topic(one) for one in publications])
        + _block("Subscriptions", [_topic(one) for one in subscriptions])
        + _block("Services", [one.name for one in services])
    )


def _block(title: str, items: list[str]) -> str:
    if not items:
        return f"\n{title}: None\n"
    return f"\n{title}: \n" + "\n".join(f" * {item}" for item in items) + "\n"


def _topic(one: Endpoint) -> str:
    return f"{one.name} [{shown_type(one.type_name)}]"


def _connections(entities: Iterable[Entity], node: NodeInfo, processes: Processes) -> Iterator[str]:
    """Yield a block per topic and other end, as the graph shows them."""
    wanted = {
        **{(Kind.SUBSCRIPTION, one.name): "outbound" for one in node.publications},
        **{(Kind.PUBLISHER, one.name): "inbound" for one in node.subscriptions},
    }
    ends = {(one.kind, one.name, one.node): one.zid for one in entities}
    order = {"outbound": 0, "inbound": 1}
    found = [
        (wanted[kind, topic], topic, other, zid)
        for (kind, topic, other), zid in ends.items()
        if (kind, topic) in wanted and other != node.name
    ]
    for direction, topic, other, zid in sorted(found, key=lambda one: (order[one[0]], *one[1:])):
        transport = "INTRAPROCESS" if zid == node.zid else "ZENOH"
        uri = f" ({processes.uri(other)})" if direction == "inbound" else ""
        yield (
            f" * topic: {topic}\n    * to: {other}{uri}\n"
            f"    * direction: {direction}\n    * transport: {transport}"
        )


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
    print("\n".join(f"{number}. {name}" for number, name in enumerate(names, 1)))
    print("\nPlease enter the number of the node you wish to kill.\n> ", end="", flush=True)
    for line in sys.stdin:
        text = line.strip()
        if text.isdigit() and 0 < int(text) <= len(names):
            return names[int(text) - 1]
        if text:
            print("ERROR: invalid selection. Please enter a number (ctrl-C to cancel)", flush=True)
    raise ToolError("no node was chosen")


_TOOL = Tool(
    "rosnode",
    {
        "cleanup": cleanup,
        "info": info,
        "kill": kill,
        "list": list_nodes,
        "machine": machine,
        "ping": ping,
    },
    _USAGE,
)
