"""Pushes the robot: once, or again and again with ``-p every:=8.0``, in turns from both sides."""

import rclpy
from gazebo_msgs.srv import ApplyLinkWrench
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.parameter import Parameter


class Push(Node):
    def __init__(self):
        # The robot's time: nothing is pushed while that stands still.
        sim_time = Parameter("use_sim_time", Parameter.Type.BOOL, True)
        super().__init__("push", parameter_overrides=[sim_time])
        self.link = self.declare_parameter("link", "balancer::base_footprint").value
        self.force = self.declare_parameter("force", 40.0).value  # N
        self.seconds = self.declare_parameter("seconds", 0.2).value
        self.every = self.declare_parameter("every", 0.0).value
        self.client = self.create_client(ApplyLinkWrench, "apply_link_wrench")
        self.sent = None

    def run(self):
        self.client.wait_for_service()
        if self.every > 0.0:
            self.create_timer(self.every, self.push)
            rclpy.spin(self)
            return
        self.push()
        rclpy.spin_until_future_complete(self, self.sent)
        answer = self.sent.result()
        if not answer.success:
            self.get_logger().error(answer.status_message)

    def push(self):
        request = ApplyLinkWrench.Request(link_name=self.link)
        request.wrench.force.x = self.force
        request.duration.sec = int(self.seconds)
        request.duration.nanosec = round(self.seconds % 1 * 1e9)
        self.get_logger().info(f"{self.force:g} N for {self.seconds:g} s at {self.link}")
        self.sent = self.client.call_async(request)
        self.force = -self.force


def main(args=None):
    rclpy.init(args=args)
    node = Push()
    try:
        node.run()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
