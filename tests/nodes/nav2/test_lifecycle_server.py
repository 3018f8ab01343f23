"""What all of Nav2's servers do in their states."""

from __future__ import annotations

import threading
from collections.abc import Iterable, Iterator
from typing import Any

import pytest
from tests.patience import eventually

from gazelle.diagnostics import Diagnostics
from gazelle.graph import Graph
from gazelle.graph.actions import ActionClient, ServerGoal
from gazelle.nodes.arguments import NodeArguments
from gazelle.nodes.nav2.lifecycle_server import ManagedServer, ServedAction, ServerSetup
from gazelle.nodes.nav2.parameters import WAYPOINT_FOLLOWER
from gazelle.nodes.navigation.simple_action_server import SimpleActionServer
from gazelle.parameters.reader import ParameterReader


class Server(ManagedServer):
    """Ends each goal at once."""

    def __init__(self, setup: ServerSetup) -> None:
        super().__init__(setup, WAYPOINT_FOLLOWER)
        self.said: list[str] = []

    def _configured(self, settings: ParameterReader, diagnostics: Diagnostics) -> bool:
        del diagnostics
        self.said.append(f"{settings.number('loop_rate'):g}")
        if "waypoint_follower_plugin" in self._tree:
            settings.report("navigation.unknown-plugin", "there is no such plug-in")
        return True

    def _served(self) -> Iterable[ServedAction]:
        for name in ("one", "two"):
            yield ServedAction(name, "Wait", self._answer)

    def _begun(self) -> None:
        self.said.append("begun")

    def _left(self) -> None:
        self.said.append("left")

    def _answer(self, action: SimpleActionServer, goal: ServerGoal) -> None:
        del goal
        action.succeed(text=action.name)


class Lenient(Server):
    errors_refuse = False


@pytest.fixture
def graph(free_port: int) -> Iterator[Graph]:
    with Graph.open(port=free_port, role="hub", environ={}) as found:
        yield found


def _setup(graph: Graph, tree: dict[str, Any]) -> ServerSetup:
    arguments = NodeArguments("server", has_ros_args=True)
    return ServerSetup(graph.create_node("server", is_ros2=True), tree, arguments, graph)


def _workers(name: str) -> int:
    return sum(one.name == name for one in threading.enumerate())


def test_two_actions_of_one_kind_are_both_answered(graph: Graph) -> None:
    server = Server(_setup(graph, {"loop_rate": 5.0}))
    assert server.configure() and server.activate()
    node = graph.create_node("client", is_ros2=True)
    for name in ("one", "two"):
        client = ActionClient(node, name, "nav2_msgs/Wait", ros_version=2)
        assert client.wait_for_server(60.0)
        sent = client.send_goal(client.types.Goal())
        assert sent.wait(60.0)
        assert sent.status.name == "SUCCEEDED"
    assert server.cleanup()
    assert server.said == ["5", "begun", "left"]


def test_who_is_active_again_has_one_worker_an_action(graph: Graph) -> None:
    server = Server(_setup(graph, {}))
    assert server.configure()
    for _ in range(4):
        assert server.activate()
        assert server.deactivate()
    assert server.activate()
    eventually(lambda: _workers("one") == _workers("two") == 1)
    server.cleanup()
    eventually(lambda: _workers("one") == _workers("two") == 0)


def test_wrong_parameters_refuse_a_server_that_cannot_do_without(graph: Graph) -> None:
    tree = {"waypoint_follower_plugin": "x"}
    assert not Server(_setup(graph, tree)).configure()
    lenient = ServerSetup(graph.create_node("lenient", is_ros2=True), tree, *_setup(graph, {})[2:])
    assert Lenient(lenient).configure()
