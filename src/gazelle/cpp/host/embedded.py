"""Code in C++ as part of a process that has a node already: the simulator with its controllers.

What C++ offers and receives is offered and received by that node, on a graph or without one, so
its messages are decoded here. There is one runtime in a process; the worlds of a process take
turns at it.
"""

from __future__ import annotations

import itertools
import logging
import threading
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

from gazelle.cpp.building.runtime import ensure_runtime
from gazelle.cpp.host.table import Core
from gazelle.cpp.verbs import verb_named
from gazelle.errors import GazelleError
from gazelle.interfaces import message_type, service_type
from gazelle.interfaces.codec import from_cdr, to_cdr
from gazelle.workspace import Workspace

__all__ = ["EmbeddedHost", "EmbeddingWorld", "NodeOfWorld", "embedded_host"]

_LEVELS = {10: "debug", 20: "info", 30: "warn", 40: "error", 50: "fatal"}
_ANSWER_S = 10.0
# Every process offers them once, for its own node.
_OF_EVERY_NODE = ("/get_loggers", "/set_logger_level")


class NodeOfWorld(Protocol):
    """What is asked of the node; `gazelle.graph.Node` and the simulator's local one have it."""

    @property
    def parameters(self) -> Any:
        """The parameter store, with ``get``, ``set`` and ``has``."""

    def create_publisher(
        self, topic: str, message_type: Any, *, latch: bool = ..., queue_size: int = ...
    ) -> Any:
        """Offer a topic."""

    def create_subscription(
        self, topic: str, message_type: Any, callback: Callable[[Any], None], *, inline: bool = ...
    ) -> Any:
        """Receive a topic."""

    def create_service(self, name: str, service_type: Any, handler: Callable[..., Any]) -> Any:
        """Offer a service."""

    def log(self, level: Any, text: str) -> None:
        """Say something."""


@dataclass(frozen=True, slots=True)
class EmbeddingWorld:
    """A world that has C++ in it.

    Attributes:
        node: of the process.
        call: has a function called in the thread that owns the world, and waits for its result.
        workspace: for look-ups of packages.
    """

    node: NodeOfWorld
    call: Callable[[Callable[[], Any]], Any]
    workspace: Workspace | None


