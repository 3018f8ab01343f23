"""A launch whose output nobody reads any more, as in ``roslaunch … | head -3``."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import psutil
import pytest
from tests.patience import stretched

_ROS1 = '<launch><node pkg="tests_pkg" type="does" name="stays" args="{args}"/></launch>'
_ROS2 = """
from launch import LaunchDescription
from launch.actions import ExecuteProcess
import sys
def generate_launch_description():
    words = {args!r}.split()
    return LaunchDescription([ExecuteProcess(cmd=[sys.executable, {script!r}, *words])])
"""


@pytest.fixture(params=["roslaunch", "ros2 launch"])
def begin(
    request: pytest.FixtureRequest, package: Path, tmp_path: Path, free_port: int
) -> Callable[[str], Any]:
    """Launches the script with arguments; its output is a pipe of the test's own."""

    def run(args: str) -> Any:
        if request.param == "roslaunch":
            file, text = tmp_path / "test.launch", _ROS1.format(args=args)
        else:
            file = tmp_path / "test.launch.py"
            text = _ROS2.format(args=args, script=str(package / "scripts" / "does"))
        file.write_text(text, encoding="utf-8")
        clean = {k: v for k, v in os.environ.items() if not k.startswith(("ROS_", "GAZELLE_"))}
        own = {"GAZELLE_PORT": str(free_port), "ROS_HOME": str(tmp_path / "home")}
        with (tmp_path / "errors").open("w") as errors:
            return subprocess.Popen(
                [sys.executable, "-m", "gazelle.cli", *request.param.split(), str(file)],
                cwd=tmp_path,
                env={**clean, **own, "GAZELLE_STUDIO": "0"},
                stdout=subprocess.PIPE,
                stderr=errors,
                text=True,
                start_new_session=True,
            )

    return run


@pytest.mark.parametrize("args", ["wait", "complain=begun wait"])
def test_launch_ends_with_its_reader(
    begin: Callable[[str], Any], args: str, tmp_path: Path
) -> None:
    launch = begin(args)
    try:
        next(line for line in launch.stdout if "started with pid" in line)
        everything = psutil.Process(launch.pid).children(recursive=True)
        launch.stdout.close()
        assert launch.wait(stretched()) == 0
    finally:
        launch.kill()
    assert not psutil.wait_procs(everything, stretched())[1]
    told = (tmp_path / "errors").read_text()
    assert "BrokenPipeError" not in told and "Traceback" not in told, told
