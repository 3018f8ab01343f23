"""A program of C++ over rclcpp, compiled once a session."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.conftest import Launched, Run

from gazelle.cpp.building.toolchain import NoToolchainError, find_toolchain
from gazelle.graph import Graph

Probe = Callable[..., Launched]
_SOURCE = Path(__file__).parent / "programs" / "rclcpp_probe.cpp"


@pytest.fixture(scope="session")
def probe_file(tmp_path_factory: pytest.TempPathFactory, shared_cpp_cache: Path) -> Path:
    """The node file of ``rclcpp_probe.cpp``."""
    del shared_cpp_cache
    try:
        find_toolchain()
    except NoToolchainError as error:
        pytest.skip(str(error))
    file = tmp_path_factory.mktemp("rclcpp") / "rclcpp_probe"
    words = ["-m", "gazelle.cpp.compile", str(_SOURCE), "-o", str(file), "--ros", "2"]
    libraries = ["--lib", "rclcpp_action", "--lib", "rclcpp_lifecycle"]
    outcome = subprocess.run(
        [sys.executable, *words, *libraries], check=False, capture_output=True, text=True
    )
    assert outcome.returncode == 0, outcome.stderr
    return file


@pytest.fixture
def probe(gazelle: Run, probe_file: Path) -> Probe:
    """Runs ``rclcpp_probe WORDS…`` on the test's own graph."""

    def run(*words: str, **options: Any) -> Launched:
        return gazelle(str(probe_file), *words, module="gazelle.cpp.host", **options)

    return run


@pytest.fixture
def graph(free_port: int) -> Any:
    """The graph of the test."""
    with Graph.open(port=free_port, role="hub", environ={}) as one:
        yield one
