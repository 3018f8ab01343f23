"""Runs the real programs of ROS 1."""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

_PATIENCE_S = 30.0


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
            timeout=_PATIENCE_S, check=False,
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
