"""ros2 lifecycle, against the services of a managed node."""

from __future__ import annotations

from typing import Any

import pytest

from gazelle.graph import Graph, Node
from gazelle.interfaces import message_type, service_type

_TRANSITION = message_type("lifecycle_msgs/msg/Transition")
_STATE = message_type("lifecycle_msgs/msg/State")
_DESCRIPTION = message_type("lifecycle_msgs/msg/TransitionDescription")


class Managed:
    """The services of a node that can be configured once."""

    def __init__(self, graph: Graph) -> None:
        self.state = _STATE(1, "unconfigured")
        self.may_change = True
        node = graph.create_node("lidar", rosout=False)
        self.row = _DESCRIPTION(
            _TRANSITION(1, "configure"), _STATE(1, "unconfigured"), _STATE(2, "inactive")
        )
        self.other = _DESCRIPTION(
            _TRANSITION(3, "activate"), _STATE(2, "inactive"), _STATE(3, "active")
        )
        kinds = {
            "get_state": ("GetState", self.get),
            "change_state": ("ChangeState", self.change),
            "get_available_transitions": ("GetAvailableTransitions", self.available),
            "get_transition_graph": ("GetAvailableTransitions", self.every),
        }
        for name, (kind, handler) in kinds.items():
            node.create_service(f"/lidar/{name}", service_type(f"lifecycle_msgs/{kind}"), handler)

    def get(self, _: Any) -> Any:
        return service_type("lifecycle_msgs/GetState").Response(current_state=self.state)

    def change(self, request: Any) -> Any:
        if self.may_change:
            self.state = _STATE(2, "inactive")
        return service_type("lifecycle_msgs/ChangeState").Response(
            success=self.may_change and request.transition.id == 1
        )

    def available(self, _: Any) -> Any:
        kind = service_type("lifecycle_msgs/GetAvailableTransitions")
        return kind.Response(available_transitions=[self.row])

    def every(self, _: Any) -> Any:
        kind = service_type("lifecycle_msgs/GetAvailableTransitions")
        return kind.Response(available_transitions=[self.row, self.other])


@pytest.fixture
def managed(graph: Graph, robot: Node) -> Managed:
    return Managed(graph)


def test_nodes_and_get(managed: Managed, run: Any) -> None:
    assert run("ros2", "lifecycle", "nodes") == (0, "/lidar\n", "")
    assert run("ros2", "lifecycle", "nodes", "-c").out == "1\n"
    assert run("ros2", "lifecycle", "get") == (0, "/lidar: unconfigured [1]\n", "")
    assert run("ros2", "lifecycle", "get", "lidar") == (0, "unconfigured [1]\n", "")


def test_list_has_start_and_goal(managed: Managed, run: Any) -> None:
    first = "- configure [1]\n\tStart: unconfigured\n\tGoal: inactive\n"
    assert run("ros2", "lifecycle", "list", "/lidar") == (0, first, "")
    second = "- activate [3]\n\tStart: inactive\n\tGoal: active\n"
    assert run("ros2", "lifecycle", "list", "-a", "/lidar").out == first + second


def test_set_by_label_and_by_number(managed: Managed, run: Any) -> None:
    assert run("ros2", "lifecycle", "set", "/lidar", "1") == (0, "Transitioning successful\n", "")
    assert run("ros2", "lifecycle", "get", "/lidar").out == "inactive [2]\n"
    managed.may_change = False
    assert run("ros2", "lifecycle", "set", "/lidar", "configure") == (
        0,
        "",
        "Transitioning failed\n",
    )
    code, _, error = run("ros2", "lifecycle", "set", "/lidar", "activate")
    assert code == 1
    assert error == "Unknown transition requested, available ones are:\n- configure [1]\n"


def test_other_nodes_have_no_lifecycle(managed: Managed, run: Any) -> None:
    code, out, error = run("ros2", "lifecycle", "get", "/robot")
    assert (code, out) == (1, "")
    assert error == "Node not found\n  the node is there and has no lifecycle\n"
    assert run("ros2", "lifecycle", "list", "/lidr").err == (
        "Node not found\n  did you mean '/lidar'?\n"
    )


def test_without_managed_nodes_nothing_is_listed(robot: Node, run: Any) -> None:
    assert run("ros2", "lifecycle", "nodes") == (0, "", "")
    assert run("ros2", "lifecycle", "get") == (0, "", "")
