"""Parameters of ROS 2 nodes: services, events, what is refused."""

from __future__ import annotations

from typing import Any

import pytest

from gazelle.errors import GraphError
from gazelle.graph.ros2_node_parameters import Descriptor, NodeParameters, ParameterPolicy
from gazelle.graph.ros2_parameter_values import (
    ParameterType,
    parameter_type,
    value_from_message,
    value_message,
)
from gazelle.interfaces import from_cdr, message_type, service_type, to_cdr
from gazelle.simulator.intra_process_node import LocalNode

VALUES = {
    "joints": ["a", "b"],
    "gains.a.p": 1.0,
    "gains.a.d": 0.5,
    "update_rate": 100,
    "use_sim_time": True,
}


def _node(**more: Any) -> tuple[LocalNode, NodeParameters, list[Any]]:
    node = LocalNode()
    events: list[Any] = []
    node.create_subscription("/parameter_events", None, events.append)
    return node, NodeParameters(node, "/arm", VALUES, **more), events


def _call(node: LocalNode, name: str, kind: str, **fields: Any) -> Any:
    return node.call(f"/arm/{name}", service_type(f"rcl_interfaces/{kind}").Request(**fields))


def _parameter(name: str, value: Any) -> Any:
    return message_type("rcl_interfaces/Parameter")(name=name, value=value_message(value))


@pytest.mark.parametrize(
    ("value", "kind"),
    [
        (None, ParameterType.NOT_SET),
        (True, ParameterType.BOOL),
        (3, ParameterType.INTEGER),
        (3.5, ParameterType.DOUBLE),
        ("x", ParameterType.STRING),
        (b"\x01\xff", ParameterType.BYTE_ARRAY),
        ([True, False], ParameterType.BOOL_ARRAY),
        ([1, 2], ParameterType.INTEGER_ARRAY),
        ([1.0, 2.5], ParameterType.DOUBLE_ARRAY),
        (["a"], ParameterType.STRING_ARRAY),
    ],
)
def test_values_survive_the_wire(value: Any, kind: ParameterType) -> None:
    message = value_message(value)
    assert message.type == kind == parameter_type(value)
    back = from_cdr(type(message), to_cdr(message))
    assert value_from_message(back) == value


def test_values_no_parameter_can_have_are_refused() -> None:
    with pytest.raises(GraphError, match="cannot be a dict"):
        value_message({"a": 1})
    with pytest.raises(GraphError, match="items of one type"):
        value_message([1, "a"])


def test_get_list_types_and_descriptions() -> None:
    limits = Descriptor("proportional gain", lowest=0.0, highest=10.0)
    node, _, _ = _node(descriptors={"gains.a.p": limits, "joints": Descriptor(read_only=True)})
    got = _call(node, "get_parameters", "GetParameters", names=["gains.a.p", "nothing"])
    assert [value_from_message(item) for item in got.values] == [1.0, None]
    listed = _call(node, "list_parameters", "ListParameters").result
    assert list(listed.names) == sorted(VALUES)
    assert list(listed.prefixes) == ["gains.a"]
    below = _call(node, "list_parameters", "ListParameters", prefixes=["gains"], depth=2).result
    assert list(below.names) == ["gains.a.d", "gains.a.p"]
    shallow = _call(node, "list_parameters", "ListParameters", depth=1).result
    assert list(shallow.names) == ["joints", "update_rate", "use_sim_time"]
    types = _call(node, "get_parameter_types", "GetParameterTypes", names=["joints", "x"]).types
    assert list(types) == [ParameterType.STRING_ARRAY, ParameterType.NOT_SET]
    (row,) = _call(
        node, "describe_parameters", "DescribeParameters", names=["gains.a.p"]
    ).descriptors
    assert (row.description, row.type) == ("proportional gain", ParameterType.DOUBLE)
    assert (row.floating_point_range[0].from_value, row.floating_point_range[0].to_value) == (0, 10)


def test_set_tells_the_owner_and_the_others() -> None:
    heard: list[dict[str, Any]] = []

    def take(changes: dict[str, Any]) -> str:
        heard.append(changes)
        return ""

    node, parameters, events = _node(on_set=take, now_ns=lambda: 1_500_000_000)
    changes = [_parameter("gains.a.p", 2), _parameter("update_rate", 50)]
    results = _call(node, "set_parameters", "SetParameters", parameters=changes).results
    assert [item.successful for item in results] == [True, True]
    assert heard == [{"gains.a.p": 2.0}, {"update_rate": 50}]
    assert parameters.values["gains.a.p"] == 2.0
    assert [event.changed_parameters[0].name for event in events] == ["gains.a.p", "update_rate"]
    assert events[0].node == "/arm"
    assert (events[0].stamp.sec, events[0].stamp.nanosec) == (1, 500_000_000)


@pytest.mark.parametrize(
    ("name", "value", "reason"),
    [
        ("gains.a.q", 1.0, "parameter 'gains.a.q' cannot be set because it was not declared; did"),
        ("joints", ["c"], "parameter 'joints' cannot be set because it is read-only"),
        (
            "update_rate",
            "fast",
            "Wrong parameter type, parameter {update_rate} is of type {integer}, setting it to "
            "{string} is not allowed.",
        ),
        ("gains.a.p", 11.0, "Parameter {gains.a.p} doesn't comply with range [0, 10]."),
        ("gains.a.d", 99.0, "the owner says no"),
    ],
)
def test_refused_changes_leave_everything_as_it_was(name: str, value: Any, reason: str) -> None:
    rows = {
        "joints": Descriptor(read_only=True),
        "gains.a.p": Descriptor(lowest=0.0, highest=10.0),
    }
    node, parameters, events = _node(
        descriptors=rows,
        on_set=lambda changes: "the owner says no" if 99.0 in changes.values() else "",
    )
    together = [_parameter("use_sim_time", False), _parameter(name, value)]
    result = _call(
        node, "set_parameters_atomically", "SetParametersAtomically", parameters=together
    ).result
    assert not result.successful
    assert result.reason.startswith(reason)
    assert parameters.values == VALUES
    assert not events


def test_declaring_undeclaring_and_own_changes_are_announced() -> None:
    node, parameters, events = _node()
    parameters.declare("new", 1)
    parameters.update({"new": 2})
    parameters.undeclare("new")
    kinds = [
        (len(e.new_parameters), len(e.changed_parameters), len(e.deleted_parameters))
        for e in events
    ]
    assert kinds == [(1, 0, 0), (0, 1, 0), (0, 0, 1)]
    parameters.close()
    assert node.services == ()


def test_undeclared_names_may_be_allowed() -> None:
    _, parameters, events = _node(policy=ParameterPolicy(allow_undeclared=True))
    assert parameters.set({"fresh": [1.0]}) == ""
    assert parameters.values["fresh"] == [1.0]
    assert events[0].new_parameters[0].name == "fresh"
