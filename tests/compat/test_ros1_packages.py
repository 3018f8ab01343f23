"""gazebo_ros.gazebo_interface, rospkg's and roslib's inner modules, and genpy.message."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any


def test_gazebo_interface_calls_gazebos_services(passes: Callable[..., Any]) -> None:
    done = passes("""
import rospy
from gazebo_msgs.srv import SetModelConfiguration, SpawnModel
from geometry_msgs.msg import Pose, Point
from gazebo_ros import gazebo_interface
rospy.init_node("spawner")
seen = []
def answer(request):
    seen.append(request)
    if request.model_name == "bad":
        raise ValueError("no such model")
    return {"success": request.model_name != "twice", "status_message": "said"}
for kind in ("urdf", "sdf"):
    rospy.Service("/gz/spawn_%s_model" % kind, SpawnModel, answer)
rospy.Service("/gz/set_model_configuration", SetModelConfiguration, answer)
for call in (gazebo_interface.spawn_urdf_model_client, gazebo_interface.spawn_sdf_model_client):
    place = Pose(position=Point(1, 2, 3))
    assert call("box", "<robot/>", "/ns", place, "map", "/gz") is True
    request = seen[-1]
    assert (request.model_name, request.model_xml, request.robot_namespace) == (
        "box", "<robot/>", "/ns")
    assert request.initial_pose.position.z == 3.0 and request.reference_frame == "map"
    assert call("twice", "<robot/>", "", Pose(), "", "/gz") is False
    assert call("bad", "<robot/>", "", Pose(), "", "/gz") is None
set_joints = gazebo_interface.set_model_configuration_client
assert set_joints("box", "robot_description", ["lift"], [0.5], "/gz") is True
assert (seen[-1].urdf_param_name, seen[-1].joint_names, list(seen[-1].joint_positions)) == (
    "robot_description", ["lift"], [0.5])
from gazebo_ros.gazebo_interface import *
assert ModelState._type == "gazebo_msgs/ModelState" and Twist._type == "geometry_msgs/Twist"
""")
    assert "Waiting for service /gz/spawn_urdf_model" in done.text
    assert "Spawn status: said" in done.text and "Service call failed: " in done.text


def test_inner_modules_of_rospkg_and_roslib_have_their_functions(
    passes: Callable[..., Any], tmp_path: Path
) -> None:
    mine = tmp_path / "src" / "mine"
    mine.mkdir(parents=True)
    (mine / "package.xml").write_text(
        "<package><name>mine</name><version>1.2.3</version><description>d</description></package>"
    )
    passes(
        f"MINE = {str(mine)!r}\n"
        + """
import os
from rospkg.common import ResourceNotFound, PACKAGE_FILE
from rospkg.environment import get_ros_home, ROS_HOME
from rospkg.rospack import RosPack, get_package_name
import roslib, roslib.names, roslib.packages
assert RosPack().get_path("mine") == MINE and get_package_name(MINE) == "mine"
try:
    RosPack().get_path("nobody")
except ResourceNotFound as error:
    assert "nobody" in str(error)
assert PACKAGE_FILE == "package.xml" and get_ros_home({"ROS_HOME": "/h"}) == "/h"
assert ROS_HOME == "ROS_HOME"
from roslib.names import *
assert roslib.names.ns_join("/a", "b") == "/a/b" and roslib.names.is_global("/a")
assert package_resource_name("std_msgs/String") == ("std_msgs", "String")
assert package_resource_name("String") == ("", "String")
try:
    package_resource_name("a/b/c")
except ValueError as error:
    assert str(error) == "invalid name [a/b/c]"
assert resource_name("p", "N") == "p/N" and resource_name("p", "N", my_pkg="p") == "N"
assert resource_name_base("p/N") == "N" and resource_name_package("p/N") == "p"
assert resource_name_package("N") is None
assert is_legal_resource_name("a/b_1") and not is_legal_resource_name("a//b")
assert not is_legal_resource_name("1a") and not is_legal_resource_name(None)
assert is_legal_resource_base_name("a1") and not is_legal_resource_base_name("a/b")
assert roslib.packages.list_pkgs_by_path(os.path.dirname(MINE)) == ["mine"]
assert issubclass(roslib.packages.InvalidROSPkgException, roslib.packages.ROSPkgException)
""",
        ROS_PACKAGE_PATH=str(tmp_path / "src"),
    )


def test_genpy_fills_messages_and_shows_them(passes: Callable[..., Any]) -> None:
    passes("""
import rospy
import genpy
from genpy.message import *
from std_msgs.msg import Header, String
from geometry_msgs.msg import Point, PoseStamped
point = Point()
fill_message_args(point, [1, 2, 3])
assert (point.x, point.z) == (1, 3)
fill_message_args(point, [{"y": 7}])
assert (point.x, point.y) == (1, 7)
stamped = PoseStamped()
fill_message_args(stamped, {"header": {"stamp": "now"}}, keys={"now": rospy.Time(5)})
assert stamped.header.stamp.secs == 5
for wrong in ([1, 2], {"w": 1}):
    try:
        fill_message_args(point, wrong)
    except MessageException as error:
        assert isinstance(error, genpy.MessageException)
    else:
        raise AssertionError(wrong)
try:
    fill_message_args(point, 3)
except ValueError as error:
    assert "invalid message_args type" in str(error)
assert strify_message(String("hi")) == str(String("hi"))
assert strify_message(Header(frame_id="map"), field_filter=lambda _: ["frame_id"]) == (
    'frame_id: "map"')
assert get_message_class("std_msgs/String") is String
""")
