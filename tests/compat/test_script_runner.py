"""User programs as ``__main__``, as scripts and as entry points."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

PACKAGE = """<package format="3"><name>py_pubsub</name><version>0.0.0</version>
<description>d</description><maintainer email="a@b.c">a</maintainer><license>x</license>
<export><build_type>ament_python</build_type></export></package>
"""
SETUP = """from setuptools import setup
package_name = 'py_pubsub'
setup(name=package_name, packages=[package_name], entry_points={
    'console_scripts': ['talker = py_pubsub.publisher_member_function:main']})
"""
HELPER = """from geometry_msgs.msg import TransformStamped
def make():
    found = TransformStamped()
    found.header.stamp.nanosec = 5
    return found
"""
NODE = """import sys
from .helper import make
def main():
    print(make().header.stamp.nanosec, sys.argv[1:], __name__)
    return 3
"""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """An ament package with a node that only its entry point starts."""
    folder = tmp_path / "src" / "py_pubsub"
    (folder / "py_pubsub").mkdir(parents=True)
    (folder / "package.xml").write_text(PACKAGE)
    (folder / "setup.py").write_text(SETUP)
    (folder / "py_pubsub" / "__init__.py").write_text("")
    (folder / "py_pubsub" / "helper.py").write_text(HELPER)
    (folder / "py_pubsub" / "publisher_member_function.py").write_text(NODE)
    return tmp_path


def test_entry_point_of_a_package_is_called_as_its_script_would(
    gazelle: Callable[..., Any], package: Path
) -> None:
    running = gazelle("rosrun", "py_pubsub", "talker", "word", cwd=package)
    assert running.wait() == 3, running.text
    assert running.lines[-1] == "5 ['word'] py_pubsub.publisher_member_function"


@pytest.mark.parametrize(("first", "name"), [("rospy", "nsecs"), ("rclpy", "nanosec")])
def test_code_on_the_command_line_says_which_messages_it_wants(
    package: Path, first: str, name: str
) -> None:
    from gazelle.launch.environment import drop_in_folder

    code = f"from std_msgs.msg import Header\nimport {first}\nHeader().stamp.{name}"
    environ = {"PYTHONPATH": str(drop_in_folder()), "PATH": "/usr/bin:/bin", "HOME": str(package)}
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=package,
        env=environ,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr


def test_a_traceback_begins_in_the_users_file(tmp_path: Path) -> None:
    script = tmp_path / "dies.py"
    script.write_text("def work():\n    return [].pop()\nwork()\n")
    words = [sys.executable, "-m", "gazelle.compat.script_runner", str(script)]
    ran = subprocess.run(words, capture_output=True, text=True, check=False)
    lines = ran.stderr.splitlines()
    assert ran.returncode == 1
    assert lines[:2] == [
        "Traceback (most recent call last):",
        f'  File "{script}", line 3, in <module>',
    ]
    assert lines[-1] == "IndexError: pop from empty list"
    assert "/gazelle/" not in ran.stderr
