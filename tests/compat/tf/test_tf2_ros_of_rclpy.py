"""tf2_ros in programs of rclpy: the same module, with rclpy's times and ROS 2's messages."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

HEAD = """
import math
import rclpy
from rclpy.duration import Duration
from rclpy.time import Time
from geometry_msgs.msg import (PointStamped, Pose, PoseStamped, PoseWithCovarianceStamped,
                               TransformStamped, Vector3Stamped)
import tf2_geometry_msgs
from tf2_geometry_msgs import do_transform_pose
from tf2_ros import LookupException, TransformException, TypeException
from tf2_ros.buffer import Buffer
from tf2_ros.static_transform_broadcaster import StaticTransformBroadcaster
from tf2_ros.transform_broadcaster import TransformBroadcaster
from tf2_ros.transform_listener import TransformListener
rclpy.init()
node = rclpy.create_node('looker')
buffer = Buffer()
listener = TransformListener(buffer, node)
def frame(parent, child, x, yaw):
    t = TransformStamped()
    t.header.stamp = node.get_clock().now().to_msg()
    t.header.frame_id, t.child_frame_id = parent, child
    t.transform.translation.x = x
    t.transform.rotation.z, t.transform.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return t
"""


def test_rclpy_program_sends_and_looks_up(passes: Callable[..., Any]) -> None:
    passes(
        HEAD
        + """
StaticTransformBroadcaster(node).sendTransform(frame('base', 'laser', 0.5, 0.0))
moving = TransformBroadcaster(node)
moving.sendTransform([frame('map', 'base', 1.0, math.pi / 2)])
found = buffer.lookup_transform('map', 'laser', Time(), timeout=Duration(seconds=5))
assert type(found).__module__ == TransformStamped.__module__ and found.header.stamp.sec > 0
assert abs(found.transform.translation.y - 0.5) < 1e-9, found
assert buffer.can_transform('map', 'laser', Time(), Duration(seconds=0.1))
known, reason = buffer.can_transform('map', 'nope', Time(), return_debug_tuple=True)
assert not known and 'nope' in reason
try:
    buffer.lookup_transform('map', 'nope', Time())
except TransformException as error:
    assert isinstance(error, LookupException) and 'nope' in str(error)
else:
    raise AssertionError('no such frame')
latest = buffer.get_latest_common_time('map', 'laser')
assert isinstance(latest, Time) and latest.nanoseconds > 0

point = PointStamped()
point.header.frame_id = 'laser'
point.point.x = 1.0
moved = buffer.transform(point, 'map', timeout=Duration(seconds=1))
assert moved.header.frame_id == 'map' and abs(moved.point.y - 1.5) < 1e-9, moved
pose = do_transform_pose(Pose(), found)
assert isinstance(pose, Pose) and abs(pose.orientation.z - math.sin(math.pi / 4)) < 1e-9
whole = PoseWithCovarianceStamped()
whole.header.frame_id = 'laser'
whole.pose.covariance[0] = 4.0
whole.pose.pose.orientation.w = 1.0
turned = buffer.transform(whole, 'map')
assert abs(turned.pose.covariance[7] - 4) < 1e-9 and abs(turned.pose.covariance[0]) < 1e-9
try:
    buffer.transform(found, 'map')
except TypeException as error:
    assert 'PoseStamped' in str(error)
else:
    raise AssertionError('transforms cannot be transformed')
"""
    )


def test_transform_is_awaited(passes: Callable[..., Any]) -> None:
    passes(
        HEAD
        + """
future = buffer.wait_for_transform_async('world', 'arm', Time())
assert not future.done()
broadcaster = TransformBroadcaster(node)
node.create_timer(0.05, lambda: broadcaster.sendTransform(frame('world', 'arm', 2.0, 0.0)))
rclpy.spin_until_future_complete(node, future, timeout_sec=10)
assert future.result() is True
async def look():
    return await buffer.lookup_transform_async('world', 'arm', Time())
task = rclpy.get_global_executor().create_task(look())
rclpy.spin_until_future_complete(node, task, timeout_sec=10)
assert task.result().transform.translation.x == 2.0
assert buffer.wait_for_transform_async('world', 'arm', Time()).done()
full = ('world', Time(), 'arm', Time(), 'world')
assert buffer.can_transform_full(*full)
assert buffer.lookup_transform_full(*full).child_frame_id == 'arm'
"""
    )


def test_objects_of_own_classes_are_transformed(passes: Callable[..., Any]) -> None:
    passes(
        HEAD
        + """
import tf2_ros
class Mine:
    def __init__(self, point):
        self.x, self.header = point.point.x, point.header
point = PointStamped()
point.header.frame_id = 'base'
StaticTransformBroadcaster(node).sendTransform(frame('map', 'base', 1.0, 0.0))
assert buffer.can_transform('map', 'base', Time(), Duration(seconds=5))
tf2_ros.ConvertRegistration().add_convert((PointStamped, Mine), Mine)
assert buffer.transform(point, 'map', new_type=Mine).x == 1.0
assert tf2_ros.convert(point, PointStamped) is point
try:
    tf2_ros.convert(point, int)
except TypeException as error:
    assert 'known: none' in str(error)
else:
    raise AssertionError('not registered')
try:
    tf2_ros.BufferInterface().lookup_transform('a', 'b', Time())
except tf2_ros.NotImplementedException:
    pass
"""
    )
