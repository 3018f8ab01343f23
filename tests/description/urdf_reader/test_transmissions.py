from __future__ import annotations

SIMPLE = "transmission_interface/SimpleTransmission"


def test_indigo_syntax(read_joint) -> None:
    found = read_joint(
        after=f"<transmission name='t'><type>{SIMPLE}</type><joint name='j'>"
        "<hardwareInterface>EffortJointInterface</hardwareInterface><role>actuated</role>"
        "<offset>0.5</offset></joint><actuator name='m'><mechanicalReduction>50"
        "</mechanicalReduction><hardwareInterface>VelocityJointInterface</hardwareInterface>"
        "</actuator></transmission>"
    )
    (item,) = found.robot.transmissions
    assert (item.name, item.type) == ("t", SIMPLE)
    (joint,), (actuator,) = item.joints, item.actuators
    assert (joint.name, joint.role, joint.offset) == ("j", "actuated", 0.5)
    assert joint.hardware_interfaces == ("EffortJointInterface",)
    assert actuator.mechanical_reduction == 50.0
    assert actuator.hardware_interfaces == ("VelocityJointInterface",)
    assert not found.codes


def test_pr2_syntax(read_joint) -> None:
    found = read_joint(
        after="<transmission name='t' type='SimpleTransmission'><actuator name='m'/>"
        "<joint name='j'/><mechanicalReduction>3</mechanicalReduction>"
        "<motorTorqueConstant>1</motorTorqueConstant></transmission>"
    )
    (item,) = found.robot.transmissions
    assert item.type == "SimpleTransmission"
    assert item.actuators[0].mechanical_reduction == 3.0
    assert not found.codes


def test_transmission_of_a_missing_joint_is_kept_and_reported(read_joint) -> None:
    found = read_joint(
        after=f"<transmission name='t'><type>{SIMPLE}</type><joint name='jj'/></transmission>"
    )
    assert "did you mean 'j'" in found.message("urdf.transmission-joint")
    assert len(found.robot.transmissions) == 1


def test_transmission_without_type_or_joint_is_left_out(read_joint) -> None:
    found = read_joint(
        after="<transmission name='t'><joint name='j'/></transmission>"
        f"<transmission name='u'><type>{SIMPLE}</type></transmission>"
    )
    assert found.robot.transmissions == ()
    texts = [item.message for item in found.diagnostics.by_code("urdf.transmission-incomplete")]
    assert texts == [
        "transmission 't' lacks a <type> and is left out",
        "transmission 'u' lacks a <joint> and is left out",
    ]


def test_classes_that_are_slips_are_told_at_their_elements(read_joint) -> None:
    found = read_joint(
        after="<transmission name='t'><type>transmission_interface/SimpleTrnasmission</type>"
        "<joint name='j'><hardwareInterface>hardware_interface/EffortJoinItnterface"
        "</hardwareInterface></joint><actuator name='m'><hardwareInterface>my_own/Interface"
        "</hardwareInterface></actuator></transmission>"
    )
    texts = [
        (item.message, item.fix) for item in found.diagnostics.by_code("urdf.transmission-class")
    ]
    assert sorted(texts) == [
        (
            "<hardwareInterface> of joint 'j' of transmission 't' is "
            "'hardware_interface/EffortJoinItnterface', which is not known",
            "did you mean 'EffortJointInterface'?",
        ),
        (
            "<type> of transmission 't' is 'transmission_interface/SimpleTrnasmission', which is "
            "not known",
            "did you mean 'SimpleTransmission'?",
        ),
    ]
