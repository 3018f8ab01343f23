"""How sessions are set up, and which port the hub has.

Proven on one machine: one hub in router mode, processes are peers that find each other through it
by gossip, command-line tools are clients. No multicast; nothing listens beyond this machine, nor
for anybody else on it (see `locators`).
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any
from urllib.parse import urlparse

from gazelle.errors import GraphError
from gazelle.graph.locators import hub_endpoint

if TYPE_CHECKING:
    import zenoh

__all__ = ["DEFAULT_PORT", "client_config", "domain_of", "hub_config", "peer_config", "port_of"]

DEFAULT_PORT = 7447
_DEFAULT_MASTER_PORT = 11311
_MAX_DOMAIN = 232
_BLOCKED_LINK_CLOSES_US = 5_000_000


def domain_of(environ: Mapping[str, str]) -> int:
    """Return ``ROS_DOMAIN_ID``, 0 when it is not set.

    Raises:
        GraphError: it is not a number from 0 to 232.
    """
    text = environ.get("ROS_DOMAIN_ID", "").strip() or "0"
    if not text.isdigit() or int(text) > _MAX_DOMAIN:
        raise GraphError(
            f"ROS_DOMAIN_ID is '{text}', not a number from 0 to {_MAX_DOMAIN}\n"
            "  fix: export ROS_DOMAIN_ID=0, or unset it"
        )
    return int(text)


def port_of(environ: Mapping[str, str]) -> int:
    """Return the graph's number, which the hub's place has: a port, where places are ports.

    ``GAZELLE_PORT`` decides. Else it is 7447, plus ``ROS_DOMAIN_ID``, plus the distance of the
    port in ``ROS_MASTER_URI`` from 11311: people who separate graphs with either get separate
    hubs. The host in ``ROS_MASTER_URI`` has no effect; nothing leaves this machine.

    Raises:
        GraphError: a variable is not usable.
    """
    text = environ.get("GAZELLE_PORT", "").strip()
    if text:
        if not text.isdigit() or not 0 < int(text) < 65536:
            raise GraphError(f"GAZELLE_PORT is '{text}', not a port number from 1 to 65535")
        return int(text)
    port = DEFAULT_PORT + domain_of(environ) + _master_port(environ) - _DEFAULT_MASTER_PORT
    return port if 1024 <= port <= 65535 else 1024 + port % 64512


def hub_config(port: int) -> zenoh.Config:
    """Return the setting of the hub: a router that listens at its place and connects nowhere."""
    return _config("router", listen=[hub_endpoint(port)])


def peer_config(port: int, endpoint: str) -> zenoh.Config:
    """Return the setting of a process with nodes: looks for the hub for ever.

    Args:
        port: the hub's.
        endpoint: where to listen, of `own_endpoint`.
    """
    return _config(
        "peer",
        listen=[endpoint],
        connect=[hub_endpoint(port)],
        settings={"connect/timeout_ms": -1, "connect/exit_on_failure": False},
    )


def client_config(port: int, patience_s: float = 0.5) -> zenoh.Config:
    """Return the setting of a command-line tool: opens only when a hub is there.

    Args:
        port: the hub's.
        patience_s: how long who listens there may take to answer as a hub does.
    """
    return _config(
        "client",
        connect=[hub_endpoint(port)],
        settings={"connect/timeout_ms": round(patience_s * 1000), "connect/exit_on_failure": True},
    )


def _config(
    mode: str,
    *,
    listen: list[str] | None = None,
    connect: list[str] | None = None,
    settings: Mapping[str, Any] | None = None,
) -> zenoh.Config:
    import zenoh

    values: dict[str, Any] = {
        "mode": mode,
        "listen/endpoints": listen or [],
        "connect/endpoints": connect or [],
        "connect/retry": {
            "period_init_ms": 20,
            "period_max_ms": 200,
            "period_increase_factor": 2,
        },
        "scouting/multicast/enabled": False,
        "scouting/gossip/enabled": True,
        # Without this a router waits half a second for answers to scouting that is switched off.
        "scouting/delay": 0,
        "open/return_conditions/connect_scouted": False,
        # Latched messages are told apart by their time.
        "timestamping/enabled": True,
        "transport/shared_memory/enabled": False,
        # A link to another process that is not opened in this time is tried no more: where sixty
        # start at once, two seconds left some without one.
        "transport/unicast/open_timeout": 30_000,
        "transport/unicast/accept_timeout": 30_000,
        # A process that was stopped must not stall reliable publishers for ever. All that waits in
        # a link goes with it, so a machine with much to do has to have time to read.
        "transport/link/tx/queue/congestion_control/block/wait_before_close": (
            _BLOCKED_LINK_CLOSES_US
        ),
        **(settings or {}),
    }
    config = zenoh.Config()
    for key, value in values.items():
        config.insert_json5(key, json.dumps(value))
    return config


def _master_port(environ: Mapping[str, str]) -> int:
    uri = environ.get("ROS_MASTER_URI", "").strip()
    if not uri:
        return _DEFAULT_MASTER_PORT
    try:
        port = urlparse(uri).port
    except ValueError:
        port = None
    if port is None:
        raise GraphError(
            f"ROS_MASTER_URI is '{uri}', not http://<host>:<port>\n"
            "  fix: export ROS_MASTER_URI=http://localhost:11311, or unset it"
        )
    return port
