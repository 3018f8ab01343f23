"""Pain 1: which ROS a package was written for, and which one is sourced."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from tests.shared_files import SHARED, shared_cases

from gazelle.diagnostics import Diagnostics
from gazelle.doctor.packages import check_environment

EXAMPLES = Path(__file__).parents[3] / "examples"

FIXTURES = Path(__file__).parents[1] / "fixtures" / "pain_01_generations"


def test_ros1_files_in_a_ros2_package_are_told(check: Any) -> None:
    found, _ = check("old_robot", FIXTURES / "broken")
    launch, script = found.by_code("package.generations-mixed")
    assert launch.message == (
        "'launch/robot.launch' is written for ROS 1 (<node type=…> is roslaunch's), the package is "
        "built for ROS 2 (ament_cmake); a real ROS 2 cannot use the file"
    )
    assert (launch.span.line, launch.span.column) == (3, 3)
    assert (script.span.line, script.fix) == (
        2,
        "port the file, or move it to a package of its own",
    )


def test_clean_twin_has_no_finding(check: Any) -> None:
    assert list(check("old_robot", FIXTURES / "clean")[0]) == []


def test_section_says_part_distribution_reason_and_treatment(check: Any) -> None:
    _, (section,) = check("old_robot", FIXTURES / "broken")
    assert section.name == "generations"
    assert section.columns == ("part", "written for", "why", "what Gazelle does")
    rows = {(row[0], row[1]): row[2:] for row in section.rows}
    assert rows["code", "Melodic and before"] == (
        "print without parentheses is Python 2's (scripts/talk.py:4)",
        "translated when it is started",
    )
    assert ("description", "Foxy to Humble") in rows
    assert rows["package", "ROS 2"][0] == (
        "package.xml of format 3, build type ament_cmake (package.xml:2)"
    )


@pytest.mark.parametrize(
    ("name", "root"),
    [
        ("tandem_controller", EXAMPLES / "pr2_style_ws/src"),
        *shared_cases(("tutorial_controller", SHARED / "workspaces/catkin_ws/src")),
    ],
)
def test_tutorial_of_2011_is_dated(check: Any, name: str, root: Path) -> None:
    _, (section,) = check(name, root)
    texts = {(row[0], row[1]) for row in section.rows}
    assert ("launch", "Fuerte and before") in texts
    assert ("description", "Diamondback to Fuerte") in texts


def test_two_sourced_distributions_are_a_mixture() -> None:
    diagnostics = Diagnostics()
    environ = {
        "ROS_DISTRO": "humble",
        "ROS_VERSION": "2",
        "AMENT_PREFIX_PATH": "/opt/ros/humble",
        "PYTHONPATH": "/opt/ros/noetic/lib/python3/dist-packages",
    }
    check_environment(environ, diagnostics=diagnostics)
    (item,) = diagnostics.by_code("package.ros-mixed")
    assert "humble in ROS_DISTRO, AMENT_PREFIX_PATH; noetic in PYTHONPATH" in item.message
    (ended,) = diagnostics.by_code("package.ros-ended")
    assert "ROS noetic is out of support since 2025-05" in ended.message


def test_version_and_conda_that_do_not_fit() -> None:
    diagnostics = Diagnostics()
    environ = {
        "ROS_DISTRO": "jazzy",
        "ROS_VERSION": "1",
        "PYTHONPATH": "/opt/ros/jazzy/lib/python3.12/site-packages",
        "CONDA_PREFIX": "/home/me/miniconda3",
    }
    check_environment(environ, diagnostics=diagnostics)
    version, conda = diagnostics.by_code("package.ros-mixed")
    assert version.message == "ROS_VERSION is 1 and ROS_DISTRO is jazzy, which is a ROS 2"
    assert conda.fix == "conda deactivate, or unset PYTHONPATH"


def test_one_sourced_distribution_or_none_is_fine() -> None:
    diagnostics = Diagnostics()
    check_environment({}, diagnostics=diagnostics)
    one = {"ROS_DISTRO": "jazzy", "ROS_VERSION": "2", "AMENT_PREFIX_PATH": "/opt/ros/jazzy"}
    check_environment(one, diagnostics=diagnostics)
    assert len(diagnostics) == 0
