from __future__ import annotations

from gazelle.diagnostics import did_you_mean, nearest_names

NAMES = ["left_wheel_joint", "right_wheel_joint", "caster", "Depth_Camera"]


def test_the_nearest_name_comes_first():
    assert nearest_names("left_whel_joint", NAMES) == ("left_wheel_joint", "right_wheel_joint")


def test_case_does_not_count():
    assert nearest_names("DEPTH_CAMERA", NAMES) == ("Depth_Camera",)


def test_nothing_near_gives_nothing():
    assert nearest_names("xyz", NAMES) == ()
    assert did_you_mean("xyz", NAMES) == ""


def test_the_question_names_all_near_ones():
    assert did_you_mean("castr", NAMES) == "did you mean 'caster'?"
    question = did_you_mean("left_whel_joint", NAMES)
    assert question == "did you mean 'left_wheel_joint' or 'right_wheel_joint'?"


def test_no_more_than_asked_for_are_returned():
    assert len(nearest_names("link_0", [f"link_{i}" for i in range(9)], count=2)) == 2
