"""A process' membership in the graph."""

from __future__ import annotations

import atexit
import itertools
import os
import threading
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, Any, ClassVar, Literal, Self

from gazelle.diagnostics import nearest_names
from gazelle.errors import GraphError, NotFoundError
from gazelle.graph import graph_info
from gazelle.graph.clock import Clock
from gazelle.graph.console import print_record
from gazelle.graph.discovery import Announcements, Discovery
from gazelle.graph.duplicate_nodes import TAKEN_OVER, DuplicateNodes
from gazelle.graph.errors import NoGraphError
from gazelle.graph.glibc_malloc import HeapTrim
from gazelle.graph.graph_info import NodeInfo, ServiceInfo, TopicInfo
from gazelle.graph.hub import HubKeeper, port_taken
from gazelle.graph.key_expressions import Entity, Kind
from gazelle.graph.local_topic import LocalTopics
from gazelle.graph.locators import own_endpoint, share, somebody_listens
from gazelle.graph.names import anonymous_name, check_node_name, join, resolve
from gazelle.graph.node import Node
from gazelle.graph.parameter_server import ParameterShare, ParameterStore, global_parameters
from gazelle.graph.process_queries import Control, ask_process, shut_down_node, wait_for_processes
from gazelle.graph.sessions import (
    CallsInFlight,
    client_config,
    close_session,
    domain_of,
    peer_config,
    port_of,
)
from gazelle.graph.wall_clock_stamps import StampWatch

if TYPE_CHECKING:
    import zenoh

    from gazelle.graph.actions.action_info import ActionInfo

__all__ = ["Graph"]

Role = Literal["auto", "hub", "client"]

# A hub that is there answers at once, but on a machine with much to do it has to wait its turn.
_HUB_S = 10.0
_LAST_CALLS_S = 1.0
# As long as a reliable message waits for a link; those before it are there or lost.
_LAST_MESSAGES_S = 5.0
_USE_SIM_TIME = "/use_sim_time"


