"""Terminals for tests that type what a document prints."""

from __future__ import annotations

import contextlib
import os
import pty
import shutil
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from tests.conftest import SHARED
from tests.tutorial.terminals import Terminal


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Where the documents' packages are not here, one test tells it for all that run them."""
    if SHARED.is_dir():
        return
    ours = [item for item in items if item.path.is_relative_to(Path(__file__).parent)]
    running = [item for item in ours if "shared_dir" in getattr(item, "fixturenames", ())]
    if not running:
        return
    why = f"{len(running)} tests run the documents' own packages, which are not here ({SHARED})"
    running[0].add_marker(pytest.mark.skip(reason=why))
    left_out = set(running[1:])
    config.hook.pytest_deselected(items=running[1:])
    items[:] = [item for item in items if item not in left_out]


@pytest.fixture
def terminal() -> Iterator[tuple[int, int]]:
    """A pseudo-terminal: the end where keys are typed, the end the program sees."""
    keys, seen = pty.openpty()
    yield keys, seen
    os.close(keys)
    os.close(seen)


@pytest.fixture
def open_terminal(tmp_path: Path, free_port: int) -> Iterator[Callable[[], Terminal]]:
    """Opens terminals with Gazelle's commands, all on one graph; they end with the test."""
    with _terminals(tmp_path, free_port) as open_one:
        yield open_one


@pytest.fixture(scope="module")
def module_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The home of a module's terminals."""
    return tmp_path_factory.mktemp("home")


@pytest.fixture(scope="module")
def open_module_terminal(module_folder: Path, module_port: int) -> Iterator[Callable[[], Terminal]]:
    """As `open_terminal`, for terminals that a module's tests share."""
    with _terminals(module_folder, module_port) as open_one:
        yield open_one


@contextlib.contextmanager
def _terminals(folder: Path, port: int) -> Iterator[Callable[[], Terminal]]:
    if not shutil.which("bash"):
        pytest.skip("bash is not installed")
    names = ("ROS_", "GAZELLE_", "AMENT_", "CMAKE_", "PYTHONPATH", "TURTLEBOT3_")
    environ = {key: value for key, value in os.environ.items() if not key.startswith(names)}
    environ["GAZELLE_PORT"] = str(port)
    # No browser in tests; what is about the page has tests of its own.
    environ["GAZELLE_STUDIO"] = "0"
    environ["PATH"] = os.pathsep.join([str(Path(sys.executable).parent), environ["PATH"]])
    opened: list[Terminal] = []

    def open_one() -> Terminal:
        one = Terminal(environ, folder)
        opened.append(one)
        one.run(f'eval "$({sys.executable} -m gazelle.cli env)"')
        return one

    try:
        yield open_one
    finally:
        for one in reversed(opened):
            one.close()
