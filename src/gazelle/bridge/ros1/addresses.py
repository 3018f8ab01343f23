"""Where the master is, and what this machine is called: ROS 1's environment variables."""

from __future__ import annotations

import socket
from collections.abc import Mapping
from typing import NamedTuple
from urllib.parse import urlsplit

from gazelle.errors import GraphError
from gazelle.graph.errors import coded

__all__ = ["Address", "MasterAddress", "address_of_master", "master_address", "own_address"]

_LOOPBACK = "127.0.0.1"
_EVERYWHERE = "0.0.0.0"  # noqa: S104 - only where ROS_HOSTNAME or ROS_IP ask for it
_LOCAL_NAMES = frozenset({"localhost", _LOOPBACK, "[::1]"})
_DEFAULT_URI = "http://127.0.0.1:11311"


class Address(NamedTuple):
    """How servers of this process are reached.

    Attributes:
        bind: the address they listen at.
        host: the name that others are told.
        names: all names they may be called by.
    """

    bind: str
    host: str
    names: frozenset[str]

    @property
    def is_loopback(self) -> bool:
        """Whether only this machine can reach them."""
        return self.bind.startswith("127.")


class MasterAddress(NamedTuple):
    """Where the master is or shall be."""

    host: str
    port: int

    @property
    def uri(self) -> str:
        """For XMLRPC."""
        return f"http://{self.host}:{self.port}/"

    @property
    def is_here(self) -> bool:
        """Whether the host is this machine."""
        if self.host in _LOCAL_NAMES:
            return True
        try:
            socket.create_server((socket.gethostbyname(self.host), 0)).close()
        except OSError:
            return False
        return True


def master_address(environ: Mapping[str, str], port: int | None = None) -> MasterAddress:
    """Return the master's place from ``ROS_MASTER_URI``.

    Args:
        environ: the environment.
        port: on this machine, in place of the variable.

    Raises:
        GraphError: the variable is not a URI with host and port.
    """
    if port is not None:
        return MasterAddress(_LOOPBACK, port)
    text = environ.get("ROS_MASTER_URI", "").strip() or _DEFAULT_URI
    try:
        parts = urlsplit(text)
        host, number = parts.hostname, parts.port
    except ValueError:
        host = number = None
    if not host or not number:
        raise GraphError(
            f"ROS_MASTER_URI is '{text}', not http://<host>:<port>\n"
            "  fix: export ROS_MASTER_URI=http://localhost:11311, or unset it"
        )
    return MasterAddress(host, number)


def own_address(environ: Mapping[str, str]) -> Address:
    """Return what ``ROS_HOSTNAME``, else ``ROS_IP`` say; the loopback interface without them.

    A name of the loopback interface keeps to it; another one opens the servers on every
    interface, as nodes of ROS 1 do.

    Raises:
        GraphError: the name is not an address of this machine.
    """
    host = environ.get("ROS_HOSTNAME", "").strip() or environ.get("ROS_IP", "").strip()
    if not host:
        return Address(_LOOPBACK, _LOOPBACK, _LOCAL_NAMES)
    variable = "ROS_HOSTNAME" if environ.get("ROS_HOSTNAME", "").strip() else "ROS_IP"
    try:
        found = socket.gethostbyname(host)
        socket.create_server((found, 0)).close()
    except OSError as error:
        raise GraphError(
            f"{variable} is '{host}', which is not an address of this machine ({error})\n"
            f"  fix: unset {variable}; then only this machine can reach the bridge"
        ) from error
    names = {host.lower(), found, socket.gethostname().lower()}
    bind = found if found.startswith("127.") else _EVERYWHERE
    return Address(bind, host, _LOCAL_NAMES | names)


def address_of_master(master: MasterAddress, own: Address) -> Address:
    """Return where a master of our own listens, so that it is found at its place.

    Args:
        master: on this machine.
        own: what the other servers of the bridge bind to.

    Raises:
        GraphError: the place is one that other machines can reach, and the bridge is not open.
    """
    if not own.is_loopback or master.host in _LOCAL_NAMES:
        return own._replace(names=own.names | {master.host})
    found = socket.gethostbyname(master.host)
    if not found.startswith("127."):
        text = f"{master.uri} is this machine as others reach it, and the bridge is open to none"
        fix = f"export ROS_MASTER_URI=http://localhost:{master.port} in all shells, or open the "
        fix += f"bridge to other machines: export ROS_HOSTNAME={master.host}"
        raise GraphError(coded("bridge.not-open", text, fix=fix))
    return Address(found, master.host, own.names | {master.host.lower(), found})
