from __future__ import annotations

import pytest

from gazelle.errors import NotFoundError
from gazelle.interfaces import message_type, service_type
from gazelle.simulator.intra_process_node import LocalNode

STRING = "std_msgs/String"


def test_a_message_reaches_subscribers_as_the_same_object() -> None:
    node, got = LocalNode(), []
    publisher = node.create_publisher("chatter", message_type(STRING))
    assert not publisher.matched
    subscription = node.create_subscription("/chatter", None, got.append)
    assert publisher.matched
    message = message_type(STRING)(data="hello")
    publisher.publish(message)
    assert got[0] is message
    subscription.unregister()
    assert not publisher.matched


def test_a_latched_message_waits_for_late_subscribers() -> None:
    node, got = LocalNode(), []
    node.create_publisher("a", message_type(STRING), latch=True).publish(
        message_type(STRING)(data="kept")
    )
    node.create_subscription("a", None, got.append)
    assert [message.data for message in got] == ["kept"]


def test_services_answer_and_unknown_ones_name_the_nearest() -> None:
    node, empty = LocalNode(), service_type("std_srvs/Empty")
    service = node.create_service("/pause", empty, lambda request: empty.Response())
    assert node.call("pause", empty.Request()) == empty.Response()
    with pytest.raises(NotFoundError, match="service '/paus' not found; did you mean '/pause'"):
        node.call("/paus", empty.Request())
    service.unregister()
    assert node.services == ()


def test_parameters_are_kept() -> None:
    node = LocalNode()
    node.parameters.set("/use_sim_time", True)
    assert node.parameters.has("/use_sim_time")
    assert node.parameters.get("/rate", 5) == 5
    with pytest.raises(KeyError):
        node.parameters.get("/rate")
