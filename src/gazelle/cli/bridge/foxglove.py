"""``gazelle bridge foxglove``: Foxglove, in a browser or on the desktop, sees the graph."""

from __future__ import annotations

import argparse
import ipaddress
import sys
import threading

from gazelle.bridge.foxglove import Allow, FoxgloveBridge, SdkViewers
from gazelle.bridge.foxglove.server_interface import Requests
from gazelle.cli.ros_types import learn_workspace_types
from gazelle.errors import GraphError
from gazelle.graph import Graph
from gazelle.process_lifetime import at_stop_signal
from gazelle.workspace import Workspace

__all__ = ["main"]

_PORT = 8765
_LOOPBACK = "127.0.0.1"


def main(argv: list[str]) -> int:
    """Run until Ctrl-C; 1 when the server cannot start."""
    options = _parser().parse_args(argv)
    learn_workspace_types()
    stop = threading.Event()
    at_stop_signal(stop.set)
    with Graph.open() as graph:
        try:
            bridge = FoxgloveBridge(
                graph,
                Workspace.discover(),
                lambda requests: _serve(requests, options),
                options.allow,
            )
        except GraphError as error:
            print(f"gazelle bridge foxglove: {error}", file=sys.stderr)
            return 1
        bridge.on_end(stop.set)
        try:
            _say(options, bridge.port)
            stop.wait()
        finally:
            bridge.close()
    return 0


def _serve(requests: Requests, options: argparse.Namespace) -> SdkViewers:
    return SdkViewers(requests, host=options.host, port=options.port, allow=options.allow)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="gazelle bridge foxglove",
        description="Shows the graph to Foxglove and other viewers of its WebSocket protocol. "
        "Topics flow only while a viewer subscribes. Viewers only look unless --allow says more.",
    )
    parser.add_argument("-p", "--port", type=_port, default=_PORT, help="default: 8765")
    parser.add_argument(
        "--host", default=_LOOPBACK, help="address to listen on, default: 127.0.0.1"
    )
    parser.add_argument(
        "--allow",
        type=_allowed,
        default=frozenset(),
        metavar="LIST",
        help="what viewers may do: publish, services, parameters, separated by commas",
    )
    return parser


def _port(text: str) -> int:
    if not text.isdigit() or int(text) > 65535:
        raise argparse.ArgumentTypeError(f"'{text}' is not a port number from 0 to 65535")
    return int(text)


def _allowed(text: str) -> frozenset[Allow]:
    names = [word.strip() for word in text.split(",") if word.strip()]
    known = [one.value for one in Allow]
    unknown = [word for word in names if word not in known]
    if unknown:
        raise argparse.ArgumentTypeError(f"'{unknown[0]}' is none of {', '.join(known)}")
    return frozenset(Allow(word) for word in names)


def _say(options: argparse.Namespace, port: int) -> None:
    host = f"[{options.host}]" if ":" in options.host else options.host
    print(f"the bridge listens at ws://{host}:{port}", flush=True)
    print("  in Foxglove: Open connection, Foxglove WebSocket, this address", flush=True)
    allowed = ", ".join(sorted(one.value for one in options.allow))
    if not _is_loopback(options.host):
        more = f" and use {allowed}" if allowed else ""
        _warn(f"everybody who reaches {options.host} can see all topics{more}; nobody is asked "
              "for a password")  # fmt: skip
        return
    print("  every user of this machine can look", flush=True)
    if allowed:
        _warn(
            f"web pages open in a browser on this machine can use {allowed} too: the server "
            "takes connections from any page"
        )


def _is_loopback(host: str) -> bool:
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"


def _warn(text: str) -> None:
    print(f"gazelle bridge foxglove: {text}", file=sys.stderr)
