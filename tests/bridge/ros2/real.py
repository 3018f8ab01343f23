"""Runs nodes of the real rclpy, which tell in lines what happens to them."""

from __future__ import annotations

import os
import signal
import subprocess
import threading
from typing import Any

import pytest
from tests.patience import await_change

VARIABLE = "GAZELLE_TEST_ROS2_PYTHON"
_END_S = 5.0
_HEAD = """
import sys, threading, time
import rclpy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
BEST_EFFORT = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
def say(*words):
    print(*words, flush=True)
rclpy.init(args=[])
"""


def skip_module_without_rclpy() -> None:
    """Skip a module as a whole where no Python with the real rclpy is named."""
    if not os.environ.get(VARIABLE):
        why = f"{VARIABLE} does not name a Python with rclpy (ROS 2, or pip: ros-rclpy …)"
        pytest.skip(why, allow_module_level=True)


class Program:
    """A running node.

    Attributes:
        lines: what it has said.
    """

    def __init__(self, python: str, code: str, environ: dict[str, str]) -> None:
        self.process = subprocess.Popen(
            [python, "-c", _HEAD + code], env=environ, text=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        self.lines: list[str] = []
        self._changed = threading.Condition()
        threading.Thread(target=self._read, daemon=True).start()

    def wait_for(self, text: str) -> str:
        """The first line with a text."""
        found: list[str] = []

        def is_there() -> bool:
            found[:] = [line for line in self.lines if text in line]
            return bool(found) or self.process.poll() is not None

        with self._changed:
            assert await_change(self._changed, is_there), (text, self.lines)
        assert found, (text, self.lines, self.process.returncode)
        return found[0]

    def count(self, text: str) -> int:
        with self._changed:
            return sum(text in line for line in self.lines)

    def say(self, line: str = "") -> None:
        """Write a line to its standard input."""
        assert self.process.stdin is not None
        self.process.stdin.write(f"{line}\n")
        self.process.stdin.flush()

    def end(self) -> None:
        """End it so that it says goodbye; ROS believes in killed ones for 20 s."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        try:
            self.process.wait(_END_S)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            with self._changed:
                self.lines.append(line.rstrip("\n"))
                self._changed.notify_all()
        with self._changed:
            self._changed.notify_all()


class Ros2:
    """Starts programs; all end with it."""

    def __init__(self, python: str, domain: int) -> None:
        self._python = python
        self._environ = {
            **{key: value for key, value in os.environ.items() if not key.startswith("ROS_")},
            "ROS_DOMAIN_ID": str(domain),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        }
        self._programs: list[Program] = []

    def __call__(self, code: str, **environ: Any) -> Program:
        """Start a program."""
        program = Program(self._python, code, {**self._environ, **environ})
        self._programs.append(program)
        return program

    def close(self) -> None:
        for program in self._programs:
            program.end()
