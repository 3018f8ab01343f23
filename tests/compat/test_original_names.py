"""The names of ROS's Python packages are here, refused with a sentence, or listed as missing.

``original_names`` holds a file per package: a line per name with the words that it takes and the
distributions that have it (Kinetic, Melodic, Noetic, Humble, Jazzy, Rolling). ``missing`` is what
is not here yet; it can only become shorter.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from gazelle.compat.unsupported.modules import UNSUPPORTED_MODULES, why_unsupported

NAMES = Path(__file__).parent / "original_names"
_ROS1 = (
    *(
        "actionlib",
        "angles",
        "bondpy",
        "cv_bridge",
        "diagnostic_updater",
    ),
    *(
        "dynamic_reconfigure",
        "gazebo_ros",
        "genpy",
        "image_geometry",
        "laser_geometry",
    ),
    *(
        "moveit_commander",
        "ros_numpy",
        "rosbag",
        "rosgraph",
        "roslaunch",
        "roslib",
    ),
    *(
        "rosmsg",
        "rosnode",
        "rosparam",
        "rospkg",
        "rospy",
        "rosservice",
        "rostest",
    ),
    *(
        "rostopic",
        "rosunit",
        "sensor_msgs",
        "srdfdom",
        "tf",
        "tf2_geometry_msgs",
        "tf2_kdl",
    ),
    *(
        "tf2_sensor_msgs",
        "tf_conversions",
        "tf_transformations",
        "unique_id",
    ),
    *("urdf_parser_py",),
)
_ROS2 = (
    *("ament_index_python", "controller_manager", "controller_manager_msgs", "launch"),
    *("launch_param_builder", "launch_pytest", "launch_ros", "launch_testing"),
    *("launch_testing_ros", "launch_xml", "launch_yaml", "message_filters"),
    *("moveit_configs_utils", "nav2_common", "nav2_simple_commander", "rclpy"),
    *("ros_gz_bridge", "ros_gz_sim", "rosbag2_py", "rosidl_runtime_py", "sensor_msgs_py"),
    *("tf2_py", "tf2_ros"),
)


@pytest.mark.parametrize("packages", [_ROS1, _ROS2], ids=["ROS 1", "ROS 2"])
def test_names_of_the_original_are_here_or_known_to_be_missing(packages: tuple[str, ...]) -> None:
    command = [sys.executable, "-m", "gazelle.compat.script_runner", str(NAMES / "compare.py")]
    done = subprocess.run(
        [*command, *(str(NAMES / f"{package}.txt") for package in packages)],
        capture_output=True,
        text=True,
        check=True,
        env=dict(os.environ),
    )
    missing = set(json.loads(done.stdout.partition("RESULT")[2]))
    known = {
        line
        for line in (NAMES / "missing").read_text(encoding="utf-8").splitlines()
        if line.partition(".")[0] in packages
    }
    assert missing == known


def test_refused_modules_say_what_they_are() -> None:
    assert [row.module for row in UNSUPPORTED_MODULES] == sorted(
        {row.module for row in UNSUPPORTED_MODULES}
    )
    sentence = why_unsupported("osrf_pycommon.process_utils")
    assert sentence is not None
    assert sentence.startswith("No module named 'osrf_pycommon.process_utils': gazelle: it is part")
    assert "pip install osrf-pycommon" in sentence
    assert why_unsupported("rclpy.node") is None
    listed = {
        line.split(" ")[0].split("(")[0]
        for file in NAMES.glob("*.txt")
        for line in file.read_text(encoding="utf-8").splitlines()
    }
    assert {row.module for row in UNSUPPORTED_MODULES} <= listed


_USES = (
    (
        "from rclpy.waitable import Waitable",
        "ModuleNotFoundError: No module named 'rclpy.waitable': gazelle: it is rclpy's inside",
    ),
    (
        "from rclpy.impl.rcutils_logger import RcutilsLogger",
        "No module named 'rclpy.impl.rcutils_logger': gazelle: it is rclpy's inside",
    ),
    (
        "from launch.frontend.parse_substitution import get_grammar_path",
        "ImportError: cannot import name 'get_grammar_path' from",
    ),
    (
        "import rclpy.clock; rclpy.clock.ClockHandle",
        "has no attribute 'ClockHandle': gazelle: it belongs to rclpy's C library",
    ),
    (
        "from rclpy.node import Node; Node.__new__(Node).handle",
        "AttributeError: 'Node' object has no attribute 'handle': gazelle: it belongs to",
    ),
    (
        "from rclpy.client import Client; Client(client_impl=1)",
        "TypeError: Client() got an unexpected keyword argument 'client_impl': gazelle: it is"
        " filled in by rclpy itself",
    ),
)
# Each in the same process, told as Python itself would.
_EACH = """
import json, sys, traceback
for program in json.loads(sys.argv[1]):
    print("==", file=sys.stderr)
    try:
        exec(program, {})
    except Exception:
        traceback.print_exc()
"""


@pytest.fixture(scope="module")
def told() -> dict[str, str]:
    """What each use of a refused name ends with."""
    programs = [program for program, _ in _USES]
    done = _python(_EACH, json.dumps(programs))
    return dict(zip(programs, done.stderr.split("==\n")[1:], strict=True))


@pytest.mark.parametrize(("program", "error"), _USES)
def test_uses_of_refused_names_end_with_their_sentence(
    told: dict[str, str], program: str, error: str
) -> None:
    assert error in told[program]
    assert "gazelle: it " in told[program]


def test_refused_names_are_not_there_and_a_users_own_are() -> None:
    program = """
import rclpy.clock, rclpy.node
class Mine(rclpy.node.Node):
    handle = 3
    def __init__(self):
        self.waitables = 4
print(hasattr(rclpy.clock, "ClockHandle"), hasattr(rclpy.node.Node, "handle"), Mine().handle)
print(Mine().waitables)
"""
    done = _python(program)
    assert done.stdout == "False False 3\n4\n", done.stderr


def _python(program: str, *words: str) -> subprocess.CompletedProcess[str]:
    file = "import gazelle.compat.import_hooks as f; f.install()\n" + program
    modules = Path(__file__).parents[2] / "src" / "gazelle" / "compat" / "modules"
    return subprocess.run(
        [sys.executable, "-c", f"import sys; sys.path.insert(0, {str(modules)!r}); {file}", *words],
        capture_output=True,
        text=True,
        check=False,
    )
