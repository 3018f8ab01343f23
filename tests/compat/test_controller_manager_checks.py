"""controller_manager.test_utils, beside a manager that says what it is told."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.compat.controller_manager_checks import (
    check_controllers_running,
    check_if_js_published,
    check_node_running,
)
from gazelle.compat.launch_ros.launch_testing_ros import MessagePump
from gazelle.compat.rclpy.context import Context
from gazelle.compat.rclpy.node import Node
from gazelle.graph import Graph
from gazelle.interfaces import message_type, service_type

_STATE: Any = message_type("controller_manager_msgs/msg/ControllerState")
_JOINTS: Any = message_type("sensor_msgs/msg/JointState")
_LIST = service_type("controller_manager_msgs/srv/ListControllers")


class _Robot:
    """A controller manager.

    Attributes:
        states: what it says, by the controllers' names.
        later: what it says after its first answer.
        asked: how often it was asked.
    """

    def __init__(self, context: Context, namespace: str = "") -> None:
        self.states: dict[str, str] = {}
        self.later: dict[str, str] = {}
        self.asked = 0
        self.node = Node("controller_manager", namespace=namespace, context=context)
        self.node.create_service(_LIST, "~/list_controllers", self._on_list)

    def _on_list(self, _request: Any, response: Any) -> Any:
        self.asked += 1
        response.controller = [_STATE(name=name, state=said) for name, said in self.states.items()]
        self.states = self.later or self.states
        return response


@pytest.fixture
def context(free_port: int, monkeypatch: pytest.MonkeyPatch) -> Iterator[Context]:
    monkeypatch.setenv("GAZELLE_PORT", str(free_port))
    with Graph.open(port=free_port, role="hub", environ={}):
        made = Context()
        made.init()
        yield made
        made.try_shutdown()


@pytest.fixture
def tester(context: Context) -> Iterator[Node]:
    made = Node("tester", context=context)
    yield made
    made.destroy_node()


@pytest.fixture(params=["", "/arm"])
def robot(request: pytest.FixtureRequest, context: Context) -> Iterator[tuple[_Robot, str]]:
    made = _Robot(context, request.param)
    pump = MessagePump(made.node, context)
    pump.start()
    yield made, request.param
    pump.stop()
    made.node.destroy_node()


def test_a_node_is_found_by_its_name(tester: Node) -> None:
    check_node_running(tester, "tester")
    with pytest.raises(AssertionError, match=r"nobody not found! There are .*'tester'"):
        check_node_running(tester, "nobody", timeout=0.0)


def test_controllers_are_waited_for_until_they_are_in_the_state(
    tester: Node, robot: tuple[_Robot, str]
) -> None:
    manager, namespace = robot
    manager.states = dict.fromkeys(("wheels", "states"), "inactive")
    manager.later = {"wheels": "active", "states": "active"}
    check_controllers_running(tester, ["wheels", "states"], namespace, timeout=stretched(30))
    assert manager.asked == 2
    manager.later = manager.states = {"wheels": "inactive"}
    check_controllers_running(tester, ["wheels"], namespace, "inactive")
    assert manager.asked == 3


def test_controllers_in_another_state_are_named_with_it(
    tester: Node, robot: tuple[_Robot, str]
) -> None:
    manager, namespace = robot
    manager.states = {"wheels": "active", "states": "inactive"}
    with pytest.raises(AssertionError, match=r"not found or not active: states \(inactive\)"):
        check_controllers_running(tester, ["wheels", "states"], namespace, timeout=0.0)


def test_controllers_that_are_not_there_are_named(tester: Node, robot: tuple[_Robot, str]) -> None:
    manager, namespace = robot
    manager.states["wheels"] = "active"
    with pytest.raises(AssertionError, match=r"not active: none \(none\), other \(none\)"):
        check_controllers_running(tester, ["none", "wheels", "other"], namespace, timeout=0.0)


def test_a_manager_without_controllers_is_told(tester: Node, robot: tuple[_Robot, str]) -> None:
    with pytest.raises(AssertionError, match="No controllers found!"):
        check_controllers_running(tester, [], robot[1], timeout=0.0)


def test_a_node_that_somebody_spins_can_look_for_controllers(
    context: Context, tester: Node, robot: tuple[_Robot, str]
) -> None:
    manager, namespace = robot
    manager.states["wheels"] = "active"
    pump = MessagePump(tester, context)
    pump.start()
    check_controllers_running(tester, ["wheels"], namespace.strip("/"))
    pump.stop()


def test_joints_are_these_and_no_others_in_any_order(context: Context, tester: Node) -> None:
    publisher = tester.create_publisher(_JOINTS, "/joint_states", 10)
    tester.create_timer(0.01, lambda: publisher.publish(_JOINTS(name=["b", "a"])))
    pump = MessagePump(tester, context)
    pump.start()
    check_if_js_published("/joint_states", ["a", "b"])
    with pytest.raises(AssertionError, match="Wrong number of joints"):
        check_if_js_published("/joint_states", ["a", "b", "c"])
    with pytest.raises(AssertionError, match=r"Wrong joint names: \['b', 'a'\] instead of"):
        check_if_js_published("/joint_states", ["a", "c"])
    pump.stop()
