"""What one test leaves behind is gone before the next one, whichever comes first."""

from __future__ import annotations

import os
import socket
from pathlib import Path

import pytest

from gazelle.bag import Connection, Encoding, learn_definitions
from gazelle.graph.type_support import hash_of
from gazelle.interfaces import (
    RosVersion,
    add_package,
    exists,
    keep_text,
    ros1_definition,
    type_hash,
)

_OWN = "left_behind_msgs/Own"
_TURNS = pytest.mark.parametrize("turn", [1, 2])


@_TURNS
def test_texts_that_came_in_are_forgotten(turn: int) -> None:
    assert ros1_definition("std_msgs/String") == "string data\n"
    text = f"# Of the peer of test {turn}.\nstring data\n"
    assert keep_text("std_msgs/String", RosVersion.ROS1, text)
    assert ros1_definition("std_msgs/String") == text


@_TURNS
def test_packages_are_forgotten(turn: int, tmp_path: Path) -> None:
    assert not exists(_OWN)
    assert hash_of("left_behind_msgs/msg/Own") == hash_of("nowhere_msgs/msg/Own")
    (tmp_path / "msg").mkdir()
    (tmp_path / "msg" / "Own.msg").write_text(f"int32[{turn}] counts\n")
    add_package("left_behind_msgs", tmp_path, RosVersion.ROS2)
    assert hash_of("left_behind_msgs/msg/Own") == type_hash("left_behind_msgs/msg/Own")


@_TURNS
def test_types_that_bags_bring_are_forgotten(turn: int) -> None:
    assert not exists(_OWN)
    assert not exists(f"left_behind_msgs/Own{3 - turn}")
    text = f"int32[{turn}] counts\n"
    for name in (_OWN, f"left_behind_msgs/Own{turn}"):
        one = Connection(0, "/own", name, Encoding.ROS1, text, "0" * 32, "/n")
        assert learn_definitions([one]) == ()
        assert ros1_definition(name) == text


def test_folders_of_the_person_are_not_used(tmp_path: Path) -> None:
    for variable in ("ROS_HOME", "XDG_CACHE_HOME", "XDG_CONFIG_HOME"):
        assert Path(os.environ[variable]).is_relative_to(tmp_path.parents[1])


def test_no_other_run_gets_a_port_in_use(free_port: int) -> None:
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", free_port))
    with socket.socket(type=socket.SOCK_DGRAM) as other, pytest.raises(OSError, match="in use"):
        other.bind(("127.0.0.1", free_port))


def test_ports_are_chosen_in_one_place() -> None:
    """Two workers that choose by themselves meet on one graph now and then."""
    here = Path(__file__).parent
    choosers = {
        str(path.relative_to(here))
        for path in here.rglob("*.py")
        if "os.getpid() %" in path.read_text(encoding="utf-8") and path != Path(__file__)
    }
    assert choosers == {"conftest.py"}
