"""What `rosgraph` is in Gazelle: a master's answers from the graph, and names."""

from __future__ import annotations

import os
import socket
import sys
from typing import Any
from urllib.parse import urlsplit

from gazelle.compat.rosgraph.rosenv import (
    DEFAULT_MASTER_PORT,
    DEFAULT_MASTER_URI,
    ROS_MASTER_URI,
    get_master_uri,
    warn_of_master,
)
from gazelle.compat.rospy import client
from gazelle.compat.rospy.exceptions import ROSException
from gazelle.compat.rospy.state import STATE
from gazelle.errors import GraphError
from gazelle.graph import Graph

__all__ = [
    "DEFAULT_MASTER_PORT",
    "DEFAULT_MASTER_URI",
    "ROS_HOSTNAME",
    "ROS_IP",
    "ROS_IPV6",
    "ROS_MASTER_URI",
    "ROS_NAMESPACE",
    "Error",
    "Failure",
    "Master",
    "MasterError",
    "MasterException",
    "MasterFailure",
    "ROSMasterException",
    "create_local_xmlrpc_uri",
    "get_address_override",
    "get_bind_address",
    "get_host_name",
    "get_local_address",
    "get_local_addresses",
    "get_master_uri",
    "is_local_address",
    "is_master_online",
    "is_online",
    "parse_http_host_and_port",
    "use_ipv6",
]

ROS_HOSTNAME = "ROS_HOSTNAME"
ROS_IP = "ROS_IP"
ROS_IPV6 = "ROS_IPV6"
ROS_NAMESPACE = "ROS_NAMESPACE"


class MasterException(Exception):  # noqa: N818 - rosgraph's name
    """There is no graph to ask."""


class MasterFailure(MasterException):
    """The master failed, which a graph does not."""


class MasterError(MasterException):
    """A question has no answer."""


Failure, Error, ROSMasterException = MasterFailure, MasterError, MasterException


def parse_http_host_and_port(url: str) -> tuple[str, int]:
    """Return host and port of an address, port 80 when it has none.

    Raises:
        ValueError: it is no address.
    """
    parts = urlsplit(url or "")
    if not parts.scheme or not parts.hostname:
        raise ValueError("not a valid URL")
    return parts.hostname, parts.port or 80


def get_address_override() -> str | None:
    """Return ``__hostname:=`` or ``__ip:=``, ``ROS_HOSTNAME`` or ``ROS_IP``; None without them."""
    for argument in sys.argv:
        if argument.startswith(("__hostname:=", "__ip:=")):
            return argument.partition(":=")[2]
    return os.environ.get(ROS_HOSTNAME, os.environ.get(ROS_IP))


def use_ipv6() -> bool:
    """Tell whether ``ROS_IPV6`` is on."""
    return os.environ.get(ROS_IPV6) == "on"


def get_bind_address(address: str | None = None) -> str:
    """Return the address that a server of a program listens at."""
    given = get_address_override() if address is None else address
    if given and (given in {"localhost", "::1"} or given.startswith("127.")):
        return "::1" if use_ipv6() else given if given.startswith("127.") else "127.0.0.1"
    return "::" if use_ipv6() else "0.0.0.0"  # noqa: S104 - rosgraph's answer


def get_local_addresses() -> list[str]:
    """Return this machine's addresses, as far as its name tells them."""
    family = socket.AF_UNSPEC if use_ipv6() else socket.AF_INET
    found = {"::1": None} if use_ipv6() else {}
    for host in (socket.gethostname(), "localhost"):
        found |= dict.fromkeys(_addresses(host, family))
    return list(found)


def is_local_address(hostname: str) -> bool:
    """Tell whether a name or an address is this machine's."""
    family = socket.AF_UNSPEC if use_ipv6() else socket.AF_INET
    own = get_local_addresses()
    return any(
        one.startswith("127.") or one == "::1" or one in own for one in _addresses(hostname, family)
    )


def create_local_xmlrpc_uri(port: int) -> str:
    """Return the address of a server of this machine."""
    return f"http://{get_host_name()}:{port}/"


def _addresses(host: str, family: int) -> list[str]:
    try:
        rows = socket.getaddrinfo(host, 0, family, 0, socket.SOL_TCP)
    except OSError:
        return []
    return [str(row[4][0]) for row in rows]


