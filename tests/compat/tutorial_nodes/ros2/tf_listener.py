"""Steers turtle2 to a frame by the transform to it, as the tf2 tutorial does."""

import math

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.time import Time
from tf2_ros import TransformException
from tf2_ros.buffer import Buffer
from tf2_ros.transform_listener import TransformListener


class FrameListener(Node):
    def __init__(self):
        super().__init__("turtle_tf2_frame_listener")
        self.target_frame = (
            self.declare_parameter("target_frame", "turtle1").get_parameter_value().string_value
        )
        self.tf_buffer = Buffer()
        self.tf_listener = TransformListener(self.tf_buffer, self)
        self.publisher = self.create_publisher(Twist, "turtle2/cmd_vel", 1)
        self.create_timer(0.1, self.on_timer)

    def on_timer(self):
        try:
            t = self.tf_buffer.lookup_transform("turtle2", self.target_frame, Time())
        except TransformException as error:
            self.get_logger().info(f"Could not transform {self.target_frame} to turtle2: {error}")
            return
        move = t.transform.translation
        msg = Twist()
        msg.angular.z = 1.0 * math.atan2(move.y, move.x)
        msg.linear.x = 0.5 * math.sqrt(move.x**2 + move.y**2)
        self.publisher.publish(msg)


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(FrameListener())
