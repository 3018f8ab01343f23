"""rosservice."""

from __future__ import annotations

import io
import re
from typing import Any

import pytest

from gazelle.graph import Node
from gazelle.interfaces import ros1_service_type

_SET_BOOL = ros1_service_type("std_srvs/SetBool")


@pytest.fixture
def calls(robot: Node) -> list[Any]:
    """A service /set that keeps what it was called with."""
    found: list[Any] = []

    def answer(request: Any) -> Any:
        found.append(request.data)
        return _SET_BOOL._response_class(success=request.data, message="done")

    robot.create_service("/set", _SET_BOOL, answer)
    return found


def test_list_shows_names_and_nodes(robot: Node, calls, run) -> None:
    robot.create_service("/arm/set", _SET_BOOL, print)
    assert run("rosservice", "list").out == "/arm/set\n/set\n"
    assert run("rosservice", "list", "-n").out == "/arm/set /robot\n/set /robot\n"
    assert run("rosservice", "list", "/arm").out == "/arm/set\n"


def test_info_type_args_uri_and_find(calls, run) -> None:
    lines = run("rosservice", "info", "set").out.splitlines()
    assert lines[0] == "Node: /robot"
    assert re.fullmatch(r"URI: gazelle://\S+:\d+/\d+", lines[1])
    assert lines[2:] == ["Type: std_srvs/SetBool", "Args: data"]
    assert run("rosservice", "type", "/set").out == "std_srvs/SetBool\n"
    assert run("rosservice", "args", "/set").out == "data\n"
    assert run("rosservice", "uri", "/set").out == lines[1].removeprefix("URI: ") + "\n"
    assert run("rosservice", "node", "/set").out == "/robot\n"
    assert run("rosservice", "find", "std_srvs/SetBool").out == "/set\n"


def test_arguments_of_a_nested_request_have_dots(robot: Node, run) -> None:
    robot.create_service("/s", ros1_service_type("gazebo_msgs/SetModelState"), print)
    args = run("rosservice", "args", "/s").out
    assert args.startswith("model_state.model_name model_state.pose.position.x ")


@pytest.mark.parametrize("word", ["true", "data: true", "{data: true}", "[true]"])
def test_call_takes_yaml_in_all_forms(calls, run, word: str) -> None:
    found = run("rosservice", "call", "/set", word)
    assert found == (0, 'success: True\nmessage: "done"\n', "")
    assert calls == [True]


def test_call_shows_the_request_when_asked(calls, run) -> None:
    assert run("rosservice", "call", "-v", "--nostr", "/set", "false").out == (
        'data: False\n---\nsuccess: False\nmessage: "<string length: 4>"\n'
    )


def test_call_without_arguments_prints_an_empty_line(robot: Node, run) -> None:
    kind = ros1_service_type("std_srvs/Empty")
    robot.create_service("/pause", kind, lambda _request: kind._response_class())
    assert run("rosservice", "call", "/pause") == (0, "\n", "")
    assert run("rosservice", "call", "/pause", "{}") == (0, "\n", "")


def test_call_reads_standard_input(calls, run, monkeypatch) -> None:
    monkeypatch.setattr("sys.stdin", io.StringIO("data: true\n---\ndata: false\n---\n"))
    assert run("rosservice", "call", "/set").code == 0
    assert calls == [True, False]


def test_wrong_arguments_are_explained(calls, run) -> None:
    found = run("rosservice", "call", "/set", "{dta: true}")
    assert found.code == 1
    assert found.err == (
        "ERROR: Incompatible arguments to call service:\nNo field name [dta]\n"
        "  std_srvs/srv/SetBool_Request has no field 'dta'; did you mean 'data'? "
        "Its fields are data\n"
        "Provided arguments are:\n * {'dta': True} (type dict)\n\nService arguments are: [data]\n"
    )
    assert not calls


def test_a_wrong_value_shows_the_definition(robot: Node, run) -> None:
    robot.create_service("/d", ros1_service_type("gazebo_msgs/DeleteModel"), print)
    found = run("rosservice", "call", "/d", "{model_name: 3}")
    assert found.err.startswith("ERROR: Unable to send request. One of the fields has an incorrect")
    assert found.err.endswith(
        "srv file:\nstring model_name\n---\nbool success\nstring status_message\n\n"
    )


def test_a_missing_service_is_one_error(calls, run) -> None:
    found = run("rosservice", "call", "/sett", "true")
    assert (found.code, found.err) == (
        1,
        "ERROR: Service [/sett] is not available.\n  did you mean '/set'?\n",
    )
    assert run("rosservice", "type", "/sett")[::2] == (
        1,
        "Unknown service [/sett]\n  did you mean '/set'?\n",
    )
    assert run("rosservice", "info", "/sett").err.startswith("ERROR: unknown service\n")


def test_what_the_handler_says_is_the_error(robot: Node, run) -> None:
    def fail(_request: Any) -> Any:
        raise ValueError("no such thing")

    robot.create_service("/set", _SET_BOOL, fail)
    found = run("rosservice", "call", "/set", "true")
    assert found.code == 1
    assert "ERROR: service [/set] responded with an error: " in found.err
    assert "no such thing" in found.err


def test_call_can_wait_for_the_service(robot: Node, run, monkeypatch) -> None:
    from gazelle.graph import Graph

    def appear(self: Graph, name: str, timeout_s: float | None = None) -> bool:
        if name not in {one.name for one in robot.graph.services()}:
            kind = _SET_BOOL
            robot.create_service(name, kind, lambda _one: kind._response_class(True, "late"))
            return False
        return True

    monkeypatch.setattr(Graph, "wait_for_service", appear)
    out = run("rosservice", "call", "--wait", "/late", "true").out
    assert out == 'success: True\nmessage: "late"\n'


def test_a_service_of_ros_1_in_another_world_is_told_its_name_there(robot, run) -> None:
    kind = ros1_service_type("std_srvs/Empty")
    robot.create_service("/_gazebo/pause_physics", kind, print)
    robot.create_service("/pause_physics", kind, print)
    assert run("rosservice", "list").out == "/pause_physics\n"
    assert run("rosservice", "call", "/gazebo/pause_physics").err == (
        "ERROR: Service [/gazebo/pause_physics] is not available.\n  it is ROS 1's, and this "
        "world was started by ROS 2 or gz, which have /pause_physics\n"
    )
