"""Files of parameters go when their launcher does."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from gazelle.launch.ros2.launch_ros import parameter_descriptions
from gazelle.launch.ros2.launch_ros.parameter_descriptions import write_temporary


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """The folder for temporary files, in which this process has written none yet."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    monkeypatch.setattr("atexit.register", lambda function: function)
    parameter_descriptions._written.cache_clear()
    yield tmp_path
    parameter_descriptions._written.cache_clear()


@pytest.mark.skipif(os.name != "posix", reason="nobody is asked for there")
def test_what_a_killed_launcher_left_is_deleted_by_the_next(folder: Path) -> None:
    # No process has this number: it is above the largest that Linux gives.
    old = folder / "launch_params_4194305-x"
    ours = folder / f"launch_params_{os.getpid()}-x"
    for path in (old, ours):
        path.write_text("a")
    new = write_temporary("b")
    assert not old.exists()
    assert ours.exists()
    assert new.read_text(encoding="utf-8") == "b"
    assert new.name.startswith(f"launch_params_{os.getpid()}-")


def test_files_are_deleted_when_the_launcher_ends(tmp_path: Path) -> None:
    code = (
        "from gazelle.launch.ros2.launch_ros.parameter_descriptions import write_temporary\n"
        "paths = [write_temporary(text) for text in 'ab']\n"
        "print([path.read_text() for path in paths])\n"
    )
    environ = {**os.environ, "TMPDIR": str(tmp_path), "TEMP": str(tmp_path)}
    done = subprocess.run(
        [sys.executable, "-c", code], env=environ, capture_output=True, text=True, check=True
    )
    assert done.stdout == "['a', 'b']\n"
    assert list(tmp_path.iterdir()) == []
