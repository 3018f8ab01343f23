"""``gazebo [options] [world]``: a world, and the panel that shows it."""

from __future__ import annotations

import os
import subprocess
import sys

from gazelle.cli import gzserver
from gazelle.process_lifetime import PARENT_VARIABLE

__all__ = ["main"]

# They only print.
_OPTIONS = frozenset({"-h", "--help", "--version"})


def main(argv: list[str]) -> int:
    """Run a world in this process until Ctrl-C; the panel ends with it."""
    if _OPTIONS & set(argv):
        return gzserver.main(argv)
    client = subprocess.Popen(
        [sys.executable, "-m", "gazelle.nodes", "gazebo_ros/gzclient"],
        env={**os.environ, "ROS_NAMESPACE": "/", PARENT_VARIABLE: str(os.getpid())},
        # Ctrl-C is for the world; the panel is ended behind it.
        start_new_session=True,
    )
    try:
        return gzserver.main(argv)
    finally:
        client.terminate()
        client.wait()
