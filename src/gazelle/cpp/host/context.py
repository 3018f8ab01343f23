"""What a runtime of C++ in this process has of the graph: nodes and their ends, by number."""

from __future__ import annotations

import atexit
import ctypes
import itertools
import os
import signal
import sys
import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Protocol

from gazelle.cpp.host.clock import ClockTeller
from gazelle.cpp.host.services import Calls, HostClient, HostServer
from gazelle.cpp.host.table import Core, LeftError
from gazelle.cpp.host.topics import HostPublisher, HostSubscription
from gazelle.cpp.verbs import verb_named
from gazelle.errors import GazelleError, GraphError
from gazelle.graph.console import Level, LogRecord, print_record

if TYPE_CHECKING:
    from gazelle.graph import Graph, Node

__all__ = ["HostContext", "HostNode", "Parameters"]

_LEVELS = {10: Level.DEBUG, 20: Level.INFO, 30: Level.WARN, 40: Level.ERROR, 50: Level.FATAL}


class Parameters(Protocol):
    """A parameter store of ROS 1, by global names."""

    def get(self, name: str, default: Any = ...) -> Any:
        """Return a value."""

    def set(self, name: str, value: Any) -> None:
        """Set a value or a namespace."""

    def has(self, name: str) -> bool:
        """Tell whether there is a value or a namespace."""

    def names(self) -> list[str]:
        """Return the names of all values."""


class HostNode:
    """A node of C++.

    Attributes:
        node: the graph's, or one that can what it can.
        core: the runtime's number of it.
        padded: write what it says as roscpp does.
        console: print what it says; False where C++ has done so.
    """

    def __init__(self, node: Any, core: int, *, padded: bool = True) -> None:
        self.node: Node = node
        self.core = core
        self.padded = padded
        self.console = True


