"""ros2 service."""

from __future__ import annotations

import io
from typing import Any

import pytest

from gazelle.graph import Node
from gazelle.interfaces import service_type

ADD = "example_interfaces/srv/AddTwoInts"


@pytest.fixture(autouse=True)
def _services(robot: Node) -> None:
    kind = service_type(ADD)

    def add(request: Any) -> Any:
        if request.a < 0:
            raise ValueError("no negative numbers")
        return kind.Response(sum=request.a + request.b)

    robot.create_service("/add_two_ints", kind, add)
    robot.create_service("/_secret", service_type("std_srvs/srv/Empty"), lambda _: None)


def test_list_type_find_and_info(run: Any) -> None:
    assert run("ros2", "service", "list") == (0, "/add_two_ints\n", "")
    assert run("ros2", "service", "list", "-t").out == f"/add_two_ints [{ADD}]\n"
    assert run("ros2", "service", "list", "-c", "--include-hidden-services").out == "2\n"
    assert run("ros2", "service", "type", "/add_two_ints") == (0, f"{ADD}\n", "")
    assert run("ros2", "service", "find", ADD) == (0, "/add_two_ints\n", "")
    assert run("ros2", "service", "find", "-c", ADD).out == "1\n"
    assert run("ros2", "service", "info", "/add_two_ints").out == (
        f"Type: {ADD}\nClients count: 0\nServices count: 1\n"
    )


def test_unknown_names_are_told_with_the_nearest(run: Any) -> None:
    near = "did you mean '/add_two_ints'?"
    code, out, error = run("ros2", "service", "type", "/add_two_int")
    assert (code, out, error) == (1, "", f"there is no service '/add_two_int'; {near}\n")
    code, _, error = run("ros2", "service", "info", "/add_two_int")
    assert (code, error) == (1, f"Unknown service '/add_two_int'\n  {near}\n")
    error = run("ros2", "service", "find", "example_interfaces/srv/AddTwoInt").err
    assert error.startswith("no service has the type 'example_interfaces/srv/AddTwoInt'; did")


def test_call(run: Any) -> None:
    assert run("ros2", "service", "call", "add_two_ints", ADD, "{a: 1, b: 2}") == (
        0,
        "requester: making request: example_interfaces.srv.AddTwoInts_Request(a=1, b=2)\n\n"
        "response:\nexample_interfaces.srv.AddTwoInts_Response(sum=3)\n\n",
        "",
    )


def test_call_with_values_of_standard_input(run: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", io.StringIO("a: 4\n"))
    out = run(
        "ros2", "service", "call", "--stdin", "/add_two_ints", "example_interfaces/AddTwoInts"
    ).out
    assert out.endswith("AddTwoInts_Response(sum=4)\n\n")


def test_repeated_calls_go_on(run_until: Any) -> None:
    words = ("call", "-r", "100", "/add_two_ints", ADD)
    out = run_until("sum=0)\n\nrequester", "ros2", "service", *words)
    assert out.count("making request") >= 2


def test_failing_call_is_an_error(run: Any) -> None:
    code, _, error = run("ros2", "service", "call", "/add_two_ints", ADD, "{a: -1}")
    assert code == 1
    reason = error.partition("\nException while calling service: ")[2]
    assert "no negative numbers" in reason


@pytest.mark.parametrize(
    ("kind", "values", "words"),
    [
        ("std_srvs/srv/SetBol", "{}", "service type 'std_srvs/srv/SetBol' not found; did you"),
        ("std_msgs/msg/String", "{}", "The passed type is not a service"),
        (ADD, "{c: 1}", "Failed to populate field: "),
        (ADD, "5", "The passed value needs to be a dictionary"),
        ("std_srvs/srv/Empty", "{}", f"service /add_two_ints has the type {ADD}, not std_srvs"),
    ],
)
def test_what_is_wrong_is_told(run: Any, kind: str, values: str, words: str) -> None:
    code, out, error = run("ros2", "service", "call", "/add_two_ints", kind, values)
    assert (code, out) == (1, "")
    assert words in error


def test_missing_service_is_waited_for(run_until: Any, capsys: pytest.CaptureFixture[str]) -> None:
    out = run_until("available", "ros2", "service", "call", "/add_two_int", ADD)
    assert out == "waiting for service to become available...\n"
    # What ends the command in the test logs there, too, and may come first.
    assert "  did you mean '/add_two_ints'?\n" in capsys.readouterr().err


def test_echo_says_that_services_cannot_be_listened_to(run: Any) -> None:
    code, _, error = run("ros2", "service", "echo", "/add_two_ints")
    assert code == 1
    assert "service introspection is not enabled for '/add_two_ints'" in error
    assert run("ros2", "service", "echo", "/x").err.startswith(
        "Could not determine the type for the passed service"
    )
