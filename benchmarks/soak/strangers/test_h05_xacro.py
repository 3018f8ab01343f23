"""xacro's own tests, with Gazelle's command and its library (ROS 1 Noetic)."""

from __future__ import annotations

import re
from collections import Counter
from xml.etree import ElementTree

from stage import Stage, robot_parts

PR2 = "test/robots/pr2/pr2.urdf.xacro"
# Arguments of a macro out of a file with a namespace are read where it is called, since xacro
# 2.1.0 (ros/xacro#373); this test of 1.14 wants them read in the macro's file.
CORRECTED_SINCE = {"test_property_resolution_with_namespaced_include"}


def test_the_library_passes_its_143_tests(stage: Stage) -> None:
    ran = stage.run("shell python3 -m unittest test_xacro", cwd="xacro/test", traceback=True)
    assert "Ran 143 tests" in ran.output, ran.output
    assert set(re.findall(r"^(?:ERROR|FAIL): (\w+)", ran.output, re.M)) == CORRECTED_SINCE


def test_the_pr2_is_what_it_was_with_xacro_1_11(stage: Stage) -> None:
    expanded = stage.run(f"xacro {PR2}", cwd="xacro")
    assert expanded.code == 0, expanded.output
    parts = robot_parts(expanded.stdout)
    assert (len(parts.links), len(parts.joints)) == (95, 94)
    robot = ElementTree.fromstring(expanded.stdout)
    assert len(robot.findall("transmission")) == 30
    assert len(robot.findall("gazebo")) == 111
    then = ElementTree.parse(stage.folder / "xacro/test/robots/pr2/pr2_1.11.4.xml").getroot()
    tags = Counter(one.tag for one in robot.iter())
    assert tags.total() == 2654
    assert tags == Counter(one.tag for one in then.iter())


def test_broken_xml_is_told_with_its_place_and_file(stage: Stage) -> None:
    broken = stage.run("xacro broken.xacro", cwd="xacro/test")
    assert broken.code == 2
    assert broken.stdout == ""
    assert broken.output.startswith(
        "XML parsing error: syntax error: line 1, column 0\nwhen processing file: broken.xacro\n"
    )


def test_a_missing_file_is_told_by_name(stage: Stage) -> None:
    missing = stage.run("xacro nofile.xacro", cwd="xacro/test")
    assert missing.code == 2
    # xacro 2.1 looks in its folder of the moment, "./"; until 2.0 the name stood alone.
    assert missing.output.startswith("error: No such file or directory: ./nofile.xacro")


def test_location_is_printed_beside_the_result(stage: Stage) -> None:
    located = stage.run("xacro location.xacro", cwd="xacro/test")
    assert located.code == 0
    assert located.stdout.rstrip().endswith("<a></a>")
    assert located.output.removeprefix(located.stdout) == "when processing file: location.xacro\n"


def test_emoji_and_a_macro_that_nobody_calls_are_fine(stage: Stage) -> None:
    assert "🍔" in stage.run("xacro emoji.xacro", cwd="xacro/test").stdout
    raising = stage.run("xacro raise.xacro", cwd="xacro/test")
    assert raising.code == 0, raising.output
    assert raising.output == raising.stdout
