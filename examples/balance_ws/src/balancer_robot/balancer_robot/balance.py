"""Keeps the robot up: /imu and /joint_states in, torques out, a hundred times a second.

Where to go is said on /cmd_vel. A balancer drives by leaning, so it first rolls back a little.
"""

import rclpy
from geometry_msgs.msg import Twist
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Imu, JointState
from std_msgs.msg import Float64MultiArray

from balancer_robot.control_law import Balancer, between, lean_of

WHEELS = ("left_wheel_joint", "right_wheel_joint")


class Balance(Node):
    """Hands messages to the control law."""

    def __init__(self):
        super().__init__("balance")
        names = ("wheel_radius", "wheel_separation", "torque_limit")
        defaults = (0.15, 0.44, 4.0)
        self.law = Balancer(*map(self.number, names, defaults))
        self.top_speed = self.number("top_speed", 0.8)
        self.top_turn_rate = self.number("top_turn_rate", 2.0)
        self.angles = self.rates = None
        self.last = None
        self.commands = self.create_publisher(Float64MultiArray, "wheel_controller/commands", 1)
        self.create_subscription(JointState, "joint_states", self.on_joints, 1)
        self.create_subscription(Twist, "cmd_vel", self.on_twist, 1)
        self.create_subscription(Imu, "imu", self.on_imu, qos_profile_sensor_data)
        self.get_logger().info("balancing; say where to go on /cmd_vel")

    def number(self, name, default):
        return self.declare_parameter(name, default).value

    def on_joints(self, joints):
        places = [joints.name.index(wheel) for wheel in WHEELS if wheel in joints.name]
        if len(places) == len(WHEELS):
            self.angles = [joints.position[place] for place in places]
            self.rates = [joints.velocity[place] for place in places]

    def on_twist(self, twist):
        self.law.speed = between(-self.top_speed, twist.linear.x, self.top_speed)
        top = self.top_turn_rate
        self.law.turn_rate = between(-top, twist.angular.z, top)

    def on_imu(self, imu):
        now = imu.header.stamp.sec + imu.header.stamp.nanosec * 1e-9
        period = 0.0 if self.last is None else now - self.last
        self.last = now
        if self.angles is None:
            return
        if period < 0.0:
            # The world was reset.
            self.law.forget()
            period = 0.0
        torques = self.law.torques(
            lean_of(imu.orientation), imu.angular_velocity.y, self.angles, self.rates, period
        )
        self.commands.publish(Float64MultiArray(data=list(torques)))


def main(args=None):
    rclpy.init(args=args)
    node = Balance()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == "__main__":
    main()
