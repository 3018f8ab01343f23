"""Fixtures: a document's launch file that runs for all tests of a module, and its pages."""

from __future__ import annotations

import contextlib
import os
import socket
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.browser.tutorial.robot import Robot
from tests.conftest import Launched, reserved_port

__all__ = ["launch", "window"]

_PAGE_AFTER_GRAPH = 8090 - 7447


@pytest.fixture(scope="module")
def launch(
    workspaces_dir: Path, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Callable[..., Robot]]:
    """Types ``roslaunch PACKAGE FILE`` in the documents' workspace, with pages switched on."""
    running: list[Launched] = []
    home = tmp_path_factory.mktemp("home")
    own = {
        "GAZELLE_STUDIO": "1",
        "GAZEBO_MODEL_PATH": str(workspaces_dir / "gazebo_models"),
        "ROS_HOME": str(home / "ros"),
        "XDG_CONFIG_HOME": str(home / "config"),
    }
    clean = {k: v for k, v in os.environ.items() if not k.startswith(("ROS_", "GAZELLE_"))}

    def run(*words: str, port: int, cwd: Path) -> Launched:
        command = [sys.executable, "-m", "gazelle.cli", *words]
        environ = {**clean, **own, "GAZELLE_PORT": str(port)}
        running.append(Launched(command, port=port, cwd=cwd, environ=environ, stdin=None))
        return running[-1]

    def start(package: str, file: str, cwd: Path = workspaces_dir / "catkin_ws") -> Robot:
        return Robot(run, package, file, port=_graph_port(reserved), cwd=cwd)

    with contextlib.ExitStack() as reserved:
        yield start
        for one in reversed(running):
            one.close()


@pytest.fixture
def window(look: Any) -> Callable[..., Any]:
    """Opens a page that is given the time a busy machine needs to draw it."""

    def open_page(url: str, *panels: str) -> Any:
        seen = look(url, *panels, size=(1280, 800))
        seen.page.set_default_timeout(60_000)
        return seen

    return open_page


def _graph_port(reserved: contextlib.ExitStack) -> int:
    """Return a port of a graph whose page's port is free as well."""
    while True:
        port = reserved.enter_context(reserved_port())
        with socket.socket() as page, contextlib.suppress(OSError):
            page.bind(("127.0.0.1", port + _PAGE_AFTER_GRAPH))
            return port
