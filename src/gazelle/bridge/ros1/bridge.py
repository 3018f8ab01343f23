"""The bridge: keeps both sides' views of each other current."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING, Any

from gazelle.bag.message_definitions import TextShare
from gazelle.bridge.node_mirrors import NodeMirrors
from gazelle.bridge.ros1.addresses import Address, MasterAddress
from gazelle.bridge.ros1.connections import Connections
from gazelle.bridge.ros1.graph_state import (
    BRIDGE_NAME,
    TypeBook,
    node_entities_of,
    ros_node_entities_of,
)
from gazelle.bridge.ros1.master_connection import MasterConnection, find_master
from gazelle.bridge.ros1.master_registry import State
from gazelle.bridge.ros1.parameter_sync import ParameterSync
from gazelle.bridge.ros1.service_types import ServiceTypes
from gazelle.bridge.ros1.services import call_service
from gazelle.bridge.ros1.slave_api import NodeEntities, SlaveNode
from gazelle.bridge.ros1.types import MessageKind, ServiceKind
from gazelle.bridge.ros1.xmlrpc_call import RemoteError, RemoteRefusedError, call
from gazelle.bridge.sync_thread import SyncThread
from gazelle.errors import GraphError
from gazelle.graph import Publisher
from gazelle.graph.errors import ServiceUnavailableError, coded

if TYPE_CHECKING:
    from gazelle.graph import Graph

__all__ = ["Bridge"]

_POLL_S = 0.5
_IDLE_S = 5.0
_NOTHING: frozenset[str] = frozenset()
_TOPICS_OF_ROSOUT = frozenset({"/rosout_agg"})
# roscore starts its own a moment after the master answers; registered under this name before it,
# ours would be told to end by it.
_NODES_OF_ROSCORE = frozenset({"/rosout"})


class Bridge:
    """Joins a graph and ROS 1.

    Attributes:
        master: the master, real or our own.
    """

    def __init__(self, graph: Graph, master: MasterAddress, address: Address) -> None:
        """Find the master at a place, or be it; then bring over what there is.

        Args:
            graph: the graph.
            master: the master's.
            address: what servers of the bridge bind to and are called.

        Raises:
            GraphError: another bridge runs on the graph, or no master can be had.
        """
        _refuse_second(graph)
        self._graph = graph
        self._lost = False
        self._sync_thread = SyncThread("ros1 bridge", self._look, self._notice)
        self._slave_nodes: dict[str, SlaveNode] = {}
        self._node = graph.create_node(BRIDGE_NAME.strip("/"), namespace="/")
        # A clock of a thousand ticks a second is of no use to a bridge.
        graph.clock.use(False)
        self._workers = ThreadPoolExecutor(2, thread_name_prefix="ros1 bridge")
        try:
            self.master: MasterConnection = find_master(
                graph.parameters, master, address, self._sync_thread.touch, self._notice
            )
        except GraphError:
            self._node.shutdown()
            raise
        self._skipped = _NOTHING if self.master.is_embedded else _TOPICS_OF_ROSOUT
        self._reserved = _NOTHING if self.master.is_embedded else _NODES_OF_ROSCORE
        self._book = TypeBook(self._notice, self._explain)
        self._services = ServiceTypes(
            self.master.ask, self._sync_thread.touch, self._book, self._notice
        )
        uri = self.master.uri
        self._mirrors: NodeMirrors[MessageKind, ServiceKind] = NodeMirrors(
            graph, self._node, self._call, self._end_in_ros1
        )
        self._connections = Connections(graph, self._node, address, uri, self._voice_of)
        self._own = SlaveNode(self._connections, self.master.ask, BRIDGE_NAME, BRIDGE_NAME)
        self._connections.own_uris.add(self._own.uri)
        self._sync = self._joined_parameters()
        self._texts = TextShare(graph)
        graph.discovery.listen(lambda entity, is_there: self._sync_thread.touch())
        self._sync_thread.start(_IDLE_S if self.master.is_embedded else _POLL_S)

    @property
    def nodes(self) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """Names of the graph's nodes in ROS 1, and of ROS 1's nodes on the graph."""
        return tuple(sorted(self._slave_nodes)), self._mirrors.names

    def on_end(self, listener: Callable[[], None]) -> None:
        """Call back when somebody ends the bridge's node (``rosnode kill``)."""
        self._node.on_shutdown(lambda reason: listener())

    def close(self) -> None:
        """Take everything that is of the other side off both; calling it twice does nothing."""
        if not self._sync_thread.close():
            return
        self._services.close()
        self._texts.close()
        self._end_parameters()
        self._end_presences()
        self._mirrors.close()
        self._connections.close()
        self.master.close()
        self._workers.shutdown(wait=False, cancel_futures=True)
        self._node.shutdown()

    def _look(self) -> None:
        try:
            self._settle()
            self._find_again()
        except RemoteError as error:
            self._lose(error)

    def _settle(self) -> None:
        state = self.master.state()
        self._register_again(state)
        entities = [one for one in self._graph.discovery.known() if one.zid != self._graph.zid]
        taken = frozenset(node for node in _nodes(state) if node not in self._slave_nodes)
        taken = (taken | self._reserved) - {BRIDGE_NAME}
        node_entities = node_entities_of(entities, taken, self._skipped, self._book)
        self._settle_slave_nodes(node_entities)
        own = frozenset({*self._slave_nodes, BRIDGE_NAME})
        services = self._services.of(one for one in state.services if one[0] not in own)
        ros_entities = ros_node_entities_of(state, own, self._skipped, services, self._book)
        self._mirrors.settle(ros_entities)
        self._settle_topics(node_entities)

    def _register_again(self, state: State) -> None:
        """Have told again what a master lacks that was started anew since it was last asked."""
        forgotten = [one for one in self._all_presences if one.is_forgotten(state)]
        for slave_node in forgotten:
            slave_node.start_over()
        if forgotten and self._sync is not None and not self._lost:
            # Who listens to parameters is forgotten, too.
            self._lost = True
            text = f"the master at {self.master.uri} has forgotten everything; it is told again"
            self._notice(text)

    @property
    def _all_presences(self) -> tuple[SlaveNode, ...]:
        return *self._slave_nodes.values(), self._own

    def _settle_slave_nodes(self, node_entities: dict[str, NodeEntities]) -> None:
        node_entities = dict(node_entities)
        self._settle_slave_node(
            self._own, node_entities.pop(BRIDGE_NAME, NodeEntities(BRIDGE_NAME, {}, {}, {}))
        )
        gone = [one for name, one in self._slave_nodes.items() if name not in node_entities]
        self._slave_nodes = {k: one for k, one in self._slave_nodes.items() if k in node_entities}
        for slave_node in gone:
            self._connections.forget_published(
                slave_node.node_entities.node, slave_node.node_entities.publishers
            )
            self._connections.own_uris.discard(slave_node.uri)
            slave_node.close()
        for name, one in node_entities.items():
            slave_node = self._slave_nodes.get(name) or self._add_presence(name, one.node)
            self._settle_slave_node(slave_node, one)

    def _add_presence(self, name: str, node: str) -> SlaveNode:
        slave_node = SlaveNode(self._connections, self.master.ask, name, node)
        self._connections.own_uris.add(slave_node.uri)
        self._slave_nodes = {**self._slave_nodes, name: slave_node}
        return slave_node

    def _settle_slave_node(self, slave_node: SlaveNode, node_entities: NodeEntities) -> None:
        gone = set(slave_node.node_entities.publishers) - set(node_entities.publishers)
        self._connections.forget_published(slave_node.node_entities.node, gone)
        slave_node.settle(node_entities)

    def _settle_topics(self, node_entities: dict[str, NodeEntities]) -> None:
        wanted = {topic for one in node_entities.values() for topic in one.subscribers}
        for topic in self._connections.keep_topics(wanted):
            self._mirrors.forget_latched(topic)

    def _voice_of(
        self, node: str, topic: str, kind: MessageKind, latched: bool
    ) -> Publisher | None:
        ours = node in self._slave_nodes or node == BRIDGE_NAME
        if ours or self._sync_thread.ended or not node.startswith("/"):
            return None
        return self._mirrors.publisher(node, topic, kind, latched)

    def _call(self, service: str, kind: ServiceKind, request: Any) -> Any:
        try:
            uri = self.master.ask("lookupService", BRIDGE_NAME, service)
        except RemoteError as error:
            raise ServiceUnavailableError(f"service [{service}] unavailable: {error}") from error
        return call_service(uri, service, kind, BRIDGE_NAME, request)

    def _end_in_ros1(self, name: str, reason: str) -> None:
        if not self._sync_thread.ended:
            self._workers.submit(self._shut_down, name, reason)

    def _shut_down(self, name: str, reason: str) -> None:
        try:
            call(self.master.ask("lookupNode", BRIDGE_NAME, name), "shutdown", BRIDGE_NAME, reason)
        except RemoteError as error:
            self._notice(f"{name} was asked to end and did not answer: {error}")

    def _joined_parameters(self) -> ParameterSync | None:
        if self.master.is_embedded:
            return None
        sync = ParameterSync(self._graph.parameters, self.master.ask, BRIDGE_NAME, self._notice)
        self._connections.on_parameter = sync.changed
        try:
            sync.start(self._own.uri)
        except (RemoteError, RemoteRefusedError):
            self._lost = True
        return sync

    def _end_parameters(self) -> None:
        if self._sync is not None:
            try:
                self._sync.close(is_lost=self._lost)
            except RemoteError:
                self._lost = True

    def _end_presences(self) -> None:
        for slave_node in self._all_presences:
            if self._lost:
                # A master that does not answer would be waited for once for each name.
                slave_node.start_over()
            try:
                slave_node.close()
            except RemoteError:
                self._lost = True

    def _lose(self, error: RemoteError) -> None:
        if self._lost:
            return
        self._lost = True
        self._notice(f"the master does not answer, the bridge waits for it: {error}")
        for slave_node in self._all_presences:
            slave_node.start_over()
        self._mirrors.close()
        self._connections.keep_topics(())

    def _find_again(self) -> None:
        if self._lost and self._sync is not None:
            self._sync.start(self._own.uri)
            self._lost = False
            self._notice(f"the master at {self.master.uri} answers again")

    def _explain(self, text: str) -> None:
        if not self._node.closed:
            self._node.log("info", text)

    def _notice(self, text: str) -> None:
        if not self._node.closed:
            self._node.log("warn", text)


def _refuse_second(graph: Graph) -> None:
    if BRIDGE_NAME in graph.node_names():
        text = "a bridge to ROS 1 already runs on this graph; a second one would double messages"
        raise GraphError(coded("bridge.second", text))


def _nodes(state: State) -> set[str]:
    sides = (state.publishers, state.subscribers, state.services)
    return {node for side in sides for node, _ in side}
