"""Names of Python programs that nothing defines."""

from __future__ import annotations

from typing import Any

import pytest


def told(check: Any, make: Any, text: str) -> list[Any]:
    root = make("", **{"scripts/go.py": text})
    codes = {"package.python-name", "package.python-attribute"}
    return [item for item in check("bot", root)[0] if item.code in codes]


NODE = """import rclpy
from rclpy.node import Node


class Driver(Node):
    def __init__(self):
        super().__init__("driver")
        self.speed_1 = 0.1
        self.create_timer(0.1, self.{0})

    def on_timer(self):
        self.get_logger().info(str(self.speed_2))
"""


@pytest.mark.parametrize(
    ("text", "words", "fix"),
    [
        ("gain = flase\n", "name 'flase' is not defined (NameError)", "did you mean 'False'?"),
        (
            "import rospy\nrospy.Publisher('a', String, queue_size=1)\n",
            "name 'String' is not defined (NameError)",
            "write above: from std_msgs.msg import String",
        ),
        (
            "def drive():\n    pass\n\n\ndirve()\n",
            "name 'dirve' is not defined (NameError)",
            "did you mean 'drive'?",
        ),
        ("qqq()\n", "name 'qqq' is not defined (NameError)", "import it, or define it above"),
    ],
)
def test_name_that_nothing_defines(check: Any, make: Any, text: str, words: str, fix: str) -> None:
    (item,) = told(check, make, text)
    assert item.message == words
    assert item.fix.startswith(fix)
    assert item.span.line == text.count("\n", 0, text.rindex(words.split("'")[1])) + 1


@pytest.mark.parametrize(
    "text",
    [
        "try:\n    unicode\nexcept NameError:\n    unicode = str\n",
        "name = raw_input('name: ')\n",
        'print "hello", xrange(3)\n',
        "from math import *\nprint(cos(pi))\n",
        "import nodes_of_mine\nnodes_of_mine.anything()\n",
    ],
)
def test_names_that_python_2_or_another_module_has(check: Any, make: Any, text: str) -> None:
    assert told(check, make, text) == []


def test_attribute_that_is_a_slip(check: Any, make: Any) -> None:
    (item,) = told(check, make, NODE.format("on_tiemr"))
    assert item.message == (
        "class Driver has no attribute 'on_tiemr' (AttributeError: 'Driver' object has no "
        "attribute 'on_tiemr')"
    )
    assert item.fix == "did you mean 'on_timer'?"
    assert (item.span.line, item.span.column) == (9, 37)


def test_attributes_of_a_base_and_numbered_ones_are_no_slips(check: Any, make: Any) -> None:
    """Nothing defines speed_2 here; a number is no slip of the finger."""
    assert told(check, make, NODE.format("on_timer")) == []
    other = NODE.format("on_tiemr").replace("(Node)", "(mine.Base)")
    assert told(check, make, f"import mine\n{other}") == []
