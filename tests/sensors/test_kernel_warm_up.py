"""Kernels are compiled once per machine, and that is said."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from gazelle.sensors import warm_up

CODE = "from gazelle.sensors import warm_up; warm_up(print)"
# One kernel of two lines in place of the cameras'.
SMALL_CODE = """
from gazelle.kernels import AREAS, dispatch
from gazelle.sensors import kernel_warm_up
dispatch.area_of = lambda module: AREAS[0]
from small import twice
kernel_warm_up._exercise = lambda: twice(2)
kernel_warm_up.warm_up(print)
"""
SMALL_KERNEL = """
from gazelle.kernels import kernel

@kernel
def twice(x):
    return 2 * x
"""


def _run(code: str, folder: Path, **environ: str) -> list[str]:
    run = subprocess.run(
        [sys.executable, "-c", code],
        check=True,
        cwd=folder,
        capture_output=True,
        text=True,
        env={**os.environ, **environ},
    )
    return run.stdout.splitlines()


def test_compiling_is_told_the_first_time_only(tmp_path: Path) -> None:
    (tmp_path / "small.py").write_text(SMALL_KERNEL, encoding="utf-8")
    started, ended = _run(SMALL_CODE, tmp_path, GAZELLE_KERNEL_CACHE=str(tmp_path))
    assert started == (
        "compiling the kernels of cameras for this machine: up to 1 s of computing, once "
        "('gazelle warm' does it ahead)"
    )
    assert ended.startswith("camera kernels compiled in ")
    assert _run(SMALL_CODE, tmp_path, GAZELLE_KERNEL_CACHE=str(tmp_path)) == []


def test_all_kernels_of_cameras_are_kept(tmp_path: Path) -> None:
    # Other tests may have compiled them already; the second process finds them in any case.
    warm_up()
    assert _run(CODE, tmp_path) == []


def test_sensors_import_without_heavy_modules() -> None:
    code = (
        "import sys, gazelle.sensors\n"
        "heavy = {'llvmlite', 'scipy', 'mujoco', 'PIL', 'rich'} & set(sys.modules)\n"
        "assert not heavy, heavy\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
