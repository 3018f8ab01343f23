"""Steered bases of ROS 2 on the ground: the circle they drive, and what odometry says of it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import gazelle
from gazelle.geometry import Pose
from gazelle.interfaces import message_type

RADIUS, BASE, TRACK = 0.1, 0.6, 0.4
AXES = {"wheel": "0 1 0", "knuckle": "0 0 1"}


def _part(name, parent, kind, x, y):
    """A wheel, or the small block a wheel is steered with."""
    mass, size = (0.5, 0.002) if kind == "wheel" else (0.3, 0.001)
    shape = ""
    if kind == "wheel":
        geometry = f'<geometry><cylinder radius="{RADIUS}" length="0.04"/></geometry>'
        shape = f'<collision><origin rpy="{math.pi / 2} 0 0"/>{geometry}</collision>'
    inertia = f'<inertia ixx="{size}" iyy="{size}" izz="{size}" ixy="0" ixz="0" iyz="0"/>'
    joint = "continuous" if kind == "wheel" else "revolute"
    return f"""
    <link name="{name}_link"><inertial><mass value="{mass}"/>{inertia}</inertial>{shape}</link>
    <joint name="{name}" type="{joint}"><origin xyz="{x} {y} 0"/><parent link="{parent}"/>
      <child link="{name}_link"/><axis xyz="{AXES[kind]}"/>
      <limit effort="20" velocity="30" lower="-1.6" upper="1.6"/></joint>"""


def _robot(parts, driven, steered):
    interfaces = '<state_interface name="position"/><state_interface name="velocity"/>'
    rows = [(name, "velocity") for name in driven] + [(name, "position") for name in steered]
    control = "".join(
        f'<joint name="{name}"><command_interface name="{word}"/>{interfaces}</joint>'
        for name, word in rows
    )
    box = '<geometry><box size="0.8 0.3 0.06"/></geometry>'
    inertia = '<inertia ixx="0.2" iyy="0.6" izz="0.7" ixy="0" ixz="0" iyz="0"/>'
    return f"""<robot name="car"><link name="base_link"><inertial><origin xyz="{BASE / 2} 0 0"/>
      <mass value="10"/>{inertia}</inertial><visual><origin xyz="{BASE / 2} 0 0"/>{box}</visual>
      </link>{"".join(parts)}
      <ros2_control name="car" type="system"><hardware>
        <plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>{control}</ros2_control>
      <gazebo><plugin filename="gz_ros2_control-system"
        name="gz_ros2_control::GazeboSimROS2ControlPlugin"/></gazebo></robot>"""


def _rear():
    return [
        _part("rr", "base_link", "wheel", 0, -TRACK / 2),
        _part("rl", "base_link", "wheel", 0, TRACK / 2),
    ]


def _car():
    parts = _rear()
    for side, y in (("fr", -TRACK / 2), ("fl", TRACK / 2)):
        parts.append(_part(f"{side}_steer", "base_link", "knuckle", BASE, y))
        parts.append(_part(side, f"{side}_steer_link", "wheel", 0, 0))
    return _robot(parts, ("rr", "rl"), ("fr_steer", "fl_steer"))


def _tricycle(driven):
    parts = [*_rear(), _part("steer", "base_link", "knuckle", BASE, 0)]
    parts.append(_part("front", "steer_link", "wheel", 0, 0))
    return _robot(parts, driven, ("steer",))


ACKERMANN = {
    "type": "ackermann_steering_controller/AckermannSteeringController",
    "traction_joints_names": ["rr", "rl"],
    "steering_joints_names": ["fr_steer", "fl_steer"],
    "wheelbase": BASE,
    "traction_wheels_radius": RADIUS,
    "traction_track_width": TRACK,
}
STEERING = {
    "type": "tricycle_steering_controller/TricycleSteeringController",
    "traction_joints_names": ["rr", "rl"],
    "steering_joints_names": ["steer"],
    "wheelbase": BASE,
    "traction_wheels_radius": RADIUS,
    "traction_track_width": TRACK,
}
TRICYCLE = {
    "type": "tricycle_controller/TricycleController",
    "traction_joint_name": "front",
    "steering_joint_name": "steer",
    "wheelbase": BASE,
    "wheel_radius": RADIUS,
}
CASES = [
    (_car, ACKERMANN, "reference", "odometry"),
    (lambda: _tricycle(("rr", "rl")), STEERING, "reference", "odometry"),
    (lambda: _tricycle(("front",)), TRICYCLE, "cmd_vel", "odom"),
]


@pytest.mark.parametrize(("make", "parameters", "command", "odometry"), CASES)
@pytest.mark.parametrize("turn", [0.3, -0.3])
def test_steered_base_drives_its_circle_on_the_ground(make, parameters, command, odometry, turn):
    with gazelle.Simulation.load(
        make(), pose=Pose((0, 0, RADIUS)), parameters={"drive": {"ros__parameters": parameters}}
    ) as sim:
        sim.controller_manager().spawn("drive")
        heard: list[Any] = []
        sim.subscribe(f"/drive/{odometry}", heard.append)
        twist = message_type("geometry_msgs/TwistStamped")()
        twist.twist.linear.x, twist.twist.angular.z = 0.4, turn
        poses = []
        for _ in range(100):
            sim.publish(f"/drive/{command}", twist)
            sim.run(seconds=0.1)
            poses.append(sim.model("car").pose)
        x, y, yaw = np.unwrap(np.array([(*p.position_m[:2], p.rpy_rad[2]) for p in poses]), axis=0)[
            20:
        ].T
        speed = np.hypot(np.diff(x), np.diff(y)).mean() / 0.1
        assert speed == pytest.approx(0.4, rel=0.03)
        assert np.diff(yaw).mean() / 0.1 == pytest.approx(turn, rel=0.05)
        measured = heard[-1].twist.twist
        assert measured.linear.x == pytest.approx(0.4, rel=0.02)
        assert measured.angular.z == pytest.approx(turn, rel=0.02)
