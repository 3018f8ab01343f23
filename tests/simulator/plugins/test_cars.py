"""Plug-ins that steer: Ackermann cars of ROS 2 and gz-sim, and the tricycle."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gazelle.interfaces import message_type
from gazelle.interfaces.poses import twist_message
from gazelle.simulator import Simulation
from gazelle.simulator.plugins.gazebo_pid import GazeboPid

Load = Callable[..., Simulation]
Listen = Callable[[Simulation, str], list[Any]]

BASE_M, TRACK_M, RADIUS_M = 0.6, 0.4, 0.1

_INERTIAL = """<inertial><mass value="{mass}"/>
  <inertia ixx="{i}" ixy="0" ixz="0" iyy="{i}" iyz="0" izz="{i}"/></inertial>"""
_TYRE = '<collision><geometry><sphere radius="0.1"/></geometry></collision>'


def _link(name: str, mass: float, inertia: float, shape: str = "") -> str:
    return f'<link name="{name}">{_INERTIAL.format(mass=mass, i=inertia)}{shape}</link>'


def _joint(name: str, parent: str, child: str, xyz: str, axis: str, limit: float = 0.0) -> str:
    kind = "revolute" if limit else "continuous"
    bounds = f'<limit lower="-{limit}" upper="{limit}" effort="500" velocity="20"/>'
    return f"""<joint name="{name}" type="{kind}"><origin xyz="{xyz}"/><parent link="{parent}"/>
      <child link="{child}"/><axis xyz="{axis}"/>{bounds if limit else ""}</joint>"""


def car(library: str, keys: str) -> str:
    """Four wheels, the front ones on knuckles above their middle."""
    parts = [_link("base_link", 20.0, 1.0)]
    for side, y in (("left", TRACK_M / 2), ("right", -TRACK_M / 2)):
        parts += [
            _link(f"{side}_knuckle", 0.5, 1e-3),
            _joint(f"{side}_steering_joint", "base_link", f"{side}_knuckle",
                   f"{BASE_M} {y} {RADIUS_M}", "0 0 1", limit=0.8),
        ]  # fmt: skip
        for end in ("front", "rear"):
            wheel = f"{end}_{side}_wheel"
            front = end == "front"
            place = "0 0 0" if front else f"0 {y} {RADIUS_M}"
            parent = f"{side}_knuckle" if front else "base_link"
            parts += [
                _link(wheel, 0.5, 2e-3, _TYRE),
                _joint(f"{end}_{side}_joint", parent, wheel, place, "0 1 0"),
            ]
    plugin = f'<gazebo><plugin name="car" filename="{library}">{keys}</plugin></gazebo>'
    return f'<robot name="car">{"".join(parts)}{plugin}</robot>'


def driven_circle(sim: Simulation, model: str = "car", seconds: float = 3.0) -> tuple[float, float]:
    """Return speed and turn rate of the middle of the rear axle."""
    before = sim.model(model).pose
    length = 0.0
    last, turned, steps = before, 0.0, 60
    for _ in range(steps):
        sim.run(seconds=seconds / steps)
        now = sim.model(model).pose
        length += math.dist(now.position_m[:2], last.position_m[:2])
        turned += math.remainder(now.rpy_rad[2] - last.rpy_rad[2], 2 * math.pi)
        last = now
    return length / seconds, turned / seconds


ACKERMANN = """<ros><namespace>/</namespace></ros>
  <right_steering_pid_gain>100 0 1</right_steering_pid_gain>
  <left_steering_pid_gain>100 0 1</left_steering_pid_gain>
  <linear_velocity_pid_gain>1 0 0</linear_velocity_pid_gain>
  <update_rate>500</update_rate><publish_odom>true</publish_odom>
  <publish_odom_tf>true</publish_odom_tf><publish_wheel_tf>true</publish_wheel_tf>
  <publish_distance>true</publish_distance><publish_steerangle>true</publish_steerangle>"""


def test_ackermann_car_turns_about_wheelbase_over_tan_of_the_steering_angle(
    load: Load, listen: Listen
) -> None:
    sim = load(car("libgazebo_ros_ackermann_drive.so", ACKERMANN))
    topics = {name: listen(sim, name) for name in ("/odom", "/distance", "/steerangle", "/tf")}
    sim.publish("/cmd_vel", twist_message((0.8, 0.0, 0.0), (0.0, 0.0, 0.4)))
    sim.run(seconds=2.0)
    speed, rate = driven_circle(sim)
    assert speed / rate == pytest.approx(BASE_M / math.tan(0.4), rel=0.03)
    left, right = (sim.joint(f"{side}_steering_joint").position for side in ("left", "right"))
    radius = BASE_M / math.tan(0.4)
    assert left == pytest.approx(math.atan(BASE_M / (radius - TRACK_M / 2)), rel=0.02)
    assert right == pytest.approx(math.atan(BASE_M / (radius + TRACK_M / 2)), rel=0.02)
    odometry = topics["/odom"][-1]
    assert odometry.twist.twist.linear.x == pytest.approx(speed, rel=0.02)
    assert odometry.pose.pose.position.x == pytest.approx(sim.model("car").pose.position_m[0])
    assert topics["/steerangle"][-1].data == pytest.approx((left + right) / 2, rel=1e-3)
    assert topics["/distance"][-1].data > 3.0 * speed
    frames = {(t.header.frame_id, t.child_frame_id) for m in topics["/tf"] for t in m.transforms}
    assert ("base_footprint", "front_left_wheel") in frames
    assert ("odom", "base_footprint") in frames


def test_ackermann_steers_the_other_way_when_driving_back_and_limits_both(load: Load) -> None:
    keys = ACKERMANN + "<max_speed>0.5</max_speed><max_steer>0.2</max_steer>"
    sim = load(car("libgazebo_ros_ackermann_drive.so", keys))
    sim.publish("/cmd_vel", twist_message((-3.0, 0.0, 0.0), (0.0, 0.0, 0.9)))
    sim.run(seconds=2.0)
    assert sim.joint("left_steering_joint").position == pytest.approx(-0.2, abs=0.02)
    assert sim.joint("rear_right_joint").velocity == pytest.approx(-5.0, rel=0.1)


def test_gazebos_pid_is_negative_feedback_with_bounded_integral_and_command() -> None:
    pid = GazeboPid(2.0, 10.0, 0.1, i_max=0.5, i_min=-0.5, cmd_max=3.0, cmd_min=-3.0)
    assert pid.update(0.1, 0.01) == pytest.approx(-(2.0 * 0.1 + 10 * 0.01 * 0.1 + 0.1 * 0.1 / 0.01))
    assert pid.update(0.1, 0.01) == pytest.approx(-(0.2 + 0.02))
    for _ in range(100):
        last = pid.update(0.1, 0.01)
    assert last == pytest.approx(-(0.2 + 0.5))
    assert pid.update(50.0, 0.01) == -3.0
    pid.reset()
    assert pid.update(0.0, 0.01) == 0.0
    assert GazeboPid(1.0, 1.0, 0.0).update(-7.0, 1.0) == pytest.approx(14.0)


GZ_CAR = f"""<left_joint>rear_left_joint</left_joint><right_joint>rear_right_joint</right_joint>
  <left_steering_joint>left_steering_joint</left_steering_joint>
  <right_steering_joint>right_steering_joint</right_steering_joint>
  <wheel_separation>{TRACK_M}</wheel_separation><kingpin_width>{TRACK_M}</kingpin_width>
  <wheel_base>{BASE_M}</wheel_base><wheel_radius>{RADIUS_M}</wheel_radius>
  <steer_p_gain>10</steer_p_gain>"""


def test_gz_car_turns_about_speed_over_turn_rate(load: Load, listen: Listen) -> None:
    sim = load(car("gz-sim-ackermann-steering-system", GZ_CAR))
    odometry = listen(sim, "/model/car/odometry")
    sim.publish("/model/car/cmd_vel", twist_message((0.6, 0.0, 0.0), (0.0, 0.0, 0.3)))
    sim.run(seconds=2.0)
    speed, rate = driven_circle(sim)
    assert (speed, rate) == (pytest.approx(0.6, rel=0.02), pytest.approx(0.3, rel=0.03))
    assert odometry[-1].header.frame_id == "car/odom"
    assert odometry[-1].twist.twist.angular.z == pytest.approx(0.3, rel=0.02)
    assert odometry[-1].twist.twist.linear.x == pytest.approx(0.6, rel=0.02)


def test_gz_car_never_turns_tighter_than_its_steering_limit(load: Load) -> None:
    sim = load(car("gz-sim-ackermann-steering-system", GZ_CAR))
    sim.publish("/model/car/cmd_vel", twist_message((0.3, 0.0, 0.0), (0.0, 0.0, 2.0)))
    sim.run(seconds=2.0)
    speed, rate = driven_circle(sim)
    assert speed / rate == pytest.approx(BASE_M / math.sin(0.5), rel=0.03)


def test_gz_car_that_only_steers_takes_an_angle(load: Load) -> None:
    keys = GZ_CAR + "<steering_only>true</steering_only><steering_limit>0.4</steering_limit>"
    sim = load(car("gz-sim-ackermann-steering-system", keys))
    sim.publish("/model/car/steer_angle", message_type("std_msgs/Float64")(data=0.9))
    sim.run(seconds=2.0)
    radius = BASE_M / math.tan(0.4)
    left = sim.joint("left_steering_joint").position
    assert left == pytest.approx(math.atan(BASE_M / (radius - TRACK_M / 2)), rel=0.01)


def tricycle(keys: str) -> str:
    parts = [
        _link("base_link", 20.0, 1.0),
        _link("fork", 0.5, 1e-3),
        _link("front_wheel", 0.5, 2e-3, _TYRE),
        _joint("front_steering_joint", "base_link", "fork", f"{BASE_M} 0 {RADIUS_M}", "0 0 1", 1.6),
        _joint("front_wheel_joint", "fork", "front_wheel", "0 0 0", "0 1 0"),
    ]
    for side, y in (("left", TRACK_M / 2), ("right", -TRACK_M / 2)):
        parts += [
            _link(f"{side}_wheel", 0.5, 2e-3, _TYRE),
            _joint(f"{side}_wheel_joint", "base_link", f"{side}_wheel", f"0 {y} {RADIUS_M}",
                   "0 1 0"),
        ]  # fmt: skip
    plugin = f"""<gazebo><plugin name="drive" filename="libgazebo_ros_tricycle_drive.so">
      <actuatedWheelDiameter>0.2</actuatedWheelDiameter>
      <encoderWheelDiameter>0.2</encoderWheelDiameter>
      <encoderWheelSeparation>{TRACK_M}</encoderWheelSeparation>
      <wheelTorque>20</wheelTorque>{keys}</plugin></gazebo>"""
    return f'<robot name="car">{"".join(parts)}{plugin}</robot>'


@pytest.mark.parametrize("keys", ["", "<steeringSpeed>2.0</steeringSpeed>"])
def test_tricycle_turns_about_wheelbase_over_tan_of_the_steering_angle(
    load: Load, listen: Listen, keys: str
) -> None:
    states = "<publishWheelJointState>true</publishWheelJointState>"
    sim = load(tricycle(keys + states + "<publishWheelTF>true</publishWheelTF>"))
    odometry, joints, tf = (listen(sim, name) for name in ("/odom", "/joint_states", "/tf"))
    angle = 0.5
    sim.publish("/cmd_vel", twist_message((0.5, 0.0, 0.0), (0.0, 0.0, angle)))
    sim.run(seconds=2.0)
    assert sim.joint("front_steering_joint").position == pytest.approx(angle, abs=0.012)
    speed, rate = driven_circle(sim)
    assert speed == pytest.approx(0.5 * math.cos(angle), rel=0.02)
    assert speed / rate == pytest.approx(BASE_M / math.tan(angle), rel=0.04)
    assert odometry[-1].child_frame_id == "base_link"
    assert odometry[-1].pose.pose.position.x == pytest.approx(sim.model("car").pose.position_m[0])
    assert joints[-1].name[0] == "front_steering_joint"
    assert joints[-1].velocity[1] == pytest.approx(5.0, rel=0.02)
    frames = {(t.header.frame_id, t.child_frame_id) for t in tf[-2].transforms + tf[-1].transforms}
    assert ("base_link", "front_steering_joint") in frames


def test_tricycle_ramps_its_wheel_within_the_acceleration(load: Load) -> None:
    sim = load(tricycle("<wheelAcceleration>4</wheelAcceleration>"))
    sim.publish("/cmd_vel", twist_message((0.5, 0.0, 0.0), (0.0, 0.0, 0.0)))
    sim.run(seconds=0.5)
    assert sim.joint("front_wheel_joint").velocity == pytest.approx(4 * 0.5, rel=0.05)


def test_tricycle_measures_with_left_minus_right(load: Load, listen: Listen) -> None:
    """As the originals: the yaw of the encoders has the other sign."""
    sim = load(tricycle("<odometrySource>encoder</odometrySource>"))
    odometry = listen(sim, "/odom")
    sim.publish("/cmd_vel", twist_message((0.5, 0.0, 0.0), (0.0, 0.0, 0.3)))
    sim.run(seconds=2.0)
    orientation = odometry[-1].pose.pose.orientation
    measured = 2 * math.atan2(orientation.z, orientation.w)
    assert measured == pytest.approx(-sim.model("car").pose.rpy_rad[2], rel=0.05)
    assert np.asarray(odometry[-1].twist.covariance).tolist() == [0.0] * 36
