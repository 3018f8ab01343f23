"""Terminals for tests that type what a document prints."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from tests.tutorial.terminals import Terminal


@pytest.fixture
def open_terminal(tmp_path: Path, free_port: int) -> Iterator[Callable[[], Terminal]]:
    """Opens terminals with Gazelle's commands, all on one graph; they end with the test."""
    if not shutil.which("bash"):
        pytest.skip("bash is not installed")
    names = ("ROS_", "GAZELLE_", "AMENT_", "CMAKE_", "PYTHONPATH", "TURTLEBOT3_")
    environ = {key: value for key, value in os.environ.items() if not key.startswith(names)}
    environ["GAZELLE_PORT"] = str(free_port)
    # No browser in tests; what is about the page has tests of its own.
    environ["GAZELLE_STUDIO"] = "0"
    environ["PATH"] = os.pathsep.join([str(Path(sys.executable).parent), environ["PATH"]])
    opened: list[Terminal] = []

    def open_one() -> Terminal:
        one = Terminal(environ, tmp_path)
        opened.append(one)
        one.run(f'eval "$({sys.executable} -m gazelle.cli env)"')
        return one

    yield open_one
    for one in reversed(opened):
        one.close()
