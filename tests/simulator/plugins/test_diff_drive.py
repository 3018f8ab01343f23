from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gazelle.interfaces import message_type
from gazelle.interfaces.poses import twist_message
from gazelle.simulator import Simulation

Load = Callable[..., Simulation]
Cart = Callable[..., str]
Listen = Callable[[Simulation, str], list[Any]]


def command(sim: Simulation, forward: float, turn: float) -> None:
    sim.publish("/cmd_vel", twist_message((forward, 0.0, 0.0), (0.0, 0.0, turn)))


def planar(message: Any) -> tuple[float, float]:
    return message.pose.pose.position.x, message.pose.pose.position.y


def yaw(orientation: Any) -> float:
    return 2 * math.atan2(orientation.z, orientation.w)


def test_wheel_odometry_after_5_m_is_within_2_per_cent_of_truth_and_command(
    load: Load, cart_urdf: Cart, drive_keys: str, listen: Listen
) -> None:
    sim = load(cart_urdf(drive_keys + "<odometrySource>encoder</odometrySource>"))
    odometry = listen(sim, "/odom")
    command(sim, 0.5, 0.0)
    sim.run(seconds=10.0)
    true = sim.model("cart").pose.position_m
    assert np.hypot(true[0], true[1]) == pytest.approx(5.0, rel=0.02)
    assert math.hypot(*planar(odometry[-1])) == pytest.approx(math.hypot(*true[:2]), rel=0.02)
    assert math.hypot(*planar(odometry[-1])) == pytest.approx(5.0, rel=0.02)


def test_wheel_odometry_after_a_full_turn_is_within_2_per_cent_of_truth_and_command(
    load: Load, cart_urdf: Cart, drive_keys: str, listen: Listen
) -> None:
    sim = load(cart_urdf(drive_keys + "<odometrySource>encoder</odometrySource>"))
    odometry = listen(sim, "/odom")
    command(sim, 0.0, 0.5)
    turned, last = 0.0, 0.0
    for _ in range(200):
        sim.run(seconds=2 * math.pi / 0.5 / 200)
        now = sim.model("cart").pose.rpy_rad[2]
        turned += math.remainder(now - last, 2 * math.pi)
        last = now
    assert turned == pytest.approx(2 * math.pi, rel=0.02)
    measured = sum(
        math.remainder(yaw(b.pose.pose.orientation) - yaw(a.pose.pose.orientation), 2 * math.pi)
        for a, b in itertools.pairwise(odometry)
    )
    assert measured == pytest.approx(turned, rel=0.02)
    assert measured == pytest.approx(2 * math.pi, rel=0.02)


def test_world_odometry_is_the_true_pose(load: Load, cart_urdf: Cart, listen: Listen) -> None:
    sim = load(cart_urdf())
    odometry, tf = listen(sim, "/odom"), listen(sim, "/tf")
    command(sim, 0.3, 0.4)
    sim.run(seconds=2.0)
    message, pose = odometry[-1], sim.model("cart").pose
    assert len(odometry) == len(tf) == 200
    assert planar(message) == pytest.approx(pose.position_m[:2], abs=1e-12)
    assert message.header.frame_id == "odom"
    assert message.child_frame_id == "base_footprint"
    covariance = np.asarray(message.pose.covariance)
    assert np.flatnonzero(covariance).tolist() == [0, 7, 14, 21, 28, 35]
    assert covariance[[0, 7, 14, 21, 28, 35]].tolist() == [1e-5, 1e-5, 1e12, 1e12, 1e12, 1e-3]
    assert message.twist.twist.linear.x == pytest.approx(0.3, rel=0.03)
    assert message.twist.twist.angular.z == pytest.approx(0.4, rel=0.05)


def test_transforms_are_odom_to_base_and_the_wheels(
    load: Load, cart_urdf: Cart, listen: Listen
) -> None:
    sim = load(cart_urdf())
    tf = listen(sim, "/tf")
    command(sim, 0.3, 0.0)
    sim.run(seconds=0.5)
    edges = [(item.header.frame_id, item.child_frame_id) for item in tf[-1].transforms]
    assert edges == [
        ("odom", "base_footprint"),
        ("base_link", "left_wheel"),
        ("base_link", "right_wheel"),
    ]
    wheel = tf[-1].transforms[1].transform
    assert wheel.translation.y == pytest.approx(0.15, abs=1e-3)


def test_wheel_joint_states_have_positions_only(
    load: Load, cart_urdf: Cart, listen: Listen
) -> None:
    sim = load(cart_urdf())
    states = listen(sim, "/joint_states")
    command(sim, 0.3, 0.0)
    sim.run(seconds=1.0)
    assert states[-1].name == ["left_joint", "right_joint"]
    assert states[-1].position == pytest.approx([3.0, 3.0], rel=0.05)
    assert len(states[-1].velocity) == len(states[-1].effort) == 0
    assert states[-1].header.frame_id == ""


