"""A row of a table: its names, and in which generation of ROS they count."""

from __future__ import annotations

import pytest

from gazelle.parameters import Parameter, refused


@pytest.mark.parametrize(
    ("row", "name", "is_its"),
    [
        (Parameter("gains.<joint>.p", "number", 0.0, "gain"), "gains.knee.p", True),
        (Parameter("gains.<joint>.p", "number", 0.0, "gain"), "gains.left.knee.p", False),
        (Parameter("rate", "number", 0.0, "rate"), "rate.x", False),
        (Parameter("rate", "number", 0.0, "rate", aliases=("freq",)), "freq", True),
        (Parameter("inner", "group", None, "more"), "inner.deep.er", True),
        (Parameter("inner", "group", None, "more"), "inner_most", False),
        (Parameter("<plugin>.inner", "refused", None, "none"), "a.inner.deep", True),
    ],
)
def test_a_pattern_stands_for_one_word_and_a_branch_for_all_below(
    row: Parameter, name: str, is_its: bool
) -> None:
    assert row.matches(name) is is_its


def test_camel_case_counts_in_ros1_and_snake_case_in_ros2() -> None:
    row = Parameter("updateRate", "number", 0.0, "rate", aliases=("update_rate",), ros2_default=9.0)
    assert row.spellings(0) == ("updateRate", "update_rate")
    assert row.spellings(1) == ("updateRate",)
    assert row.spellings(2) == ("update_rate",)
    assert (row.default_in(1), row.default_in(2)) == (0.0, 9.0)


def test_a_key_of_one_spelling_counts_in_its_generations() -> None:
    assert Parameter("alwaysOn", "flag", True, "on").spellings(2) == ("alwaysOn",)
    assert Parameter("alwaysOn", "flag", True, "on", ros_versions=(1,)).spellings(2) == ()


def test_refused_rows_share_their_reason() -> None:
    first, second = refused("there is none here", "a", "b")
    assert (first.key, second.key) == ("a", "b")
    assert first.is_refused
    assert second.meaning == "there is none here"
