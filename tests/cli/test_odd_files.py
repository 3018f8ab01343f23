"""Devices, pipes and folders in the place of files: no command waits for ever or breaks."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from tests.patience import stretched

_GAZELLE = f"{sys.executable} -m gazelle.cli"
pytestmark = pytest.mark.skipif(os.name == "nt", reason="devices and pipes are files elsewhere")


def _run(words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        ["bash", "-c", words], capture_output=True, text=True, timeout=stretched(), check=False
    )


def test_check_urdf_reads_what_a_command_writes() -> None:
    robot = '<robot name=\\"r\\"><link name=\\"base\\"/></robot>'
    found = _run(f'{_GAZELLE} check_urdf <(echo "{robot}")')
    assert found.stdout.startswith("robot name is: r\n---------- Successfully Parsed XML")
    assert found.returncode == 0


@pytest.mark.parametrize("command", ["check_urdf", "xacro", "gz sdf -k", "ign sdf -k"])
def test_endless_device_and_silent_pipe_are_refused(command: str, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    found = _run(f"for file in /dev/zero {tmp_path}/pipe; do {_GAZELLE} {command} $file; done")
    text = found.stdout + found.stderr
    assert "Traceback" not in text
    assert "it is a device, not a file" in text
    assert str(tmp_path / "pipe") in text
