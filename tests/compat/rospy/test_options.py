"""Options of rospy, rosgraph and roslib that act, and those that are told of."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from gazelle.graph import Graph


def test_node_without_rostime_stays_on_wall_time(passes: Callable[..., Any], graph: Graph) -> None:
    graph.parameters.set("/use_sim_time", True)
    done = passes("""
import rospy
rospy.init_node("clockless", disable_rostime=True, xmlrpc_port=4000)
assert rospy.get_time() > 1e9
""")
    text = "init_node: nothing listens at xmlrpc_port 4000; this graph has no such ports"
    assert done.text.count(text) == 1


def test_ros_root_is_of_the_environment_and_may_be_required(passes: Callable[..., Any]) -> None:
    passes("""
import rospy
assert rospy.get_ros_root(env={}) is None
assert rospy.get_ros_root(env={"ROS_ROOT": "/opt/ros"}) == "/opt/ros"
try:
    rospy.get_ros_root(required=True, env={})
except rospy.ROSException as error:
    assert str(error) == "ROS_ROOT is not set"
else:
    raise AssertionError
""")


def test_master_of_another_address_is_told_of(passes: Callable[..., Any]) -> None:
    done = passes(
        """
import rosgraph
assert rosgraph.is_master_online("http://other:11311")
rosgraph.Master("/me", "http://other:11311/")
rosgraph.Master("/me", rosgraph.get_master_uri())
""",
        ROS_MASTER_URI="http://localhost:11311",
    )
    told = [line for line in done.lines if line.startswith("[WARN] master")]
    assert told == [
        f"[WARN] master http://other:11311{end}: answered by the graph of this process,"
        " http://localhost:11311"
        for end in ("", "/")
    ]


def test_roslib_searches_and_filters_where_it_is_told(
    passes: Callable[..., Any], tmp_path: Path
) -> None:
    mine = tmp_path / "elsewhere" / "mine"
    for folder in ("a", "b"):
        (mine / folder).mkdir(parents=True)
        (mine / folder / "robot.urdf").write_text("<robot/>")
    (mine / "package.xml").write_text("<package><name>mine</name></package>")
    passes(
        f"MINE = {str(mine)!r}\n"
        + """
import os, rospkg
from roslib import packages
HERE = os.path.dirname(MINE)
assert packages.get_pkg_dir("mine", ros_package_path=HERE) == MINE
assert packages.get_pkg_dir("mine", ros_root=HERE) == MINE
found = packages.find_resource("mine", "robot.urdf", lambda path: "/a/" in path,
                               rospkg.RosPack([HERE]))
assert found == [MINE + "/a/robot.urdf"], found
cache = {}
assert packages.list_pkgs_by_path(HERE, cache=cache) == ["mine"]
assert cache["mine"][0] == MINE, cache
"""
    )
