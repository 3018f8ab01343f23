"""The service by which tools ask a buffer for its frames."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

_ROS1 = """
import rospy, tf, tf2_ros
from tf2_msgs.srv import FrameGraph
from geometry_msgs.msg import TransformStamped
rospy.init_node("looker")
tf2_ros.Buffer(debug=False), tf2_ros.Buffer(rospy.Duration(10), False), tf.Transformer()
"""


def test_buffer_of_rospy_tells_its_frames_unless_told_not_to(passes: Callable[..., Any]) -> None:
    passes(
        _ROS1
        + """
try:
    rospy.wait_for_service("/looker/tf2_frames", 0.2)
except rospy.ROSException:
    pass
else:
    raise AssertionError("it is offered")
buffer, other = tf2_ros.Buffer(), tf2_ros.Buffer()
frame = TransformStamped()
frame.header.frame_id, frame.child_frame_id = "map", "odom"
frame.transform.rotation.w = 1.0
buffer.set_transform_static(frame, "me")
answer = rospy.ServiceProxy("~tf2_frames", FrameGraph)()
assert "odom" in answer.frame_yaml and "parent: 'map'" in answer.frame_yaml, answer
"""
    )


def test_buffer_of_rclpy_tells_its_frames(passes: Callable[..., Any]) -> None:
    passes("""
import rclpy, tf2_ros
from rclpy.qos import QoSProfile
rclpy.init()
node = rclpy.create_node("looker")
buffer = tf2_ros.Buffer(node=node)
names = dict(node.get_service_names_and_types_by_node("looker", "/"))
assert names["/tf2_frames"] == ["tf2_msgs/srv/FrameGraph"], names
tf2_ros.TransformBroadcaster(node, QoSProfile(depth=7))
(told,) = node.get_publishers_info_by_topic("/tf")
assert told.qos_profile.depth == 7, told
""")


def test_static_frames_reach_late_listeners_whatever_the_qos(passes: Callable[..., Any]) -> None:
    done = passes("""
import rclpy, tf2_ros
rclpy.init()
tf2_ros.StaticTransformBroadcaster(rclpy.create_node("looker"), 5)
try:
    tf2_ros.TransformListener(tf2_ros.Buffer(), None, depth=1)
except TypeError as error:
    assert str(error).endswith("got an unexpected keyword argument 'depth'"), error
else:
    raise AssertionError
""")
    text = "StaticTransformBroadcaster: late listeners get its frames whatever the QoS"
    assert done.text.count(text) == 1


def test_graph_of_frames_says_when_it_was_recorded(passes: Callable[..., Any]) -> None:
    passes(
        _ROS1
        + """
transformer, frame = tf.Transformer(), TransformStamped()
frame.header.frame_id, frame.child_frame_id = "map", "odom"
frame.transform.rotation.w = 1.0
transformer.setTransform(frame)
assert "Recorded at time: 12.500" in transformer.allFramesAsDot(rospy.Time(12.5))
"""
    )


def test_listener_of_rclpy_takes_frames_from_the_topics_it_is_given(
    passes: Callable[..., Any],
) -> None:
    passes("""
import rclpy, tf2_ros
rclpy.init()
node = rclpy.create_node("looker")
tf2_ros.TransformListener(tf2_ros.Buffer(), node, tf_topic="/far/tf", tf_static_topic="/far/static")
topics = dict(node.get_subscriber_names_and_types_by_node("looker", "/"))
assert "/far/tf" in topics and "/far/static" in topics and "/tf" not in topics, topics
""")
