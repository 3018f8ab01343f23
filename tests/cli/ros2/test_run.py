"""ros2 run."""

from __future__ import annotations

import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

_MANIFEST = (
    "<package format='3'><name>demo</name><version>0.0.1</version><description/>"
    "<maintainer email='a@b.c'>a</maintainer><license>MIT</license>"
    "<export><build_type>ament_python</build_type></export></package>"
)
_SETUP = "setup(entry_points={'console_scripts': ['talk = demo.nodes:talk']})"
_NODES = """
import os, signal, sys

def talk():
    # Held before the word that lets the test send it.
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTERM})
    print(*sys.argv[1:], flush=True)
    if "early" in sys.argv:
        os.kill(os.getpid(), signal.SIGTERM)
    if {"early", "wait"} & set(sys.argv):
        signal.sigwait({signal.SIGTERM})
        sys.exit(5)
    sys.exit(3 if "fail" in sys.argv else 0)
"""


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An ament_python package with one console script."""
    folder = tmp_path / "demo"
    (folder / "demo").mkdir(parents=True)
    for name, text in (("package.xml", _MANIFEST), ("setup.py", _SETUP), ("demo/nodes.py", _NODES)):
        (folder / name).write_text(text, encoding="utf-8")
    (folder / "demo" / "__init__.py").touch()
    monkeypatch.chdir(folder)
    return folder


def test_console_script_gets_its_arguments(package: Path, gazelle: Callable[..., Any]) -> None:
    words = ("a", "--ros-args", "-r", "__node:=b")
    running = gazelle("ros2", "run", "--prefix", "env A=b", "demo", "talk", *words, cwd=package)
    assert running.wait() == 0
    assert running.lines == ["a --ros-args -r __node:=b"]


def test_failure_is_told_and_passed_on(package: Path, gazelle: Callable[..., Any]) -> None:
    running = gazelle("ros2", "run", "demo", "talk", "fail", cwd=package)
    assert running.wait() == 3
    assert running.lines == ["fail", "[ros2run]: Process exited with failure 3"]


def test_node_ends_with_the_command(package: Path, gazelle: Callable[..., Any]) -> None:
    running = gazelle("ros2", "run", "demo", "talk", "wait", cwd=package)
    running.wait_for_line("wait")
    assert running.stop(signal.SIGTERM) == 5


def test_node_that_blocks_a_signal_gets_it_when_it_waits_for_it(
    package: Path, gazelle: Callable[..., Any]
) -> None:
    running = gazelle("ros2", "run", "demo", "talk", "early", cwd=package)
    assert running.wait() == 5, running.text


def test_missing_package_and_executable_are_told(package: Path, run: Any) -> None:
    code, out, error = run("ros2", "run", "dmo", "talk")
    assert (code, out) == (1, "")
    assert "did you mean 'demo'" in error
    assert error.endswith("Package 'dmo' not found\n")
    code, _, error = run("ros2", "run", "demo", "tlk")
    assert code == 1
    assert "did you mean 'talk'" in error
    assert error.endswith("No executable found\n")
    assert run("ros2", "run", "demo").code == 2
