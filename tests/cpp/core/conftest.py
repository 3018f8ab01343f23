"""A small program of C++ over the core alone, compiled once a session."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from tests.conftest import Launched, Run

from gazelle.cpp.building.toolchain import NoToolchainError, find_toolchain

Probe = Callable[..., Launched]
_PROGRAMS = Path(__file__).parent / "programs"


@pytest.fixture(scope="session")
def probe_file(tmp_path_factory: pytest.TempPathFactory, shared_cpp_cache: Path) -> Path:
    """The node file of ``core_probe.cpp``."""
    del shared_cpp_cache
    return compiled("core_probe", tmp_path_factory.mktemp("probe"))


@pytest.fixture
def probe(gazelle: Run, probe_file: Path) -> Probe:
    """Runs ``core_probe WORDS…`` on the test's own graph."""

    def run(*words: str, **options: Any) -> Launched:
        return gazelle(str(probe_file), *words, module="gazelle.cpp.host", **options)

    return run


def compiled(name: str, folder: Path, *flags: str) -> Path:
    """Compile one of the programs here, against the core alone."""
    try:
        find_toolchain()
    except NoToolchainError as error:
        pytest.skip(str(error))
    file = folder / name
    source = str(_PROGRAMS / f"{name}.cpp")
    command = [sys.executable, "-m", "gazelle.cpp.compile", source, "-o", str(file), "--ros", "0"]
    outcome = subprocess.run([*command, "-f=-g", *flags], check=False, capture_output=True)
    assert outcome.returncode == 0, outcome.stderr.decode()
    return file