def get_host_name() -> str:
    """Return this machine's name, or what ``ROS_HOSTNAME`` or ``ROS_IP`` says."""
    return os.environ.get(ROS_HOSTNAME) or os.environ.get(ROS_IP) or socket.gethostname()


def get_local_address() -> str:
    """Return the address others would use, which is this machine's own."""
    return os.environ.get(ROS_HOSTNAME) or os.environ.get(ROS_IP) or "127.0.0.1"


def is_master_online(master_uri: str | None = None) -> bool:
    """Return whether a graph is running; another address than this one's own is told of."""
    warn_of_master(master_uri)
    try:
        Graph.open(role="client").close()
    except GraphError:
        return False
    return True


is_online = is_master_online


class Master:
    """Answers without the status that the XML-RPC calls carry.

    Every call raises `MasterException` when no graph is running.

    Args:
        caller_id: without effect: the graph knows who asks.
        master_uri: told once where it is not this process's own.
    """

    def __init__(self, caller_id: str = "", master_uri: str | None = None) -> None:
        warn_of_master(master_uri)
        self.master_uri = master_uri or get_master_uri()
        self._answers = client.Master()

    def getSystemState(self) -> list[Any]:
        """Return publishers, subscribers and services by name."""
        return list(self._checked(lambda: self._answers.getSystemState()[2]))

    def getPublishedTopics(self, subgraph: str = "/") -> list[list[str]]:
        """Return ``[topic, type]`` of all published topics."""
        return list(self._checked(lambda: self._answers.getPublishedTopics(subgraph)[2]))

    def getTopicTypes(self) -> list[list[str]]:
        """Return ``[topic, type]`` of all topics, subscribed ones too."""
        from gazelle.interfaces import ros1_type_of

        topics = self._checked(lambda: STATE.open_graph().topics())
        return [[one.name, ros1_type_of(one.type_name)] for one in topics]

    def getPid(self) -> int:
        """Return this process's number."""
        return int(self._checked(lambda: self._answers.getPid()[2]))

    def getUri(self) -> str:
        """Return the master's address."""
        return self.master_uri

    def lookupNode(self, node_name: str) -> str:
        """Return a node's address, ``gazelle://HOST/PID``: nodes have no XML-RPC of their own.

        Raises:
            MasterError: there is no such node.
        """
        from gazelle.errors import NotFoundError

        try:
            info = self._checked(lambda: STATE.open_graph().node_info(node_name))
        except NotFoundError as error:
            raise MasterError(f"unknown node [{node_name}]") from error
        return f"gazelle://{info.host}/{info.pid}"

    def lookupService(self, service: str) -> str:
        """Return the address of the node that answers a service.

        Raises:
            MasterError: nobody does.
        """
        services = self._checked(lambda: STATE.open_graph().services())
        for one in services:
            if one.name == STATE.resolved(service) and one.servers:
                return self.lookupNode(one.servers[0])
        raise MasterError("no provider")

    def getParam(self, key: str) -> Any:
        """Return a parameter.

        Raises:
            MasterError: it is not set.
        """
        try:
            return self._checked(lambda: client.get_param(key))
        except KeyError as error:
            raise MasterError(f"Parameter [{key}] is not set") from error

    def setParam(self, key: str, value: Any) -> None:
        """Set a parameter."""
        self._checked(lambda: client.set_param(key, value))

    def hasParam(self, key: str) -> bool:
        """Return whether a parameter is set."""
        return bool(self._checked(lambda: client.has_param(key)))

    def deleteParam(self, key: str) -> None:
        """Delete a parameter.

        Raises:
            MasterError: it is not set.
        """
        try:
            self._checked(lambda: client.delete_param(key))
        except KeyError as error:
            raise MasterError(f"parameter [{key}] is not set") from error

    def searchParam(self, key: str) -> str | None:
        """Return the global name of a parameter, looked for from here upwards."""
        found: str | None = self._checked(lambda: client.search_param(key))
        return found

    def getParamNames(self) -> list[str]:
        """Return the names of all parameters."""
        return list(self._checked(client.get_param_names))

    def is_online(self) -> bool:
        """Return whether a graph is running."""
        return is_master_online()

    def _checked(self, call: Any) -> Any:
        try:
            return call()
        except ROSException as error:
            raise MasterException(str(error)) from error
