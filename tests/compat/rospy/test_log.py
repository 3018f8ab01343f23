"""logdebug … logfatal: layout, streams, levels, /rosout, throttling, files."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

from gazelle.graph import Node

Run = Callable[..., Any]

_LEVELS = """
import rospy
rospy.init_node("speaker", log_level=rospy.DEBUG)
rospy.logdebug("detail %d", 1)
rospy.loginfo("100%")
rospy.logwarn("careful %s", "there")
rospy.logerr("wrong")
rospy.logfatal("over")
for _ in range(3):
    rospy.loginfo_once("once")
    rospy.logwarn_throttle(60, "rarely")
for text in ("a", "a", "b"):
    rospy.loginfo_throttle_identical(60, "said " + text)
"""


def test_lines_have_rospys_layout_and_levels_their_streams(passes: Run) -> None:
    done = passes(_LEVELS)
    said = [line for line in done.lines if re.match(r"\[[A-Z]+\] \[\d+\.\d{6}\]: ", line)]
    plain = [re.sub(r" \[\d+\.\d{6}\]", "", line) for line in said]
    assert sorted(plain) == sorted([
        "[DEBUG]: detail 1", "[INFO]: 100%", "[WARN]: careful there", "[ERROR]: wrong",
        "[FATAL]: over", "[INFO]: once", "[WARN]: rarely", "[INFO]: said a", "[INFO]: said b",
    ])  # fmt: skip


def test_debug_is_silent_unless_asked_for(passes: Run) -> None:
    done = passes("import rospy\nrospy.init_node('quiet')\nrospy.logdebug('hidden')\n")
    assert "hidden" not in done.text


def test_layout_follows_rosconsole_format(passes: Run) -> None:
    done = passes(
        "import rospy\nrospy.init_node('quiet')\nrospy.logwarn('look')\n",
        ROSCONSOLE_FORMAT="${severity}|${node}|${message}",
    )
    assert "WARN|/quiet|look" in done.lines


def test_rosout_tells_who_said_what_and_where(passes: Run, node: Node) -> None:
    heard: list[Any] = []
    node.create_subscription("/rosout", "rcl_interfaces/msg/Log", heard.append)
    code = (
        "import rospy\nrospy.init_node('speaker')\ndef tell():\n    rospy.logwarn('look')\ntell()\n"
    )
    done = passes(code)
    (log,) = done.eventually(lambda: [item for item in heard if item.msg == "look"])
    assert (log.name, log.level, log.function, log.line) == ("/speaker", 30, "tell", 4)
    assert log.file.endswith("program.py")


def test_log_argument_names_the_file(passes: Run, tmp_path: Path) -> None:
    file = tmp_path / "logs" / "speaker.log"
    passes("import rospy\nrospy.init_node('s')\nrospy.loginfo('kept')\n", f"__log:={file}")
    assert file.read_text(encoding="utf-8").endswith("]: kept\n")
