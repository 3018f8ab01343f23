"""rosunit and rostest: a program's own cases, their report and the exit code."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from pathlib import Path
from typing import Any

PROGRAM = """
import sys, unittest, rospy, rostest
from std_msgs.msg import String
class TestTalk(unittest.TestCase):
    def test_message_arrives(self):
        rospy.init_node('test_talk')
        pub = rospy.Publisher('chatter', String, queue_size=1, latch=True)
        pub.publish('hello')
        self.assertEqual(rospy.wait_for_message('chatter', String, timeout=30).data, WANTED)
rostest.rosrun('my_pkg', 'test_talk', TestTalk, sys.argv)
"""


def test_passing_cases_give_zero_and_a_report(program: Callable[..., Any], tmp_path: Path) -> None:
    file = tmp_path / "results" / "r.xml"
    done = program(PROGRAM.replace("WANTED", "'hello'"), f"--gtest_output=xml:{file}")
    assert done.wait() == 0, done.text
    suite = ElementTree.parse(file).getroot()
    assert suite.attrib["name"] == "my_pkg.test_talk"
    assert (suite.attrib["tests"], suite.attrib["failures"]) == ("1", "0")


def test_failing_case_gives_one_and_is_named(program: Callable[..., Any], tmp_path: Path) -> None:
    file = tmp_path / "r.xml"
    done = program(PROGRAM.replace("WANTED", "'bye'"), f"--gtest_output=xml:{file}")
    assert done.wait() == 1
    failure = ElementTree.parse(file).getroot().find("testcase/failure")
    assert failure is not None and "AssertionError: 'hello' != 'bye'" in (failure.text or "")


def test_rosunit_runs_cases_without_ros(program: Callable[..., Any]) -> None:
    done = program(
        "import unittest, rosunit\n"
        "class Bare(unittest.TestCase):\n"
        "    def test_sum(self):\n        self.assertEqual(1 + 1, 2)\n"
        "rosunit.unitrun('p', 't', Bare, ['p', '--text'])\n"
    )
    assert done.wait() == 0 and "test_sum" in done.text and "OK" in done.text


def test_programs_of_rosbag2_get_messages_of_ros2(passes: Callable[..., Any]) -> None:
    passes(
        """
import rosbag2_py
from std_msgs.msg import String
assert hasattr(String, 'FIELDS') and not hasattr(String, '_slot_types')
"""
    )
