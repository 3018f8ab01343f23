"""``roswtf [FILE.launch …]``: what is wrong in files and in the running graph.

Files are the doctor's; for the graph there are the rules of the original and of its plug-in for tf.
"""

from __future__ import annotations

import argparse
import os
import threading
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from gazelle.cli.node_processes import Processes
from gazelle.diagnostics import Severity
from gazelle.errors import GazelleError
from gazelle.graph import Entity, Graph, Kind, NoGraphError
from gazelle.workspace import Workspace

__all__ = ["Findings", "look_at_graph", "main", "summary"]

_WARNING = "\033[1mWARNING\033[0m"
_ERROR = "\033[31m\033[1mERROR\033[0m"
_LISTEN_S = 1.0
_OWN = "/roswtf"
_ANY = "*"
# They come and go with ROS itself; a clock that is missing has a rule of its own.
_NEVER_MISSED = ("/rosout", "/rosout_agg", "/parameter_events", "/clock")
_RULE = "=" * 80
_NO_MASTER = "ROS Master does not appear to be running.\nOnline graph checks will not be run."


@dataclass(slots=True)
class Findings:
    """Texts of warnings and errors, in the order found."""

    warnings: list[str] = field(default_factory=list)
    errors: list[str] = field(default_factory=list)

    def warn(self, title: str, items: list[str]) -> None:
        """Add a warning about several things, if there are any."""
        if items:
            self.warnings.append("\n".join([title, *items]) + "\n")

    def blame(self, title: str, items: list[str]) -> None:
        """Add an error about several things, if there are any."""
        if items:
            self.errors.append("\n".join([title, *items]) + "\n")


def main(argv: list[str]) -> int:
    """Print both summaries.

    Returns:
        0 whatever was found, as the original does; 1 when a file is missing, 2 for wrong usage.
    """
    parser = argparse.ArgumentParser(
        prog="roswtf",
        description="roswtf is a tool for verifying a ROS installation and running system.",
    )
    parser.add_argument("launch", nargs="*", metavar="LAUNCH", help="launch files to look at")
    parser.add_argument("--all", action="store_true", help="run all tests against all packages")
    parser.add_argument("--offline", action="store_true", help="only run offline tests")
    try:
        options = parser.parse_args(argv)
    except SystemExit as stop:
        return int(stop.code or 0)
    missing = [name for name in options.launch if not Path(name).is_file()]
    if missing:
        parser.print_usage()
        print(f"roswtf: cannot locate file: {', '.join(missing)}")
        return 1
    _files(options.launch, everything=options.all)
    if not options.offline:
        _graph()
    return 0


def summary(title: str, found: Findings) -> str:
    """Return the block of one kind of checks, colours included, without the last line end."""
    lines = [title, ""]
    if not found.warnings and not found.errors:
        return "\n".join([*lines, "No errors or warnings"])
    if found.warnings:
        lines.append(f"Found {len(found.warnings)} warning(s).")
        lines += ["Warnings are things that may be just fine, but are sometimes at fault", ""]
        lines += [*(f"{_WARNING} {text}" for text in found.warnings), ""]
    if found.errors:
        lines += [f"Found {len(found.errors)} error(s).", ""]
        lines += [f"{_ERROR} {text}" for text in found.errors]
    return "\n".join(lines).removesuffix("\n" if not found.errors else "")


def look_at_graph(graph: Graph, listen_s: float = _LISTEN_S) -> Findings:
    """Apply every rule; listens to tf for a moment.

    Args:
        graph: the graph.
        listen_s: how long.
    """
    found = Findings()
    entities = [one for one in graph.entities() if not one.node.startswith(_OWN)]
    _unconnected(entities, found)
    _simulated_time(graph, entities, found)
    _silent_nodes(graph, entities, found)
    _types(entities, found)
    _services(entities, found)
    _frames(graph, found, listen_s)
    return found


def _look_at_files(launches: Sequence[str], found: Findings) -> None:
    """Examine launch files."""
    for name in launches:
        _examine([name], found)


def _look_at_folder(folder: Path, found: Findings, *, everything: bool) -> None:
    """Examine the package of a folder; the whole workspace with `everything`."""
    workspace = Workspace.discover()
    here = {folder.resolve(), *folder.resolve().parents}
    own = list(workspace.user_packages)
    package = next((item for item in own if item.path.resolve() in here), None)
    if package is None:
        print("No package or stack in the current directory")
    else:
        print(f"Package: {package.name}")
    if everything:
        names = [str(item.path) for item in own]
    else:
        names = [] if package is None else [str(package.path)]
    for name in names:
        _examine([name], found)


