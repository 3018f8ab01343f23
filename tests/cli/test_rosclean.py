"""rosclean."""

from __future__ import annotations

import io
import os
import subprocess
from pathlib import Path

import pytest

from gazelle.cli.main import main

Capture = pytest.CaptureFixture[str]


@pytest.fixture
def logs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """``log`` below ROS_HOME with an old run and a new one of 2 MB each."""
    monkeypatch.setenv("ROS_HOME", str(tmp_path))
    monkeypatch.delenv("ROS_LOG_DIR", raising=False)
    for age, name in ((1000, "old"), (0, "new")):
        run = tmp_path / "log" / name
        run.mkdir(parents=True)
        (run / "node.log").write_bytes(b"x" * (2 << 20))
        os.utime(run, (1e9 - age, 1e9 - age))
    return tmp_path / "log"


def test_check_prints_what_du_prints(logs: Path, capsys: Capture) -> None:
    size = subprocess.run(["du", "-sh", str(logs)], capture_output=True, text=True, check=True)
    assert main(["rosclean", "check"]) == 0
    assert capsys.readouterr().out == f"{size.stdout.split()[0]} ROS node logs\n"


def test_purge_asks_first(logs: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sys.stdin", io.StringIO("what\nn\n"))
    assert main(["rosclean", "purge"]) == 0
    assert logs.is_dir()
    assert capsys.readouterr().out == (
        "Purging ROS node logs.\nPLEASE BE CAREFUL TO VERIFY THE COMMAND BELOW!\n"
        f"Okay to perform:\n\nrm -rf {logs}\n(y/n)?\nPlease enter 'y' or 'n'\n"
    )
    monkeypatch.setattr("sys.stdin", io.StringIO("y\n"))
    assert main(["rosclean", "purge"]) == 0
    assert not logs.exists()
    assert main(["rosclean", "check"]) == 0


def test_purge_keeps_the_newest_below_a_size(logs: Path) -> None:
    assert main(["rosclean", "purge", "-y", "--size", "3"]) == 0
    assert [item.name for item in logs.iterdir()] == ["new"]


def test_links_are_removed_not_followed(logs: Path, tmp_path: Path) -> None:
    (logs / "latest").symlink_to(logs / "new")
    kept = tmp_path / "kept"
    kept.mkdir()
    (kept / "file").touch()
    (logs / "other").symlink_to(kept)
    assert main(["rosclean", "purge", "-y"]) == 0
    assert (kept / "file").is_file()


def test_a_folder_of_more_than_logs_is_left_alone(
    logs: Path, tmp_path: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path))
    assert main(["rosclean", "purge", "-y"]) == 1
    assert "is no folder of logs only; nothing removed" in capsys.readouterr().err
    assert logs.is_dir()


def test_wrong_usage(capsys: Capture) -> None:
    assert main(["rosclean"]) == 2
    assert "usage: rosclean" in capsys.readouterr().err
