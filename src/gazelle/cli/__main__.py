"""``gazelle COMMAND…``, also as ``python -m gazelle.cli``, which ROS-named commands call."""

from __future__ import annotations

import os
import signal
from typing import NoReturn

from gazelle.cli.main import main
from gazelle.ending import end_with

__all__ = ["run"]


def run() -> NoReturn:
    """Run the command of the command line and end the process."""
    _heed_interrupts()
    if "GAZELLE_PARENT_PID" in os.environ:
        # Started by a launch: most commands are not, and need nothing of the graph for this.
        from gazelle.graph.parent import end_with_parent

        end_with_parent()
    end_with(main)


def _heed_interrupts() -> None:
    """End on SIGINT also where a script started the command with ``&``.

    Shells without job control start such commands with SIGINT ignored, and Python leaves it at
    that. rospy, rclpy and roslaunch do not, so scripts rely on ``kill -INT``.
    """
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)


if __name__ == "__main__":
    run()
