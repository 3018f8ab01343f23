"""gz-sim's odometry_publisher and pose_publisher: the truth, as it stands and moves."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gazelle.geometry import Pose
from gazelle.simulator import Simulation

Load = Callable[..., Simulation]
Listen = Callable[[Simulation, str], list[Any]]

MODEL = """<sdf version="1.9"><world name="lab"><gravity>0 0 0</gravity>
  <model name="bot"><pose>1 2 3 0 0 1.5707963267948966</pose>
  <link name="base"><inertial><mass>5</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia>
    </inertial><sensor name="eye" type="imu"><pose>0.1 0 0.2 0 0 0</pose></sensor></link>
  <link name="mast"><pose>0 0 1 0 0 0</pose><inertial><mass>.01</mass>
    <inertia><ixx>1e-4</ixx><iyy>1e-4</iyy><izz>1e-4</izz></inertia></inertial></link>
  <joint name="turn" type="revolute"><parent>base</parent><child>mast</child>
    <axis><xyz>0 0 1</xyz></axis></joint>
  <plugin filename="{filename}" name="{name}">{keys}</plugin></model></world></sdf>"""


def odometry(keys: str = "") -> str:
    name = "gz::sim::systems::OdometryPublisher"
    return MODEL.format(filename="gz-sim-odometry-publisher-system", name=name, keys=keys)


def poses(keys: str = "") -> str:
    name = "gz::sim::systems::PosePublisher"
    return MODEL.format(filename="gz-sim-pose-publisher-system", name=name, keys=keys)


def xyz(message: Any) -> tuple[float, float, float]:
    return (message.x, message.y, message.z)


def push(sim: Simulation) -> None:
    sim.link("base").handle.set_velocity((0.0, 2.0, 0.5), (0.0, 0.0, 0.4))


def test_flat_odometry_is_the_truth_without_height(load: Load, listen: Listen) -> None:
    sim = load(odometry())
    messages = listen(sim, "/model/bot/odometry")
    push(sim)
    sim.run(seconds=0.5)
    message, pose = messages[-1], sim.model("bot").pose
    assert len(messages) == 25
    assert (message.header.frame_id, message.child_frame_id) == ("bot/odom", "bot/base_footprint")
    assert xyz(message.pose.pose.position) == pytest.approx((*pose.position_m[:2], 0.0), abs=1e-6)
    # It started with its nose along y; since then it has turned by 0.4 rad/s · 0.5 s.
    forward, left = 2 * math.cos(0.2), -2 * math.sin(0.2)
    assert xyz(message.twist.twist.linear) == pytest.approx((forward, left, 0.0), abs=5e-3)
    assert xyz(message.twist.twist.angular) == pytest.approx((0.0, 0.0, 0.4), abs=1e-3)


def test_three_dimensions_with_an_offset_and_tf(load: Load, listen: Listen) -> None:
    keys = "<dimensions>3</dimensions><odom_frame>odom</odom_frame>"
    keys += "<robot_base_frame>base</robot_base_frame><odom_topic>odom</odom_topic>"
    keys += "<tf_topic>/tf</tf_topic><xyz_offset>0.5 0 0</xyz_offset>"
    keys += "<odom_publish_frequency>10</odom_publish_frequency>"
    sim = load(odometry(keys))
    messages, moved = listen(sim, "/odom"), listen(sim, "/tf")
    push(sim)
    sim.run(seconds=0.5)
    wanted = sim.model("bot").pose @ Pose((0.5, 0.0, 0.0))
    assert len(messages) == len(moved) == 5
    assert xyz(messages[-1].pose.pose.position) == pytest.approx(wanted.position_m, abs=1e-6)
    twist = messages[-1].twist.twist
    assert twist.linear.z == pytest.approx(0.5, abs=1e-3)
    # ω × r: half a metre ahead of the axis it goes sideways by 0.2 m/s more.
    assert twist.linear.y == pytest.approx(-2 * math.sin(0.2) + 0.2, abs=5e-3)
    (transform,) = moved[-1].transforms
    assert (transform.header.frame_id, transform.child_frame_id) == ("odom", "base")
    assert xyz(transform.transform.translation) == pytest.approx(wanted.position_m, abs=1e-6)


def test_noise_is_on_the_velocities_and_in_the_covariance(load: Load, listen: Listen) -> None:
    keys = "<gaussian_noise>0.2</gaussian_noise>"
    keys += "<odom_publish_frequency>1000</odom_publish_frequency>"
    sim = load(odometry(keys))
    plain = listen(sim, "/model/bot/odometry")
    known = listen(sim, "/model/bot/odometry_with_covariance")
    sim.run(seconds=2.0)
    values = np.array([message.twist.twist.linear.x for message in plain])
    assert values.std() == pytest.approx(0.2, rel=0.08)
    assert plain[5].twist.twist.linear.x == known[5].twist.twist.linear.x
    assert known[0].twist.covariance[0] == pytest.approx(0.04)
    assert plain[0].twist.covariance[0] == 0.0


def test_one_dimension_is_refused(load: Load) -> None:
    (found,) = load(odometry("<dimensions>1</dimensions>")).diagnostics.by_code(
        "parameter.bad-value"
    )
    assert "<dimensions> is 1, not 2 or 3" in found.message


def test_links_are_published_one_by_one_relative_to_the_model(load: Load, listen: Listen) -> None:
    sim = load(poses("<update_frequency>20</update_frequency>"))
    messages = listen(sim, "/model/bot/pose")
    sim.joint("turn").handle.set_state(position=0.3)
    sim.run(seconds=0.1)
    assert [message.child_frame_id for message in messages] == ["bot/base", "bot/mast"] * 2
    assert {message.header.frame_id for message in messages} == {"bot"}
    mast = messages[-1].transform
    assert xyz(mast.translation) == pytest.approx((0, 0, 1), abs=1e-6)
    assert 2 * math.asin(mast.rotation.z) == pytest.approx(0.3, abs=1e-6)


def test_poses_come_in_one_message_and_static_ones_apart(load: Load, listen: Listen) -> None:
    keys = (
        "<use_pose_vector_msg>true</use_pose_vector_msg><static_publisher>true</static_publisher>"
    )
    keys += "<publish_model_pose>true</publish_model_pose>"
    keys += "<publish_sensor_pose>true</publish_sensor_pose><update_frequency>50</update_frequency>"
    keys += "<static_update_frequency>1</static_update_frequency>"
    sim = load(poses(keys))
    moving, fixed = listen(sim, "/model/bot/pose"), listen(sim, "/model/bot/pose_static")
    sim.run(seconds=1.0)
    assert (len(moving), len(fixed)) == (50, 1)
    assert [item.child_frame_id for item in moving[-1].transforms] == ["bot/mast"]
    found = {item.child_frame_id: item for item in fixed[-1].transforms}
    assert set(found) == {"bot", "bot/base", "bot/base/eye"}
    assert found["bot"].header.frame_id == "lab"
    assert xyz(found["bot"].transform.translation) == pytest.approx((1, 2, 3))
    assert found["bot/base/eye"].header.frame_id == "bot/base"
    assert xyz(found["bot/base/eye"].transform.translation) == pytest.approx((0.1, 0, 0.2))
