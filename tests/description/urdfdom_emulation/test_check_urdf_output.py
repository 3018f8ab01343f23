"""The tree and the drawing of robots that urdfdom accepts."""

from __future__ import annotations

import pytest
from tests.description.recorded_robots import OWN, SAMPLES, RecordedRobots
from tests.shared_files import shared_cases

from gazelle.description.urdfdom_emulation import (
    EndlessTreeError,
    Robot,
    graphviz_text,
    tree_text,
    urdfdom_verdict,
)


def _robot(links: str, *joints: str, extra: str = "") -> Robot:
    """Return a robot: ``_robot("a b", "j a b")`` has joint j from a to b."""
    parts = [f'<link name="{name}"/>' for name in links.split()]
    for joint in joints:
        name, parent, child = joint.split()
        parts.append(
            f'<joint name="{name}" type="fixed"><parent link="{parent}"/>'
            f'<child link="{child}"/>{extra}</joint>'
        )
    robot = urdfdom_verdict(f'<robot name="r">{"".join(parts)}</robot>\n').robot
    assert robot is not None
    return robot


def test_children_come_by_the_names_of_joints() -> None:
    robot = _robot("a b c d", "z a b", "y a c", "x b d")
    assert tree_text(robot).splitlines() == [
        "robot name is: r",
        "---------- Successfully Parsed XML ---------------",
        "root Link: a has 2 child(ren)",
        "    child(1):  c",
        "    child(2):  b",
        "        child(1):  d",
    ]


@pytest.mark.parametrize("robots", [OWN, *shared_cases(SAMPLES)])
def test_the_drawing_is_the_recorded_one(robots: RecordedRobots) -> None:
    robot = urdfdom_verdict(robots.text("good") + "\n").robot
    assert robot is not None
    assert graphviz_text(robot) == robots.drawing.read_text(encoding="utf-8")


def test_the_drawing_has_origins_with_six_digits() -> None:
    robot = _robot("a b", "j a b", extra='<origin xyz="0.1234567 1e-7 -0" rpy="0 0 1"/>')
    assert '"a" -> "j" [label="xyz: 0.123457 1e-07 -0 \\nrpy: 0 -0 1"]\n' in graphviz_text(robot)


def test_a_loop_below_the_root_ends_with_an_error() -> None:
    robot = _robot("a b c", "i a b", "j b c", "k c b")
    for shown in (tree_text, graphviz_text):
        with pytest.raises(EndlessTreeError, match=r"the joints around link '[bc]' form a loop"):
            shown(robot)


def test_too_many_ways_end_with_an_error() -> None:
    links = " ".join(f"l{i:02}" for i in range(40))
    joints = [f"{word}{i:02} l{i:02} l{i + 1:02}" for i in range(39) for word in ("a", "b")]
    with pytest.raises(EndlessTreeError, match="its links have too many parents"):
        tree_text(_robot(links, *joints))
