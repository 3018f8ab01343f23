"""The bridge: the graph as viewers of Foxglove's protocol see it."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from typing import TYPE_CHECKING, Any

from gazelle.bridge.foxglove.assets import read_asset
from gazelle.bridge.foxglove.channels import Topics
from gazelle.bridge.foxglove.client_publishers import Speech
from gazelle.bridge.foxglove.clock import Pulse
from gazelle.bridge.foxglove.connections import connections_of
from gazelle.bridge.foxglove.node_parameters import NodeParameters
from gazelle.bridge.foxglove.parameters import Parameters
from gazelle.bridge.foxglove.schemas import SchemaBook
from gazelle.bridge.foxglove.server_interface import Allow, Connections, Requests, Viewers
from gazelle.bridge.foxglove.services import Services
from gazelle.bridge.sync_thread import Settling
from gazelle.errors import GazelleError
from gazelle.graph.callback_queue import Mailbox

if TYPE_CHECKING:
    from gazelle.graph import Graph
    from gazelle.workspace import Workspace

__all__ = ["FoxgloveBridge"]

_NAME = "foxglove_bridge"
_IDLE_S = 5.0
_ENDING_S = 5.0


class FoxgloveBridge:
    """Shows a graph to viewers."""

    def __init__(
        self,
        graph: Graph,
        workspace: Workspace,
        make_viewers: Callable[[Requests], Viewers],
        allow: Collection[Allow] = (),
    ) -> None:
        """Show what there is.

        Args:
            graph: the graph.
            workspace: has the meshes that robots' descriptions name.
            make_viewers: starts the server.
            allow: what viewers may do beside looking.

        Raises:
            GraphError: the server cannot start.
        """
        self._graph = graph
        self._workspace = workspace
        self._settling = Settling("foxglove bridge", self._settle, self._notice)
        self._connections: Connections | None = None
        # A clock of a thousand ticks a second is of no use while nobody looks.
        graph.clock.use(False)
        taken = f"/{_NAME}" in graph.node_names()
        self._node = graph.create_node(_NAME, namespace="/", anonymous=taken)
        self._speech = Speech(self._node, self._notice)
        nodes = NodeParameters(graph, self._node, self._notice)
        self._parameters = Parameters(graph.parameters, nodes, self._notice)
        self._looking = Mailbox(self._look, size=0, name="foxglove viewers")
        try:
            self._viewers = make_viewers(self)
        except GazelleError:
            self._node.shutdown()
            raise
        book = SchemaBook(self._notice)
        self._pulse = Pulse(graph, self._viewers.show_time)
        self._topics = Topics(self._node, self._viewers, book, self._pulse.sim_time)
        services = Services(self._node, self._viewers, book)
        self._services = services if Allow.SERVICES in allow else None
        if Allow.PARAMETERS in allow:
            self._parameters.follow(self._viewers.show_parameters)
        graph.discovery.listen(lambda entity, is_there: self._settling.touch())
        self._settling.start(_IDLE_S)

    @property
    def port(self) -> int:
        """Where viewers connect."""
        return self._viewers.port

    def on_end(self, listener: Callable[[], None]) -> None:
        """Call back when somebody ends the bridge's node (``rosnode kill``)."""
        self._node.on_shutdown(lambda reason: listener())

    def close(self) -> None:
        """Say good-bye to all viewers; calling it twice does nothing."""
        if not self._settling.close():
            return
        self._pulse.close()
        self._parameters.close()
        self._viewers.close()
        self._looking.close(_ENDING_S)
        self._topics.close()
        self._speech.close()
        self._node.shutdown()

    def subscribe(self, viewer: int, channel: int) -> None:
        """A viewer wants a channel."""
        # Not here: the server may hold a lock that adding or removing channels needs.
        self._looking.put((True, viewer, channel))

    def unsubscribe(self, viewer: int, channel: int) -> None:
        """A viewer wants a channel no more."""
        self._looking.put((False, viewer, channel))

    def advertise(self, viewer: int, number: int, topic: str, type_name: str, words: str) -> None:
        """A viewer will publish a topic."""
        self._speech.advertise((viewer, number), topic, type_name, words)

    def unadvertise(self, viewer: int, number: int) -> None:
        """A viewer publishes a topic no more."""
        self._speech.unadvertise((viewer, number))

    def publish(self, viewer: int, number: int, data: bytes) -> None:
        """A viewer sends a message."""
        self._speech.publish((viewer, number), data)

    def get_parameters(self, names: Iterable[str]) -> dict[str, Any]:
        """Return parameters by name."""
        return self._parameters.get(names)

    def set_parameters(self, values: Mapping[str, Any]) -> dict[str, Any]:
        """Set parameters; return what they are afterwards."""
        return self._parameters.set(values)

    def read_asset(self, uri: str) -> bytes | None:
        """Return a file of a package or model."""
        return read_asset(self._workspace, uri)

    def _look(self, wish: tuple[bool, int, int]) -> None:
        wants, viewer, channel = wish
        try:
            (self._topics.subscribe if wants else self._topics.unsubscribe)(viewer, channel)
            self._pulse.beat(fast=self._topics.is_watched)
        except GazelleError as error:
            self._notice(str(error))

    def _settle(self) -> None:
        entities = self._graph.discovery.known()
        self._topics.settle(entities)
        if self._services is not None:
            self._services.settle(entities)
        connections = connections_of(entities, self._node.name)
        if connections != self._connections:
            self._connections = connections
            self._viewers.show_connections(connections)

    def _notice(self, text: str) -> None:
        if not self._node.closed:
            self._node.log("warn", text)
