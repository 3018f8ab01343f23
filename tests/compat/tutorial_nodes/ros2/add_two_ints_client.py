"""Asks for the sum of two numbers of the command line."""

import sys

import rclpy
from example_interfaces.srv import AddTwoInts
from rclpy.node import Node


class MinimalClientAsync(Node):
    def __init__(self):
        super().__init__("minimal_client_async")
        self.cli = self.create_client(AddTwoInts, "add_two_ints")
        while not self.cli.wait_for_service(timeout_sec=1.0):
            self.get_logger().info("service not available, waiting again...")

    def send_request(self, a, b):
        return self.cli.call_async(AddTwoInts.Request(a=a, b=b))


rclpy.init()
client = MinimalClientAsync()
future = client.send_request(int(sys.argv[1]), int(sys.argv[2]))
rclpy.spin_until_future_complete(client, future)
client.get_logger().info(f"Result of add_two_ints: {future.result().sum}")
client.destroy_node()
rclpy.shutdown()
