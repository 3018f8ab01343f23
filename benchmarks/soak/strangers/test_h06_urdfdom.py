"""urdfdom's own robots, out of its C++ tests, and its program check_urdf (Humble)."""

from __future__ import annotations

import ast
import json
import re
import shlex
from pathlib import Path

import pytest
from stage import Stage

SOURCES = ("urdf_unit_test.cpp", "urdf_version_test.cpp")
PARSED = "---------- Successfully Parsed XML ---------------"
GOOD = {
    "parse_joint_doubles", "parse_link_doubles", "parse_color_doubles",
    "test_version_not_specified", "test_version_one_float",
}  # fmt: skip
BAD = {"test_version_wrong_type", "test_version_unsupported_version", "test_version_one_int"}
READ_BACK = """
import json, sys
from urdf_parser_py.urdf import URDF
robot = URDF.from_xml_string(sys.stdin.read())
j1, l1 = robot.joint_map["j1"], robot.link_map["l1"]
found = {
    "dynamics": j1.dynamics and [j1.dynamics.damping, j1.dynamics.friction],
    "limit": j1.limit and [j1.limit.lower, j1.limit.upper, j1.limit.effort, j1.limit.velocity],
    "mimic": j1.mimic and [j1.mimic.joint, j1.mimic.multiplier, j1.mimic.offset],
    "radius": l1.visual and l1.visual.geometry.radius,
    "mass": l1.inertial and l1.inertial.mass,
    "colour": l1.visual and l1.visual.material and l1.visual.material.color.rgba,
}
print(json.dumps(found))
"""


@pytest.fixture(scope="module")
def robots(folder: Path) -> dict[str, str]:
    """The robots in the C++ tests, by the test's name."""
    found = {}
    for source in SOURCES:
        text = (folder / "urdfdom/urdf_parser/test" / source).read_text()
        for test in text.split("\nTEST(")[1:]:
            literal = re.search(r'_str\s*=((?:\s*"(?:\\.|[^"\\])*")+)\s*;', test)
            if literal:
                # Neighbouring strings are one, with the same escapes, in C++ and Python.
                name = test.partition(",")[2].partition(")")[0].strip()
                found[name] = ast.literal_eval(f"({literal[1]})")
    return found


def test_check_urdf_tells_good_robots_from_bad(stage: Stage, robots: dict[str, str]) -> None:
    assert set(robots) == GOOD | BAD
    for name, text in robots.items():
        checked = stage.run("check_urdf /dev/stdin", stdin=text)
        if name in GOOD:
            assert checked.code == 0, checked.output
            assert checked.stdout.startswith(f"robot name is: test\n{PARSED}\nroot Link: l1 has")
        else:
            assert checked.code == 255, checked.output
            assert checked.stdout == ""
            assert "ERROR: Model Parsing the xml failed\n" in checked.output


def test_a_link_with_two_parents_is_a_child_twice(stage: Stage, robots: dict[str, str]) -> None:
    checked = stage.run("check_urdf /dev/stdin", stdin=robots["parse_joint_doubles"])
    assert checked.stdout.splitlines() == [
        "robot name is: test", PARSED, "root Link: l1 has 2 child(ren)",
        "    child(1):  l2", "    child(2):  l2",
    ]  # fmt: skip


def test_check_urdf_without_a_file_says_what_it_expects(stage: Stage) -> None:
    alone = stage.run("check_urdf")
    assert alone.code == 255
    assert "Expect URDF xml file to parse" in alone.output


def test_numbers_are_read_as_they_are_written(stage: Stage, robots: dict[str, str]) -> None:
    def read_back(name: str) -> dict[str, object]:
        ran = stage.run(f"shell python3 -c {shlex.quote(READ_BACK)}", stdin=robots[name])
        assert ran.code == 0, ran.output
        found: dict[str, object] = json.loads(ran.stdout)
        return found

    joint = read_back("parse_joint_doubles")
    assert joint["dynamics"] == [87.098, 3.129]
    assert joint["limit"] == [12.34, 22.999, 99.0, 23.0]
    assert joint["mimic"] == ["j2", 9.87, 0.098]
    link = read_back("parse_color_doubles")
    assert link["colour"] == [1.0, 0.65, 0.0, 0.01]
    assert (link["radius"], link["mass"]) == (1.349, 8.4396)


@pytest.mark.parametrize(
    ("vector", "words"),
    [
        ("1.0 foo 3.0", "Unable to parse component [foo] to a double"),
        ("1.0 2.10.110 3.0", "Unable to parse component [2.10.110] to a double"),
        ("1.0 2.0", "Parser found 2 elements but 3 expected while parsing vector [1.0 2.0]"),
        ("1 2 3 4", "Parser found 4 elements but 3 expected while parsing vector [1 2 3 4]"),
    ],
)
def test_a_wrong_vector_is_an_error(stage: Stage, vector: str, words: str) -> None:
    robot = f"""<robot name="test"><link name="l1"/><link name="l2"/>
      <joint name="j1" type="fixed"><origin xyz="{vector}"/>
        <parent link="l1"/><child link="l2"/></joint></robot>"""
    checked = stage.run("check_urdf /dev/stdin", stdin=robot)
    assert checked.code == 255, checked.output
    assert "ERROR: Model Parsing the xml failed\n" in checked.output
    assert words in checked.output
