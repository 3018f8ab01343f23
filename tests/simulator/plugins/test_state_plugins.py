"""joint_state_publisher, p3d and the IMUs."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gazelle.geometry import Pose
from gazelle.interfaces import service_type
from gazelle.interfaces.poses import twist_message
from gazelle.simulator import Simulation

Load = Callable[..., Simulation]
Cart = Callable[..., str]
Listen = Callable[[Simulation, str], list[Any]]


def plugin(filename: str, keys: str) -> str:
    return f'<gazebo><plugin name="p" filename="{filename}">{keys}</plugin></gazebo>'


def test_joint_states_list_the_joints_named(load: Load, cart_urdf: Cart, listen: Listen) -> None:
    keys = "<robotNamespace>r</robotNamespace><jointName>right_joint, left_joint</jointName>"
    keys += "<updateRate>20</updateRate>"
    sim = load(cart_urdf(extra=plugin("libgazebo_ros_joint_state_publisher.so", keys)))
    states = listen(sim, "/r/joint_states")
    sim.publish("/cmd_vel", twist_message((0.3, 0.0, 0.0), (0.0, 0.0, 0.0)))
    sim.run(seconds=1.0)
    assert len(states) == 20
    assert states[-1].name == ["right_joint", "left_joint"]
    assert states[-1].velocity == pytest.approx([3.0, 3.0], rel=0.02)
    assert len(states[-1].effort) == 0


def test_joint_states_without_names_list_all_moving_joints(
    load: Load, cart_urdf: Cart, listen: Listen
) -> None:
    keys = "<robotNamespace>all</robotNamespace>"
    sim = load(cart_urdf(extra=plugin("libgazebo_ros_joint_state_publisher.so", keys)))
    states = listen(sim, "/all/joint_states")
    sim.run(seconds=0.1)
    assert states[-1].name == ["left_joint", "right_joint"]


def test_the_gz_joint_state_system_publishes_every_step(
    load: Load, cart_urdf: Cart, listen: Listen
) -> None:
    sim = load(cart_urdf(extra=plugin("gz-sim-joint-state-publisher-system", "")), world=None)
    states = listen(sim, "/world/default/model/cart/joint_state")
    sim.run(seconds=0.1)
    assert len(states) == 100


def test_p3d_is_the_true_pose_of_a_link(load: Load, cart_urdf: Cart, listen: Listen) -> None:
    keys = "<bodyName>base_link</bodyName><topicName>truth</topicName><updateRate>50</updateRate>"
    keys += "<xyzOffset>0 0 1</xyzOffset>"
    sim = load(cart_urdf(extra=plugin("libgazebo_ros_p3d.so", keys)))
    truth = listen(sim, "/truth")
    sim.publish("/cmd_vel", twist_message((0.3, 0.0, 0.0), (0.0, 0.0, 0.5)))
    sim.run(seconds=1.0)
    message, pose = truth[-1], sim.link("base_link").pose
    assert len(truth) == 50
    assert message.header.frame_id == "world"
    assert message.child_frame_id == "base_link"
    position = message.pose.pose.position
    assert (position.x, position.y) == pytest.approx(pose.position_m[:2])
    assert position.z == pytest.approx(pose.position_m[2] + 1.0)
    assert message.twist.twist.angular.z == pytest.approx(0.5, rel=0.1)


def test_p3d_noise_has_the_sigma_asked_for(load: Load, cart_urdf: Cart, listen: Listen) -> None:
    keys = "<bodyName>base_link</bodyName><topicName>truth</topicName>"
    keys += "<gaussianNoise>0.1</gaussianNoise>"
    sim = load(cart_urdf(extra=plugin("libgazebo_ros_p3d.so", keys)))
    truth = listen(sim, "/truth")
    sim.run(seconds=2.0)
    values = np.array([message.twist.twist.linear.x for message in truth])
    assert len(values) == 2000
    assert abs(values.mean()) < 4 * 0.1 / math.sqrt(len(values))
    assert values.std() == pytest.approx(0.1, rel=0.08)
    assert truth[-1].pose.covariance[0] == pytest.approx(0.01)


@pytest.mark.parametrize(
    ("filename", "keys", "topic", "frame"),
    [
        (
            "libgazebo_ros_imu.so",
            "<bodyName>base_link</bodyName><topicName>imu</topicName><updateRate>100</updateRate>"
            "<serviceName>calibrate</serviceName>",
            "/imu",
            "base_link",
        ),
        (
            "libhector_gazebo_ros_imu.so",
            "<bodyName>base_link</bodyName><topicName>raw</topicName><updateRate>100</updateRate>"
            "<frameId>imu_frame</frameId>",
            "/raw",
            "imu_frame",
        ),
    ],
)
def test_a_model_imu_reads_plus_g_at_rest(
    load: Load, cart_urdf: Cart, listen: Listen, filename: str, keys: str, topic: str, frame: str
) -> None:
    sim = load(cart_urdf(extra=plugin(filename, keys)))
    readings = listen(sim, topic)
    sim.run(seconds=1.0)
    reading = readings[-1]
    assert len(readings) == 100
    assert reading.header.frame_id == frame
    assert reading.linear_acceleration.z == pytest.approx(9.8, abs=0.02)
    assert abs(reading.linear_acceleration.x) < 0.02
    assert reading.orientation.w == pytest.approx(1.0, abs=1e-3)


def test_an_imus_calibration_service_answers(load: Load, cart_urdf: Cart) -> None:
    keys = "<bodyName>base_link</bodyName><serviceName>calibrate</serviceName>"
    sim = load(cart_urdf(extra=plugin("libgazebo_ros_imu.so", keys)))
    empty = service_type("std_srvs/Empty")
    assert sim.server.node.call("/calibrate", empty.Request()) == empty.Response()  # type: ignore[attr-defined]


IMU_SENSOR = """<gazebo reference="base_link"><sensor name="imu" type="imu">
  <update_rate>50</update_rate>
  <plugin name="imu_plugin" filename="libgazebo_ros_imu_sensor.so">{keys}</plugin>
