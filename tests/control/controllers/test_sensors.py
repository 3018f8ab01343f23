"""Controllers that publish sensors."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from tests.control.plant import MS, PlantJoint, make_controller, make_robot, run
from tests.control.recording_ports import RecordingPorts

from gazelle.control.controllers.force_torque_sensor_broadcaster import ForceTorqueSensorBroadcaster
from gazelle.control.controllers.gps_sensor_broadcaster import GpsSensorBroadcaster
from gazelle.control.controllers.imu_sensor_broadcaster import ImuSensorBroadcaster
from gazelle.control.controllers.pose_broadcaster import PoseBroadcaster
from gazelle.control.controllers.range_sensor_broadcaster import RangeSensorBroadcaster
from gazelle.control.controllers.ros1_sensor_controllers import (
    ForceTorqueSensorController,
    ImuSensorController,
)
from gazelle.control.controllers.sensor_messages import (
    IMU_INTERFACES,
    POSE_INTERFACES,
    WRENCH_INTERFACES,
)
from gazelle.control.errors import ControllerError
from gazelle.diagnostics import Diagnostics

HALF = math.sqrt(0.5)
# Turned by 90 degrees about z, spinning about x, lying still.
IMU = dict(zip(IMU_INTERFACES, (0.0, 0.0, HALF, HALF, 1.0, 2.0, 3.0, 0.1, 0.2, 9.8), strict=True))
WRENCH = dict(zip(WRENCH_INTERFACES, (1.0, 2.0, 3.0, 4.0, 5.0, 6.0), strict=True))
POSE = dict(zip(POSE_INTERFACES, (1.0, 2.0, 3.0, 0.0, 0.0, HALF, HALF), strict=True))
SENSORS = {"imu": IMU, "ft": WRENCH, "eye": {"range": 1.5}, "pose": POSE}
FRAMES = {"imu": "imu_link", "ft": "wrist"}


def _robot(ros_version: int, **more: dict[str, float]) -> Any:
    robot, _ = make_robot(
        [PlantJoint("a")],
        ros_version=ros_version,
        sensors={**SENSORS, **more},
        sensor_frames=FRAMES,
    )
    return robot


def _xyz(vector: Any) -> tuple[float, ...]:
    return vector.x, vector.y, vector.z


def _xyzw(quaternion: Any) -> tuple[float, ...]:
    return (*_xyz(quaternion), quaternion.w)


def test_ros1_controllers_publish_every_sensor_of_their_kind_at_the_rate() -> None:
    robot = _robot(1)
    ports = RecordingPorts()
    imu, _ = make_controller(ImuSensorController, robot, {"publish_rate": 100}, ports=ports)
    wrench, _ = make_controller(
        ForceTorqueSensorController, robot, {"publish_rate": 50}, ports=ports
    )
    imu.start(0)
    wrench.start(0)
    run(robot, [imu, wrench], 101)
    assert set(ports.publishers) == {"imu", "ft"}
    imus, wrenches = ports.publishers["imu"].messages, ports.publishers["ft"].messages
    assert [m.header.stamp.nanosec // MS for m in imus] == [11, 21, 31, 41, 51, 61, 71, 81, 91]
    assert len(wrenches) == 4
    assert (imus[0].header.frame_id, wrenches[0].header.frame_id) == ("imu_link", "wrist")
    assert _xyzw(imus[0].orientation) == (0.0, 0.0, HALF, HALF)
    assert _xyz(imus[0].angular_velocity) == (1.0, 2.0, 3.0)
    assert _xyz(imus[0].linear_acceleration) == (0.1, 0.2, 9.8)
    assert _xyz(wrenches[0].wrench.force) == (1.0, 2.0, 3.0)
    assert _xyz(wrenches[0].wrench.torque) == (4.0, 5.0, 6.0)


def test_ros1_controller_without_sensors_says_so_and_needs_a_rate() -> None:
    robot, _ = make_robot([PlantJoint("a")])
    _, ports = make_controller(ForceTorqueSensorController, robot, {"publish_rate": 50})
    assert "the hardware has no sensor with force.x" in ports.lines[0][1]
    with pytest.raises(ControllerError, match="no 'publish_rate' given"):
        make_controller(ImuSensorController, robot, {})


def test_imu_broadcaster_publishes_one_sensor_at_every_update() -> None:
    covariance = [float(k) for k in range(9)]
    parameters = {
        "sensor_name": "imu",
        "frame_id": "tilted",
        "static_covariance_angular_velocity": covariance,
        "static_covariance_orientation": [1.0],
    }
    found = Diagnostics()
    robot = _robot(2)
    controller, ports = make_controller(ImuSensorBroadcaster, robot, parameters, diagnostics=found)
    run(robot, controller, 3)
    messages = ports.publishers["~/imu"].messages
    assert len(messages) == 3
    last = messages[-1]
    assert last.header.frame_id == "tilted" and last.header.stamp.nanosec == 2 * MS
    assert _xyz(last.angular_velocity) == (1.0, 2.0, 3.0)
    assert list(last.angular_velocity_covariance) == covariance
    assert list(last.orientation_covariance) == [0.0] * 9
    assert "has 1 values, not 9" in found.by_code("parameter.bad-value")[0].message


def test_imu_offset_turns_the_frame() -> None:
    covariance = [1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 3.0]
    parameters = {
        "sensor_name": "imu",
        "frame_id": "turned",
        "static_covariance_linear_acceleration": covariance,
        "rotation_offset": {"yaw": math.pi / 2.0},
    }
    robot = _robot(2)
    controller, ports = make_controller(ImuSensorBroadcaster, robot, parameters)
    run(robot, controller, 1)
    message = ports.publishers["~/imu"].last
    assert _xyz(message.angular_velocity) == pytest.approx((-2.0, 1.0, 3.0))
    assert _xyz(message.linear_acceleration) == pytest.approx((-0.2, 0.1, 9.8))
    assert _xyzw(message.orientation) == pytest.approx((0.0, 0.0, 0.0, 1.0))
    turned = np.asarray(message.linear_acceleration_covariance).reshape(3, 3)
    assert turned == pytest.approx(np.diag([2.0, 1.0, 3.0]))


def test_what_an_imu_does_not_measure_has_covariance_minus_one() -> None:
    robot = _robot(2, bare={**IMU, "orientation.w": math.nan})
    parameters = {"sensor_name": "bare", "frame_id": "f"}
    controller, ports = make_controller(ImuSensorBroadcaster, robot, parameters)
    run(robot, controller, 1)
    message = ports.publishers["~/imu"].last
    assert message.orientation_covariance[0] == -1.0
    assert _xyzw(message.orientation) == (0.0, 0.0, 0.0, 0.0)


def test_wrench_is_offset_then_multiplied_and_both_change_live() -> None:
    parameters = {
        "sensor_name": "ft",
        "frame_id": "wrist",
        "offset": {"force": {"x": 10.0}},
        "multiplier": {"force": {"x": 2.0}, "torque": {"z": -1.0}},
    }
    robot = _robot(2)
    controller, ports = make_controller(ForceTorqueSensorBroadcaster, robot, parameters)
    run(robot, controller, 1)
    message = ports.publishers["~/wrench"].last
    assert _xyz(message.wrench.force) == (22.0, 2.0, 3.0)
    assert _xyz(message.wrench.torque) == (4.0, 5.0, -6.0)
    assert controller.changed({"offset.force.x": -1.0, "multiplier.torque.x": 0.0}) == ""
    run(robot, controller, 1)
    message = ports.publishers["~/wrench"].last
    assert (message.wrench.force.x, message.wrench.torque.x) == (0.0, 0.0)


def test_single_wrench_interfaces_leave_the_others_unknown() -> None:
    parameters = {"frame_id": "f", "interface_names": {"force": {"z": "ft/force.y"}}}
    robot = _robot(2)
    controller, ports = make_controller(ForceTorqueSensorBroadcaster, robot, parameters)
    run(robot, controller, 1)
    force = ports.publishers["~/wrench"].last.wrench.force
    assert force.z == 2.0 and math.isnan(force.x)
    for wrong, text in (
        ({"frame_id": "f"}, "'sensor_name' or at least one"),
        ({**parameters, "sensor_name": "ft"}, "can not be specified together"),
    ):
        with pytest.raises(ControllerError, match=text):
            make_controller(ForceTorqueSensorBroadcaster, robot, wrong)


def test_filter_chain_is_reported() -> None:
    found = Diagnostics()
    parameters = {
        "sensor_name": "ft",
        "frame_id": "f",
        "sensor_filter_chain": {"filter1": {"type": "control_filters/LowPassFilterWrench"}},
    }
    make_controller(ForceTorqueSensorBroadcaster, _robot(2), parameters, diagnostics=found)
    (one,) = found.by_code("parameter.idle")
    assert "~/wrench_filtered is not offered" in one.message


def test_range_is_published_with_its_facts() -> None:
    parameters = {"sensor_name": "eye", "frame_id": "f", "radiation_type": 1, "max_range": 2.0}
    robot = _robot(2)
    controller, ports = make_controller(RangeSensorBroadcaster, robot, parameters)
    run(robot, controller, 1)
    message = ports.publishers["~/range"].last
    assert (message.range, message.max_range, message.radiation_type) == (1.5, 2.0, 1)
    assert message.field_of_view == pytest.approx(0.52)
    with pytest.raises(ControllerError, match="did you mean 'eye'"):
        make_controller(RangeSensorBroadcaster, robot, {**parameters, "sensor_name": "eyes"})


def test_pose_and_its_transform() -> None:
    robot = _robot(2)
    parameters = {"pose_name": "pose", "frame_id": "map", "tf": {"publish_rate": 500.0}}
    controller, ports = make_controller(PoseBroadcaster, robot, parameters)
    controller.start(0)
    run(robot, controller, 10)
    poses, transforms = (ports.publishers[name].messages for name in ("~/pose", "/tf"))
    assert (len(poses), len(transforms)) == (10, 5)
    assert _xyz(poses[0].pose.position) == (1.0, 2.0, 3.0)
    (transform,) = transforms[0].transforms
    assert (transform.header.frame_id, transform.child_frame_id) == ("map", "pose")
    assert _xyz(transform.transform.translation) == (1.0, 2.0, 3.0)
    assert _xyzw(transform.transform.rotation) == (0.0, 0.0, HALF, HALF)


def test_invalid_pose_has_no_transform_and_is_said_every_second() -> None:
    robot = _robot(2, lost={**POSE, "orientation.w": 2.0})
    parameters = {"pose_name": "lost", "frame_id": "map"}
    controller, ports = make_controller(PoseBroadcaster, robot, parameters)
    controller.start(0)
    run(robot, controller, 1500)
    assert len(ports.publishers["~/pose"].messages) == 1500
    assert not ports.publishers["/tf"].messages
    assert [text[:24] for _, text in ports.lines] == ["controller: Invalid pose"] * 2


def test_gps_fix_with_covariance_given_or_read() -> None:
    values = {"status": 0.0, "service": 1.0, "latitude": 48.1, "longitude": 11.5, "altitude": 520.0}
    variances = {f"{axis}_covariance": k for k, axis in enumerate(("latitude", "longitude"), 1)}
    robot = _robot(2, gps={**values, **variances, "altitude_covariance": 3.0})
    parameters: dict[str, Any] = {"sensor_name": "gps", "frame_id": "antenna"}
    given = {**parameters, "static_position_covariance": [float(k) for k in range(9)]}
    controller, ports = make_controller(GpsSensorBroadcaster, robot, given)
    run(robot, controller, 1)
    message = ports.publishers["~/gps/fix"].last
    assert (message.latitude, message.longitude, message.altitude) == (48.1, 11.5, 520.0)
    assert (message.status.status, message.status.service) == (0, 1)
    assert message.position_covariance_type == 3 and message.position_covariance[5] == 5.0
    read = {**parameters, "read_covariance_from_interface": True}
    controller, ports = make_controller(GpsSensorBroadcaster, robot, read)
    run(robot, controller, 1)
    message = ports.publishers["~/gps/fix"].last
    assert message.position_covariance_type == 2
    assert list(message.position_covariance) == [1, 0, 0, 0, 2, 0, 0, 0, 3]


@pytest.mark.parametrize(
    ("cls", "parameters"),
    [
        (ImuSensorBroadcaster, {"sensor_name": "imu", "frame_id": "f"}),
        (ForceTorqueSensorBroadcaster, {"sensor_name": "ft", "frame_id": "f"}),
        (RangeSensorBroadcaster, {"sensor_name": "eye", "frame_id": "f"}),
        (PoseBroadcaster, {"pose_name": "pose", "frame_id": "f"}),
        (ImuSensorController, {"publish_rate": 1000}),
    ],
)
def test_no_message_is_built_for_nobody(cls: Any, parameters: dict[str, Any]) -> None:
    robot = _robot(2)
    ports = RecordingPorts(subscribed=False)
    controller, _ = make_controller(cls, robot, parameters, ports=ports)
    controller.start(0)
    run(robot, controller, 5)
    assert ports.publishers
    assert not any(publisher.messages for publisher in ports.publishers.values())
