"""``roscore``: the graph's hub, the parameter store and rosout, for people who start with it."""

from __future__ import annotations

import argparse

from gazelle.diagnostics import Diagnostics
from gazelle.launch.launch_config import LaunchConfig
from gazelle.launch.roslaunch import LaunchOptions, launch
from gazelle.workspace import Workspace

__all__ = ["main"]


def main(argv: list[str]) -> int:
    """Run until Ctrl-C."""
    parser = argparse.ArgumentParser(
        prog="roscore",
        description="Runs the hub and parameter store alone; nothing in Gazelle needs it.",
    )
    parser.add_argument("-p", "--port", type=int, help="port of the graph")
    parser.add_argument("-v", dest="verbose", action="store_true", help="accepted")
    options = parser.parse_args(argv)
    return launch(
        LaunchConfig(),
        workspace=Workspace.discover(),
        diagnostics=Diagnostics(),
        options=LaunchOptions(port=options.port),
        title="roscore",
    )
