from __future__ import annotations

from gazelle.description.model import ForceTorqueSpec


def _block(inside: str) -> str:
    return f"<gazebo reference='j'>{inside}</gazebo>"


def test_words_of_a_joint(read_joint) -> None:
    found = read_joint(
        after=_block(
            "<implicitSpringDamper>true</implicitSpringDamper><stopCfm>0.1</stopCfm>"
            "<provideFeedback>true</provideFeedback><stopErp>0.3</stopErp>"
            "<springStiffness>5</springStiffness><springReference value='0.2'/>"
        )
    )
    joint = found.robot.joint("j")
    assert joint.implicit_spring_damper
    assert joint.provide_feedback
    assert (joint.limit_cfm, joint.limit_erp) == (0.1, 0.3)
    assert (joint.axis.spring_stiffness, joint.axis.spring_reference) == (5.0, 0.2)
    assert not found.codes


def test_fixed_joint_lumping_words(read_joint) -> None:
    for word in ("preserveFixedJoint", "disableFixedJointLumping"):
        joint = read_joint(kind="fixed", after=_block(f"<{word}>true</{word}>")).robot.joint("j")
        assert joint.disable_fixed_joint_lumping
        assert joint.type.value == "fixed"


def test_sdf_physics_of_a_joint(read_joint) -> None:
    found = read_joint(
        after=_block(
            "<physics><provide_feedback>1</provide_feedback><ode><cfm>0.01</cfm><limit>"
            "<cfm>0.2</cfm><erp>0.4</erp></limit><cfm_damping>1</cfm_damping></ode></physics>"
        )
    )
    joint = found.robot.joint("j")
    assert (joint.cfm, joint.limit_cfm, joint.limit_erp) == (0.01, 0.2, 0.4)
    assert joint.provide_feedback
    assert joint.implicit_spring_damper
    assert not found.codes


def test_force_torque_sensor_hangs_on_the_joint(read_joint) -> None:
    joint = read_joint(after=_block("<sensor type='force_torque' name='ft'/>")).robot.joint("j")
    assert isinstance(joint.sensors[0].spec, ForceTorqueSpec)


def test_spring_on_a_fixed_joint_is_reported(read_joint) -> None:
    found = read_joint(kind="fixed", after=_block("<springStiffness>5</springStiffness>"))
    assert "has no effect: joint 'j' is fixed" in found.message("urdf.gazebo-no-axis")


def test_fudge_factor_and_unknown_words_are_reported(read_joint) -> None:
    found = read_joint(after=_block("<fudgeFactor>1</fudgeFactor><mu1>1</mu1>"))
    assert "<fudgeFactor> of joint 'j'" in found.message("urdf.gazebo-no-effect")
    assert "<mu1> is not known in <gazebo> for joint 'j'" in found.message("xml.unknown-tag")