</sensor></gazebo>"""


def test_the_imu_sensor_plug_in_measures_turning(
    load: Load, cart_urdf: Cart, listen: Listen
) -> None:
    keys = "<topicName>imu</topicName><frameName>imu_link</frameName>"
    keys += "<updateRateHZ>20</updateRateHZ>"
    sim = load(cart_urdf(extra=IMU_SENSOR.format(keys=keys)))
    readings = listen(sim, "/imu")
    sim.publish("/cmd_vel", twist_message((0.0, 0.0, 0.0), (0.0, 0.0, 0.6)))
    sim.run(seconds=1.0)
    assert len(readings) == 20
    assert readings[-1].header.frame_id == "imu_link"
    assert readings[-1].angular_velocity.z == pytest.approx(0.6, rel=0.05)


def test_the_ros_2_imu_is_remapped_and_keeps_the_sensors_rate(
    load: Load, cart_urdf: Cart, listen: Listen
) -> None:
    keys = "<ros><namespace>/demo</namespace><remapping>~/out:=imu</remapping></ros>"
    keys += "<initial_orientation_as_reference>true</initial_orientation_as_reference>"
    sim = load(cart_urdf(extra=IMU_SENSOR.format(keys=keys)))
    sim.model("cart").pose = Pose.from_xyz_rpy((0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
    readings = listen(sim, "/demo/imu")
    sim.run(seconds=1.0)
    assert len(readings) == 50
    assert readings[-1].header.frame_id == "base_link"
    assert readings[-1].orientation.z == pytest.approx(0.0, abs=1e-3)


@pytest.mark.parametrize(
    ("filename", "orientation"),
    [("libgazebo_ros_imu.so", 0.04), ("libhector_gazebo_ros_imu.so", 0.0)],
)
def test_an_imus_covariances_are_its_noise_squared(
    load: Load, cart_urdf: Cart, listen: Listen, filename: str, orientation: float
) -> None:
    keys = "<bodyName>base_link</bodyName><topicName>imu</topicName>"
    keys += "<gaussianNoise>0.2</gaussianNoise>"
    sim = load(cart_urdf(extra=plugin(filename, keys)))
    readings = listen(sim, "/imu")
    sim.run(seconds=1.0)
    for name in ("linear_acceleration", "angular_velocity"):
        values = np.array([getattr(item, name).x for item in readings])
        assert values.std() == pytest.approx(0.2, rel=0.1)
        covariance = getattr(readings[0], f"{name}_covariance")
        assert np.reshape(covariance, (3, 3)) == pytest.approx(0.04 * np.eye(3))
    assert readings[0].orientation_covariance[0] == pytest.approx(orientation)


def test_hectors_biases_shift_readings_and_tilt_the_orientation(
    load: Load, cart_urdf: Cart, listen: Listen
) -> None:
    keys = "<bodyName>base_link</bodyName><topicName>imu</topicName>"
    keys += "<accelOffset>0.98 0 0</accelOffset><rateOffset>0 0 0.1</rateOffset>"
    keys += "<yawOffset>0.3</yawOffset><accelScaleError>1 1 1.01</accelScaleError>"
    sim = load(cart_urdf(extra=plugin("libhector_gazebo_ros_imu.so", keys)))
    readings = listen(sim, "/imu")
    sim.run(seconds=1.0)
    reading = readings[-1]
    assert reading.linear_acceleration.x == pytest.approx(0.98, abs=0.02)
    assert reading.linear_acceleration.z == pytest.approx(9.8 * 1.01, abs=0.02)
    assert reading.angular_velocity.z == pytest.approx(0.1, abs=1e-3)
    # A filter that takes 0.1 g ahead for gravity believes that the nose points up.
    q = reading.orientation
    roll, pitch, yaw = Pose(quat_xyzw=(q.x, q.y, q.z, q.w)).rpy_rad
    assert (roll, pitch, yaw) == pytest.approx((0.0, -0.1, 0.3), abs=2e-3)


def test_hectors_calibration_takes_the_rates_drift_away(
    load: Load, cart_urdf: Cart, listen: Listen
) -> None:
    keys = "<bodyName>base_link</bodyName><rateDrift>0.5 0.5 0.5</rateDrift>"
    sim = load(cart_urdf(extra=plugin("libhector_gazebo_ros_imu.so", keys)))
    readings = listen(sim, "/imu")
    sim.run(seconds=0.5)
    assert abs(readings[-1].angular_velocity.z) > 0.01
    empty = service_type("std_srvs/Empty")
    sim.server.node.call("/imu/calibrate", empty.Request())  # type: ignore[attr-defined]
    sim.run(seconds=0.05)
    assert abs(readings[-1].angular_velocity.z) < 0.005
