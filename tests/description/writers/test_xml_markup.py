"""Numbers, angles and comments as they are written."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gazelle.description.writers.xml_markup import Markup, exact_rpy, from_tag, number, xyz_rpy
from gazelle.description.xml import parse_xml
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose


@pytest.mark.parametrize(
    ("value", "text"), [(1.0, "1"), (0.1, "0.1"), (-0.0, "0"), (1e-7, "1e-07"), (7, "7")]
)
def test_numbers_are_the_shortest_that_are_read_back(value: float, text: str) -> None:
    assert number(value) == text
    assert float(text) == value


def test_angles_at_the_poles_give_the_rotation_back() -> None:
    rng = np.random.default_rng(1)
    for pitch in (math.pi / 2, -math.pi / 2, math.pi / 2 - 1e-9, 1.5707, 0.3):
        for _ in range(50):
            roll, yaw = rng.uniform(-3, 3, 2)
            pose = Pose.from_xyz_rpy((0, 0, 0), (roll, pitch, yaw))
            again = Pose.from_xyz_rpy((0, 0, 0), exact_rpy(pose))
            assert np.abs(pose.matrix() - again.matrix()).max() < 1e-14


def test_round_angles_stay_round() -> None:
    pose = Pose.from_xyz_rpy((0.1, 0, 0), (0.0, 1.5707, 1.5707))
    assert xyz_rpy(pose) == ("0.1 0 0", "0 1.5707 1.5707")


def test_comments_cannot_end_early() -> None:
    robot = Markup("robot")
    robot.comment("gazelle --fix --> <link/>-")
    text = robot.to_text(["a\nb --"])
    root = parse_xml(text, "t", found := Diagnostics())
    assert root is not None
    assert root.children == ()
    assert list(found) == []


def test_texts_in_several_lines_keep_their_indentation() -> None:
    yaml = "<param>\n  a:\n    - 1\n</param>"
    tag = parse_xml(f"<p>{yaml}</p>", "t", Diagnostics())
    again = parse_xml(from_tag(tag).to_text(), "t", Diagnostics())
    assert again.children[0].raw_text == tag.children[0].raw_text