class EmbeddedHost:
    """What `gazelle.cpp.host.table.Core` serves C++ with, over the node of a world.

    Attributes:
        core: the runtime.
        libraries: all of its libraries by name.
        state: what families of verbs keep.
        spin: calls what waits in the queues of C++; set by whoever runs the code.
    """

    def __init__(self, libraries: dict[str, Path]) -> None:
        """Load the runtime for good.

        Args:
            libraries: by name, ``core`` among them.
        """
        self.libraries = libraries
        self.core = Core(libraries["core"])
        self.spin: Callable[[], None] = lambda: None
        self.state: dict[str, Any] = {}
        self._world: EmbeddingWorld | None = None
        self._time_ns = 0
        self._numbers = itertools.count(1)
        self._ends: dict[int, Callable[[], None]] = {}
        self._publishers: dict[int, tuple[Any, Any, int]] = {}
        self._answers: dict[int, _Answer] = {}
        self._sending = threading.local()
        self._core_attached()

    def enter(self, world: EmbeddingWorld, time_ns: int) -> None:
        """Let what C++ asks from now on be about a world, and tell the time there."""
        self._world = world
        self.state["package/workspace"] = world.workspace
        jump_ns = min(time_ns - self._time_ns, 0)
        self._time_ns = time_ns
        self.core.on_clock(sim_time=True, page=0, now_ns=time_ns, jump_ns=jump_ns)

    @property
    def parameters(self) -> Any:
        """The parameter store of the world, for the verbs of parameters."""
        return self._of_world().node.parameters

    def call(self, verb: str, request: dict[str, Any]) -> Any:
        """Do what a verb says."""
        own = _OWN_VERBS.get(verb)
        if own is not None:
            return own(self, request)
        return verb_named(verb)(self, request)

    def publish(self, publisher: int, data: bytes) -> None:
        """Send a message."""
        found = self._publishers.get(publisher)
        if found is None:
            return
        port, kind, number = found
        # What C++ sends to itself it has handed on already.
        self._sending.is_on = True
        try:
            port.publish(from_cdr(kind, data))
        finally:
            self._sending.is_on = False
        self.core.on_matched(number, int(port.matched), 1)

    def request(
        self, client: int, call: int, data: bytes, timeout_s: float | None, *, is_waiting: bool
    ) -> None:
        """Refuse to ask a service: the loop that would wait is the one that others wait for."""
        text = b"services cannot be called from code that runs in the control loop"
        self.core.on_response(call, 2, text)

    def respond(self, request: int, data: bytes, *, is_error: bool) -> None:
        """Answer a request."""
        answer = self._answers.pop(request, None)
        if answer is not None:
            answer.data, answer.is_error = data, is_error
            answer.done.set()

    def log(
        self, node: int, level: int, text: str, logger: str, place: tuple[str, int, str]
    ) -> None:
        """Say something by the world's node."""
        word = _LEVELS.get(level, "info")
        if self._world is None:
            logging.getLogger("gazelle.cpp").log(level, text)
        else:
            self._world.node.log(word, text)

    def _core_attached(self) -> None:
        self.core.attach(self)

    def _of_world(self) -> EmbeddingWorld:
        if self._world is None:
            raise GazelleError("there is no world that this code is part of")
        return self._world

    def _kept(self, close: Callable[[], None]) -> int:
        handle = next(self._numbers)
        self._ends[handle] = close
        return handle

    # Verbs.

    def _create_node(self, request: dict[str, Any]) -> dict[str, Any]:
        name = str(request["name"]).rpartition("/")[2]
        full_name = f"/{name}"
        return {"handle": 1, "name": name, "namespace": "/", "full_name": full_name}

    def _advertise(self, request: dict[str, Any]) -> dict[str, Any]:
        kind = message_type(request["type"])
        topic, number = request["topic"], request["core"]
        depth = int(request.get("qos", {}).get("depth", 10)) or 10
        port = self._of_world().node.create_publisher(
            topic, kind, latch=bool(request.get("latch")), queue_size=depth
        )
        handle = self._kept(port.unregister)
        self._publishers[handle] = (port, kind, number)
        self.core.on_matched(number, int(port.matched), 1)
        return {"handle": handle, "topic": topic, "type": request["type"], "gid": f"{handle:032x}"}

    def _subscribe(self, request: dict[str, Any]) -> dict[str, Any]:
        if not request["type"]:
            raise GazelleError("code in the control loop can only listen to a type that it names")
        kind = message_type(request["type"])
        topic, number, name = request["topic"], request["core"], request["type"].encode()
        sequence = itertools.count(1)

        def take(message: Any) -> None:
            if getattr(self._sending, "is_on", False):
                return
            info = (next(sequence), self._time_ns, bytes(16), b"")
            self.core.on_message(number, to_cdr(message), name, info)

        port = self._of_world().node.create_subscription(topic, kind, take, inline=True)
        return {"handle": self._kept(port.unregister), "topic": topic}

    def _offer(self, request: dict[str, Any]) -> dict[str, Any]:
        name, number = request["name"], request["core"]
        if name.endswith(_OF_EVERY_NODE):
            return {"handle": self._kept(lambda: None), "name": name}
        service = service_type(request["type"])
        world = self._of_world()

        def handle(asked: Any) -> Any:
            answer = _Answer()
            ticket = next(self._numbers)
            self._answers[ticket] = answer
            data = to_cdr(asked)

            def take() -> None:
                self.core.on_request(number, ticket, data, (bytes(16), ticket, 0, b""))
                self.spin()

            world.call(take)
            if not answer.done.wait(_ANSWER_S):
                self._answers.pop(ticket, None)
                raise GazelleError(f"service {name} did not answer within {_ANSWER_S:g} s")
            if answer.is_error:
                raise GazelleError(answer.data.decode("utf-8", "replace"))
            return from_cdr(service.Response, answer.data)

        port = world.node.create_service(name, service, handle)
        return {"handle": self._kept(port.unregister), "name": name}

    def _client(self, request: dict[str, Any]) -> dict[str, Any]:
        return {"handle": self._kept(lambda: None), "name": request["name"]}

    def _close(self, request: dict[str, Any]) -> None:
        handle = int(request["handle"])
        self._publishers.pop(handle, None)
        close = self._ends.pop(handle, None)
        if close is not None:
            close()

    def _refuse(self, request: dict[str, Any]) -> None:
        text = f"{request['topic']}: messages of type {request['type']} are not taken, "
        self._of_world().node.log("warn", f"{text}{request['wanted']} is")


class _Answer:
    """The answer of C++ to one request."""

    def __init__(self) -> None:
        self.done = threading.Event()
        self.data = b""
        self.is_error = False


_OWN_VERBS: dict[str, Callable[[EmbeddedHost, dict[str, Any]], Any]] = {
    "clock/prefer": lambda host, request: None,
    "clock/use": lambda host, request: None,
    "end/close": EmbeddedHost._close,
    "graph/nodes": lambda host, request: [],
    "graph/services": lambda host, request: [],
    "graph/topics": lambda host, request: [],
    "node/arguments": lambda host, request: [],
    "node/create": EmbeddedHost._create_node,
    "node/resolve": lambda host, request: request["name"],
    "node/shutdown": lambda host, request: None,
    "process/leave": lambda host, request: None,
    "service/client": EmbeddedHost._client,
    "service/is_ready": lambda host, request: False,
    "service/offer": EmbeddedHost._offer,
    "service/wait": lambda host, request: False,
    "topic/advertise": EmbeddedHost._advertise,
    "topic/refuse": EmbeddedHost._refuse,
    "topic/subscribe": EmbeddedHost._subscribe,
}

_hosts: list[EmbeddedHost] = []


def embedded_host(library: str) -> EmbeddedHost:
    """Return the host of this process, with a runtime library and all it needs compiled.

    Args:
        library: such as ``control``; the first one that is asked for is the only one.

    Raises:
        CppBuildError: it cannot be compiled.
        NoToolchainError: there is no compiler.
    """
    if not _hosts:
        _hosts.append(EmbeddedHost(ensure_runtime([library], 1).libraries))
    return _hosts[0]
