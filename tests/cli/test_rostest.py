"""rostest: ``<test>`` nodes run, their results are read, the exit code says it all."""

from __future__ import annotations

import unittest
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.patience import stretched

from gazelle.cli.rostest import Case, read_cases, write_suite
from gazelle.compat.rostest import rosrun

_TEST = """#!/usr/bin/env python3
import sys, time, unittest
import rospy, rostest
from std_msgs.msg import Int32

class TestIt(unittest.TestCase):
    def test_parameter(self):
        self.assertEqual(rospy.get_param("/limit"), 7)
    def test_hears(self):
        if rospy.get_param("~listens", False):
            self.assertEqual(rospy.wait_for_message("/count", Int32, PATIENCE_S).data, 5)
    def test_slow(self):
        time.sleep(rospy.get_param("~sleep", 0))
    def test_equal(self):
        self.assertEqual(rospy.get_param("~value", 1), 1)

if __name__ == "__main__":
    rospy.init_node("it")
    rostest.rosrun("demo_pkg", "it", TestIt)
"""
_TALKER = """#!/usr/bin/env python3
import rospy
from std_msgs.msg import Int32
rospy.init_node("talker")
rospy.Publisher("/count", Int32, latch=True, queue_size=1).publish(5)
rospy.spin()
"""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """demo_pkg with a test and a talker."""
    folder = tmp_path / "src" / "demo_pkg"
    (folder / "test").mkdir(parents=True)
    (folder / "package.xml").write_text(
        "<package format='2'><name>demo_pkg</name><version>0.1.0</version><description>d"
        "</description><maintainer email='a@b.example'>A</maintainer><license>MIT</license>"
        "</package>",
        encoding="utf-8",
    )
    for name, text in (
        ("it.py", _TEST.replace("PATIENCE_S", str(stretched()))),
        ("talker.py", _TALKER),
    ):
        (folder / "test" / name).write_text(text, encoding="utf-8")
        (folder / "test" / name).chmod(0o755)
    return folder


@pytest.fixture
def rostest(gazelle: Callable[..., Any], package: Path) -> Callable[[str], Any]:
    """Runs rostest on the body of a launch file."""

    def call(body: str) -> Any:
        text = f'<launch><param name="/limit" value="7"/>{body}</launch>'
        (package / "test" / "it.test").write_text(text, encoding="utf-8")
        run = gazelle(
            "rostest", "demo_pkg", "it.test", cwd=package.parent,
            ROS_PACKAGE_PATH=str(package.parent),
        )  # fmt: skip
        return run.wait(), run.text

    return call


def test_tests_pass_beside_the_nodes_of_the_file(
    rostest: Callable[[str], Any], tmp_path: Path
) -> None:
    code, text = rostest(
        '<node pkg="demo_pkg" type="talker.py" name="talker"/>'
        '<test test-name="it" pkg="demo_pkg" type="it.py"><param name="listens" value="true"/>'
        "</test>"
    )
    assert code == 0, text
    assert "[Testcase: testit] ... ok" in text
    assert "[demo_pkg.__main__.TestIt/test_hears][passed]" in text
    assert "SUMMARY\n * RESULT: SUCCESS\n * TESTS: 4\n * ERRORS: 0\n * FAILURES: 0\n" in text
    folder = tmp_path / "ros_home" / "test_results" / "demo_pkg"
    assert [one.name for one in read_cases(folder / "rosunit-it.xml")] == [
        "test_equal", "test_hears", "test_parameter", "test_slow",
    ]  # fmt: skip
    assert 'errors="0" failures="0"' in (folder / "rostest-it.xml").read_text(encoding="utf-8")


def test_failures_time_limits_and_missing_nodes_are_told(rostest: Callable[[str], Any]) -> None:
    code, text = rostest(
        '<test test-name="bad" pkg="demo_pkg" type="it.py"><param name="value" value="2"/></test>'
        '<test test-name="slow" pkg="demo_pkg" type="it.py" time-limit="1.5">'
        '<param name="sleep" value="60"/></test>'
        '<test test-name="none" pkg="demo_pkg" type="nope.py"/>'
    )
    assert code == 1
    assert "[demo_pkg.__main__.TestIt/test_equal][FAILURE]-----" in text
    assert "AssertionError: 2 != 1" in text
    assert "Test time limit of 1.5 s exceeded: [slow]" in text
    assert "Test node cannot be found: " in text
    assert " * RESULT: FAIL\n * TESTS: 6\n * ERRORS: 2\n * FAILURES: 1\n" in text


def test_results_are_read_as_they_were_written(tmp_path: Path) -> None:
    cases = [
        Case("m.C", "test_<a>", 0.5),
        Case("m.C", "test_b", 0.25, "failure", "AssertionError", "1 < 2 & 3"),
        Case("m.C", "test_c", 0.0, "error", "OSError", "gone"),
    ]
    write_suite(tmp_path / "r.xml", "suite", cases)
    assert read_cases(tmp_path / "r.xml") == cases


def test_broken_results_are_an_error(tmp_path: Path) -> None:
    (tmp_path / "r.xml").write_text("<testsuite><testcase", encoding="utf-8")
    (case,) = read_cases(tmp_path / "r.xml")
    assert case.problem == "error"
    assert case.text.startswith("the results cannot be read: ")


class _Sums(unittest.TestCase):
    def test_sum(self) -> None:
        self.assertEqual(1 + 1, 2)

    def test_wrong(self) -> None:
        with self.subTest(part=1.5):
            self.assertEqual(1 + 1, 3)

    @unittest.skip("not today")
    def test_skipped(self) -> None:
        raise OSError("never")

    def test_raises(self) -> None:
        raise OSError("gone")


# pytest would run them as tests of its own.
_Sums.__test__ = False  # type: ignore[attr-defined]


def test_rosrun_writes_junit_xml_and_ends_with_one(tmp_path: Path, capsys: Any) -> None:
    file = tmp_path / "deep" / "r.xml"
    with pytest.raises(SystemExit) as ended:
        rosrun("demo_pkg", "sums", _Sums, ["prog", f"--gtest_output=xml:{file}"])
    assert ended.value.code == 1
    problems = {one.name: one.problem for one in read_cases(file)}
    assert problems == {
        "test_raises": "error", "test_skipped": "", "test_sum": "",
        "test_wrong (part=1.5)": "failure",
    }  # fmt: skip
    assert "FAILED (failures=1, errors=1, skipped=1)" in capsys.readouterr().out


def test_file_without_tests_is_said(rostest: Callable[[str], Any]) -> None:
    code, text = rostest("")
    assert code == 1
    assert "has no <test>; roslaunch runs it" in text
