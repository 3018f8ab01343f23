from __future__ import annotations

import math

import pytest

from gazelle.description.model import JointType

LINKS = (
    "<link name='a'/><link name='b'><pose>0.1 0.13 0.1 0 1.5707963267948966 1.5707963267948966"
    "</pose></link>"
)


def _joint(axis="<axis><xyz>0 1 0</xyz></axis>", kind="revolute", extra=""):
    return (
        f"{LINKS}<joint name='j' type='{kind}'><pose>0 0 -0.03 0 0 0</pose>"
        f"<parent>a</parent><child>b</child>{axis}{extra}</joint>"
    )


def test_axis_of_sdf_1_4_is_given_in_the_models_frame(model):
    joint = model(_joint(), version="1.4").joint("j")
    in_model = joint.T_model_joint.rotate(joint.axis.xyz)
    assert in_model == pytest.approx((0, 1, 0))


def test_axis_of_later_versions_is_given_in_the_joints_frame(model):
    assert model(_joint(), version="1.5").joint("j").axis.xyz == pytest.approx((0, 1, 0))


def test_use_parent_model_frame_of_sdf_1_5(model):
    axis = "<axis><xyz>0 1 0</xyz><use_parent_model_frame>true</use_parent_model_frame></axis>"
    joint = model(_joint(axis), version="1.6").joint("j")
    assert joint.T_model_joint.rotate(joint.axis.xyz) == pytest.approx((0, 1, 0))


def test_expressed_in_of_sdf_1_7(model):
    axis = "<axis><xyz expressed_in='__model__'>0 0 2</xyz></axis>"
    joint = model(_joint(axis)).joint("j")
    assert joint.T_model_joint.rotate(joint.axis.xyz) == pytest.approx((0, 0, 1))


def test_expressed_in_an_unknown_frame_is_reported(model, diagnostics):
    model(_joint("<axis><xyz expressed_in='nowhere'>0 0 1</xyz></axis>"))
    assert "expressed_in='nowhere'" in diagnostics.by_code("sdf.unknown-frame")[0].message


def test_joint_pose_is_given_in_the_child(model):
    joint = model(_joint()).joint("j")
    # The wheel's z points along the model's y after pitch and yaw of 90 degrees.
    assert joint.T_model_joint.position_m == pytest.approx((0.1, 0.1, 0.1))


def test_limits_of_1e16_and_missing_ones_are_infinite(model):
    axis = "<axis><xyz>0 0 1</xyz><limit><lower>-1e16</lower><upper>1e16</upper></limit></axis>"
    for text in (axis, "<axis><xyz>0 0 1</xyz></axis>"):
        found = model(_joint(text)).joint("j").axis
        assert (found.lower, found.upper) == (-math.inf, math.inf)
        assert (found.effort, found.velocity) == (math.inf, math.inf)


def test_negative_effort_and_velocity_mean_no_limit(model):
    axis = "<axis><xyz>0 0 1</xyz><limit><effort>-1</effort><velocity>-1</velocity></limit></axis>"
    found = model(_joint(axis)).joint("j").axis
    assert (found.effort, found.velocity) == (math.inf, math.inf)


def test_infinity_as_a_word_is_a_limit(model, diagnostics):
    axis = "<axis><xyz>0 0 1</xyz><limit><lower>-inf</lower><upper>0.5</upper></limit></axis>"
    found = model(_joint(axis)).joint("j").axis
    assert (found.lower, found.upper) == (-math.inf, 0.5)
    assert not diagnostics.errors


def test_dynamics_and_limits_are_read(model):
    axis = (
        "<axis><xyz>0 0 1</xyz><limit><lower>-1</lower><upper>2</upper><effort>3</effort>"
        "<velocity>4</velocity></limit><dynamics><damping>5</damping><friction>6</friction>"
        "<spring_reference>7</spring_reference><spring_stiffness>8</spring_stiffness></dynamics>"
        "</axis>"
    )
    found = model(_joint(axis)).joint("j").axis
    assert (found.lower, found.upper, found.effort, found.velocity) == (-1, 2, 3, 4)
    assert (found.damping, found.friction) == (5, 6)
    assert (found.spring_reference, found.spring_stiffness) == (7, 8)


@pytest.mark.parametrize("kind", ["universal", "revolute2", "gearbox"])
def test_joints_with_two_axes(model, kind):
    axes = "<axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2>"
    joint = model(_joint(axes, kind)).joint("j")
    assert joint.axis.xyz == pytest.approx((1, 0, 0))
    assert joint.axis2.xyz == pytest.approx((0, 1, 0))


@pytest.mark.parametrize(
    ("kind", "first", "second"),
    [("universal", (0, 1, 0), (1, 0, 0)), ("revolute2", (1, 0, 0), (0, 1, 0))],
)
def test_unsaid_axes_of_two_are_one_of_the_parents_and_one_of_the_childs(
    model, kind, first, second
):
    found = model(_joint("", kind))
    joint, child = found.joint("j"), found.link("b")
    assert joint.T_model_joint.rotate(joint.axis.xyz) == pytest.approx(first)
    in_child = child.T_model_link.inverse().rotate(joint.T_model_joint.rotate(joint.axis2.xyz))
    assert in_child == pytest.approx(second)


@pytest.mark.parametrize("kind", ["fixed", "ball"])
def test_joints_without_axis(model, kind):
    joint = model(_joint(kind=kind)).joint("j")
    assert joint.type is JointType(kind)
    assert joint.axis is None


