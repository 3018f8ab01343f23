"""The master, whichever it is: one that ROS 1 runs, or our own."""

from __future__ import annotations

import errno
import uuid
from collections.abc import Callable
from typing import Any, Protocol

from gazelle.bridge.ros1.addresses import Address, MasterAddress, address_of_master
from gazelle.bridge.ros1.master import Master
from gazelle.bridge.ros1.master_registry import State
from gazelle.bridge.ros1.tcpros_server import ServerSocket
from gazelle.bridge.ros1.xmlrpc_call import RemoteRefusedError, call
from gazelle.errors import GraphError
from gazelle.graph import ParameterStore
from gazelle.graph.errors import coded

__all__ = ["EmbeddedMaster", "MasterConnection", "RunningMaster", "find_master"]

_SUCCESS = 1
_ASKING = "/ros1_bridge"
_PROBE_S = 2.0
_FACTS = {"/rosdistro": "noetic\n", "/rosversion": "1.15.15\n"}


class MasterConnection(Protocol):
    """How the bridge talks to a master."""

    uri: str
    is_embedded: bool

    def ask(self, method: str, *arguments: Any) -> Any:
        """Call a method of the Master API and return its value."""

    def state(self) -> State:
        """Return what is registered."""

    def close(self) -> None:
        """Leave it."""


class RunningMaster:
    """A master that ROS 1 runs in another process."""

    is_embedded = False

    def __init__(self, uri: str) -> None:
        self.uri = uri

    def ask(self, method: str, *arguments: Any) -> Any:
        """Call a method.

        Raises:
            RemoteError: it does not answer, or refuses.
        """
        return call(self.uri, method, *arguments)

    def state(self) -> State:
        """Ask for what is registered.

        Raises:
            RemoteError: it does not answer.
        """
        sides = self.ask("getSystemState", _ASKING)
        types = self.ask("getTopicTypes", _ASKING)
        pairs = [
            frozenset((node, name) for name, nodes in side for node in nodes) for side in sides
        ]
        return State(pairs[0], pairs[1], pairs[2], {str(one[0]): str(one[1]) for one in types})

    def close(self) -> None:
        """Nothing to do; it stays."""


class EmbeddedMaster:
    """A master of our own, for as long as the bridge runs."""

    is_embedded = True

    def __init__(
        self,
        parameters: ParameterStore,
        master: MasterAddress,
        address: Address,
        on_change: Callable[[], None],
        notice: Callable[[str], None],
    ) -> None:
        """Listen at the master's place.

        Raises:
            GraphError: its port belongs to another program.
        """
        self._master = Master(parameters, on_change)
        try:
            self._server_socket = ServerSocket(
                address, self._master.methods, None, notice, port=master.port
            )
        except OSError as error:
            self._master.close()
            text = (
                f"port {master.port} is taken by a program that is not a ROS 1 master, or by one "
            )
            text += "that does not answer"
            if error.errno != errno.EADDRINUSE:
                text = f"port {master.port} cannot be listened at: {error.strerror}"
            fix = "end that program, or choose another port: gazelle bridge ros1 --port 11312"
            raise GraphError(coded("bridge.master-port-taken", text, fix=fix)) from error
        self.uri = self._master.uri = self._server_socket.uri
        for name, value in _FACTS.items():
            if not parameters.has(name):
                parameters.set(name, value)
        if not parameters.has("/run_id"):
            parameters.set("/run_id", str(uuid.uuid1()))

    def ask(self, method: str, *arguments: Any) -> Any:
        """Call a method.

        Raises:
            RemoteRefusedError: it refuses.
        """
        code, text, value = self._master.methods[method](*arguments)
        if code != _SUCCESS:
            raise RemoteRefusedError(text)
        return value

    def state(self) -> State:
        """Return what is registered."""
        return self._master.registry.state()

    def close(self) -> None:
        """Listen no more; nodes of ROS 1 go on and wait for the next master."""
        self._server_socket.close()
        self._master.close()


def find_master(
    parameters: ParameterStore,
    master: MasterAddress,
    address: Address,
    on_change: Callable[[], None],
    notice: Callable[[str], None],
) -> MasterConnection:
    """Return the master that runs at a place, our own when none does.

    Args:
        parameters: the graph's, for a master of our own.
        master: where.
        address: what our own binds to and is called.
        on_change: called after every registration at our own.
        notice: told of failures.

    Raises:
        GraphError: it should be on another machine and does not answer there, or the port is
            another program's.
    """
    if _answers(master.uri):
        return RunningMaster(master.uri)
    if not master.is_here:
        text = f"no ROS 1 master answers at {master.uri}, and it is not this machine"
        raise GraphError(coded("bridge.no-master", text))
    bound = address_of_master(master, address)
    return EmbeddedMaster(parameters, master, bound, on_change, notice)


def _answers(uri: str) -> bool:
    try:
        call(uri, "getPid", _ASKING, timeout_s=_PROBE_S)
    except GraphError:
        return False
    return True
