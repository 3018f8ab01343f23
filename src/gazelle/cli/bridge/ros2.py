"""``gazelle bridge ros2``: real ROS 2 and the graph see each other."""

from __future__ import annotations

import argparse
import os
import sys
import threading

from gazelle.bridge.ros2 import About, Bridge, candidates, is_open
from gazelle.cli.ros_types import learn_workspace_types
from gazelle.graph import Graph
from gazelle.process_lifetime import at_stop_signal

__all__ = ["main"]


def main(argv: list[str]) -> int:
    """Run until Ctrl-C."""
    options = _parser().parse_args(argv)
    environ = dict(os.environ)
    learn_workspace_types()
    stop = threading.Event()
    with Graph.open() as graph:
        # Starting ROS may take long; until then a signal ends the process at once.
        bridge = Bridge(graph, candidates(options.python, environ), environ)
        at_stop_signal(stop.set)
        bridge.on_end(stop.set)
        try:
            _say(bridge.about, graph.domain, is_network=is_open(environ))
            stop.wait()
        finally:
            bridge.close()
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="gazelle bridge ros2",
        description="Joins the graph and ROS 2 through ROS's own rclpy, with its middleware and "
        "ROS_DOMAIN_ID. Topics flow only while the other side subscribes. Keeps to this machine "
        "unless ROS_AUTOMATIC_DISCOVERY_RANGE (before Iron: ROS_LOCALHOST_ONLY=0) says otherwise.",
    )
    parser.add_argument(
        "--python",
        metavar="PATH",
        help="the Python that has rclpy; by default that of the sourced ROS 2, else this one",
    )
    return parser


def _say(about: About, domain: int, *, is_network: bool) -> None:
    where = "other machines too" if is_network else "this machine only"
    print(f"the bridge has joined ROS 2: {about.rmw}, domain {domain}, {where}", flush=True)
    print(f"  rclpy of {about.python}", flush=True)
    if is_network:
        print(
            "gazelle bridge ros2: other machines can reach it, and ROS 2 asks nobody for a "
            "password; unset ROS_AUTOMATIC_DISCOVERY_RANGE and ROS_LOCALHOST_ONLY for this "
            "machine only",
            file=sys.stderr,
        )
    else:
        text = "every user of this machine can reach it: ROS 2 asks nobody for a password"
        print(f"  {text}", flush=True)