class Graph:
    """The graph as one process sees it; open one per process with `Graph.open`.

    Roles: ``auto`` carries the hub when nobody does, else joins; ``hub`` is the same but takes
    a lost hub over at once, for launches, simulators and ``roscore``; ``client`` only joins,
    for command-line tools. When the process with the hub ends, another one takes the hub and
    the parameters over; with none left the graph is gone.

    Attributes:
        port: the graph's number.
        domain: ``ROS_DOMAIN_ID``.
        session: the transport.
        zid: the session's name, in tokens.
        announcements: tells others what there is.
        clock: the clock of all nodes here.
        parameters: the parameter store, by global names.
        local: topics' ends in this process.
        stamps: finds messages of the wrong clock.
        heap: gives memory back that large messages leave free.
        console: writes what nodes log, taken over by nodes when they are made.
        calls: of services, that have no answer yet.
    """

    _open: ClassVar[list[Graph]] = []

    def __init__(
        self,
        session: zenoh.Session,
        *,
        port: int,
        domain: int,
        environ: Mapping[str, str],
        keeper: HubKeeper | None,
    ) -> None:
        """Wrap an open session; use `Graph.open`."""
        self.session = session
        self.port = port
        self.domain = domain
        self.zid = str(session.zid())
        self.announcements = Announcements(session)
        self.local = LocalTopics()
        self.parameter_share = ParameterShare(session, may_own=keeper is not None)
        self.parameters: ParameterStore = global_parameters(self.parameter_share)
        self.clock = Clock(lambda: self.parameters.get_cached(_USE_SIM_TIME, False))
        self.stamps = StampWatch(self.clock)
        self.heap = HeapTrim()
        self.console: Callable[..., None] = print_record
        self._environ = environ
        self._keeper = keeper
        self._discovery = Discovery(session, domain, port, self.zid)
        self._duplicate_nodes = DuplicateNodes(session, domain, self.zid, self._discovery)
        self._nodes: list[Node] = []
        self._ids = itertools.count()
        self._lock = threading.RLock()
        self._control: Control | None = None
        self._closed = False
        self.calls = CallsInFlight()

    @classmethod
    def open(
        cls,
        *,
        environ: Mapping[str, str] | None = None,
        port: int | None = None,
        role: Role = "auto",
    ) -> Graph:
        """Join the graph.

        Args:
            environ: the environment, that of the process by default.
            port: the hub's port, from the environment by default (see `config.port_of`).
            role: how to join, see the class.

        Raises:
            PortTakenError: the port belongs to another program.
            NoGraphError: a client found no graph.
        """
        values = dict(os.environ if environ is None else environ)
        domain = domain_of(values)
        port = port_of(values) if port is None else port
        if role == "client":
            session = _open_client(port)
            graph = cls(session, port=port, domain=domain, environ=values, keeper=None)
        else:
            graph = _open_peer(cls, port, domain, values, eager=role == "hub")
        graph._start()
        return graph

    @classmethod
    def current(cls) -> Graph | None:
        """Return the graph this process opened last and has not closed, None without one."""
        return cls._open[-1] if cls._open else None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exc_info: object) -> None:
        self.close()

    @property
    def is_hub(self) -> bool:
        """True when this process carries the hub."""
        return self._keeper is not None and self._keeper.is_hub

    @property
    def connected(self) -> bool:
        """True while there is a hub; a graph without one heals within a second."""
        return not self._closed and (self._keeper is None or self._keeper.connected)

    @property
    def nodes(self) -> tuple[Node, ...]:
        """The nodes of this process."""
        with self._lock:
            return tuple(self._nodes)

    def create_node(
        self,
        name: str,
        *,
        namespace: str | None = None,
        remappings: Mapping[str, str] | None = None,
        anonymous: bool = False,
        rosout: bool = True,
        is_ros2: bool = False,
    ) -> Node:
        """Add a node; in ROS 1, one of the same name anywhere on the graph is told to shut down.

        Args:
            name: one legal part.
            namespace: where it lives, ``ROS_NAMESPACE`` by default.
            remappings: names as in ``a:=b`` arguments.
            anonymous: make the name unique.
            rosout: announce ``/rosout``, where `Node.log` goes.
            is_ros2: names follow ROS 2, where they may start with ``_`` and be there twice.

        Raises:
            IllegalNameError: the name is not legal.
        """
        if self._closed:
            raise GraphError("the graph is closed")
        own = check_node_name(anonymous_name(name) if anonymous else name, is_ros2=is_ros2)
        if namespace is None:
            namespace = self._environ.get("ROS_NAMESPACE", "")
        namespace = resolve(namespace or "/", "/")
        full = join(namespace, own)
        if not anonymous and not is_ros2:
            self._shut_node_down(full, TAKEN_OVER)
            self._duplicate_nodes.claim(full)
        with self.announcements.together():
            node = Node(self, full, namespace, remappings or {}, rosout=rosout)
        with self._lock:
            self._nodes.append(node)
        if self._keeper is not None:
            self.clock.follow(node)
        return node

    def topics(self, *, include_hidden: bool = False) -> tuple[TopicInfo, ...]:
        """Return all topics with type, publishers and subscriptions, by name."""
        return graph_info.topics_of(self.entities(), include_hidden=include_hidden)

    def topic_names_and_types(self, *, include_hidden: bool = False) -> list[tuple[str, str]]:
        """Return names and types of all topics, by name."""
        return [(one.name, one.type_name) for one in self.topics(include_hidden=include_hidden)]

    def services(self, *, include_hidden: bool = False) -> tuple[ServiceInfo, ...]:
        """Return all services with type and servers, by name."""
        return graph_info.services_of(self.entities(), include_hidden=include_hidden)

    def actions(self) -> tuple[ActionInfo, ...]:
        """Return all actions of ROS 1 and ROS 2 with type, servers and clients, by name."""
        from gazelle.graph.actions.action_info import actions_of

        return actions_of(self.entities())

    def node_names(self, *, include_hidden: bool = False) -> tuple[str, ...]:
        """Return the global names of all nodes, sorted."""
        return graph_info.nodes_of(self.entities(), include_hidden=include_hidden)

    def node_info(self, name: str) -> NodeInfo:
        """Return all about one node, its process number included.

        Raises:
            NotFoundError: there is no such node.
        """
        entities = self.entities()
        full = resolve(name)
        info = graph_info.node_info(entities, full)
        if info is None:
            raise self._no_node(full, entities)
        pid, host = ask_process(self.session, self.domain, info.zid)
        return info._replace(pid=pid, host=host)

    def publishers_info(self, topic: str) -> tuple[Entity, ...]:
        """Return the publishers of a topic."""
        return self._ends(Kind.PUBLISHER, topic)

    def subscriptions_info(self, topic: str) -> tuple[Entity, ...]:
        """Return the subscriptions of a topic."""
        return self._ends(Kind.SUBSCRIPTION, topic)

    def kill_node(self, name: str, reason: str = "user request") -> bool:
        """Ask a node to shut down, as ``rosnode kill`` does; return whether its process answered.

        Raises:
            NotFoundError: there is no such node.
        """
        entities = self.entities()
        full = resolve(name)
        info = graph_info.node_info(entities, full)
        if info is None:
            raise self._no_node(full, entities)
        return shut_down_node(self.session, self.domain, info.zid, full, reason)

    def entities(self) -> tuple[Entity, ...]:
        """Return everything on the graph, asking afresh; complete also just after joining."""
        return self._discovery.ask()

    @property
    def discovery(self) -> Discovery:
        """What is known of the graph without asking, and notice of changes."""
        return self._discovery

    def entity_with_gid(self, gid: bytes) -> Entity | None:
        """Return the publisher that an attachment names, if it is there."""
        return self._discovery.with_gid(gid)

    def subscription_count(self, topic: str) -> int:
        """Return how many subscriptions of a topic are known."""
        return self._discovery.count(Kind.SUBSCRIPTION, topic)

    def publisher_count(self, topic: str) -> int:
        """Return how many publishers of a topic are known."""
        return self._discovery.count(Kind.PUBLISHER, topic)

    def has_service(self, name: str) -> bool:
        """Return whether somebody offers the service."""
        full = resolve(name)
        return self._discovery.count(Kind.SERVICE, full) > 0 or any(
            one.kind is Kind.SERVICE and one.name == full for one in self.entities()
        )

    def wait_for_service(self, name: str, timeout_s: float | None = None) -> bool:
        """Wait until somebody offers the service; False when time is up first."""
        full = resolve(name)
        return self._discovery.wait_for(
            lambda known: any(one.kind is Kind.SERVICE and one.name == full for one in known),
            timeout_s,
        )

    def finds_service(self, name: str) -> bool:
        """Return whether somebody offers the service, when nothing new comes to the graph."""
        full = resolve(name)
        return self._discovery.settles(
            lambda known: any(one.kind is Kind.SERVICE and one.name == full for one in known)
        )

    def next_id(self) -> int:
        """Return a number that no entity of this session has."""
        return next(self._ids)

    def forget(self, one: Any) -> None:
        """Forget a node, or something of a node, that was closed."""
        with self._lock:
            if isinstance(one, Node):
                if one in self._nodes:
                    self._nodes.remove(one)
                self._duplicate_nodes.release(one.name)
                return
            owners = [node for node in self._nodes if node.name == one.entity.node]
        for owner in owners:
            owner.drop(one)

    def close(self) -> None:
        """Shut the nodes down and leave; calling it twice does nothing."""
        with self._lock:
            if self._closed:
                return
            self._closed = True
        self.clock.close()
        for node in self.nodes:
            node.shutdown("graph closed")
        self._deliver_last()
        if self in Graph._open:
            Graph._open.remove(self)
        self._discovery.close()
        if self._control is not None:
            self._control.close()
        self.parameter_share.close()
        if self._keeper is not None:
            self._keeper.settle()
        close_session(self.session)
        self.calls.wait_until_none(_LAST_CALLS_S)
        if self._keeper is not None:
            self._keeper.close()
        atexit.unregister(self.close)

    def _start(self) -> None:
        self._discovery.start()
        self._control = Control(self.session, self.domain, self.zid, self._shut_node_down)
        if self._keeper is not None:
            self.parameters.on_change(self._on_parameter)
        Graph._open.append(self)
        atexit.register(self.close)

    def _deliver_last(self) -> None:
        """Wait for the subscribers of what was sent last: what waits in a link ends with it."""
        import zenoh

        topics = self.local.sent_since(time.monotonic() - _LAST_MESSAGES_S)
        entities = self._discovery.known() if topics else ()
        zids = {
            one.zid
            for one in entities
            if one.kind is Kind.SUBSCRIPTION and one.name in topics and one.zid != self.zid
        }
        with suppress(zenoh.ZError):
            wait_for_processes(self.session, self.domain, zids, _LAST_MESSAGES_S)

    def _on_parameter(self, name: str) -> None:
        if name in ("/", _USE_SIM_TIME):
            # Not here: the store waits for its listeners, and subscribing takes its time.
            threading.Thread(target=self.clock.refresh, daemon=True).start()

    def _shut_node_down(self, name: str, reason: str, since_ns: int | None = None) -> bool:
        with self._lock:
            node = next((one for one in self._nodes if one.name == name), None)
        if node is None or (
            since_ns is not None and not self._duplicate_nodes.yields(name, since_ns)
        ):
            return False
        node.log("warn", f"shutdown request: [{name}] Reason: {reason}")
        node.shutdown(reason)
        return True

    def _ends(self, kind: Kind, topic: str) -> tuple[Entity, ...]:
        full = resolve(topic)
        return tuple(one for one in self.entities() if one.kind is kind and one.name == full)

    def _no_node(self, name: str, entities: tuple[Entity, ...]) -> NotFoundError:
        names = graph_info.nodes_of(entities)
        return NotFoundError(
            "node", name, nearest=nearest_names(name, names), hint="ROS says: Unknown node"
        )


