"""Message packages are importable without being installed."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from gazelle.launch.environment import drop_in_folder


def _python(code: str, cwd: Path, **environ: str) -> str:
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=cwd,
        env={
            "PYTHONPATH": str(drop_in_folder()),
            "PATH": "/usr/bin:/bin",
            "HOME": str(cwd),
            **environ,
        },
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    package = tmp_path / "src" / "my_robot"
    (package / "msg").mkdir(parents=True)
    (package / "srv").mkdir()
    (package / "src" / "my_robot").mkdir(parents=True)
    (package / "package.xml").write_text(
        "<package format='2'><name>my_robot</name><version>0.1.0</version>"
        "<description>d</description><maintainer email='a@b.c'>a</maintainer>"
        "<license>x</license><buildtool_depend>catkin</buildtool_depend></package>"
    )
    (package / "msg" / "Wheel.msg").write_text(
        "std_msgs/Header header\nfloat64 speed\nuint8 LEFT=1\n"
    )
    (package / "srv" / "Stop.srv").write_text("bool now\n---\nstring why\n")
    (package / "src" / "my_robot" / "__init__.py").write_text("ANSWER = 7 / 2\nprint 'old'\n")
    (package / "src" / "my_robot" / "parts.py").write_text("NAME = 'part'\n")
    return tmp_path


def test_ros_messages_and_services_take_ros_1_form(tmp_path: Path) -> None:
    code = """
from geometry_msgs.msg import Twist
from std_srvs.srv import SetBool, SetBoolRequest, SetBoolResponse
from std_msgs.msg._String import String
import sensor_msgs.msg
t = Twist(); t.linear.x = 0.5
print(Twist._type, Twist._md5sum, t.linear.x)
print(SetBoolRequest(True).data, SetBool._request_class is SetBoolRequest, String('a').data)
print(sensor_msgs.msg.Image().header.seq)
"""
    assert _python(code, tmp_path).splitlines() == [
        "geometry_msgs/Twist 9f195f881246fdfa2798d1d3eebca84a 0.5",
        "True True a",
        "0",
    ]


def test_definitions_of_a_workspace_package_become_classes(workspace: Path) -> None:
    code = """
from my_robot.msg import Wheel
from my_robot.srv import Stop, StopResponse
print(Wheel.LEFT, Wheel(speed=2.0).speed, StopResponse('x').why)
"""
    assert _python(code, workspace).split() == ["old", "1", "2.0", "x"]


def test_python_module_of_a_workspace_package_is_found_and_translated(workspace: Path) -> None:
    code = "import my_robot\nfrom my_robot.parts import NAME\nprint(my_robot.ANSWER, NAME)"
    assert _python(code, workspace).split() == ["old", "3", "part"]


def test_unknown_message_is_an_import_error(tmp_path: Path) -> None:
    code = """
try:
    from std_msgs.msg import Strin
except ImportError as error:
    print(error)
"""
    assert "cannot import name 'Strin' from 'std_msgs.msg'" in _python(code, tmp_path)


def test_an_installed_sitecustomize_still_runs(tmp_path: Path) -> None:
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "sitecustomize.py").write_text("print('mine')\n")
    path = f"{drop_in_folder()}:{tmp_path / 'other'}"
    assert _python("", tmp_path, PYTHONPATH=path) == "mine\n"
