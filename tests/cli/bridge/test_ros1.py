"""``gazelle bridge ros1`` as a program."""

from __future__ import annotations

import xmlrpc.client
from collections.abc import Callable
from typing import Any

import pytest

from gazelle.cli.bridge import main

Run = Callable[..., Any]
Port = Callable[[], int]


def test_bridge_without_a_name_shows_what_there_is(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([]) == 2
    assert main(["--help"]) == 0
    assert "ros1       nodes and tools of an installed ROS 1" in capsys.readouterr().out
    assert main(["ros3"]) == 2
    assert "'ros3' is not a bridge; did you mean 'ros2' or 'ros1'?" in capsys.readouterr().err


def test_bridge_says_where_it_is_and_leaves_in_peace(gazelle: Run, next_port: Port) -> None:
    uri = f"http://127.0.0.1:{next_port()}"
    run = gazelle("bridge", "ros1", ROS_MASTER_URI=uri)
    run.wait_for_line(rf"^the bridge is the master at {uri}/$")
    run.wait_for_line(rf"export ROS_MASTER_URI={uri}$")
    run.wait_for_line("every user of this machine can reach it: ROS 1 asks nobody for a password")
    assert xmlrpc.client.ServerProxy(uri).getUri("/me") == [1, "", f"{uri}/"]
    assert run.stop() == 0
    with pytest.raises(OSError):
        xmlrpc.client.ServerProxy(uri).getUri("/me")


def test_port_is_a_port(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["ros1", "--port", "99999"])
    assert "'99999' is not a port number from 1 to 65535" in capsys.readouterr().err


def test_bad_address_is_told(gazelle: Run) -> None:
    run = gazelle("bridge", "ros1", ROS_IP="203.0.113.7")
    assert run.wait() == 1
    assert "ROS_IP is '203.0.113.7', which is not an address of this machine" in run.text


def test_open_address_is_told(gazelle: Run, next_port: Port) -> None:
    run = gazelle("bridge", "ros1", "--port", str(next_port()), ROS_IP="0.0.0.0")
    run.wait_for_line("other machines can reach it as 0.0.0.0")
    assert run.stop() == 0
