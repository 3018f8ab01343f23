"""Programs of C++ over roscpp, compiled once a session."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from tests.conftest import Launched, Run

from gazelle.cpp.building.toolchain import NoToolchainError, find_toolchain
from gazelle.graph import Graph

Probe = Callable[..., Launched]
_PROGRAMS = Path(__file__).parent / "programs"


@pytest.fixture(scope="session")
def compiled(
    tmp_path_factory: pytest.TempPathFactory, shared_cpp_cache: Path
) -> Callable[[str, str], Path]:
    """Compiles a program here by its name, with a library beside roscpp, once a session."""
    del shared_cpp_cache
    if sys.platform != "linux":
        pytest.skip("nodes of C++ run on Linux for now")
    try:
        find_toolchain()
    except NoToolchainError as error:
        pytest.skip(str(error))

    @cache
    def compiled_file(name: str, library: str) -> Path:
        file = tmp_path_factory.mktemp("roscpp") / name
        source = str(_PROGRAMS / f"{name}.cpp")
        words = ["-m", "gazelle.cpp.compile", source, "-o", str(file), "--ros", "1"]
        outcome = subprocess.run(
            [sys.executable, *words, "--lib", library, "-f=-Werror"],
            check=False,
            capture_output=True,
        )
        assert outcome.returncode == 0, outcome.stderr.decode()
        return file

    return compiled_file


@pytest.fixture
def probe(gazelle: Run, compiled: Callable[[str, str], Path]) -> Probe:
    """Runs ``roscpp_probe WORDS…`` on the test's own graph."""
    return runner(gazelle, compiled("roscpp_probe", "rosbag"))


@pytest.fixture
def camera(gazelle: Run, compiled: Callable[[str, str], Path]) -> Probe:
    """Runs ``camera_probe WORDS…`` on the test's own graph."""
    return runner(gazelle, compiled("camera_probe", "camera_info_manager"))


def runner(gazelle: Run, file: Path) -> Probe:
    """Return what runs a node file."""

    def run(*words: str, **options: Any) -> Launched:
        return gazelle(str(file), *words, module="gazelle.cpp.host", **options)

    return run


@pytest.fixture
def graph(free_port: int) -> Iterator[Graph]:
    """The test's graph."""
    with Graph.open(port=free_port, role="hub", environ={}) as one:
        yield one
