"""Rows T1 to T4: the first section of the document TOOLS, typed into terminals as printed."""

from __future__ import annotations

import re
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from pathlib import Path
from statistics import median
from typing import NamedTuple

import pytest
from tests.patience import eventually, undisturbed
from tests.tutorial.terminals import Terminal

from gazelle.bag import open_bag

pytestmark = pytest.mark.tutorial

Open = Callable[[], Terminal]
_PRESSES = 40
_POSE = "/turtle1/pose"
_UP, _LEFT = "\x1b[A", "\x1b[D"
_TWIST = """\
geometry_msgs/Vector3 linear
  float64 x
  float64 y
  float64 z
geometry_msgs/Vector3 angular
  float64 x
  float64 y
  float64 z
"""
_NODE_INFO = """\
--------------------------------------------------------------------------------
Node [/turtlesim]
Publications: 
 * /rosout [rosgraph_msgs/Log]
 * /turtle1/color_sensor [turtlesim/Color]
 * /turtle1/pose [turtlesim/Pose]
"""  # noqa: W291 - as the original prints it
_INFO = r"""path:        \S+\.bag
version:     2\.0
duration:    \d\.\ds
start:       \w{3} \d\d 20\d\d \d\d:\d\d:\d\d\.\d\d \(\d+\.\d\d\)
end:         \w{3} \d\d 20\d\d \d\d:\d\d:\d\d\.\d\d \(\d+\.\d\d\)
size:        \d+\.\d KB
messages:    \d+
compression: none \[(\d+)/\1 chunks\]
types:       geometry_msgs/Twist \[9f195f881246fdfa2798d1d3eebca84a\]
             rosgraph_msgs/Log   \[acffd30cd6b6de30f120938c17c593fb\]
             turtlesim/Color     \[353891e354491c51aabe32df673fb446\]
             turtlesim/Pose      \[863b248d5016ca62ea2e895ae5265cf9\]
topics:      /rosout                +\d+ msgs? +: rosgraph_msgs/Log *
             /rosout_agg            +\d+ msgs? +: rosgraph_msgs/Log *
             /turtle1/cmd_vel       +2 msgs    : geometry_msgs/Twist
             /turtle1/color_sensor +\d+ msgs    : turtlesim/Color *
             /turtle1/pose         +\d+ msgs    : turtlesim/Pose *
             /turtle2/color_sensor +\d+ msgs    : turtlesim/Color *
             /turtle2/pose         +\d+ msgs    : turtlesim/Pose
"""
_NO_WINDOW = r"\[{0}\] no window opens: .*the node stays alive"


class _Desk(NamedTuple):
    """Four terminals: three are taken by programs that stay."""

    core: Terminal
    turtle: Terminal
    keys: Terminal
    free: Terminal


@pytest.fixture
def desk(open_terminal: Open) -> _Desk:
    """The document's turtle, ready to be driven."""
    with ThreadPoolExecutor() as pool:
        desk = _Desk(*pool.map(lambda _name: open_terminal(), _Desk._fields))
    desk.core.start("roscore", r"^started core service \[/rosout\]$")
    desk.turtle.start("rosrun turtlesim turtlesim_node", r"Spawning turtle \[turtle1\]")
    desk.keys.start("rosrun turtlesim turtle_teleop_key", r"^Use arrow keys to move the turtle\.")
    return desk


def test_first_section_of_the_document_is_typed(desk: _Desk, tmp_path: Path) -> None:
    _look_at_the_graph(desk)
    _drive(desk)
    _record_and_play(desk, tmp_path)
    desk.keys.type("q")
    assert desk.keys.ended() == ""
    told = desk.free.run("rosnode info /teleop_turtle")
    assert "cannot contact [/teleop_turtle]: unknown node" in told
    desk.turtle.interrupt(code=0)
    assert "done\n" in desk.core.interrupt(code=0)


def _look_at_the_graph(desk: _Desk) -> None:
    run = desk.free.run
    assert run("rosnode list") == "/rosout\n/teleop_turtle\n/turtlesim\n"
    assert run("rosnode info /turtlesim").startswith(_NODE_INFO)
    assert run("rostopic list").split() == [
        "/rosout", "/rosout_agg", "/turtle1/cmd_vel", "/turtle1/color_sensor", "/turtle1/pose",
    ]  # fmt: skip
    assert " * /turtle1/cmd_vel [geometry_msgs/Twist] 1 subscriber\n" in run("rostopic list -v")
    assert run("rostopic type /turtle1/cmd_vel | rosmsg show") == f"{_TWIST}\n"
    desk.free.start("rostopic hz /turtle1/pose", r"^average rate: \d\d\.\d+$")
    assert re.search(r"^\tmin: 0\.0\d\ds max: .* std dev: .* window: \d+$", desk.free.text, re.M)
    desk.free.interrupt(code=0)
    # The document's windows are panels of the page, which is switched off here.
    for name in ("rqt_graph", "rqt_plot"):
        desk.free.start(f"rosrun {name} {name}", _NO_WINDOW.format(name))
        desk.free.interrupt(code=0)