def test_stamped_commands_are_taken_too(load: Load, cart_urdf: Cart) -> None:
    sim = load(cart_urdf())
    stamped = message_type("geometry_msgs/TwistStamped")()
    stamped.twist.linear.x = 0.4
    sim.publish("/cmd_vel", stamped)
    sim.run(seconds=1.0)
    assert sim.link("base_link").linear_velocity_m_s[0] == pytest.approx(0.4, rel=0.02)


def test_acceleration_is_limited(load: Load, cart_urdf: Cart, drive_keys: str) -> None:
    sim = load(cart_urdf(drive_keys + "<wheelAcceleration>0.5</wheelAcceleration>"))
    command(sim, 1.0, 0.0)
    sim.run(seconds=1.0)
    assert sim.link("base_link").linear_velocity_m_s[0] == pytest.approx(0.5, abs=0.03)


def test_torque_is_limited(load: Load, cart_urdf: Cart, drive_keys: str) -> None:
    weak = drive_keys.replace("<wheelTorque>10<", "<wheelTorque>0.2<")
    sim = load(cart_urdf(weak))
    sim.run(seconds=0.2)
    command(sim, 5.0, 0.0)
    sim.run(seconds=0.5)
    # Two wheels of 0.2 N·m on 0.1 m push 9.2 kg (and two wheels that turn, 0.15 kg each) at 4 N.
    assert sim.link("base_link").linear_velocity_m_s[0] == pytest.approx(0.5 * 4 / 9.5, rel=0.05)


def test_an_idle_robot_stays_still(load: Load, cart_urdf: Cart) -> None:
    sim = load(cart_urdf())
    sim.run(seconds=1.0)
    before = sim.model("cart").pose
    sim.run(seconds=10.0)
    after = sim.model("cart").pose
    assert np.linalg.norm(np.subtract(after.position_m, before.position_m)) < 1e-3
    assert abs(math.degrees(after.rpy_rad[2] - before.rpy_rad[2])) < 0.1


@pytest.mark.parametrize(
    ("word", "source"), [("world", "world"), ("encoder", "encoder"), ("1", "world"), ("0", "world")]
)
def test_odometry_sources_are_words_in_ros_1(
    load: Load, cart_urdf: Cart, drive_keys: str, listen: Listen, word: str, source: str
) -> None:
    sim = load(cart_urdf(drive_keys + f"<odometrySource>{word}</odometrySource>"))
    sim.model("cart").pose = sim.model("cart").pose.from_xyz_rpy((1.0, 0.0, 0.0))
    odometry = listen(sim, "/odom")
    sim.run(seconds=0.05)
    x = planar(odometry[-1])[0]
    assert x == pytest.approx(1.0 if source == "world" else 0.0, abs=0.01)


def test_an_unknown_odometry_source_means_world_and_is_reported(
    load: Load, cart_urdf: Cart, drive_keys: str
) -> None:
    sim = load(cart_urdf(drive_keys + "<odometrySource>encodr</odometrySource>"))
    (found,) = sim.diagnostics.by_code("parameter.bad-value")
    assert "<odometrySource> is 'encodr'" in found.message
    assert found.fix == "did you mean 'encoder'?"


def test_parameters_that_the_geometry_contradicts_are_reported(
    load: Load, cart_urdf: Cart, drive_keys: str
) -> None:
    wrong = drive_keys.replace(">0.3<", ">0.2<").replace(">0.2<", ">0.25<", 1)
    sim = load(cart_urdf(wrong.replace("<wheelDiameter>0.2<", "<wheelDiameter>0.15<")))
    (found,) = sim.diagnostics.by_code("plugin.wheel-geometry")
    assert "wheel separation is 0.25 m, the joints are 0.3 m apart" in found.message
    assert "wheel diameter is 0.15 m, the wheels' shapes measure 0.2 m" in found.message
    assert found.span is not None


def test_right_parameters_are_not_reported(load: Load, cart_urdf: Cart) -> None:
    found = [item.code for item in load(cart_urdf()).diagnostics]
    assert not [code for code in found if code.startswith("plugin.")]


def test_swapped_wheels_are_reported_and_driven_as_written(
    load: Load, cart_urdf: Cart, drive_keys: str
) -> None:
    swapped = drive_keys.replace("left_joint", "x").replace("right_joint", "left_joint")
    sim = load(cart_urdf(swapped.replace(">x<", ">right_joint<")))
    (found,) = sim.diagnostics.by_code("plugin.wheels-swapped")
    assert "turns the robot right: 'right_joint', named as the left joint" in found.message
    command(sim, 0.0, 0.5)
    sim.run(seconds=1.0)
    assert sim.model("cart").pose.rpy_rad[2] < -0.3


