"""Runs the real programs of ROS 1."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from tests.patience import stretched

NO_ROS1 = "ROS 1 is not installed (Debian: apt-get install ros-core python3-rosbag …)"


@cache
def has_ros1() -> bool:
    """Tell whether the real programs of ROS 1 are here."""
    words = ["/usr/bin/python3", "-c", "import rospy, rostopic, rosbag, nav_msgs.msg, std_srvs.srv"]
    try:
        subprocess.run(words, check=True, capture_output=True, env={"PATH": "/usr/bin"})
    except (OSError, subprocess.CalledProcessError):
        return False
    return True


def skip_module_without_ros1() -> None:
    """Skip a module as a whole where ROS 1 is not installed."""
    if not has_ros1():
        pytest.skip(NO_ROS1, allow_module_level=True)


class Ros1:
    """Runs real programs with a clean environment."""

    def __init__(self, master: str, folder: Path) -> None:
        self._folder = folder
        self._environ = {
            "HOME": str(folder),
            "PATH": "/usr/bin:/bin",
            "PYTHONUNBUFFERED": "1",
            "ROS_MASTER_URI": master,
            "ROS_PACKAGE_PATH": "/usr/share",
        }

    def __call__(self, *words: str) -> str:
        """What a program prints; it must end well."""
        done = subprocess.run(
            words, env=self._environ, cwd=self._folder, capture_output=True, text=True,
            timeout=stretched(), check=False,
        )  # fmt: skip
        assert done.returncode == 0, f"{words}: {done.stdout}{done.stderr}"
        return done.stdout

    @contextmanager
    def running(self, *words: str) -> Iterator[subprocess.Popen[str]]:
        """A program in the background, ended afterwards."""
        with subprocess.Popen(
            words, env=self._environ, cwd=self._folder, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        ) as process:  # fmt: skip
            try:
                yield process
            finally:
                process.terminate()

    def python(self, code: str) -> Any:
        """A program of rospy in the background."""
        return self.running("/usr/bin/python3", "-c", code)
