"""Python programs of packages: syntax, and the messages they import."""

from __future__ import annotations

from typing import Any

import pytest


def found(check: Any, make: Any, text: str, **files: str) -> list[Any]:
    root = make("", **{"scripts/go.py": text}, **files)
    return [item for item in check("bot", root)[0] if item.code.startswith("package.")]


def told(check: Any, make: Any, text: str, **files: str) -> list[Any]:
    codes = {"package.python-syntax", "package.import-missing"}
    return [item for item in found(check, make, text, **files) if item.code in codes]


def test_colon_that_was_forgotten(check: Any, make: Any) -> None:
    (item,) = told(check, make, "import rospy\nif rospy\n    pass\n")
    assert item.code == "package.python-syntax"
    assert item.message == "'scripts/go.py' is not Python: expected ':'"
    assert str(item.span).endswith("scripts/go.py:2:9")


def test_python_2_is_python(check: Any, make: Any) -> None:
    assert told(check, make, 'print "hello"\nexcept_ = 1\n') == []


@pytest.mark.parametrize(
    ("line", "words", "fix"),
    [
        (
            "from sensor_msgs.msg import LaserScna",
            "package 'sensor_msgs' has no msg 'LaserScna' (ImportError: cannot import name",
            "did you mean 'LaserScan'?",
        ),
        (
            "from std_srvs.srv import Emtpy",
            "package 'std_srvs' has no srv 'Emtpy'",
            "did you mean 'Empty'?",
        ),
        (
            "from sensro_msgs.msg import LaserScan",
            "there is no package 'sensro_msgs' (ModuleNotFoundError",
            "did you mean 'sensor_msgs'?",
        ),
        (
            "from bot.msg import Hors",
            "package 'bot' has no msg 'Hors'",
            "did you mean 'Horse'?",
        ),
    ],
)
def test_message_that_is_misspelt(check: Any, make: Any, line: str, words: str, fix: str) -> None:
    (item,) = told(check, make, f"import rospy\n{line}\n", **{"msg/Horse.msg": "int32 legs\n"})
    assert item.code == "package.import-missing"
    assert words in item.message
    assert (item.fix, item.span.line) == (fix, 2)


def test_what_generators_make_is_there(check: Any, make: Any) -> None:
    text = "from bot.msg import RunAction, RunGoal, RunActionResult\n"
    text += "from bot.srv import Feed, FeedRequest\nfrom geometry_msgs.msg import *\n"
    text += "from control_msgs.msg import FollowJointTrajectoryAction\n"
    text += "from somebody_elses_msgs.msg import Thing\nfrom sensor_msgs.msg import LaserScan3D\n"
    files = {"action/Run.action": "---\n---\n", "srv/Feed.srv": "---\n"}
    assert told(check, make, text, **files) == []
