"""A program of C++ over roscpp, compiled once a session."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from tests.conftest import Launched, Run

from gazelle.cpp.toolchain import NoToolchainError, find_toolchain
from gazelle.graph import Graph

Probe = Callable[..., Launched]
_PROGRAMS = Path(__file__).parent / "programs"


@pytest.fixture(scope="session")
def roscpp_probe_file(tmp_path_factory: pytest.TempPathFactory, shared_cpp_cache: Path) -> Path:
    """The node file of ``roscpp_probe.cpp``."""
    del shared_cpp_cache
    if sys.platform != "linux":
        pytest.skip("nodes of C++ run on Linux for now")
    try:
        find_toolchain()
    except NoToolchainError as error:
        pytest.skip(str(error))
    file = tmp_path_factory.mktemp("roscpp") / "probe"
    source = str(_PROGRAMS / "roscpp_probe.cpp")
    command = [sys.executable, "-m", "gazelle.cpp.compile", source, "-o", str(file), "--ros", "1"]
    outcome = subprocess.run(
        [*command, "--lib", "rosbag", "-f=-Werror"], check=False, capture_output=True
    )
    assert outcome.returncode == 0, outcome.stderr.decode()
    return file


@pytest.fixture
def probe(gazelle: Run, roscpp_probe_file: Path) -> Probe:
    """Runs ``roscpp_probe WORDS…`` on the test's own graph."""

    def run(*words: str, **options: Any) -> Launched:
        return gazelle(str(roscpp_probe_file), *words, module="gazelle.cpp.host", **options)

    return run


@pytest.fixture
def graph(free_port: int) -> Iterator[Graph]:
    """The test's graph."""
    with Graph.open(port=free_port, role="hub", environ={}) as one:
        yield one
