"""Tables of ``gazelle doctor``: rows on one line, or folded where words end."""

from __future__ import annotations

import pytest

from gazelle.cli.doctor.report_tables import table_lines, table_title
from gazelle.doctor import Section

PLACE = "use_gui moved (launch/slam_robot_gazebo.launch:3)"
SECTION = Section(
    "generations",
    "written for",
    ("part", "why", "what"),
    (("launch", PLACE, "runs as it is"), ("code", "rospy", "runs")),
    "bot",
)


def test_a_row_is_one_line_as_wide_as_it_is() -> None:
    assert table_lines(SECTION) == [
        f"part     {'why':{len(PLACE)}}   what",
        "─" * (6 + 3 + len(PLACE) + 3 + 13),
        f"launch   {PLACE}   runs as it is",
        f"code     {'rospy':{len(PLACE)}}   runs",
    ]
    assert table_title(SECTION) == "written for of bot"


def test_a_terminal_folds_at_words_and_parts_of_paths() -> None:
    assert table_lines(SECTION, 60) == [
        f"part     {'why':27}   what",
        "─" * (6 + 3 + 27 + 3 + 13),
        f"launch   {'use_gui moved (launch/':27}   runs as it is",
        "         slam_robot_gazebo.launch:3)",
        f"code     {'rospy':27}   runs",
    ]


@pytest.mark.parametrize("width", range(1, 90))
def test_no_word_is_broken_at_any_width(width: int) -> None:
    text = "\n".join(table_lines(SECTION, width))
    for word in ("use_gui", "moved", "(launch/", "slam_robot_gazebo.launch:3)", "rospy"):
        assert word in text


def test_scoped_names_fold_behind_their_colons_and_lines_stay_with_files() -> None:
    section = Section("x", "x", ("a",), (("robot::base_link::collision", "")[:1], ("b.xml:12",)))
    assert table_lines(section, 8) == [
        "a", "─" * 11, "robot::", "base_link::", "collision", "b.xml:12",
    ]  # fmt: skip


def test_indents_stay_when_a_cell_is_folded() -> None:
    section = Section("frames", "x", ("frame",), (("  base_link → laser_link",),))
    assert table_lines(section, 14)[2:] == ["  base_link →", "  laser_link"]


def test_rows_can_be_chosen() -> None:
    assert table_lines(SECTION, rows=SECTION.rows[1:]) == [
        "part   why     what",
        "─" * 19,
        "code   rospy   runs",
    ]


def test_wide_characters_count_twice_and_steering_ones_are_left_out() -> None:
    section = Section("x", "x", ("a", "b"), (("車", "one"), ("x\x1b[2J", "two")))
    assert table_lines(section)[2:] == ["車      one", "x [2J   two"]
