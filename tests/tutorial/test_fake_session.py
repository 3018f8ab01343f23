"""Row T7 typed into terminals as the document TOOLS prints it, from ``catkin_make`` on."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from tests.tutorial.terminals import Terminal

pytestmark = pytest.mark.tutorial

_EMPTY_LINE = "\x15"
_KEYS_OF_TELEOP = r"^CTRL-C to quit$"


@pytest.fixture(scope="module")
def terminals(
    open_module_terminal: Callable[[], Terminal], workspaces_dir: Path, module_folder: Path
) -> list[Terminal]:
    """Three terminals; the published packages lie in ``~/catkin_ws/src``."""
    shutil.copytree(workspaces_dir / "turtlebot3_ws" / "src", module_folder / "catkin_ws" / "src")
    (module_folder / "catkin_ws").chmod(0o755)
    with ThreadPoolExecutor() as pool:
        opened = list(pool.map(lambda _number: open_module_terminal(), range(3)))
    assert "Build files are in: " in opened[0].run("cd ~/catkin_ws && catkin_make")
    for one in opened:
        one.run("source ~/catkin_ws/devel/setup.bash")
    return opened


def test_fake_turtlebot_is_launched_driven_and_echoed(terminals: list[Terminal]) -> None:
    robot, keys, free = terminals
    told = robot.run("roslaunch turtlebot3_fake turtlebot3_fake.launch", code=1)
    assert "environment variable 'TURTLEBOT3_MODEL' is not set" in told
    for one in (robot, keys):
        one.run("export TURTLEBOT3_MODEL=waffle")
    robot.start(
        "roslaunch turtlebot3_fake turtlebot3_fake.launch",
        r"^process\[turtlebot3_fake_node-\d+\]: started with pid \[\d+\]$",
    )
    keys.start("roslaunch turtlebot3_teleop turtlebot3_teleop_key.launch", _KEYS_OF_TELEOP)
    # The second launch belongs to the run of the first, as with one master.
    assert _log_folder(robot) == _log_folder(keys)
    for key in "wwa":
        keys.type(key)
        keys.wait_for(r"^currently:\tlinear vel 0\.0[12]\t angular vel 0\.[01]")
    free.start("rostopic echo /odom", r'^child_frame_id: "base_footprint"$')
    free.wait_for(r"^    linear: \n      x: 0\.02\n(.*\n){5}      z: 0\.1$")
    free.interrupt(code=0)
    free.start("rosrun rqt_tf_tree rqt_tf_tree", r"\[rqt_tf_tree\] no window opens")
    free.interrupt(code=0)
    assert "done\n" in keys.interrupt(code=0)
    assert "[turtlebot3_fake_node-" in robot.interrupt(code=0)
    shown = free.run(f"cat {_log_folder(robot)}/roslaunch-*.log")
    assert "[roslaunch][INFO] " in shown
    assert "killing on exit" in shown


def test_tab_completes_what_is_typed(terminals: list[Terminal]) -> None:
    _robot, keys, free = terminals
    keys.start("roscore", r"started core service")
    free.run("export TURTLEBOT3_MODEL=waffle")
    # What is asked for once is completed once: the topic has to be there.
    assert any("/rosout_agg" in free.run("rostopic list") for _ in range(20))
    for typed, wanted in (
        ("rostopic echo /rosout_\t", "rostopic echo /rosout_agg "),
        ("roslaunch turtlebot3_fa\t", "roslaunch turtlebot3_fake "),
        (
            "roslaunch turtlebot3_fake turtlebot3_fake.launch mo\t",
            "roslaunch turtlebot3_fake turtlebot3_fake.launch model:=",
        ),
        ("rosmsg show geometry_msgs/TwistW\t", "rosmsg show geometry_msgs/TwistWithCovariance"),
        ("rosparam get /run\t", "rosparam get /run_id "),
        (
            "ros2 interface show geometry_msgs/msg/Poly\t",
            "ros2 interface show geometry_msgs/msg/Polygon",
        ),
        ("rosrun turtlesim turtlesim_n\t", "rosrun turtlesim turtlesim_node "),
    ):
        free.type(typed)
        free.wait_for(re.escape(wanted))
        free.type(_EMPTY_LINE)
    keys.interrupt(code=0)


def _log_folder(terminal: Terminal) -> str:
    return str(re.findall(r"\.\.\. logging to (\S+)/roslaunch-", terminal.text)[-1])
