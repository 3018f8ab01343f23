"""rosgraph's addresses and names, rospkg's folders, and rosnode's machines."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.compat import rospkg
from gazelle.compat.rosgraph import masterapi, names

Run = Callable[..., Any]


def test_addresses_follow_words_and_variables(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.argv", ["program"])
    monkeypatch.delenv("ROS_IPV6", raising=False)
    monkeypatch.setenv("ROS_HOSTNAME", "robot")
    assert masterapi.get_master_uri(env={}) == "http://localhost:11311"
    assert masterapi.get_master_uri(argv=["__master:=http://a:1"]) == "http://a:1"
    assert masterapi.get_address_override() == "robot"
    assert masterapi.create_local_xmlrpc_uri(80) == "http://robot:80/"
    assert masterapi.get_bind_address("localhost") == "127.0.0.1"
    assert masterapi.get_bind_address("127.0.0.9") == "127.0.0.9"
    assert masterapi.get_bind_address() == "0.0.0.0"
    assert masterapi.is_local_address("127.0.0.1")
    assert not masterapi.is_local_address("no such host")
    monkeypatch.setattr("sys.argv", ["program", "__ip:=10.0.0.1"])
    assert masterapi.get_address_override() == "10.0.0.1"
    monkeypatch.setenv("ROS_IPV6", "on")
    assert masterapi.get_bind_address() == "::"
    assert masterapi.parse_http_host_and_port("http://a:81/x") == ("a", 81)
    with pytest.raises(ValueError, match="not a valid URL"):
        masterapi.parse_http_host_and_port("a:81")


def test_remaps_are_told_from_other_words() -> None:
    legal = [names.is_legal_remap(word) for word in ("a:=b", "__name:=b", "1:=b", "a")]
    assert legal == [True, True, False, False]


def test_folders_come_from_the_environment_given(tmp_path: Path) -> None:
    env = {"ROS_HOME": str(tmp_path), "ROS_PACKAGE_PATH": "/a:/b"}
    assert rospkg.get_log_dir(env) == str(tmp_path / "log")
    assert rospkg.get_test_results_dir(env) == str(tmp_path / "test_results")
    assert rospkg.get_ros_paths(env) == ["/a", "/b"]
    assert rospkg.get_etc_ros_dir(env) == "/etc/ros"
    assert not rospkg.on_ros_path(str(tmp_path), env)


def test_nodes_are_found_by_machine(passes: Run) -> None:
    passes(
        """
import rosgraph, rosnode, rosparam, rospy, socket
rospy.init_node("one")
(machine,) = rosnode.get_machines_by_nodes()
assert "/one" in rosnode.get_nodes_by_machine(machine)
assert rosnode.rosnode_ping_all() == (rosnode.get_node_names(), [])
master = rosgraph.Master("/one")
assert rosnode.get_api_uri(master, "/one").startswith("gazelle://")
assert rosnode.get_api_uri(master, "/nobody") is None
assert rosparam.load_str(str="a: 1", filename="f") == [({"a": 1}, "/")]
"""
    )
