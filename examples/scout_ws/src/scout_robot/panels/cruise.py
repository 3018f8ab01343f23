"""A panel of the page: drives the scout and stops it before obstacles."""

import math

from gazelle.studio.plugins import Button, Label, Panel, Plot, Row, Slider

AHEAD_RAD = math.radians(20)


class Cruise(Panel):
    title = "Scout Cruise"
    group = "Robot Tools"
    about = "Drives ahead and stops before obstacles"
    widgets = (
        Slider("speed", min=0.0, max=0.5, value=0.2, unit="m/s"),
        Slider("turn", min=-2.0, max=2.0, value=0.0, unit="rad/s"),
        Slider("gap", text="Stop before", min=0.2, max=2.0, value=0.5, unit="m"),
        Row(Button("go"), Button("stop", enabled=False)),
        Label("free", text="Free way ahead", unit="m"),
        Plot("speeds", curves=("wanted", "driven"), unit="m/s"),
    )

    def start(self, node):
        self.node = node
        self.driving = False
        self.wanted = 0.0
        node.advertise("cmd_vel", "geometry_msgs/Twist")
        node.subscribe("scan", "sensor_msgs/LaserScan", self.on_scan)
        node.subscribe("odom", "nav_msgs/Odometry", self.on_odometry)
        self.every(0.1, self.drive)

    def stop(self):
        self.on_stop()

    def on_go(self):
        self.set_driving(True)

    def on_stop(self):
        self.set_driving(False)
        self.send_twist(0.0, 0.0)

    def on_scan(self, scan):
        ranges = [
            distance
            for ray, distance in enumerate(scan.ranges)
            if abs(scan.angle_min + ray * scan.angle_increment) < AHEAD_RAD
            and scan.range_min <= distance <= scan.range_max
        ]
        free = min(ranges, default=math.inf)
        self["free"] = round(free, 2)
        if self.driving and free < self["gap"]:
            self.on_stop()

    def on_odometry(self, odometry):
        self.add("speeds", self.wanted, odometry.twist.twist.linear.x)

    def drive(self):
        if self.driving:
            self.send_twist(self["speed"], self["turn"])

    def set_driving(self, driving):
        self.driving = driving
        self.change("go", enabled=not driving)
        self.change("stop", enabled=driving)

    def send_twist(self, speed, turn):
        self.wanted = speed
        twist = self.node.message("geometry_msgs/Twist", linear={"x": speed}, angular={"z": turn})
        self.node.publish("cmd_vel", twist)
