"""Processes of a launch that a signal stops."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.patience import eventually

from gazelle.launch.node_process import StoppedProcess

pytestmark = pytest.mark.skipif(not hasattr(os, "waitid"), reason="the system has no waitid")


class Wall:
    def __init__(self) -> None:
        self.now_s = 100.0

    def __call__(self) -> float:
        return self.now_s


@pytest.fixture
def sleeper() -> Iterator[subprocess.Popen[bytes]]:
    with subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE) as popen:
        yield popen
        popen.kill()


def test_stop_and_going_on_are_told_once(sleeper: subprocess.Popen[bytes]) -> None:
    wall, pid = Wall(), sleeper.pid
    stopped = StoppedProcess(pid, clock=wall)
    assert stopped.news() == ""
    sleeper.send_signal(signal.SIGSTOP)
    assert eventually(stopped.news) == (
        f"process is stopped [pid {pid}]: it does nothing until it gets SIGCONT (kill -CONT {pid})"
    )
    assert stopped.news() == ""
    wall.now_s += 20.0
    sleeper.send_signal(signal.SIGCONT)
    assert eventually(stopped.news) == f"process goes on after 20.0 s [pid {pid}]"


def test_the_end_is_left_for_others(sleeper: subprocess.Popen[bytes]) -> None:
    stopped = StoppedProcess(sleeper.pid)
    sleeper.kill()
    os.waitid(os.P_PID, sleeper.pid, os.WEXITED | os.WNOWAIT)
    assert stopped.news() == ""
    assert sleeper.wait() == -signal.SIGKILL
    assert stopped.news() == ""


def _stop_and_let_go_on(run: Any, label: str, started: str) -> None:
    found = re.search(r"\[(\d+)\]$", run.wait_for_line(f"{label}{started}"))
    assert found
    pid = int(found[1])
    os.kill(pid, signal.SIGSTOP)
    run.wait_for_line(rf"{label}:? process is stopped \[pid {pid}\]")
    os.kill(pid, signal.SIGCONT)
    run.wait_for_line(rf"{label}:? process goes on after \d+\.\d s \[pid {pid}\]")
    assert run.stop() == 0


def test_roslaunch_tells_of_a_node_that_is_stopped(
    launch: Callable[..., Any], node: Callable[..., str]
) -> None:
    run = launch(node("idle", "say=here wait", output="screen"), "--no-bridge")
    run.wait_for_line("^here$")
    _stop_and_let_go_on(run, r"\[idle-2\]", ": started with pid")


def test_ros2_launch_tells_of_a_process_that_is_stopped(
    gazelle: Callable[..., Any], tmp_path: Path
) -> None:
    file = tmp_path / "idle.launch.py"
    words = [sys.executable, "-c", "import threading; threading.Event().wait(60)"]
    file.write_text(
        "from launch import LaunchDescription\n"
        "from launch.actions import ExecuteProcess\n"
        "def generate_launch_description():\n"
        f"    return LaunchDescription([ExecuteProcess(cmd={words!r}, name='idle')])\n",
        encoding="utf-8",
    )
    run = gazelle("ros2", "launch", str(file))
    _stop_and_let_go_on(run, r"\[idle-1\]", ": process started with pid")