def test_legacy_mode_is_honoured_and_explained(
    load: Load, cart_urdf: Cart, drive_keys: str
) -> None:
    legacy = drive_keys.replace("<legacyMode>false", "<legacyMode>true")
    sim = load(cart_urdf(legacy))
    assert sim.diagnostics.by_code("plugin.legacy-mode")
    assert sim.diagnostics.by_code("plugin.wheels-swapped")
    command(sim, 0.0, 0.5)
    sim.run(seconds=1.0)
    assert sim.model("cart").pose.rpy_rad[2] < -0.3


def test_without_legacy_mode_the_geometry_decides(
    load: Load, cart_urdf: Cart, drive_keys: str
) -> None:
    sim = load(cart_urdf(drive_keys.replace("<legacyMode>false</legacyMode>", "")))
    assert not sim.diagnostics.by_code("plugin.wheels-swapped")
    command(sim, 0.0, 0.5)
    sim.run(seconds=1.0)
    assert sim.model("cart").pose.rpy_rad[2] > 0.3


def test_wheels_that_turn_backwards_are_reported(load: Load, cart_urdf: Cart) -> None:
    sim = load(cart_urdf(axis=-1))
    (found,) = sim.diagnostics.by_code("plugin.drives-backwards")
    assert "positive speed of 'left_joint' and 'right_joint' drives the robot backward" in (
        found.message
    )


def test_a_namespace_prefixes_topics_and_frames(
    load: Load, cart_urdf: Cart, drive_keys: str, listen: Listen
) -> None:
    sim = load(cart_urdf(drive_keys + "<robotNamespace>/robot1</robotNamespace>"))
    odometry = listen(sim, "/robot1/odom")
    sim.run(seconds=0.05)
    assert odometry[-1].header.frame_id == "robot1/odom"
    assert odometry[-1].child_frame_id == "robot1/base_footprint"


def test_ros_2_names_and_remappings_mean_the_same(
    load: Load, cart_urdf: Cart, listen: Listen
) -> None:
    drive = """<ros><namespace>/demo</namespace><remapping>cmd_vel:=drive</remapping>
      <remapping>odom:=wheel_odom</remapping></ros><update_rate>50</update_rate>
      <left_joint>left_joint</left_joint><right_joint>right_joint</right_joint>
      <wheel_separation>0.3</wheel_separation><wheel_diameter>0.2</wheel_diameter>
      <max_wheel_torque>10</max_wheel_torque><publish_odom>true</publish_odom>
      <publish_odom_tf>true</publish_odom_tf><odometry_source>0</odometry_source>
      <odometry_frame>odom</odometry_frame><robot_base_frame>base_link</robot_base_frame>"""
    sim = load(cart_urdf(drive))
    odometry = listen(sim, "/demo/wheel_odom")
    sim.publish("/demo/drive", twist_message((0.4, 0.0, 0.0), (0.0, 0.0, 0.0)))
    sim.run(seconds=1.0)
    assert len(odometry) == 50
    assert odometry[-1].child_frame_id == "base_link"
    assert planar(odometry[-1])[0] == pytest.approx(0.4, rel=0.05)
    assert not sim.diagnostics.by_code("parameter.unknown")


def test_the_gz_system_drives_and_measures(load: Load, cart_urdf: Cart, listen: Listen) -> None:
    system = """<gazebo><plugin filename="gz-sim-diff-drive-system"
        name="gz::sim::systems::DiffDrive">
      <left_joint>left_joint</left_joint><right_joint>right_joint</right_joint>
      <wheel_separation>0.3</wheel_separation><wheel_radius>0.1</wheel_radius>
      <max_linear_acceleration>0.5</max_linear_acceleration></plugin></gazebo>"""
    text = cart_urdf(extra=system)
    first = text.index('<gazebo><plugin name="drive"')
    text = text[:first] + text[text.index("</gazebo>", first) + len("</gazebo>") :]
    sim = load(text)
    odometry = listen(sim, "/model/cart/odometry")
    sim.publish("/model/cart/cmd_vel", twist_message((0.5, 0.0, 0.0), (0.0, 0.0, 0.0)))
    sim.run(seconds=3.0)
    assert len(odometry) == 150
    assert odometry[-1].header.frame_id == "cart/odom"
    # One second to 0.5 m/s, then two at that speed.
    assert planar(odometry[-1])[0] == pytest.approx(1.25, rel=0.02)
    assert sim.model("cart").pose.position_m[0] == pytest.approx(1.25, rel=0.02)