def _open_peer(
    cls: type[Graph], port: int, domain: int, environ: Mapping[str, str], *, eager: bool
) -> Graph:
    import zenoh

    keeper = HubKeeper(port, eager=eager)
    keeper.carry()
    endpoint = own_endpoint()
    session = zenoh.open(peer_config(port, endpoint))
    share(endpoint)
    graph = cls(session, port=port, domain=domain, environ=environ, keeper=keeper)
    if not keeper.start(session, _HUB_S, graph.parameter_share.own):
        keeper.close()
        close_session(session)
        raise port_taken(port)
    return graph


def _open_client(port: int) -> zenoh.Session:
    import zenoh

    if not somebody_listens(port):
        raise NoGraphError(
            f"no graph is running on port {port} (Unable to communicate with master!)\n"
            "  fix: start a launch, a simulator or `gazelle roscore`; GAZELLE_PORT, "
            "ROS_DOMAIN_ID and ROS_MASTER_URI must be the same in all shells, and so must the user "
            "be (GAZELLE_GRAPH_FOLDER shares a graph)"
        )
    try:
        # A hub on a busy machine is silent as a stranger is, for a second and more.
        return zenoh.open(client_config(port, _HUB_S))
    except zenoh.ZError as error:
        raise port_taken(port) from error
