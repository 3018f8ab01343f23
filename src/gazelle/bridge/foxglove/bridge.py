"""The bridge: the graph as viewers of Foxglove's protocol see it.

The server answers any web page, so only what a description is made of leaves this machine: files of
such kinds, inside packages and models.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping
from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Any
from urllib.parse import unquote

from gazelle.bridge.foxglove.channels import SchemaBook, Topics
from gazelle.bridge.foxglove.client_publishers import ClientPublishers
from gazelle.bridge.foxglove.clock import ViewerClock
from gazelle.bridge.foxglove.parameters import NodeParameters, Parameters
from gazelle.bridge.foxglove.server_interface import Allow, Connections, Requests, Viewers
from gazelle.bridge.foxglove.services import Services
from gazelle.bridge.sync_thread import SyncThread
from gazelle.errors import GazelleError
from gazelle.graph import Entity, Kind
from gazelle.graph.callback_queue import CallbackQueue
from gazelle.graph.names import is_hidden

if TYPE_CHECKING:
    from gazelle.graph import Graph
    from gazelle.workspace import Workspace

__all__ = ["FoxgloveBridge", "connections_of", "read_asset"]

_SCHEMES = ("package", "model")
_MESHES = frozenset({".dae", ".fbx", ".glb", ".gltf", ".mtl", ".obj", ".stl"})
_PICTURES = frozenset({".bmp", ".jpeg", ".jpg", ".png", ".tga", ".tif", ".tiff", ".webp"})
_DESCRIPTIONS = frozenset({".sdf", ".srdf", ".urdf", ".xacro"})
_NAME = "foxglove_bridge"
_IDLE_S = 5.0
_ENDING_S = 5.0


def connections_of(entities: Iterable[Entity], own: str) -> Connections:
    """Return the nodes that publish, subscribe and answer, by topic and service.

    Args:
        entities: of the graph.
        own: the bridge's node, whose subscriptions are the viewers' and are left out.
    """
    found: dict[Kind, dict[str, set[str]]] = {
        kind: {} for kind in (Kind.PUBLISHER, Kind.SUBSCRIPTION, Kind.SERVICE)
    }
    for one in entities:
        is_own_ear = one.kind is Kind.SUBSCRIPTION and one.node == own
        if one.kind in found and not is_hidden(one.name) and not is_own_ear:
            found[one.kind].setdefault(one.name, set()).add(one.node)
    return Connections(*(_sorted(side) for side in found.values()))


def read_asset(workspace: Workspace, uri: str) -> bytes | None:
    """Return a file's bytes, None when there is none, or it is none of a viewer's business.

    Args:
        workspace: finds packages and models.
        uri: ``package://…`` or ``model://…``.
    """
    scheme, _, path_text = uri.partition("://")
    path = PurePosixPath(unquote(path_text))
    if scheme not in _SCHEMES or not _stays_inside(unquote(path_text)):
        return None
    if path.suffix.lower() not in _MESHES | _PICTURES | _DESCRIPTIONS:
        return None
    found = workspace.resolve(uri).path
    return found.read_bytes() if found is not None and found.is_file() else None


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
        self._sync_thread = SyncThread("foxglove bridge", self._settle, self._notice)
        self._connections: Connections | None = None
        # A clock of a thousand ticks a second is of no use while nobody looks.
        graph.clock.use(False)
        taken = f"/{_NAME}" in graph.node_names()
        self._node = graph.create_node(_NAME, namespace="/", anonymous=taken)
        self._client_publishers = ClientPublishers(self._node, self._notice)
        nodes = NodeParameters(graph, self._node, self._notice)
        self._parameters = Parameters(graph.parameters, nodes, self._notice)
        self._looking = CallbackQueue(self._look, size=0, name="foxglove viewers")
        try:
            self._viewers = make_viewers(self)
        except GazelleError:
            self._node.shutdown()
            raise
        book = SchemaBook(self._notice)
        self._clock = ViewerClock(graph, self._viewers.show_time)
        self._topics = Topics(self._node, self._viewers, book, self._clock.sim_time)
        services = Services(self._node, self._viewers, book)
        self._services = services if Allow.SERVICES in allow else None
        if Allow.PARAMETERS in allow:
            self._parameters.follow(self._viewers.show_parameters)
        graph.discovery.listen(lambda entity, is_there: self._sync_thread.touch())
        self._sync_thread.start(_IDLE_S)

    @property
    def port(self) -> int:
        """Where viewers connect."""
        return self._viewers.port

    def on_end(self, listener: Callable[[], None]) -> None:
        """Call back when somebody ends the bridge's node (``rosnode kill``)."""
        self._node.on_shutdown(lambda reason: listener())

    def close(self) -> None:
        """Say good-bye to all viewers; calling it twice does nothing."""
        if not self._sync_thread.close():
            return
        self._clock.close()
        self._parameters.close()
        self._viewers.close()
        self._looking.close(_ENDING_S)
        self._topics.close()
        self._client_publishers.close()
        self._node.shutdown()

    def subscribe(self, viewer: int, channel: int) -> None:
        """A viewer wants a channel."""
        # Not here: the server may hold a lock that adding or removing channels needs.
        self._looking.put((True, viewer, channel))

    def unsubscribe(self, viewer: int, channel: int) -> None:
        """A viewer wants a channel no more."""
        self._looking.put((False, viewer, channel))

    def advertise(
        self, viewer: int, number: int, topic: str, type_name: str, encoding: str
    ) -> None:
        """A viewer will publish a topic."""
        self._client_publishers.advertise((viewer, number), topic, type_name, encoding)

    def unadvertise(self, viewer: int, number: int) -> None:
        """A viewer publishes a topic no more."""
        self._client_publishers.unadvertise((viewer, number))

    def publish(self, viewer: int, number: int, data: bytes) -> None:
        """A viewer sends a message."""
        self._client_publishers.publish((viewer, number), data)

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
            self._clock.beat(fast=self._topics.is_watched)
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


def _sorted(side: dict[str, set[str]]) -> dict[str, tuple[str, ...]]:
    return {name: tuple(sorted(nodes)) for name, nodes in sorted(side.items())}


def _stays_inside(path_text: str) -> bool:
    """Whether no part of a path leads out of the package that it starts with."""
    return not any(
        part in ("", ".", "..") or set("\\:") & set(part) for part in path_text.split("/")
    )