class HostContext:
    """Does what the table of a runtime of C++ offers.

    It opens the graph when C++ first needs it. A process that has nodes of its own (a simulator
    whose controllers are C++) gives one to `adopt`: nodes that C++ makes are that one then.

    Attributes:
        core: the runtime.
        state: what families of verbs keep for this process, by their names.
    """

    def __init__(
        self,
        core: Core,
        open_graph: Callable[[], Graph] | None = None,
        *,
        parameters: Parameters | None = None,
    ) -> None:
        """Have nothing yet.

        Args:
            core: the runtime.
            open_graph: opens the graph, `Graph.open` by default.
            parameters: the parameters of ROS 1, the graph's by default.
        """
        self.core = core
        self.state: dict[str, Any] = {}
        self._open_graph = open_graph
        self._parameters = parameters
        self._graph: Graph | None = None
        self._adopted: Any = None
        self._lock = threading.RLock()
        self._numbers = itertools.count(1)
        self._nodes: dict[int, HostNode] = {}
        self._ends: dict[int, Any] = {}
        self._publishers: dict[int, HostPublisher] = {}
        self._clock: ClockTeller | None = None
        self._calls = Calls(core)
        self._closed = False

    def attach(self) -> None:
        """Give the runtime the table; see `Core.attach`. It is left before Python ends."""
        self.core.attach(self)
        atexit.register(self.leave)

    @property
    def graph(self) -> Graph:
        """The graph, opened when it is first asked for.

        Raises:
            GraphError: it cannot be joined, or C++ has been given a node without a graph.
        """
        with self._lock:
            if self._closed:
                raise LeftError
            if self._graph is None:
                if self._adopted is not None:
                    raise GraphError("this program is on no graph")
                self._graph = self._opened()
                self._clock = ClockTeller(self._graph.clock, self.core)
                self._graph.discovery.listen(self._on_entity)
            return self._graph

    @property
    def has_graph(self) -> bool:
        """Whether the graph is open."""
        return self._graph is not None

    @property
    def parameters(self) -> Parameters:
        """The parameters of ROS 1 by global names."""
        return self._parameters or self.graph.parameters

    def adopt(self, node: Any) -> None:
        """Let C++ have this node of the process, whatever it calls the node that it makes.

        Args:
            node: a node of the graph, or what can `create_publisher`, `create_subscription`,
                `create_service` and `create_client` with its arguments.
        """
        self._adopted = node
        graph = getattr(node, "graph", None)
        if graph is not None:
            self._graph = graph
            self._clock = ClockTeller(graph.clock, self.core)
            graph.discovery.listen(self._on_entity)

    @property
    def adopted(self) -> Any:
        """The node that `adopt` was given, or None."""
        return self._adopted

    def add_node(self, one: HostNode) -> int:
        """Keep a node and return its number."""
        number = next(self._numbers)
        with self._lock:
            self._nodes[number] = one
        node = one.node
        if node is not self._adopted:
            node.on_shutdown(lambda reason: self._on_node_shutdown(number, reason))
        return number

    def node(self, number: int) -> HostNode:
        """Return a node by its number.

        Raises:
            GraphError: it was shut down.
        """
        try:
            return self._nodes[number]
        except KeyError:
            raise GraphError("the node was shut down") from None

    @property
    def nodes(self) -> tuple[HostNode, ...]:
        """All nodes of C++ that are there."""
        with self._lock:
            return tuple(self._nodes.values())

    def drop_node(self, number: int) -> None:
        """Shut a node down, if it is there."""
        with self._lock:
            one = self._nodes.pop(number, None)
        if one is not None and one.node is not self._adopted:
            one.node.shutdown()

    def add_end(self, end: Any) -> int:
        """Keep a publisher, subscription, server or client and return its number."""
        number = next(self._numbers)
        with self._lock:
            self._ends[number] = end
            if isinstance(end, HostPublisher):
                self._publishers[number] = end
        return number

    def end(self, number: int) -> Any:
        """Return what `add_end` kept.

        Raises:
            GraphError: it was closed.
        """
        try:
            return self._ends[number]
        except KeyError:
            raise GraphError("it was closed") from None

    def drop_end(self, number: int) -> None:
        """Close what `add_end` kept, if it is there."""
        with self._lock:
            end = self._ends.pop(number, None)
            self._publishers.pop(number, None)
        if end is not None:
            end.close()

    def emit(self, listener: int, value: Any) -> None:
        """Give a value to a listener of C++, by the number that came in a request."""
        if not self._closed:
            self.core.emit(listener, value)

    def leave(self) -> None:
        """Leave the graph; whatever C++ calls afterwards is without effect. Twice does nothing."""
        with self._lock:
            if self._closed:
                return
            self._closed = True
        self._calls.close()
        if self._graph is not None:
            self._graph.discovery.ignore(self._on_entity)
        if self._adopted is None and self._graph is not None:
            self._graph.close()
        self.core.detach()

    # The table.

    def call(self, verb: str, request: dict[str, Any]) -> Any:
        """Do what a verb says."""
        if self._closed:
            raise LeftError
        return verb_named(verb)(self, request)

    def publish(self, publisher: int, data: bytes) -> None:
        """Send a message."""
        end = self._publishers.get(publisher)
        if end is not None:
            end.publish(data)

    def request(
        self, client: int, call: int, data: bytes, timeout_s: float | None, *, is_waiting: bool
    ) -> None:
        """Ask a service."""
        if self._closed:
            raise LeftError
        end: HostClient = self.end(client)
        self._calls.ask(end, call, data, timeout_s, is_waiting=is_waiting)

    def respond(self, request: int, data: bytes, *, is_error: bool) -> None:
        """Answer a request."""
        HostServer.answer(request, data, is_error=is_error)

    def log(
        self, node: int, level: int, text: str, logger: str, place: tuple[str, int, str]
    ) -> None:
        """Say something on the console, in the log file and on ``/rosout``."""
        severity = _LEVELS.get(level, Level.INFO)
        file, line, function = place
        one = self._nodes.get(node)
        clock = self._graph.clock if self._graph is not None else None
        sim_ns = clock.now_ns() if clock is not None and clock.use_sim_time else None
        name = "" if one is None else getattr(one.node, "name", "")
        record = LogRecord(
            severity, text, name, time.time_ns(), sim_ns, logger, file, function, line
        )
        tell = None if one is None else getattr(one.node, "tell", None)
        try:
            if one is None or tell is None:
                print_record(record)
            else:
                tell(record, padded=one.padded, console=one.console)
        except BrokenPipeError:
            # Nobody reads any more what it says, as in ``rosrun … | head``.
            _end_by_pipe()

    def _opened(self) -> Graph:
        if self._open_graph is not None:
            return self._open_graph()
        from gazelle.graph import Graph

        return Graph.open()

    def _on_node_shutdown(self, number: int, reason: str) -> None:
        with self._lock:
            one = self._nodes.get(number)
        if one is not None and not self._closed:
            self.core.on_node_shutdown(one.core, reason)

    def _on_entity(self, entity: Any, is_there: bool) -> None:
        """Tell C++ of what came to the graph or went."""
        try:
            with self._lock:
                ends = tuple(self._ends.values())
            for end in ends:
                if isinstance(end, (HostPublisher, HostSubscription)):
                    end.on_entity(entity, is_there=is_there)
            self.core.on_graph_change()
        except GazelleError as error:
            sys.stderr.write(f"{error}\n")


def _end_by_pipe() -> None:
    """End as a program does that has not said otherwise; Python has."""
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGPIPE})
    ctypes.CDLL(None).signal(int(signal.SIGPIPE), None)
    os.kill(os.getpid(), signal.SIGPIPE)
