"""What is said about transmissions, and what is done with them."""

from __future__ import annotations

from tests.control.hardware.rig import Rig, ros1_rig, rotor, transmission


def message(rig: Rig, code: str) -> str:
    (finding,) = rig.diagnostics.by_code(code)
    return f"{finding.message} {finding.fix}"


def test_joints_have_the_interface_of_their_transmission() -> None:
    parts = [
        part
        for name, kind in (("a", "Effort"), ("b", "Position"), ("c", "Velocity"))
        for part in (rotor(name), transmission(name, kind))
    ]
    rig = ros1_rig(*parts)
    assert list(rig.robot.interface_values.command_index) == [
        "a/effort",
        "b/position",
        "c/velocity",
    ]
    assert rig.robot.joints["b"].hardware_interfaces == (
        "hardware_interface/PositionJointInterface",
        "hardware_interface/JointStateInterface",
    )
    assert rig.robot.ros_version == 1


def test_an_interface_without_its_package_is_understood() -> None:
    rig = ros1_rig(
        rotor("a"), transmission("a", prefix=""), rotor("b"), transmission("b", "Position", "")
    )
    assert list(rig.robot.interface_values.command_index) == ["a/effort", "b/position"]
    text = message(rig, "control.hardware-interface-prefix")
    assert "hardware interfaces of a, b lack 'hardware_interface/'" in text
    assert "Deprecated syntax, please prepend" in text


def test_of_several_interfaces_the_first_counts() -> None:
    more = transmission("j").replace(
        "</joint>",
        "<hardwareInterface>hardware_interface/PositionJointInterface</hardwareInterface></joint>",
    )
    rig = ros1_rig(rotor("j"), more)
    assert list(rig.robot.interface_values.command_index) == ["j/effort"]
    assert "specifies multiple hardware interfaces" in message(
        rig, "control.hardware-interface-extra"
    )


def test_transmission_of_2011_is_driven_by_efforts() -> None:
    old = (
        '<transmission name="t" type="SimpleTransmission"><actuator name="m"/><joint name="j"/>'
        "<mechanicalReduction>1</mechanicalReduction></transmission>"
    )
    rig = ros1_rig(rotor("j"), old)
    assert list(rig.robot.interface_values.command_index) == ["j/effort"]
    text = message(rig, "control.hardware-interface-missing")
    assert "it is driven by efforts, as on the PR2" in text


def test_an_interface_in_the_actuator_is_used() -> None:
    moved = (
        '<transmission name="t"><type>transmission_interface/SimpleTransmission</type>'
        '<joint name="j"/><actuator name="m"><hardwareInterface>VelocityJointInterface'
        "</hardwareInterface></actuator></transmission>"
    )
    rig = ros1_rig(rotor("j"), moved)
    assert list(rig.robot.interface_values.command_index) == ["j/velocity"]
    assert "belongs into <joint>" in message(rig, "control.hardware-interface-missing")


def test_an_unknown_interface_leaves_a_joint_that_can_be_read() -> None:
    rig = ros1_rig(rotor("j"), transmission("j", "Effrot"))
    assert rig.robot.interface_values.command_index == {}
    assert rig.state("j/position") == 0.0
    text = message(rig, "control.hardware-interface-unknown")
    assert "No matching hardware interface found" in text
    assert "did you mean 'EffortJointInterface'" in text


def test_a_wrong_joint_is_left_out_with_the_nearest_name() -> None:
    rig = ros1_rig(rotor("elbow"), transmission("elbow"), transmission("elbwo"))
    assert list(rig.robot.joints) == ["elbow"]
    text = message(rig, "control.hardware-joint")
    assert 'This robot has a joint named "elbwo" which is not in the gazebo model.' in text
    assert "did you mean 'elbow'?" in text


def test_a_fixed_joint_may_be_named_to_hardware_of_another_package() -> None:
    tip = transmission("tip").replace("hardware_interface/Effort", "arm_hw/Model")
    rig = ros1_rig(rotor("tip", "fixed", ""), tip, rotor("k"), transmission("k"))
    assert list(rig.robot.joints) == ["k"]
    assert not rig.diagnostics.by_code("control.hardware-joint")


def test_a_fixed_joint_cannot_be_driven() -> None:
    fixed = rotor("j", "fixed", "")
    rig = ros1_rig(fixed, transmission("j"), rotor("k"), transmission("k"))
    assert list(rig.robot.joints) == ["k"]
    assert "is fixed and cannot be driven" in message(rig, "control.hardware-joint")


def test_two_transmissions_of_one_joint_count_once() -> None:
    rig = ros1_rig(rotor("j"), transmission("j"), transmission("j", "Position"))
    assert list(rig.robot.interface_values.command_index) == ["j/effort"]
    assert "the first one counts" in message(rig, "control.transmission-twice")


def test_a_differential_drives_each_of_its_joints_directly() -> None:
    roles = "".join(
        f'<joint name="{name}"><role>joint{number}</role><hardwareInterface>hardware_interface/'
        "EffortJointInterface</hardwareInterface></joint>"
        f'<actuator name="m{number}"><role>actuator{number}</role><mechanicalReduction>30'
        "</mechanicalReduction></actuator>"
        for number, name in ((1, "a"), (2, "b"))
    )
    pair = (
        '<transmission name="wrist"><type>transmission_interface/DifferentialTransmission</type>'
        f"{roles}</transmission>"
    )
    rig = ros1_rig(rotor("a"), rotor("b"), pair)
    assert list(rig.robot.interface_values.command_index) == ["a/effort", "b/effort"]
    assert "has more than one joint" in message(rig, "control.transmission-joints")
    text = message(rig, "control.transmission-idle")
    assert "mechanical reductions have no effect on simulated joints" in text
    assert "(wrist)" in text


def test_a_robot_without_transmissions_is_reported() -> None:
    rig = ros1_rig(rotor("j"))
    assert rig.robot.joints == {}
    assert "No valid transmissions found." in message(rig, "control.no-transmissions")
