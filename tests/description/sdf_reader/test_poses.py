from __future__ import annotations

import math

import pytest

from gazelle.description.sdf_reader.poses import read_pose, relative_to_of
from gazelle.geometry import IDENTITY_POSE, Pose


def test_six_numbers_are_metres_and_fixed_axis_radians(tag, context):
    pose = read_pose(tag("<pose>1 2 3 0.1 0.2 0.3</pose>"), context)
    assert pose.position_m == (1, 2, 3)
    assert pose.rpy_rad == pytest.approx((0.1, 0.2, 0.3))


def test_no_pose_and_an_empty_one_are_the_identity(tag, context):
    assert read_pose(None, context) == IDENTITY_POSE
    assert read_pose(tag("<pose/>"), context) == IDENTITY_POSE


def test_degrees_attribute_turns_angles_into_radians(tag, context):
    pose = read_pose(tag("<pose degrees='true'>0 0 0 0 0 90</pose>"), context)
    assert pose.rpy_rad == pytest.approx((0, 0, math.pi / 2))


def test_quaternions_are_normalised(tag, context):
    pose = read_pose(tag("<pose rotation_format='quat_xyzw'>1 0 0 0 0 2 2</pose>"), context)
    assert pose.quat_xyzw == pytest.approx((0, 0, math.sqrt(0.5), math.sqrt(0.5)))


def test_both_formats_of_one_rotation_agree(tag, context):
    euler = read_pose(tag("<pose>0 0 0 0.4 -0.7 1.2</pose>"), context)
    numbers = " ".join(repr(value) for value in euler.quat_xyzw)
    text = f"<pose rotation_format='quat_xyzw'>0 0 0 {numbers}</pose>"
    assert read_pose(tag(text), context).quat_xyzw == pytest.approx(euler.quat_xyzw)


def test_null_quaternion_is_reported(tag, context, diagnostics):
    found = read_pose(tag("<pose rotation_format='quat_xyzw'>1 0 0 0 0 0 0</pose>"), context)
    assert found == Pose((1, 0, 0))
    assert "length 0" in diagnostics.by_code("sdf.bad-value")[0].message


def test_unknown_rotation_format_is_reported(tag, context, diagnostics):
    read_pose(tag("<pose rotation_format='euler'>0 0 0 0 0 0</pose>"), context)
    assert "euler_rpy, quat_xyzw" in diagnostics.by_code("sdf.bad-value")[0].fix


def test_wrong_count_is_reported_with_the_text(tag, context, diagnostics):
    assert read_pose(tag("<pose>1 2 3</pose>"), context) == IDENTITY_POSE
    message = diagnostics.by_code("xml.bad-number")[0].message
    assert message == "<pose> needs 6 numbers, found 3: '1 2 3'"


def test_decimal_comma_is_explained(tag, context, diagnostics):
    read_pose(tag("<pose>0,5 0 0 0 0 0</pose>"), context)
    assert "not a comma" in diagnostics.by_code("xml.bad-number")[0].message


@pytest.mark.parametrize(
    ("attribute", "expected"), [("relative_to='a'", "a"), ("frame='b'", "b"), ("frame=''", "")]
)
def test_frame_is_the_old_word_for_relative_to(tag, attribute, expected):
    assert relative_to_of(tag(f"<link><pose {attribute}>0 0 0 0 0 0</pose></link>")) == expected
