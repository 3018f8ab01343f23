"""A package whose nodes say what they were given, and a graph for launches in this process."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from gazelle.launch.ros2.launch_ros import launch_graph
from gazelle.workspace.ament_index import known_workspace

# Fast: it prints its words, and the files that ROS's words name.
_SHOW = """#!/bin/sh
echo "words: $*"
while [ $# -gt 0 ]; do
  if [ "$1" = --params-file ]; then cat "$2"; fi
  shift
done
"""
_MANAGED = """#!/usr/bin/env python3
import rclpy
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn


class Managed(LifecycleNode):
    def on_configure(self, state):
        print("configured", flush=True)
        failing = self.declare_parameter("fails", False).value
        return TransitionCallbackReturn.ERROR if failing else TransitionCallbackReturn.SUCCESS

    def on_activate(self, state):
        print("activated", flush=True)
        return super().on_activate(state)


rclpy.init()
rclpy.spin(Managed("managed"))
"""


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The folder of package ``demo`` in a workspace of its own."""
    folder = tmp_path / "ws" / "src" / "demo"
    (folder / "scripts").mkdir(parents=True)
    (folder / "package.xml").write_text("<package format='3'><name>demo</name></package>")
    for name, text in (("show", _SHOW), ("managed", _MANAGED)):
        path = folder / "scripts" / name
        path.write_text(text)
        path.chmod(0o755)
    (folder / "src").mkdir()
    (folder / "src" / "compiled.cpp").write_text("int main() {}")
    monkeypatch.chdir(tmp_path / "ws")
    known_workspace.cache_clear()
    yield folder
    known_workspace.cache_clear()


@pytest.fixture(autouse=True)
def _own_graph(free_port: int, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setenv("GAZELLE_PORT", str(free_port))
    monkeypatch.delenv("GAZELLE_PARENT_PID", raising=False)
    yield
    launch_graph.drop_graph()
