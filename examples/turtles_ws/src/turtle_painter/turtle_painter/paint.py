"""Has turtles draw flowers: each drives a circle, turns a little on the spot, and again.

turtle1 stays free, for whoever wants to steer one.
"""

import math

import rclpy
from geometry_msgs.msg import Twist
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from turtlesim.msg import Pose
from turtlesim.srv import SetPen, Spawn

# Name, x and y of the middle, radius of the petals and colour.
PAINTERS = (
    ("poppy", 2.9, 7.6, 0.9, (240, 90, 80)),
    ("cornflower", 8.2, 7.6, 0.9, (110, 160, 250)),
    ("buttercup", 5.5, 2.9, 1.1, (250, 210, 80)),
)
PETALS = 8
TURN_RATE = 2.0  # rad/s
PERIOD_S = 0.05


class Painter:
    """One turtle: how far it has turned says whether a petal is done."""

    def __init__(self, node, name, x, y, radius, colour):
        self.place = Spawn.Request(x=x, y=y, theta=0.0, name=name)
        self.colour = colour
        self.radius = radius
        self.petals = 0
        self.is_turning = False
        self.turned = 0.0
        self.theta = None
        self.pen = node.create_client(SetPen, f"/{name}/set_pen")
        self.commands = node.create_publisher(Twist, f"/{name}/cmd_vel", 1)
        node.create_subscription(Pose, f"/{name}/pose", self.on_pose, 10)

    def take_pen(self):
        red, green, blue = self.colour
        return self.pen.call_async(SetPen.Request(r=red, g=green, b=blue, width=3))

    def on_pose(self, pose):
        if self.theta is not None:
            self.turned += math.remainder(pose.theta - self.theta, 2 * math.pi)
        self.theta = pose.theta

    def step(self):
        whole = 2 * math.pi / PETALS if self.is_turning else 2 * math.pi
        if self.turned >= whole:
            # What it turned too far counts for what comes next, or the flower would go round.
            self.turned -= whole
            self.petals += self.is_turning
            self.is_turning = not self.is_turning
        twist = Twist()
        if self.petals < PETALS:
            twist.angular.z = TURN_RATE
            twist.linear.x = 0.0 if self.is_turning else TURN_RATE * self.radius
        self.commands.publish(twist)


class Paint(Node):
    def __init__(self):
        super().__init__("paint")
        self.spawn = self.create_client(Spawn, "/spawn")
        self.painters = [Painter(self, *row) for row in PAINTERS]

    def run(self):
        self.spawn.wait_for_service()
        for painter in self.painters:
            rclpy.spin_until_future_complete(self, self.spawn.call_async(painter.place))
            painter.pen.wait_for_service()
            rclpy.spin_until_future_complete(self, painter.take_pen())
        self.get_logger().info("painting")
        self.create_timer(PERIOD_S, self.step)
        rclpy.spin(self)

    def step(self):
        for painter in self.painters:
            painter.step()


def main(args=None):
    rclpy.init(args=args)
    node = Paint()
    try:
        node.run()
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
