"""``gazelle bridge ros1``: real ROS 1 and the graph see each other."""

from __future__ import annotations

import argparse
import os
import sys
import threading

from gazelle.bridge.ros1 import Address, Bridge, MasterAddress, master_address, own_address
from gazelle.cli.ros_types import learn_workspace_types
from gazelle.graph import Graph
from gazelle.process_lifetime import at_stop_signal

__all__ = ["main"]


def main(argv: list[str]) -> int:
    """Run until Ctrl-C."""
    options = _parser().parse_args(argv)
    master = master_address(os.environ, options.port)
    address = own_address(os.environ)
    learn_workspace_types()
    stop = threading.Event()
    at_stop_signal(stop.set)
    with Graph.open() as graph:
        bridge = Bridge(graph, master, address)
        bridge.on_end(stop.set)
        try:
            _say(bridge, master, address)
            stop.wait()
        finally:
            bridge.close()
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="gazelle bridge ros1",
        description="Joins the graph and ROS 1. Joins the master at ROS_MASTER_URI if one runs "
        "there, else it is the master. Topics flow only while the other side subscribes.",
    )
    parser.add_argument(
        "-p",
        "--port",
        type=_port,
        help="port of the master on this machine, in place of ROS_MASTER_URI",
    )
    return parser


def _port(text: str) -> int:
    if not text.isdigit() or not 0 < int(text) < 65536:
        raise argparse.ArgumentTypeError(f"'{text}' is not a port number from 1 to 65535")
    return int(text)


def _say(bridge: Bridge, master: MasterAddress, address: Address) -> None:
    what = "is the master" if bridge.master.is_embedded else "has joined the master"
    print(f"the bridge {what} at {bridge.master.uri}", flush=True)
    print(
        f"  in shells of ROS 1: export ROS_MASTER_URI={bridge.master.uri.rstrip('/')}", flush=True
    )
    if not address.is_loopback:
        print(
            f"gazelle bridge ros1: other machines can reach it as {address.host}, and ROS 1 asks "
            "nobody for a password; unset ROS_HOSTNAME and ROS_IP for this machine only",
            file=sys.stderr,
        )
        return
    print("  every user of this machine can reach it: ROS 1 asks nobody for a password", flush=True)
    if not master.is_here:
        print(
            f"gazelle bridge ros1: nodes on {master.host} cannot reach this machine as "
            f"{address.host}; export ROS_IP with its address in their network",
            file=sys.stderr,
        )
