"""The Python modules rosmsg and rosgraph."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.compat.command_modules import rosmsg
from gazelle.compat.rosgraph import names

TWIST = """geometry_msgs/Vector3 linear
  float64 x
  float64 y
  float64 z
geometry_msgs/Vector3 angular
  float64 x
  float64 y
  float64 z
"""


def test_texts_are_those_of_the_tool() -> None:
    assert rosmsg.get_msg_text("geometry_msgs/Twist") == TWIST
    assert rosmsg.get_msg_text("std_msgs/Empty") == ""
    raw = rosmsg.get_msg_text("geometry_msgs/Twist", raw=True)
    assert raw.split() == ["Vector3", "linear", "Vector3", "angular"]
    text = "bool data\n---\nbool success\nstring message\n"
    assert rosmsg.get_srv_text("std_srvs/SetBool") == text
    assert "bool data" in rosmsg.get_srv_text("std_srvs/SetBool", raw=True)
    assert rosmsg.rosmsg_md5(rosmsg.MODE_MSG, "geometry_msgs/Twist").startswith("9f195f88124")
    with pytest.raises(rosmsg.ROSMsgException, match=r"Unable to load msg \[std_msgs/Strin\].*did"):
        rosmsg.get_msg_text("std_msgs/Strin")
    with pytest.raises(rosmsg.ROSMsgException, match=r"Unknown srv type \[std_srvs/SetBol\]; did"):
        rosmsg.get_srv_text("std_srvs/SetBol")


def test_lists_hold_the_workspaces_own_types(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = tmp_path / "listed_msgs"
    (package / "msg").mkdir(parents=True)
    (package / "package.xml").write_text(
        "<package format='2'><name>listed_msgs</name><version>0.0.1</version>"
        "<description>d</description><maintainer email='a@b.c'>a</maintainer>"
        "<license>MIT</license><buildtool_depend>catkin</buildtool_depend></package>"
    )
    (package / "msg" / "Mine.msg").write_text("int8 x  # mine\n")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    assert rosmsg.list_types("listed_msgs") == ["listed_msgs/Mine"]
    assert rosmsg.get_msg_text("listed_msgs/Mine") == "int8 x\n"
    assert rosmsg.get_msg_text("listed_msgs/Mine", raw=True) == "int8 x  # mine\n"
    found = dict(rosmsg.iterate_packages(None, rosmsg.MODE_MSG))
    assert found["listed_msgs"] == str(package / "msg") and "sensor_msgs" in found
    assert list(rosmsg.rosmsg_search(None, rosmsg.MODE_MSG, "Mine")) == ["listed_msgs/Mine"]
    assert "std_srvs/Empty" in rosmsg.list_srvs("std_srvs")
    with pytest.raises(Exception, match="no_such_msgs"):
        rosmsg.list_msgs("no_such_msgs")
    with pytest.raises(ValueError, match="Unknown mode"):
        rosmsg.list_types("std_msgs", ".action")


@pytest.mark.reference
def test_names_are_those_of_rosgraph_1_15() -> None:
    pairs = [("/a", "b"), ("/a/", "b"), ("", "b"), ("/a", "/b"), ("/a", "~b"), ("~", "b")]
    assert [names.ns_join(*one) for one in pairs] == ["/a/b", "/a/b", "b", "/b", "~b", "~b"]
    assert [names.namespace(one) for one in ("/a/b", "/a", "a/b", "/")] == ["/a/", "/", "a/", "/"]
    words = ["a//b", "/a//b/", "/", "a/"]
    assert [names.canonicalize_name(one) for one in words] == ["a/b", "/a/b", "/", "a"]
    resolved = [
        names.resolve_name(one, "/ns/node", {"/ns/r": "/y"})
        for one in ("x", "~x", "/x", "", "~/x", "r")
    ]
    assert resolved == ["/ns/x", "/ns/node/x", "/x", "/ns/", "/ns/node/x", "/y"]
    words = ["x", "a:=b", "_p:=1", "__name:=q", ":=c", "d:=e:=f", "g:="]
    assert names.load_mappings(words) == {"a": "b", "__name": "q"}
    with pytest.raises(ValueError, match="cannot turn"):
        names.make_global_ns("~x")


def test_master_answers_from_the_graph(passes: Callable[..., Any]) -> None:
    passes("""
import rosgraph, rosgraph.masterapi, rospy
from rosgraph.names import script_resolve_name
from rosgraph.network import get_host_name
from std_msgs.msg import String
rospy.init_node('asker')
publisher = rospy.Publisher('chat', String, queue_size=1)
master = rosgraph.Master('/asker')
assert rosgraph.is_master_online() and master.is_online()
assert ['/chat', 'std_msgs/String'] in master.getTopicTypes()
master.setParam('/deep/value', 3)
assert master.getParam('/deep') == {'value': 3} and master.hasParam('/deep/value')
assert '/deep/value' in master.getParamNames()
master.deleteParam('/deep/value')
try:
    master.getParam('/deep/value')
except rosgraph.MasterError as error:
    assert 'is not set' in str(error)
else:
    raise AssertionError
assert master.lookupNode('/asker').startswith('gazelle://')
try:
    rosgraph.masterapi.Master('/asker').lookupNode('/nobody')
except rosgraph.MasterException as error:
    assert str(error) == 'unknown node [/nobody]'
else:
    raise AssertionError
assert rosgraph.myargv(['prog', 'a:=b', 'mine']) == ['prog', 'mine']
assert script_resolve_name('tool', 'x') == '/x' and get_host_name()
""")