def test_continuous_joint_has_no_limits(model):
    axis = "<axis><xyz>0 0 1</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis>"
    joint = model(_joint(axis, "continuous")).joint("j")
    assert joint.type is JointType.CONTINUOUS
    assert joint.axis.upper == math.inf


def test_both_words_for_a_thread_mean_the_same(model):
    new = model(_joint(kind="screw", extra="<screw_thread_pitch>0.5</screw_thread_pitch>"))
    old = model(_joint(kind="screw", extra="<thread_pitch>-12.566370614359172</thread_pitch>"))
    assert new.joint("j").thread_pitch_rad_m == pytest.approx(4 * math.pi)
    assert old.joint("j").thread_pitch_rad_m == pytest.approx(4 * math.pi)


def test_gearbox_words(model):
    extra = "<gearbox_ratio>-2</gearbox_ratio><gearbox_reference_body>a</gearbox_reference_body>"
    joint = model(_joint(kind="gearbox", extra=extra)).joint("j")
    assert (joint.gearbox_ratio, joint.gearbox_reference_body) == (-2, "a")


def test_mimic_folds_its_reference_into_the_offset(model):
    axis = (
        "<axis><xyz>0 0 1</xyz><mimic joint='k'><multiplier>2</multiplier><offset>0.5</offset>"
        "<reference>0.1</reference></mimic></axis>"
    )
    mimic = model(_joint(axis)).joint("j").mimic
    assert (mimic.joint, mimic.multiplier) == ("k", 2)
    assert mimic.offset == pytest.approx(0.3)


def test_mimic_without_joint_is_reported(model, diagnostics):
    axis = "<axis><xyz>0 0 1</xyz><mimic><multiplier>2</multiplier></mimic></axis>"
    assert model(_joint(axis)).joint("j").mimic is None
    assert "mimic" in diagnostics.by_code("xml.missing-attribute")[0].message


def test_softness_and_feedback(model):
    extra = (
        "<physics><ode><cfm>1e-3</cfm><erp>0.3</erp><limit><cfm>0.1</cfm><erp>0.4</erp></limit>"
        "<cfm_damping>1</cfm_damping><provide_feedback>1</provide_feedback></ode></physics>"
    )
    joint = model(_joint(extra=extra)).joint("j")
    assert (joint.cfm, joint.erp, joint.limit_cfm, joint.limit_erp) == (1e-3, 0.3, 0.1, 0.4)
    assert joint.implicit_spring_damper
    assert joint.provide_feedback


def test_force_torque_sensor_of_a_joint(model):
    extra = "<sensor name='ft' type='force_torque'><update_rate>30</update_rate></sensor>"
    assert model(_joint(extra=extra)).joint("j").sensors[0].update_rate_hz == 30


def test_null_axis_is_reported(model, diagnostics):
    assert model(_joint("<axis><xyz>0 0 0</xyz></axis>")).joint("j").axis.xyz == (0, 0, 1)
    assert "joint 'j' has length 0" in diagnostics.by_code("sdf.bad-value")[0].message


def test_unknown_type_is_reported_with_the_nearest(model, diagnostics):
    assert model(_joint(kind="revolut")).joints == ()
    (found,) = diagnostics.by_code("sdf.unknown-joint-type")
    assert "'revolut'" in found.message
    assert "'revolute'" in found.fix


def test_parent_may_be_the_world_but_not_the_child(model, diagnostics):
    body = (
        "<link name='b'/><joint name='j' type='fixed'><parent>{}</parent><child>{}</child></joint>"
    )
    assert model(body.format("world", "b")).joint("j").parent == "world"
    assert model(body.format("b", "world")).joints == ()
    assert "child frame with name 'world'" in diagnostics.by_code("sdf.bad-joint")[0].message


def test_ends_may_be_frames(model):
    found = model(
        "<link name='a'/><link name='b'/><frame name='f' attached_to='b'/>"
        "<joint name='j' type='fixed'><parent>a</parent><child>f</child></joint>"
    )
    assert found.joint("j").child == "b"


def test_joint_between_nested_models(model):
    found = model(
        "<model name='left'><link name='l'/></model><model name='right'><link name='l'/></model>"
        "<joint name='j' type='fixed'><parent>left</parent><child>right::l</child></joint>"
    )
    assert (found.joint("j").parent, found.joint("j").child) == ("left::l", "right::l")
    assert found.canonical_link == "left::l"


def test_joint_may_share_its_name_with_a_link(model, diagnostics):
    found = model(
        "<link name='a'/><link name='wheel'><pose>1 0 0 0 0 0</pose></link>"
        "<joint name='wheel' type='fixed'><pose>0 1 0 0 0 0</pose><parent>a</parent>"
        "<child>wheel</child></joint>",
        version="1.4",
    )
    assert found.joint("wheel").T_model_joint.position_m == pytest.approx((1, 1, 0))
    assert not len(diagnostics)


def test_joint_of_a_link_with_itself_is_reported(model, diagnostics):
    body = "<link name='a'/><joint name='j' type='fixed'><parent>a</parent><child>a</child></joint>"
    assert model(body).joints == ()
    assert "joins 'a' to itself" in diagnostics.by_code("sdf.bad-joint")[0].message


def test_missing_end_is_reported(model, diagnostics):
    assert (
        model("<link name='a'/><joint name='j' type='fixed'><child>a</child></joint>").joints == ()
    )
    assert "names no <parent>" in diagnostics.by_code("xml.missing-tag")[0].message
