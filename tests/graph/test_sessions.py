from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import pytest

from gazelle.errors import GraphError
from gazelle.graph import locators, sessions


@pytest.mark.parametrize(
    ("environ", "expected"),
    [
        ({}, 7447),
        ({"ROS_DOMAIN_ID": "3"}, 7450),
        ({"ROS_MASTER_URI": "http://localhost:11311"}, 7447),
        ({"ROS_MASTER_URI": "http://robot:11316/"}, 7452),
        ({"GAZELLE_PORT": "9000", "ROS_DOMAIN_ID": "3"}, 9000),
    ],
)
def test_port_follows_the_environment(environ: dict[str, str], expected: int) -> None:
    assert sessions.port_of(environ) == expected


def test_port_stays_one_that_can_be_used() -> None:
    assert 1024 <= sessions.port_of({"ROS_MASTER_URI": "http://localhost:80"}) <= 65535


@pytest.mark.parametrize(
    ("environ", "text"),
    [
        ({"ROS_DOMAIN_ID": "red"}, "ROS_DOMAIN_ID is 'red', not a number from 0 to 232"),
        ({"ROS_DOMAIN_ID": "233"}, "ROS_DOMAIN_ID is '233'"),
        ({"GAZELLE_PORT": "0"}, "GAZELLE_PORT is '0', not a port number"),
        ({"ROS_MASTER_URI": "localhost"}, "ROS_MASTER_URI is 'localhost', not http"),
        ({"ROS_MASTER_URI": "http://h:x"}, "ROS_MASTER_URI is 'http://h:x', not http"),
    ],
)
def test_bad_environment_is_told(environ: dict[str, str], text: str) -> None:
    with pytest.raises(GraphError, match=text):
        sessions.port_of(environ)


@pytest.mark.parametrize(
    "make",
    [
        sessions.hub_config,
        lambda port: sessions.peer_config(port, locators.own_endpoint()),
        sessions.client_config,
    ],
)
@pytest.mark.parametrize("has_files", [True, False])
def test_nothing_leaves_the_machine(
    make: Callable[[int], Any], has_files: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(locators, "_HAS_SOCKET_FILES", has_files and locators._HAS_SOCKET_FILES)
    links = "unixsock-stream//tmp/gazelle-" if locators._HAS_SOCKET_FILES else "tcp/127.0.0.1:"
    made = make(7447)
    for key in ("listen/endpoints", "connect/endpoints"):
        assert all(one.startswith(links) for one in json.loads(made.get_json(key)))
    assert made.get_json("scouting/multicast/enabled") == "false"
