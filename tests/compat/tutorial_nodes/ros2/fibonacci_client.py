"""Sends a goal and tells of feedback and result, as the rclpy tutorial does."""

import rclpy
from action_tutorials_interfaces.action import Fibonacci
from rclpy.action import ActionClient
from rclpy.node import Node


class FibonacciActionClient(Node):
    def __init__(self):
        super().__init__("fibonacci_action_client")
        self._client = ActionClient(self, Fibonacci, "fibonacci")

    def send_goal(self, order):
        goal = Fibonacci.Goal()
        goal.order = order
        self._client.wait_for_server()
        future = self._client.send_goal_async(goal, feedback_callback=self.feedback_callback)
        future.add_done_callback(self.goal_response_callback)

    def goal_response_callback(self, future):
        goal_handle = future.result()
        if not goal_handle.accepted:
            self.get_logger().info("Goal rejected :(")
            return
        self.get_logger().info("Goal accepted :)")
        goal_handle.get_result_async().add_done_callback(self.get_result_callback)

    def get_result_callback(self, future):
        result = future.result().result
        self.get_logger().info(f"Result: {[int(one) for one in result.sequence]}")
        rclpy.shutdown()

    def feedback_callback(self, message):
        count = len(message.feedback.partial_sequence)
        self.get_logger().info(f"Received feedback of {count} numbers")


if __name__ == "__main__":
    rclpy.init()
    client = FibonacciActionClient()
    client.send_goal(8)
    rclpy.spin(client)
