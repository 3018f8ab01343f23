"""What of each side the other gets."""

from __future__ import annotations

from gazelle.bridge.ros2.mirror_plan import (
    BRIDGE_NAME,
    TopicOfNode,
    TopicOfType,
    crosses,
    graph_entities_of,
)
from gazelle.bridge.ros2.qos import QosProfile
from gazelle.bridge.ros2.ros2_graph import NOTHING, RosEndpoint, RosState
from gazelle.graph import ANY_TYPE, Entity, Kind
from gazelle.graph.key_expressions import Qos

STRING = "std_msgs/msg/String"


def entity(
    kind: Kind, name: str, *, node: str = "/robot", type_name: str = STRING, qos: Qos | None = None
) -> Entity:
    return Entity("a", 1, 2, kind, node, name, type_name, qos=qos or Qos())


def test_hidden_names_stay_but_for_actions() -> None:
    assert crosses("/chatter", STRING)
    assert crosses("/fibonacci/_action/status", "action_msgs/msg/GoalStatusArray")
    assert not crosses("/_secret", STRING)
    assert not crosses("/a/get_type_description", "type_description_interfaces/srv/X")


def test_publishers_of_a_node_go_with_their_quality() -> None:
    found = graph_entities_of(
        [
            entity(Kind.NODE, "", type_name=""),
            entity(Kind.PUBLISHER, "/a", qos=Qos(reliable=False, depth=3)),
            entity(Kind.PUBLISHER, "/b", qos=Qos(latched=True, depth=0)),
            entity(Kind.SERVICE, "/c", type_name="std_srvs/srv/Empty"),
        ],
        NOTHING,
    )
    assert found.nodes == {"/robot": "/robot"}
    assert found.publishers == {
        TopicOfNode("/robot", "/a", STRING): QosProfile(False, False, 3),
        TopicOfNode("/robot", "/b", STRING): QosProfile(True, True, 1),
    }
    assert found.services == {("/robot", "/c"): "std_srvs/srv/Empty"}


def test_a_topic_is_asked_for_once() -> None:
    both = [
        entity(Kind.SUBSCRIPTION, "/a", node="/two"),
        entity(Kind.SUBSCRIPTION, "/a", node="/one"),
    ]
    assert graph_entities_of(both, NOTHING).subscriptions == {TopicOfType("/a", STRING): "/one"}


def test_any_type_is_that_of_ros() -> None:
    any_type = [entity(Kind.SUBSCRIPTION, "/a", type_name=ANY_TYPE)]
    assert graph_entities_of(any_type, NOTHING).subscriptions == {}
    state = RosState((), (RosEndpoint("/n", "/a", STRING, True, False, 1),), (), ())
    assert graph_entities_of(any_type, state).subscriptions == {TopicOfType("/a", STRING): "/robot"}


def test_name_that_ros_uses_gets_an_ending() -> None:
    state = RosState(("/robot",), (), (), ())
    found = graph_entities_of(
        [entity(Kind.NODE, ""), entity(Kind.NODE, "", node="/_ros2cli_1")], state
    )
    assert found.nodes == {"/robot": "/robot_gazelle", "/_ros2cli_1": BRIDGE_NAME}


def test_state_is_read_from_a_report() -> None:
    state = RosState.from_report(
        {
            "nodes": [["/a"], ["/b"]],
            "publishers": [["/a", "/t", STRING, True, False, 4]],
            "subscriptions": [["/b", "/t", STRING, False, True]],
            "services": [["/a", "/s", "std_srvs/srv/Empty"]],
        }
    )
    assert state.publishers == (RosEndpoint("/a", "/t", STRING, True, False, 4),)
    assert state.without(frozenset({"/a"})) == RosState(
        ("/b",), (), (RosEndpoint("/b", "/t", STRING, False, True),), ()
    )
