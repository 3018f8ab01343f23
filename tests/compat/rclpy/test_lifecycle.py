"""Lifecycle nodes; transitions and events listed are those of rclpy 9.1.2 with rcl_lifecycle."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.compat.rclpy.lifecycle.states import TRANSITIONS, StateMachine
from gazelle.graph import Node
from gazelle.interfaces import message_type, service_type

PROGRAM = """
import rclpy
from rclpy.lifecycle import LifecycleNode, State, TransitionCallbackReturn
from std_msgs.msg import String
rclpy.init()
class Talker(LifecycleNode):
    tries = 0
    def on_configure(self, state: State) -> TransitionCallbackReturn:
        assert state.label == 'unconfigured' and state.state_id == 1, state
        self.pub = self.create_lifecycle_publisher(String, 'lifecycle_chatter', 10)
        return super().on_configure(state)
    def on_activate(self, state):
        self.tries += 1
        if self.tries == 1:
            return TransitionCallbackReturn.FAILURE
        if self.tries == 2:
            raise ValueError('no camera')
        return super().on_activate(state)
    def on_cleanup(self, state):
        self.destroy_lifecycle_publisher(self.pub)
        return TransitionCallbackReturn.SUCCESS
node = Talker('talker')
"""


def test_callbacks_decide_where_a_transition_ends(passes: Callable[..., Any]) -> None:
    done = passes(
        PROGRAM
        + """
assert str(TransitionCallbackReturn.ERROR) == 'TransitionCallbackReturnType.ERROR'
S, F, E = (TransitionCallbackReturn[n] for n in ('SUCCESS', 'FAILURE', 'ERROR'))
state = lambda: node._LifecycleNodeMixin__machine.state.label
assert node.trigger_configure() is S and state() == 'inactive'
assert not node.pub.is_activated and node.pub.publish(String(data='lost')) is None
assert node.trigger_activate() is F and state() == 'inactive'
assert node.trigger_activate() is E and state() == 'unconfigured'
assert node.trigger_activate() is E
assert node.trigger_configure() is S
assert node.trigger_activate() is S and state() == 'active'
assert node.pub.is_activated
try:
    node.pub.publish(3)
except TypeError:
    pass
else:
    raise AssertionError('not a String')
assert node.trigger_deactivate() is S and not node.pub.is_activated
assert node.trigger_cleanup() is S and state() == 'unconfigured'
assert node.trigger_shutdown() is S and state() == 'finalized'
try:
    node.trigger_shutdown()
except RuntimeError as error:
    assert 'finalized' in str(error)
try:
    node.add_managed_entity(3)
except TypeError as error:
    assert str(error) == 'Expected a rclpy.lifecycle.ManagedEntity instance.'
"""
    )
    assert "on_activate() raised ValueError: no camera" in done.text
    assert "No transition matching activate found for current state unconfigured" in done.text
    assert "(possible: configure [1], shutdown [5])" in done.text
    assert "Unable to start transition activate from current state (1, 'unconfigured')" in done.text


def test_others_change_the_state_by_services(program: Callable[..., Any], node: Node) -> None:
    events: list[tuple[str, str]] = []
    node.create_subscription(
        "/talker/transition_event",
        message_type("lifecycle_msgs/msg/TransitionEvent"),
        lambda event: events.append((event.start_state.label, event.goal_state.label)),
    )
    running = program(PROGRAM + "rclpy.spin(node)")

    def ask(name: str, kind: str, **fields: Any) -> Any:
        service = service_type(f"lifecycle_msgs/srv/{kind}")
        client = node.create_client(f"/talker/{name}", service)
        assert client.wait_for_service(stretched(20)), running.text
        request = service.Request()
        for field, value in fields.items():
            request.transition.id, request.transition.label = value, field
        return client.call(request)

    assert ask("get_state", "GetState").current_state.label == "unconfigured"
    assert ask("change_state", "ChangeState", configure=0).success
    assert ask("get_state", "GetState").current_state.id == 2
    assert not ask("change_state", "ChangeState", nope=0).success
    possible = ask("get_available_transitions", "GetAvailableTransitions").available_transitions
    assert [one.transition.label for one in possible] == ["cleanup", "activate", "shutdown"]
    graph = ask("get_transition_graph", "GetAvailableTransitions").available_transitions
    assert len(graph) == 25 and graph[-1].goal_state.label == "finalized"
    states = ask("get_available_states", "GetAvailableStates").available_states
    assert [one.id for one in states] == [0, 1, 2, 3, 4, 10, 11, 12, 13, 14, 15]
    running.eventually(lambda: len(events) >= 2)
    assert events == [("unconfigured", "configuring"), ("configuring", "inactive")]


@pytest.mark.parametrize("label", ["configure", "cleanup", "activate", "deactivate", "shutdown"])
def test_every_transition_has_three_outcomes(label: str) -> None:
    for one in (one for one in TRANSITIONS if one.label == label):
        outcomes = [other.label for other in TRANSITIONS if other.start == one.goal]
        assert outcomes == ["transition_success", "transition_failure", "transition_error"]


def test_state_machine_finds_by_number_and_label() -> None:
    machine = StateMachine()
    found = machine.find(1)
    assert found is not None and found == machine.find("configure")
    assert machine.find(3) is None
    machine.go(found)
    assert machine.state == ("configuring", 10)
