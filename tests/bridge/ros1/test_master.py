"""The embedded master's answers, as a real one gives them."""

from __future__ import annotations

import xmlrpc.client
from collections.abc import Callable
from typing import Any

import pytest
from tests.bridge.ros1.peer import Peer, ask

from gazelle.bridge.ros1 import Bridge
from gazelle.graph import Graph

Eventually = Callable[[Callable[[], Any]], Any]


def test_facts_that_roscore_sets_are_there(bridge: Bridge, peer: Peer) -> None:
    assert peer.call("getParam", "/rosdistro") == "noetic\n"
    assert len(peer.call("getParam", "run_id")) == 36
    assert peer.call("getUri") == bridge.master.uri
    assert peer.call("getPid") > 0


def test_unknown_names_are_told_as_the_real_master_does(bridge: Bridge) -> None:
    uri = bridge.master.uri
    assert ask(uri, "lookupNode", "/a", "/b") == [-1, "unknown node [/b]", ""]
    assert ask(uri, "lookupService", "/a", "/b") == [-1, "no provider", ""]
    assert ask(uri, "getParam", "/a", "x") == [-1, "Parameter [/x] is not set", 0]
    assert ask(uri, "deleteParam", "/a", "/x") == [-1, "parameter [/x] is not set", 0]


def test_illegal_names_are_refused(bridge: Bridge) -> None:
    code, text, _ = ask(bridge.master.uri, "registerPublisher", "/a", "b c", "x/Y", "http://h:1/")
    assert (code, text) == (-1, "ERROR: parameter [name] is not a legal name: 'b c'")
    code, text, _ = ask(bridge.master.uri, "registerSubscriber", "/a", "/b", "*", "nowhere")
    assert text == "ERROR: parameter [caller_api] is not an XMLRPC URI: 'nowhere'"


def test_subscriber_is_told_of_publishers_that_come_and_go(
    make_peer: Callable[..., Peer], eventually: Eventually
) -> None:
    hearer, talker = make_peer("/hearer"), make_peer("/talker")
    assert hearer.call("registerSubscriber", "/a", "std_msgs/String", hearer.uri) == []
    found = talker.call("registerPublisher", "/a", "std_msgs/String", talker.uri)
    assert found == [hearer.uri]
    eventually(lambda: ("publisherUpdate", ("/master", "/a", [talker.uri])) in hearer.updates)
    assert talker.call("unregisterPublisher", "/a", talker.uri) == 1
    assert talker.call("unregisterPublisher", "/a", talker.uri) == 0
    eventually(lambda: ("publisherUpdate", ("/master", "/a", [])) in hearer.updates)


def test_publisher_states_the_type_whoever_came_first(make_peer: Callable[..., Peer]) -> None:
    peer = make_peer()
    peer.call("registerSubscriber", "/a", "*", peer.uri)
    assert peer.call("getTopicTypes") == [["/a", "*"]]
    peer.call("registerPublisher", "/a", "std_msgs/Int32", peer.uri)
    peer.call("registerSubscriber", "/a", "std_msgs/String", peer.uri)
    assert peer.call("getTopicTypes") == [["/a", "std_msgs/Int32"]]


def test_parameters_are_those_of_the_graph(graph: Graph, peer: Peer) -> None:
    peer.call("setParam", "~rate", 5)
    peer.call("setParam", "/arm", {"p": 1.5, "names": ["a", "b"]})
    assert graph.parameters.get("/peer/rate") == 5
    graph.parameters.set("/arm/i", True)
    assert peer.call("getParam", "/arm") == {"p": 1.5, "names": ["a", "b"], "i": True}
    assert peer.call("hasParam", "/arm/p") is True
    assert "/arm/names" in peer.call("getParamNames")
    assert peer.call("searchParam", "rate") == "/peer/rate"
    peer.call("deleteParam", "/arm")
    assert not graph.parameters.has("/arm")


def test_parameter_changes_are_told_to_who_asked(
    graph: Graph, make_peer: Callable[..., Peer], eventually: Eventually
) -> None:
    peer, other = make_peer("/a"), make_peer("/b")
    assert peer.call("subscribeParam", peer.uri, "/gains") == {}
    graph.parameters.set("/gains", {"p": 1})
    eventually(lambda: ("paramUpdate", ("/master", "/gains/", {"p": 1})) in peer.updates)
    other.call("setParam", "/gains/p", 2)
    eventually(lambda: ("paramUpdate", ("/master", "/gains/p/", 2)) in peer.updates)
    peer.call("setParam", "/gains/p", 3)
    graph.parameters.delete("/gains")
    eventually(lambda: peer.updates[-1] == ("paramUpdate", ("/master", "/gains/", {})))
    assert ("paramUpdate", ("/master", "/gains/p/", 3)) not in peer.updates
    peer.call("unsubscribeParam", peer.uri, "/gains")
    assert not bool(other.updates)


def test_numbers_too_big_for_xmlrpc_become_floats(graph: Graph, peer: Peer) -> None:
    graph.parameters.set("/big", 1 << 40)
    assert peer.call("getParam", "/big") == float(1 << 40)


@pytest.mark.parametrize("method", ["setParam", "getParam", "registerPublisher", "lookupNode"])
def test_names_that_are_no_texts_are_refused_without_a_traceback(
    bridge: Bridge, method: str, capfd: pytest.CaptureFixture[str]
) -> None:
    rest = {"setParam": (1,), "registerPublisher": ("std_msgs/Int32", "http://here:1/")}
    master: Any = xmlrpc.client.ServerProxy(bridge.master.uri)
    code, text, _ = getattr(master, method)("/peer", 3.5, *rest.get(method, ()))
    assert code == -1
    assert "must be a string" in text or "is not a legal name" in text
    assert "Traceback" not in "".join(capfd.readouterr())


def test_several_calls_in_one_as_roslaunch_sends_them(bridge: Bridge) -> None:
    calls: Any = xmlrpc.client.MultiCall(xmlrpc.client.ServerProxy(bridge.master.uri))
    calls.setParam("/roslaunch", "/one", 1)
    calls.getParam("/roslaunch", "/one")
    calls.getPid("/roslaunch", "too", "many")
    calls.nothing()
    answers = calls()
    results = [answers[place] for place in range(3)]
    with pytest.raises(xmlrpc.client.Fault, match='method "nothing" is not supported'):
        print(answers[3])
    assert results[1] == [1, "Parameter [/one]", 1]
    assert results[2][0] == -1
    assert "wrong arguments of getPid" in results[2][1]
