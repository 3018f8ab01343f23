"""Server and client of dynamic_reconfigure on one graph, and without a graph."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.graph import Graph
from gazelle.graph.dynamic_reconfigure import (
    DynamicGroup,
    DynamicParameter,
    EnumConstant,
    ReconfigureClient,
    ReconfigureError,
    ReconfigureServer,
    enum_edit_method,
)
from gazelle.interfaces import message_type, service_type

SIZE = enum_edit_method((EnumConstant("Small", 0), EnumConstant("Large", 2)), "Sizes")
GROUP = DynamicGroup(
    "Default",
    (
        DynamicParameter("p", "double", 1.0, "Gain.", 0.0, 10.0, level=1),
        DynamicParameter("size", "int", 0, "Size.", 0, 3, SIZE, 2),
    ),
    (DynamicGroup("More", (DynamicParameter("on", "bool", False, "Switch.", level=4),)),),
)


class StandIn:
    """A node that keeps what is published; services are called by tests."""

    def __init__(self, **stored: Any) -> None:
        self.stored = {f"/n/{key}": value for key, value in stored.items()}
        self.sets: list[str] = []
        self.sent: dict[str, list[Any]] = {}
        self.services: dict[str, Callable[[Any], Any]] = {}
        self.lines: list[str] = []
        self.parameters = self

    def get(self, name: str, default: Any) -> Any:
        return self.stored.get(name, default)

    def set(self, name: str, value: Any) -> None:
        self.sets.append(name)
        self.stored[name] = value

    def create_publisher(self, topic: str, message_type: Any, *, latch: bool = False) -> Any:
        assert latch
        sent = self.sent.setdefault(topic, [])

        class Publisher:
            publish = staticmethod(sent.append)

            @staticmethod
            def unregister() -> None:
                del self.sent[topic]

        return Publisher()

    def create_service(self, name: str, service_type: Any, handler: Any) -> Any:
        self.services[name] = handler

        class Service:
            @staticmethod
            def unregister() -> None:
                del self.services[name]

        return Service()

    def log(self, level: str, text: str) -> None:
        self.lines.append(f"{level}: {text}")


def _offer(node: Any, **options: Any) -> tuple[ReconfigureServer, list[Any]]:
    heard: list[Any] = []

    def changed(values: dict[str, Any], level: int) -> None:
        heard.append((dict(values), level))

    return ReconfigureServer(node, "/n", GROUP, changed, **options), heard


def test_stored_values_are_taken_over_if_they_fit() -> None:
    node = StandIn(p=99, size="big", on=True)
    server, heard = _offer(node)
    assert server.values == {"p": 10.0, "size": 0, "on": True}
    assert node.stored == {"/n/p": 10.0, "/n/size": 0, "/n/on": True}
    assert heard == []
    fresh, _ = _offer(StandIn(p=99), reads_store=False)
    assert fresh.values["p"] == 1.0


def test_change_is_heard_with_its_levels_told_and_stored() -> None:
    node = StandIn()
    server, heard = _offer(node, calls_at_start=True)
    assert heard == [({"p": 1.0, "size": 0, "on": False}, 0xFFFFFFFF)]
    node.sets.clear()
    assert server.set({"p": 20.0, "on": True}) == {"p": 10.0, "size": 0, "on": True}
    assert heard[1] == ({"p": 10.0, "size": 0, "on": True}, 5)
    assert node.sets == ["/n/p", "/n/on"]
    update = node.sent["/n/parameter_updates"][-1]
    assert [(one.name, one.value) for one in update.doubles] == [("p", 10.0)]
    server.set({"q": 1.0, "size": 2.5})
    assert heard[2][1] == 0
    assert "'q' = 1.0 is not one of its parameters" in node.lines[0]
    assert "'size' = 2.5 is no int" in node.lines[1]


def test_callback_may_correct_values() -> None:
    node = StandIn()
    server = ReconfigureServer(
        node, "/n", GROUP, lambda values, level: {**values, "size": 1, "p": 50.0}
    )
    assert server.set({"size": 3})["size"] == 1
    assert node.stored["/n/size"] == 1 and server.values["p"] == 10.0


def test_request_changes_groups_and_close_withdraws_everything() -> None:
    node = StandIn()
    ran: list[int] = []

    def run(work: Callable[[], Any]) -> Any:
        ran.append(1)
        return work()

    server, _ = _offer(node, run=run)
    request = service_type("dynamic_reconfigure/Reconfigure").Request()
    state = message_type("dynamic_reconfigure/GroupState")
    request.config.groups = [state(name="More", state=False, id=1, parent=0)]
    response = node.services["/n/set_parameters"](request)
    assert ran == [1] and server.states == {"Default": True, "More": False}
    assert [one.state for one in response.config.groups] == [True, False]
    server.close()
    server.close()
    assert not node.services and not node.sent


@pytest.fixture
def pair(join: Callable[..., Graph]) -> tuple[ReconfigureServer, ReconfigureClient]:
    node = join().create_node("n")
    server, _ = _offer(node)
    return server, ReconfigureClient(join().create_node("client"), "n")


def test_client_sees_description_and_values(pair: Any) -> None:
    server, client = pair
    assert client.wait_for_server(stretched(10))
    assert client.wait_for_values(10.0) == {"p": 1.0, "size": 0, "on": False}
    assert [group.name for group in client.description.groups] == ["More"]
    assert client.set({"p": "2.5", "on": "yes", "size": "large"}, timeout_s=stretched(30)) == {
        "p": 2.5,
        "size": 2,
        "on": True,
    }
    assert server.values == {"p": 2.5, "size": 2, "on": True}
    assert client.values == server.values
    client.set({}, states={"More": False}, timeout_s=stretched(30))
    assert not server.states["More"]
    client.close()


def test_client_says_what_cannot_be_set(pair: Any) -> None:
    _, client = pair
    with pytest.raises(ReconfigureError, match="don't know parameter: sise; did you mean 'size'"):
        client.set({"sise": 1}, timeout_s=stretched(30))
    with pytest.raises(ReconfigureError, match=r"can't set parameter 'p' of <class 'float'>: coul"):
        client.set({"p": "much"}, timeout_s=stretched(30))


def test_client_of_nobody_gives_up_in_time(join: Callable[..., Graph]) -> None:
    client = ReconfigureClient(join().create_node("client"), "nobody")
    assert not client.wait_for_server(0.01)
    assert client.wait_for_values(0.01) is None
    with pytest.raises(ReconfigureError, match="'/nobody' does not describe its parameters"):
        client.set({"p": 1.0}, timeout_s=0.01)


def test_listeners_hear_values_after_the_description(
    join: Callable[..., Graph], inbox: Any
) -> None:
    node = join().create_node("n")
    server, _ = _offer(node)
    ReconfigureClient(
        join().create_node("client"),
        "/n",
        on_description=lambda group: inbox("description"),
        on_values=lambda config, group: inbox(config.doubles[0].value),
    )
    assert inbox.wait_for(2)[:2] == ["description", 1.0]
    server.set({"p": 4.0})
    assert inbox.wait_for(3)[2] == 4.0