def _examine(argv: list[str], found: Findings) -> None:
    # The doctor is not needed for a look at the graph alone.
    from gazelle.doctor import examine

    try:
        report = examine(argv)
    except GazelleError as error:
        found.errors.append(str(error))
        return
    for item in report.findings:
        location = f"{item.span}: " if item.span else ""
        text = f"{location}{item.message} [{item.code}]" + (
            f"\n  fix: {item.fix}" if item.fix else ""
        )
        if item.severity is Severity.ERROR:
            found.errors.append(text)
        elif item.severity is Severity.WARNING:
            found.warnings.append(text)


def _unconnected(entities: list[Entity], found: Findings) -> None:
    published = {one.name for one in entities if one.kind is Kind.PUBLISHER}
    by_node: dict[str, set[str]] = defaultdict(set)
    for one in entities:
        if one.kind is Kind.SUBSCRIPTION and one.name not in {*published, *_NEVER_MISSED}:
            by_node[one.node].add(one.name)
    lines = []
    for node, topics in sorted(by_node.items()):
        lines += [f" * {node}:", *(f"   * {topic}" for topic in sorted(topics))]
    found.warn("The following node subscriptions are unconnected:", lines)


def _simulated_time(graph: Graph, entities: list[Entity], found: Findings) -> None:
    is_simulated = graph.parameters.get("/use_sim_time", False) is True
    clocks = [one for one in entities if one.kind is Kind.PUBLISHER and one.name == "/clock"]
    if is_simulated and not clocks:
        found.warnings.append("/use_sim_time is set but no publisher of /clock is present")


def _silent_nodes(graph: Graph, entities: list[Entity], found: Findings) -> None:
    processes = Processes(graph, entities)
    silent = [name for name in sorted(processes.zid_of) if not processes.ask(name)[0]]
    title = "Could not contact the following nodes:"
    found.blame(title, [f" * {name}" for name in silent])


def _types(entities: list[Entity], found: Findings) -> None:
    types: dict[str, dict[str, set[str]]] = defaultdict(lambda: defaultdict(set))
    for one in entities:
        if one.kind in (Kind.PUBLISHER, Kind.SUBSCRIPTION) and one.type_name != _ANY:
            types[one.name][one.type_name].add(one.node)
    lines = [
        f" * topic [{topic}] is {kind} for {', '.join(sorted(nodes))}"
        for topic, kinds in sorted(types.items())
        if len(kinds) > 1
        for kind, nodes in sorted(kinds.items())
    ]
    found.blame("Nodes disagree about the types of topics, so they hear nothing:", lines)


def _services(entities: list[Entity], found: Findings) -> None:
    servers: dict[str, list[str]] = defaultdict(list)
    for one in entities:
        if one.kind is Kind.SERVICE:
            servers[one.name].append(one.node)
    lines = [
        f" * service [{name}] is provided by {', '.join(sorted(nodes))}"
        for name, nodes in sorted(servers.items())
        if len(nodes) > 1
    ]
    found.warn("The following services have several providers; one of them answers:", lines)


def _frames(graph: Graph, found: Findings, listen_s: float) -> None:
    from gazelle.graph.tf import TransformBuffer, TransformListener

    node = graph.create_node(_OWN.strip("/"), anonymous=True, rosout=False)
    told: list[str] = []
    buffer = TransformBuffer(on_warning=told.append)
    listener = TransformListener(buffer, node)
    threading.Event().wait(listen_s)
    listener.close()
    found.blame("TF problems:", [f" * {text}" for text in told])
    roots = {one.parent for one in buffer.frames()} - {one.name for one in buffer.frames()}
    if len(roots) > 1:
        title = "TF: there are several trees, and no transforms between them; their roots:"
        found.warn(title, [f" * {name}" for name in sorted(roots)])
    node.shutdown()


def _files(launches: list[str], *, everything: bool) -> None:
    found = Findings()
    if launches:
        _look_at_files(launches, found)
    else:
        _look_at_folder(Path.cwd(), found, everything=everything)
    print(_RULE)
    print(summary("Static checks summary:", found), flush=True)


def _graph() -> None:
    print(_RULE)
    try:
        graph = Graph.open(role="client")
    except NoGraphError:
        uri = os.environ.get("ROS_MASTER_URI", "http://localhost:11311")
        print(f"{_NO_MASTER}\nROS_MASTER_URI is [{uri}]")
        return
    print("Beginning tests of your ROS graph. These may take a while...", flush=True)
    with graph:
        print("analyzing graph...\n... done analyzing graph\nrunning graph rules...", flush=True)
        found = look_at_graph(graph)
    print("... done running graph rules\n")
    print(summary("Online checks summary:", found), flush=True)
