"""What Nav2's servers have in common: a managed node with parameters, actions and a costmap."""

from __future__ import annotations

import contextlib
import threading
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable
from typing import Any, NamedTuple, Protocol

from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph, Node
from gazelle.graph.actions import ServerGoal
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.lifecycle import serve
from gazelle.nodes.nav2.costmap_node import CostmapNode
from gazelle.nodes.navigation.simple_action_server import SimpleActionServer
from gazelle.nodes.parameters import log_findings, node_reader, offer_parameters, start_ros2_node
from gazelle.parameters import ParameterTable
from gazelle.parameters.reader import ParameterReader

__all__ = ["ManagedNode", "ManagedServer", "ServedAction", "ServerSetup", "run_server"]

_WAIT_S = 0.2


class ServerSetup(NamedTuple):
    """What a server is made of.

    Attributes:
        node: on the graph.
        tree: its parameters, nested.
        arguments, graph: its costmap's, a node of its own.
    """

    node: Node
    tree: dict[str, Any]
    arguments: NodeArguments
    graph: Graph


class ServedAction(NamedTuple):
    """An action of a server.

    Attributes:
        name: on the graph.
        kind: in nav2_msgs.
        answer: works on a goal that was begun, in a thread of the action's own.
    """

    name: str
    kind: str
    answer: Callable[[SimpleActionServer, ServerGoal], None]


class ManagedNode(Protocol):
    """What the states of a managed node do; each tells whether it went well."""

    def configure(self) -> bool:
        """Read parameters, make what they name."""

    def activate(self) -> bool:
        """Begin to work."""

    def deactivate(self) -> bool:
        """Leave the work."""

    def cleanup(self) -> bool:
        """Give everything back."""


def run_server(
    make: Callable[[ServerSetup], ManagedNode],
    arguments: NodeArguments,
    graph: Graph,
    stop: threading.Event,
) -> int:
    """Be a managed node until told to stop."""
    node, tree = start_ros2_node(arguments, graph)
    server = make(ServerSetup(node, tree, arguments, graph))
    serve(arguments, node, stop, {
        "configure": server.configure, "activate": server.activate,
        "deactivate": server.deactivate, "cleanup": server.cleanup,
    })  # fmt: skip
    server.cleanup()
    node.shutdown()
    return 0


class ManagedServer(ABC):
    """A server whose parts say what it reads, which actions it has, and what they do."""

    errors_refuse = True
    """Whether errors in parameters keep it from being configured."""

    def __init__(self, setup: ServerSetup, table: ParameterTable, costmap: str = "") -> None:
        """Offer the parameters.

        Args:
            setup: of the node.
            table: of its parameters.
            costmap: name of the costmap that is its own, empty for none.
        """
        self._node, self._tree = setup.node, setup.tree
        self._setup, self._costmap_name = setup, costmap
        self._parameters = offer_parameters(setup.node, setup.tree)
        self._settings = node_reader(table, setup.tree, setup.node.name, Diagnostics())
        self._costmap: CostmapNode | None = None
        self._actions: dict[str, SimpleActionServer] = {}
        # Who works takes it along, so that the next activation does not wake the last one's.
        self._ending = threading.Event()
        self._turns: contextlib.AbstractContextManager[Any] = contextlib.nullcontext()

    @abstractmethod
    def _configured(self, settings: ParameterReader, diagnostics: Diagnostics) -> bool:
        """Read the settings; tell whether there is something to work with."""

    def _served(self) -> Iterable[ServedAction]:
        """Return the actions to offer while the server is active."""
        return ()

    def _begun(self) -> None:  # noqa: B027 - most have actions only
        """Do what there is to do besides actions."""

    def _left(self) -> None:  # noqa: B027 - most only answer
        """Do what comes after the end of actions that were offered."""

    def configure(self) -> bool:
        """Read parameters and log what is wrong with them."""
        diagnostics = Diagnostics()
        if self._costmap_name:
            setup = self._setup
            self._costmap = CostmapNode(
                self._costmap_name, setup.arguments, setup.graph, diagnostics
            )
        table = self._settings.table
        self._settings = node_reader(table, self._tree, self._node.name, diagnostics)
        is_ready = self._configured(self._settings, diagnostics)
        is_fine = log_findings(self._node, diagnostics)
        return is_ready and (is_fine or not self.errors_refuse)

    def activate(self) -> bool:
        """Offer the actions."""
        if self._costmap is not None:
            self._costmap.live.start()
        self._ending = threading.Event()
        for name, kind, answer in self._served():
            action = SimpleActionServer(self._node, name, f"nav2_msgs/{kind}", ros_version=2)
            self._actions[name] = action
            words = (action, answer, self._ending)
            threading.Thread(target=self._work, args=words, name=name, daemon=True).start()
        self._begun()
        return True

    def deactivate(self) -> bool:
        """Withdraw the actions."""
        self._ending.set()
        actions, self._actions = self._actions, {}
        for action in actions.values():
            action.close()
        if actions:
            self._left()
        return True

    def cleanup(self) -> bool:
        """Close the costmap as well."""
        self.deactivate()
        if self._costmap is not None:
            self._costmap.close()
            self._costmap = None
        return True

    def _work(
        self,
        action: SimpleActionServer,
        answer: Callable[[SimpleActionServer, ServerGoal], None],
        ending: threading.Event,
    ) -> None:
        while not ending.is_set() and not self._node.closed:
            if not action.wait(_WAIT_S):
                continue
            with self._turns:
                goal = action.take()
                if goal is not None:
                    answer(action, goal)
