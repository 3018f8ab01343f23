"""What the doctor knows of built-in nodes that do one thing each."""

from __future__ import annotations

from collections.abc import Callable
from xml.sax.saxutils import escape

import pytest
from tests.doctor.conftest import Examine, Write, codes

from gazelle.doctor import Report

Launch = Callable[..., Report]

FAKE = '<node name="fake" pkg="turtlebot3_fake" type="turtlebot3_fake_node">{}</node>'
STATES = '<node name="rsp" pkg="robot_state_publisher" type="robot_state_publisher"/>'
_WHEELS = "".join(
    f'<link name="{side}"/><joint name="{side}_joint" type="continuous">'
    f'<parent link="base_footprint"/><child link="{side}"/></joint>'
    for side in ("wheel_left", "wheel_right", "arm")
)
ROBOT = escape(f'<robot name="r"><link name="base_footprint"/>{_WHEELS}</robot>', {'"': "&quot;"})
DESCRIPTION = f'<param name="robot_description" value="{ROBOT}"/>'


@pytest.fixture
def launched(written: Write, examined: Examine) -> Launch:
    """Examines the text of a launch file."""

    def run(*elements: str, **files: str) -> Report:
        folder = written(**{"one.launch": f"<launch>{''.join(elements)}</launch>"}, **files)
        return examined(folder, "bot", "one.launch")

    return run


def _silent(report: Report) -> list[str]:
    return [item.message for item in report.findings if "the state of" in item.message]


def test_fake_robot_sends_its_wheels_and_nothing_else(launched: Launch) -> None:
    (finding,) = _silent(launched(DESCRIPTION, FAKE.format(""), STATES))
    assert "arm_joint" in finding
    assert "wheel_left_joint" not in finding


def test_fake_robot_moves_the_base_in_the_odometry_frame(launched: Launch) -> None:
    frame = '<param name="odom_frame" value="world"/>'
    report = launched(DESCRIPTION, frame, FAKE.format(""), STATES)
    rows = [row for section in report.sections for row in section.rows]
    assert ("world → base_footprint", "moving", "/fake") in rows


def test_remaps_of_the_mimic_as_a_namespace_are_of_use(launched: Launch) -> None:
    mimic = '<node name="m" pkg="turtlesim" type="mimic"><remap from="{}" to="a/turtle1"/></node>'
    assert "doctor.remap-unused" not in codes(launched(mimic.format("input")))
    assert "doctor.remap-unused" in codes(launched(mimic.format("inptu")))


@pytest.mark.parametrize(
    ("package", "type_name"),
    [("turtlebot3_teleop", "turtlebot3_teleop_key"), ("turtlebot3_gazebo", "turtlebot3_drive")],
)
def test_remap_that_a_driver_has_no_use_for_is_told(
    launched: Launch, package: str, type_name: str
) -> None:
    node = f'<node name="n" pkg="{package}" type="{type_name}"><remap from="{{}}" to="x"/></node>'
    assert "doctor.remap-unused" in codes(launched(node.format("cmd_vle")))
    assert "doctor.remap-unused" not in codes(launched(node.format("cmd_vel")))
