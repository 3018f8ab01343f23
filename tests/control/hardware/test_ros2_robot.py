"""What is said about ``<ros2_control>`` blocks, and what is done with them."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from tests.control.hardware.rig import Rig, block, joint, ros2_rig, rotor

from gazelle.control.hardware.sensor_states import IMU_STATES, SensorReadout


def message(rig: Rig, code: str) -> str:
    (finding,) = rig.diagnostics.by_code(code)
    return f"{finding.message} {finding.fix}"


def test_interfaces_are_those_of_the_block() -> None:
    states = '<state_interface name="position"/>'
    rig = ros2_rig(
        rotor("a"), rotor("b"), block(joint("a", ("effort",)), joint("b", states=states))
    )
    assert list(rig.robot.interface_values.command_index) == ["a/effort", "b/position"]
    assert set(rig.robot.interface_values.state_index) == {
        "a/position",
        "a/velocity",
        "a/effort",
        "b/position",
    }
    assert rig.robot.joints["a"].command_interfaces == ("effort",)
    assert rig.robot.joints["b"].limits.max_velocity == 4.0
    assert (rig.hardware.name, rig.hardware.type) == ("hw", "system")


def test_several_blocks_make_several_components() -> None:
    rig = ros2_rig(
        rotor("a"), rotor("b"), block(joint("a")), block(joint("b")).replace("hw", "tool")
    )
    assert [item.name for item in rig.robot.components] == ["hw", "tool"]
    rig.claim("a/position", "b/position")
    rig.run(100, a_position=0.1, b_position=0.2)
    assert (rig.position("a"), rig.position("b")) == pytest.approx((0.1, 0.2), abs=1e-6)


def test_a_driver_of_a_real_robot_is_reported_and_nothing_takes_its_place() -> None:
    rig = ros2_rig(
        rotor("j"), block(joint("j"), plugin="ur_robot_driver/URPositionHardwareInterface")
    )
    assert rig.robot.components == ()
    text = message(rig, "control.hardware-plugin")
    assert "ur_robot_driver/URPositionHardwareInterface does not exist" in text
    assert "write <plugin>gazebo_ros2_control/GazeboSystem</plugin>" in text
    assert (
        "class 'URPositionHardwareInterface' of package 'ur_robot_driver', which is compiled code "
        "that is not here; lost with it, for every controller: joint 'j' (" in text
    )
    assert rig.robot.absent == {"j": "hw"}
    assert [item.code for item in rig.diagnostics] == ["control.hardware-plugin"]


def test_a_misspelt_class_gets_the_nearest_name() -> None:
    rig = ros2_rig(rotor("j"), block(joint("j"), plugin="gazebo_ros2_control/GazeboSytem"))
    assert "did you mean 'gazebo_ros2_control/GazeboSystem'" in message(
        rig, "control.hardware-plugin"
    )


def test_hardware_of_the_other_gazebo_works_with_a_notice() -> None:
    rig = ros2_rig(rotor("j"), block(joint("j"), plugin="ign_ros2_control/IgnitionSystem"))
    assert "it works here all the same" in message(rig, "control.hardware-plugin-other")
    assert rig.hardware.options.is_gz


def test_mock_hardware_mirrors_and_moves_nothing() -> None:
    rig = ros2_rig(rotor("j"), block(joint("j"), plugin="mock_components/GenericSystem"))
    assert "moves nothing" in message(rig, "control.hardware-plugin-other")
    rig.claim("j/position")
    rig.run(100, j_position=0.7)
    assert rig.state("j/position") == 0.7
    assert rig.position("j") == 0.0


def test_a_wrong_joint_is_left_out_with_the_nearest_name() -> None:
    rig = ros2_rig(rotor("elbow"), block(joint("elbow"), joint("elbwo")))
    assert list(rig.robot.joints) == ["elbow"]
    text = message(rig, "control.hardware-joint")
    assert "Skipping joint in the URDF named 'elbwo' which is not in the gazebo model." in text
    assert "did you mean 'elbow'?" in text


def test_an_interface_that_is_not_simulated_is_left_out() -> None:
    rig = ros2_rig(rotor("j"), block(joint("j", ("positon", "effort"))))
    assert list(rig.robot.interface_values.command_index) == ["j/effort"]
    assert "did you mean 'position'?" in message(rig, "control.ros2-control-interface")


def test_a_mimic_of_an_unknown_joint_is_reported() -> None:
    own = joint("j", more='<param name="mimic">k</param>')
    rig = ros2_rig(rotor("j"), block(own))
    assert "Mimicked joint 'k' not found" in message(rig, "control.ros2-control-mimic")


def test_a_bad_number_is_reported_and_left_out() -> None:
    states = (
        '<state_interface name="position"><param name="initial_value">0,4</param></state_interface>'
    )
    rig = ros2_rig(rotor("j"), block(joint("j", states=states)))
    assert "initial_value of interface 'position' is '0,4', not a number" in message(
        rig, "control.ros2-control-value"
    )
    assert rig.position("j") == 0.0


def test_gpio_and_parameters_of_real_hardware_are_reported() -> None:
    gpio = '<gpio name="io"><command_interface name="out1"/></gpio>'
    rig = ros2_rig(
        rotor("j"), block(joint("j"), gpio, parameters='<param name="robot_ip">1.2.3.4</param>')
    )
    assert "gpio 'io' of 'hw' is left out" in message(rig, "control.ros2-control-gpio")
    assert "'robot_ip'" in message(rig, "control.hardware-parameter")


def test_a_model_without_a_block_is_reported() -> None:
    rig = ros2_rig(rotor("j"))
    assert "no ros2_control tag" in message(rig, "control.ros2-control-missing")


def test_transmissions_of_a_block_and_a_wrong_type_are_reported() -> None:
    gear = '<transmission name="t"><plugin>SimpleTransmission</plugin></transmission>'
    rig = ros2_rig(rotor("j"), block(joint("j"), gear).replace('type="system"', 'type="sytem"'))
    assert "have no effect on simulated joints" in message(rig, "control.transmission-idle")
    text = message(rig, "control.ros2-control-value")
    assert "is of type 'sytem'" in text
    assert "did you mean 'system'?" in text
    assert list(rig.robot.joints) == ["j"]


class OneImu:
    names = ("imu",)

    def __init__(self) -> None:
        self.readings = 0

    def find(self, name: str) -> SensorReadout | None:
        return SensorReadout(IMU_STATES, "tool0", self.read) if name == "imu" else None

    def read(self) -> Sequence[float]:
        self.readings += 1
        return tuple(float(number) for number in range(10))


def sensor(name: str, *states: str) -> str:
    made = "".join(f'<state_interface name="{item}"/>' for item in states)
    return f'<sensor name="{name}">{made}</sensor>'


def test_sensor_states_are_measured_once_somebody_asks() -> None:
    source = OneImu()
    own = sensor("imu", "angular_velocity.y", "orientation.w")
    rig = ros2_rig(rotor("j"), block(own), sensors=source)
    assert rig.robot.sensors == {"imu": ("imu/angular_velocity.y", "imu/orientation.w")}
    assert rig.robot.sensor_frames == {"imu": "tool0"}
    rig.robot.read(0, 0)
    assert source.readings == 0
    assert rig.state("imu/angular_velocity.y") == 5.0
    assert rig.state("imu/orientation.w") == 3.0


def test_a_wrong_sensor_is_reported_with_the_nearest_name() -> None:
    rig = ros2_rig(rotor("j"), block(joint("j"), sensor("imuu")), sensors=OneImu())
    text = message(rig, "control.ros2-control-sensor")
    assert "Skipping sensor in the URDF named 'imuu'" in text
    assert "did you mean 'imu'?" in text


def test_a_wrong_state_of_a_sensor_is_reported() -> None:
    rig = ros2_rig(rotor("j"), block(sensor("imu", "orientation.v")), sensors=OneImu())
    assert "sensor 'imu' has no state 'orientation.v'" in message(
        rig, "control.ros2-control-interface"
    )


def test_joint_that_stands_twice_in_a_block_is_left_out_the_second_time() -> None:
    rig = ros2_rig(rotor("a"), rotor("b"), block(joint("a"), joint("a"), joint("b")))
    assert "a/position" in rig.robot.interface_values.command_index
    text = message(rig, "control.ros2-control-twice")
    assert text.startswith("<joint> 'a' stands twice in hardware 'hw'; the second one is left out")
