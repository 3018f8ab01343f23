"""Adds what it is sent."""

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node


class MinimalService(Node):
    def __init__(self):
        super().__init__("minimal_service")
        self.srv = self.create_service(AddTwoInts, "add_two_ints", self.add)

    def add(self, request, response):
        response.sum = request.a + request.b
        self.get_logger().info(f"Incoming request a: {request.a} b: {request.b}")
        return response


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(MinimalService())
