"""tf2_ros, tf and tf2_geometry_msgs in a program of their own, against frames of the test."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.graph import Node
from gazelle.interfaces import fill, message_type

Run = Callable[..., Any]

_TF2 = """
import math, rospy, tf2_ros, tf2_geometry_msgs
from geometry_msgs.msg import PointStamped, PoseStamped, TransformStamped, Vector3Stamped
rospy.init_node("looker")
buffer = tf2_ros.Buffer()
listener = tf2_ros.TransformListener(buffer)
found = buffer.lookup_transform("map", "laser", rospy.Time(0), rospy.Duration(5))
assert (found.header.frame_id, found.child_frame_id) == ("map", "laser")
move = found.transform.translation
assert abs(move.x - 1) < 1e-9 and abs(move.y - 2) < 1e-9, move
assert buffer.can_transform("map", "laser", rospy.Time(0))
assert not buffer.can_transform("map", "nowhere", rospy.Time(0))

point = PointStamped()
point.header.frame_id = "laser"
point.point.x = 1.0
moved = buffer.transform(point, "map")
assert moved.header.frame_id == "map"
assert abs(moved.point.x - 1) < 1e-9 and abs(moved.point.y - 3) < 1e-9, moved
turned = tf2_geometry_msgs.do_transform_vector3(Vector3Stamped(vector=point.point), found)
assert abs(turned.vector.x) < 1e-9 and abs(turned.vector.y - 1) < 1e-9
pose = PoseStamped(); pose.header.frame_id = "laser"; pose.pose.orientation.w = 1.0
there = buffer.transform(pose, "map")
assert abs(there.pose.orientation.z - math.sin(math.pi / 4)) < 1e-9

def raises(kind, function, *args):
    try:
        function(*args)
    except kind as error:
        return str(error)
    raise AssertionError("nothing raised")

assert "nowhere" in raises(tf2_ros.LookupException, buffer.lookup_transform,
                           "map", "nowhere", rospy.Time(0))
raises(tf2_ros.ExtrapolationException, buffer.lookup_transform, "odom", "base", rospy.Time(9e5))
raises(tf2_ros.TypeException, buffer.transform, TransformStamped(), "map")

own = TransformStamped()
own.header.frame_id, own.child_frame_id, own.header.stamp = "laser", "tip", rospy.Time.now()
own.transform.rotation.w = own.transform.translation.z = 1.0
tf2_ros.StaticTransformBroadcaster().sendTransform(own)
assert buffer.lookup_transform("laser", "tip", rospy.Time(0), rospy.Duration(5))

import tf
from tf.transformations import euler_from_quaternion
old = tf.TransformListener()
old.waitForTransform("/map", "/laser", rospy.Time(0), rospy.Duration(5))
(x, y, z), rotation = old.lookupTransform("/map", "laser", rospy.Time(0))
assert (round(x, 6), round(y, 6), z) == (1.0, 2.0, 0.0)
assert abs(euler_from_quaternion(rotation)[2] - math.pi / 2) < 1e-9
raises(tf.LookupException, old.lookupTransform, "/map", "/nowhere", rospy.Time(0))
assert old.frameExists("laser") and "laser" in old.getFrameStrings()
assert old.transformPoint("map", point).point.y == moved.point.y
tf.TransformBroadcaster().sendTransform((0, 0, 5), (0, 0, 0, 1), rospy.Time.now(), "/flag", "map")
old.waitForTransform("map", "flag", rospy.Time(0), rospy.Duration(5))
assert old.lookupTransform("map", "flag", rospy.Time(0))[0] == (0, 0, 5)
"""


def _frame(parent: str, child: str, **transform: Any) -> Any:
    message = message_type("tf2_msgs/msg/TFMessage")()
    one = message_type("geometry_msgs/msg/TransformStamped")()
    fill(one, {"header": {"frame_id": parent}, "child_frame_id": child, "transform": transform})
    message.transforms = [one]
    return message


def test_buffers_listeners_and_broadcasters_work_on_the_graphs_frames(
    passes: Run, node: Node
) -> None:
    half = 0.5**0.5
    frames = message_type("tf2_msgs/msg/TFMessage")
    node.create_publisher("/tf_static", frames, latch=True).publish(
        _frame("base", "laser", rotation={"z": half, "w": half})
    )
    node.create_publisher("/tf", frames, latch=True).publish(
        _frame("odom", "base", translation={"x": 1.0, "y": 2.0}, rotation={"w": 1.0})
    )
    other = node.graph.create_node("map_node")
    other.create_publisher("/tf_static", frames, latch=True).publish(
        _frame("map", "odom", rotation={"w": 1.0})
    )
    passes(_TF2)


_SYNCHRONISED = """
import message_filters, rospy, threading
from std_msgs.msg import Header
from sensor_msgs.msg import Image, CameraInfo
rospy.init_node("sync")
pairs, near, done = [], [], threading.Event()
image = message_filters.Subscriber("image", Image)
info = message_filters.Subscriber("info", CameraInfo)
message_filters.TimeSynchronizer([image, info], 10).registerCallback(
    lambda a, b: pairs.append((a.header.stamp.secs, b.header.stamp.secs)))
def close(a, b):
    near.append((round(a.header.stamp.to_sec(), 6), round(b.header.stamp.to_sec(), 6)))
    if len(near) == 3:
        done.set()
message_filters.ApproximateTimeSynchronizer([image, info], 10, 0.1).registerCallback(close)
cache = message_filters.Cache(image, 5)
images = rospy.Publisher("image", Image, queue_size=10)
infos = rospy.Publisher("info", CameraInfo, queue_size=10)
for time in (1, 2, 3.05):
    images.publish(Image(header=Header(stamp=rospy.Time(time))))
for time in (1, 2, 3):
    infos.publish(CameraInfo(header=Header(stamp=rospy.Time(time))))
assert done.wait(30), near
assert sorted(pairs) == [(1, 1), (2, 2)]
assert sorted(near) == [(1.0, 1.0), (2.0, 2.0), (3.05, 3.0)]
assert cache.getElemBeforeTime(rospy.Time(2.5)).header.stamp == rospy.Time(2)
assert cache.getElemAfterTime(rospy.Time(2.5)).header.stamp.secs == 3
assert len(cache.getInterval(rospy.Time(1), rospy.Time(2))) == 2
"""


def test_message_filters_bring_together_what_belongs_together(passes: Run) -> None:
    passes(_SYNCHRONISED)


_MODULES = """
import genpy, rosgraph, roslib, rospkg, rospy
roslib.load_manifest("anything")
assert rospkg.RosPack().get_path("gazebo_ros").endswith("gazebo_ros")
assert "gazebo_ros" in rospkg.RosPack().list()
try:
    rospkg.RosPack().get_path("no_such_pkg")
    raise AssertionError("nothing raised")
except rospkg.ResourceNotFound as error:
    assert "no_such_pkg" in str(error)
assert rosgraph.is_master_online()
rospy.init_node("asker")
names = dict(rosgraph.Master("/asker").getSystemState()[0])
assert "/asker" in names["/rosout"]
assert genpy.Time(1.5).to_nsec() == 1_500_000_000 and genpy.Duration(2) == rospy.Duration(2)
assert issubclass(rospy.Message, genpy.Message)
"""


def test_small_modules_answer_from_workspace_and_graph(passes: Run) -> None:
    passes(_MODULES)
