"""Which tests run where and when: order, marks and workers, as hooks of pytest and xdist."""

from __future__ import annotations

import contextlib
import importlib
import os
import zlib
from pathlib import Path
from typing import Any

import pytest

__all__ = [
    "pytest_collection",
    "pytest_collection_modifyitems",
    "pytest_xdist_auto_num_workers",
    "pytest_xdist_make_scheduler",
]

_SLOW_S = 10.0
_NOT_QUICK = ("slow", "tutorial")
# What starts processes: fixtures by name, and names that a test's function speaks of.
_STARTING_FIXTURES = {"gazelle", "gazelle_launch", "module_gazelle", "pytester", "browser"}
_STARTING_NAMES = {"subprocess", "Popen", "multiprocessing"}


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Start the files with the longest tests first, so that no worker ends long after the others.

    ``@pytest.mark.slow(seconds)`` says how long. The other files are mixed, always in the same way:
    those of some folders compute, those of others wait for processes, and side by side they leave
    no processor idle.
    """
    lengths: dict[Path, float] = {}
    for item in items:
        if marker := item.get_closest_marker("slow"):
            seconds = marker.args[0] if marker.args else _SLOW_S
            lengths[item.path] = lengths.get(item.path, 0.0) + seconds
    places = {path: zlib.crc32(path.name.encode()) for path in {item.path for item in items}}
    items.sort(key=lambda item: (-lengths.get(item.path, 0.0), places[item.path], item.path))
    _mark_quick(items)


def _mark_quick(items: list[pytest.Item]) -> None:
    """Mark a test of every file ``quick``: the first that is not long and starts no process."""
    touched: set[Path] = set()
    for item in items:
        if item.path in touched or any(map(item.get_closest_marker, _NOT_QUICK)):
            continue
        if isinstance(item, pytest.Function) and not _starts_processes(item):
            touched.add(item.path)
            item.add_marker(pytest.mark.quick)


def _starts_processes(item: pytest.Function) -> bool:
    named = set(item.function.__code__.co_names)
    for function in map(vars(item.module).get, tuple(named)):
        named |= set(getattr(getattr(function, "__code__", None), "co_names", ()))
    return bool(named & _STARTING_NAMES or _STARTING_FIXTURES & set(item.fixturenames))


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """Keep a file's tests in one worker, for what they share; files in the order collected."""
    from xdist.scheduler import LoadFileScheduling

    if config.getoption("dist") != "load":
        return None
    config.option.loadscopereorder = False
    return LoadFileScheduling(config, log)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_auto_num_workers() -> int:
    """Two workers more than processors: many a test waits for a process or for time to pass."""
    return _processors() + 2


@pytest.hookimpl(tryfirst=True)
def pytest_collection(session: pytest.Session) -> None:
    """Let each worker of a whole run import a part of the tests first.

    All workers import all tests, and in a fresh clone each would rewrite and compile all of them;
    what one has done, the others read.
    """
    numbers = getattr(session.config, "workerinput", None)
    folder = Path(__file__).parent
    if numbers is None or [Path(one).resolve() for one in session.config.args] != [folder]:
        return
    own, count = int(numbers["workerid"].removeprefix("gw")), numbers["workercount"]
    files = sorted(one for one in folder.rglob("test_*.py") if "workspaces" not in one.parts)
    # These say what else is to be rewritten, before anybody imports it.
    for file in (*sorted(folder.rglob("conftest.py")), *files[own::count]):
        name = ".".join(("tests", *file.relative_to(folder).with_suffix("").parts))
        # Collecting it says what is wrong, or that it is to be skipped.
        with contextlib.suppress(Exception, pytest.skip.Exception):
            importlib.import_module(name)


def _processors() -> int:
    # Those of this process: containers may have fewer than the machine.
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1
