"""Has turtles draw flowers: each drives circles, a petal each, and turns a little between them.

turtle1 stays free, for whoever wants to steer one.
"""

import math

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from turtlesim.srv import SetPen, Spawn

# Name, x, y of the middle, size of the petals and colour.
PAINTERS = (
    ("poppy", 3.2, 7.4, 0.8, (240, 90, 80)),
    ("cornflower", 7.9, 7.2, 0.9, (100, 150, 250)),
    ("buttercup", 5.6, 3.2, 1.0, (250, 210, 80)),
)
PETALS = 8
PERIOD_S = 0.05
PETAL_S = 4.0


class Painter:
    """One turtle: a petal is a circle that ends where it began."""

    def __init__(self, node, name, x, y, radius, colour):
        self.name = name
        self.radius = radius
        self.petal = 0
        self.elapsed = 0.0
        self.is_there = False
        self.commands = node.create_publisher(Twist, f"/{name}/cmd_vel", 1)
        self.pen = node.create_client(SetPen, f"/{name}/set_pen")
        self.colour = colour
        self.place = Spawn.Request(x=x, y=y, theta=0.0, name=name)

    def begin(self):
        red, green, blue = self.colour
        self.pen.call_async(SetPen.Request(r=red, g=green, b=blue, width=3))
        self.is_there = True

    def step(self):
        if not self.is_there:
            if self.pen.service_is_ready():
                self.begin()
            return
        twist = Twist()
        if self.petal < PETALS:
            twist.linear.x = 2 * math.pi * self.radius / PETAL_S
            twist.angular.z = 2 * math.pi / PETAL_S * (1 + 1 / PETALS)
            self.elapsed += PERIOD_S
            if self.elapsed >= PETAL_S:
                self.elapsed, self.petal = 0.0, self.petal + 1
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
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
