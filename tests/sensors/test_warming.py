"""Kernels are compiled once per machine, and that is said."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

CODE = "from gazelle.sensors import warm_up; warm_up(print)"


def _run(cache: Path) -> list[str]:
    run = subprocess.run(
        [sys.executable, "-c", CODE],
        check=True,
        capture_output=True,
        text=True,
        env={**os.environ, "NUMBA_CACHE_DIR": str(cache)},
    )
    return run.stdout.splitlines()


@pytest.mark.slow
def test_compiling_is_told_the_first_time_only(tmp_path) -> None:
    started, ended = _run(tmp_path)
    assert started == "compiling camera kernels: a few seconds, once on this machine"
    assert ended.startswith("camera kernels compiled in ")
    assert _run(tmp_path) == []


def test_sensors_import_without_heavy_modules() -> None:
    code = (
        "import sys, gazelle.sensors\n"
        "heavy = {'numba', 'scipy', 'mujoco', 'PIL', 'rich'} & set(sys.modules)\n"
        "assert not heavy, heavy\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
