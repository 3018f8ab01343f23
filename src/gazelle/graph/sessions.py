"""How sessions of the transport are set up and end, and which port the hub has.

Proven on one machine: one hub in router mode, processes are peers that find each other through it
by gossip, command-line tools are clients. No multicast; nothing listens beyond this machine, nor
for anybody else on it (see `locators`).
"""

from __future__ import annotations

import contextlib
import ctypes
import json
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any
from urllib.parse import urlparse

from gazelle.errors import GraphError
from gazelle.graph.locators import hub_endpoint

if TYPE_CHECKING:
    import zenoh

__all__ = [
    "DEFAULT_PORT",
    "CallsInFlight",
    "client_config",
    "close_session",
    "domain_of",
    "hub_config",
    "liveliness_tokens",
    "peer_config",
    "port_of",
]

_CLOSE_S = 2.0
DEFAULT_PORT = 7447
_DEFAULT_MASTER_PORT = 11311
_MAX_DOMAIN = 232
_BLOCKED_LINK_CLOSES_US = 5_000_000
_MAX_REPLIES = 1 << 20


class CallsInFlight:
    """Counts threads that wait inside the transport.

    A thread that is still there when Python ends is ended by force, and the transport's frames
    cannot be: the process would abort.
    """

    def __init__(self) -> None:
        self._count = 0
        self._changed = threading.Condition()

    @contextmanager
    def waiting(self) -> Iterator[None]:
        """Mark the calling thread as one that waits."""
        with self._changed:
            self._count += 1
        try:
            yield
        finally:
            with self._changed:
                self._count -= 1
                self._changed.notify_all()

    def wait_until_none(self, timeout_s: float) -> bool:
        """Wait until no thread waits any more; False when time is up first."""
        with self._changed:
            return self._changed.wait_for(lambda: self._count == 0, timeout_s)


def close_session(session: Any, then: Callable[[], None] | None = None) -> None:
    """Leave; what the session declared disappears for all others.

    The transport waits up to ten seconds for its threads, which may be in the middle of a link
    that just broke. They get two here; the process' end takes the rest.

    The object stays for good (20 kB). Its destructor waits for the transport's threads, too, but
    does not let other threads of Python run meanwhile, and a callback of another session that one
    of these is in would wait for just that: everything in the process stood still for ten seconds,
    and all its links were lost.

    Args:
        session: the one to close.
        then: called when it is closed, however long that takes.
    """
    ctypes.pythonapi.Py_IncRef(ctypes.py_object(session))
    arguments = (session, then or _do_nothing)
    closing = threading.Thread(target=_close, args=arguments, name="gazelle-close", daemon=True)
    try:
        closing.start()
    except RuntimeError:
        # Python 3.12 and later start no thread at the process' very end.
        _close(*arguments)
    else:
        closing.join(_CLOSE_S)


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


def liveliness_tokens(session: Any, selector: str, timeout_s: float) -> frozenset[str] | None:
    """Ask for liveliness tokens.

    Args:
        session: who asks; it leaves out what its own subscribers of tokens were told before.
        selector: of the tokens.
        timeout_s: how long to wait for the answer's end.

    Returns:
        Their key expressions; None when the answer had no end in time.

    Raises:
        zenoh.ZError: the session is closed.
    """
    import zenoh

    # What this session knows is answered before get() returns: a channel of zenoh's usual
    # 256 places would fill up and nobody could ever empty it.
    channel: Any = zenoh.handlers.FifoChannel(_MAX_REPLIES)
    # All are taken: one that finds no place would hold up the close.
    replies = tuple(session.liveliness().get(selector, channel, timeout=timeout_s))
    if any(reply.ok is None for reply in replies):
        return None
    return frozenset(str(reply.ok.key_expr) for reply in replies)


def _close(session: Any, then: Callable[[], None]) -> None:
    import zenoh

    with contextlib.suppress(zenoh.ZError):
        session.close()
    then()


def _do_nothing() -> None:
    pass


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
