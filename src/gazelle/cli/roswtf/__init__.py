"""``roswtf [FILE.launch …]``: what is wrong in files (the doctor says) and in the running graph."""

from __future__ import annotations

import argparse
import os
from pathlib import Path

from gazelle.cli.roswtf.findings import Findings, summary
from gazelle.cli.roswtf.static import look_at_files, look_at_folder
from gazelle.graph import Graph, NoGraphError

__all__ = ["main"]

_RULE = "=" * 80
_NO_MASTER = "ROS Master does not appear to be running.\nOnline graph checks will not be run."


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


def _files(launches: list[str], *, everything: bool) -> None:
    found = Findings()
    if launches:
        look_at_files(launches, found)
    else:
        look_at_folder(Path.cwd(), found, everything=everything)
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
    from gazelle.cli.roswtf.online import look_at_graph

    print("Beginning tests of your ROS graph. These may take a while...", flush=True)
    with graph:
        print("analyzing graph...\n... done analyzing graph\nrunning graph rules...", flush=True)
        found = look_at_graph(graph)
    print("... done running graph rules\n")
    print(summary("Online checks summary:", found), flush=True)