def _drive(desk: _Desk) -> None:
    run = desk.free.run
    desk.free.start("rostopic echo /turtle1/pose", r"^linear_velocity: 0\.0$")
    desk.keys.type(_UP)
    desk.free.wait_for(r"^linear_velocity: 2\.0$")
    desk.free.interrupt(code=0)
    twist = "geometry_msgs/Twist -- '[2.0, 0.0, 0.0]' '[0.0, 0.0, 1.8]'"
    told = run(f"rostopic pub -1 /turtle1/cmd_vel {twist}")
    assert told == "publishing and latching message for 3.0 seconds\n"
    # A command holds for a second.
    assert re.search(r"theta: 1\.[5-8]", run("rostopic echo -n1 /turtle1/pose"))
    assert run('rosservice call /spawn 2 2 0.2 ""') == 'name: "turtle2"\n'
    assert "/turtle2/pose\n" in run("rostopic list")
    assert run("rosparam get /turtlesim/background_b") == "255\n"
    run("rosparam set /turtlesim/background_r 150")
    assert run("rosservice call /clear") == "\n"


def _record_and_play(desk: _Desk, tmp_path: Path) -> None:
    run = desk.free.run
    desk.free.start("rosbag record -a", r"Recording to '.*'\.$")
    # Topics are listened to one after the other, that of the keys before the poses.
    _wait_for_poses(tmp_path, 20)
    desk.keys.type(_UP)
    _wait_for_poses(tmp_path, 80)
    desk.keys.type(_LEFT)
    _wait_for_poses(tmp_path, 120)
    desk.free.interrupt(code=0)
    (file,) = tmp_path.glob("????-??-??-??-??-??.bag")
    _check_bag(file)
    assert re.fullmatch(_INFO, run(f"rosbag info {file.name}"))
    for words, rate in (("", 1.0), ("-r 2 ", 2.0)):
        line = f"rosbag play {words}{file.name}"
        # What the terminal shows begins a little before the first message.
        undisturbed(lambda line=line: _played_s(desk.free, line), _duration_s(file) / rate, rel=0.5)
    desk.free.start(
        "rosbag record -O subset /turtle1/cmd_vel /turtle1/pose", r"Recording to 'subset.bag'\.$"
    )
    for _ in range(_PRESSES):
        # On a busy machine the recorder may still be about to listen.
        desk.keys.type(_UP)
        desk.keys.pause(0.5)
        if len(_counts(tmp_path / "subset.bag.active")) == 2:
            break
    desk.free.interrupt(code=0)
    assert set(_counts(tmp_path / "subset.bag")) == {"/turtle1/cmd_vel", "/turtle1/pose"}
    # The system stops what touches the terminal in the background; this does not.
    assert "Stopped" not in run("rosbag play -q -r 9 subset.bag & wait")


def test_words_as_printed_by_web_pages_are_told(open_terminal: Open) -> None:
    run = open_terminal().run
    told = run("rosbag play \u2013r 2 turtle.bag", code=1)
    assert "rosbag: '\u2013r' begins with '\u2013' (U+2013), a dash of printed text" in told
    assert told.endswith("options begin with '-': -r\n")
    assert "a quotation mark of printed text" in run("rosnode info \u201c/turtlesim\u201d", code=1)


def _check_bag(file: Path) -> None:
    counts = _counts(file)
    assert set(counts) == {
        "/rosout", "/rosout_agg", "/turtle1/cmd_vel", "/turtle1/color_sensor", "/turtle1/pose",
        "/turtle2/color_sensor", "/turtle2/pose",
    }  # fmt: skip
    assert counts["/turtle1/cmd_vel"] == 2
    # The turtle tells its pose at 62.5 Hz, now and then later where others want the cores.
    stamps_ns = [one.stamp_ns for one in open_bag(file).messages() if one.connection.topic == _POSE]
    assert median(b - a for a, b in pairwise(stamps_ns)) == pytest.approx(16e6, rel=0.3)


def _wait_for_poses(folder: Path, count: int) -> None:
    """Wait until a recorder that is at work has so many."""
    (file,) = folder.glob("????-??-??-??-??-??.bag.active")
    eventually(lambda: _counts(file).get(_POSE, 0) >= count)


def _counts(file: Path) -> dict[str, int]:
    bag = open_bag(file)
    return {one.topic: bag.summary.counts[one.id] for one in bag.connections}


def _duration_s(file: Path) -> float:
    summary = open_bag(file).summary
    return (summary.end_ns - summary.start_ns) / 1e9


def _played_s(terminal: Terminal, line: str) -> float:
    """Play a bag and return how long the terminal showed it running."""
    terminal.start(line, r"\[RUNNING\]")
    start_s = time.monotonic()
    assert terminal.ended().endswith("Done.\n")
    return time.monotonic() - start_s
