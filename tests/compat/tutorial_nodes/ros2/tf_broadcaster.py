"""Sends the frame of a turtle where its pose says it is, as the tf2 tutorial does."""

import rclpy
from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from tf2_ros import TransformBroadcaster
from tf_transformations import quaternion_from_euler
from turtlesim.msg import Pose


class FramePublisher(Node):
    def __init__(self):
        super().__init__("turtle_tf2_frame_publisher")
        self.turtlename = (
            self.declare_parameter("turtlename", "turtle").get_parameter_value().string_value
        )
        self.tf_broadcaster = TransformBroadcaster(self)
        self.create_subscription(Pose, f"/{self.turtlename}/pose", self.handle_turtle_pose, 1)

    def handle_turtle_pose(self, msg):
        t = TransformStamped()
        t.header.stamp = self.get_clock().now().to_msg()
        t.header.frame_id = "world"
        t.child_frame_id = self.turtlename
        t.transform.translation.x = msg.x
        t.transform.translation.y = msg.y
        x, y, z, w = quaternion_from_euler(0, 0, msg.theta)
        t.transform.rotation.x, t.transform.rotation.y = x, y
        t.transform.rotation.z, t.transform.rotation.w = z, w
        self.tf_broadcaster.sendTransform(t)


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(FramePublisher())
