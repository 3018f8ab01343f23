"""Kernels whose cache is damaged, full, gone, or somebody else's still work."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.patience import stretched

_KERNEL = """
from gazelle.numba_jit import njit


@njit(cache=True)
def twice(x):
    return 2 * x
"""
_RUN = """
from kernel import twice
print(twice(2), sum(twice.stats.cache_hits.values()))
"""
_FULL = """
import errno
from gazelle import kernel_cache

def refused(*_):
    raise OSError(errno.ENOSPC, "No space left on device")

kernel_cache._File._save_data = refused
from kernel import twice
print(twice(2), twice(2.0))
"""
_REMOVED = """
import shutil, sys
from kernel import twice
shutil.rmtree(twice.stats.cache_path)
print(twice(2), twice(2.0))
"""

Run = Callable[..., tuple[str, str]]
needs_root = pytest.mark.skipif(
    os.name != "posix" or os.geteuid() != 0, reason="only root gives files to others"
)
needs_rights = pytest.mark.skipif(os.name != "posix", reason="rights are the system's elsewhere")


@pytest.fixture
def run(tmp_path: Path) -> Run:
    (tmp_path / "kernel.py").write_text(_KERNEL, encoding="utf-8")
    (tmp_path / "cache").mkdir(mode=0o700)

    def run(code: str = _RUN, **environ: str) -> tuple[str, str]:
        done = subprocess.run(
            [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True,
            timeout=stretched(), check=True,
            env={**os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "cache"), **environ},
        )  # fmt: skip
        return done.stdout.strip(), done.stderr

    return run


@pytest.mark.parametrize("ending", ["nbi", "nbc"])
@pytest.mark.parametrize("left", [b"", b"half", b"\x80\x05."])
def test_a_damaged_file_counts_as_not_there(
    run: Run, tmp_path: Path, ending: str, left: bytes
) -> None:
    assert run() == ("4 0", "")
    (file,) = (tmp_path / "cache").rglob(f"*.{ending}")
    file.write_bytes(left)
    assert run() == ("4 0", "")
    assert run() == ("4 1", "")


def test_on_a_full_disk_kernels_work_and_it_is_told_once(run: Run, tmp_path: Path) -> None:
    out, told = run(_FULL)
    assert out == "4 4.0"
    (folder,) = (tmp_path / "cache").iterdir()
    assert told == (
        f"gazelle: cannot keep compiled kernels in '{folder}': No space left on device; they are "
        "made anew each time\n"
        "  fix: make some room there, or let NUMBA_CACHE_DIR name another folder\n"
    )


def test_a_folder_that_is_removed_while_running_is_made_again(run: Run) -> None:
    assert run(_REMOVED) == ("4 4.0", "")
    assert run() == ("4 1", "")


@needs_root
def test_nothing_is_loaded_from_a_folder_of_another_user(run: Run, tmp_path: Path) -> None:
    own = {"XDG_CACHE_HOME": str(tmp_path / "own")}
    assert run() == ("4 0", "")
    os.chown(tmp_path / "cache", 54321, 54321)
    out, told = run(**own)
    assert out == "4 0"
    assert told == (
        f"gazelle: cannot use '{tmp_path / 'cache'}', which NUMBA_CACHE_DIR names: it belongs to "
        "user 54321, who could have put code there\n"
        "  fix: let NUMBA_CACHE_DIR name another folder; each user has their own\n"
    )
    assert list((tmp_path / "own" / "gazelle" / "kernels").iterdir())
    assert run(**own)[0] == "4 1"


@needs_rights
def test_beside_a_module_kernels_are_kept_where_nobody_else_may_write(
    run: Run, tmp_path: Path
) -> None:
    beside = tmp_path / "__pycache__"
    beside.mkdir(mode=0o700)
    elsewhere = {"NUMBA_CACHE_DIR": "", "XDG_CACHE_HOME": str(tmp_path / "own")}
    assert run(**elsewhere) == ("4 0", "")
    assert list(beside.glob("*.nbi"))
    beside.chmod(0o777)
    assert run(**elsewhere) == ("4 0", "")
    assert list((tmp_path / "own" / "gazelle" / "kernels").rglob("*.nbi"))
