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


_COMMANDS = ("check_urdf", "xacro", "gz sdf -k", "ign sdf -k")
# All commands in one process: what is shown is that none of them waits, not how it starts.
_EVERY = """
import contextlib, sys
from gazelle.cli.main import main
sys.stderr = sys.stdout
for command in sys.argv[2:]:
    for file in ("/dev/zero", sys.argv[1]):
        print("==", command, flush=True)
        with contextlib.suppress(SystemExit):
            main([*command.split(), file])
"""


@pytest.fixture(scope="module")
def pipe(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A pipe that nobody writes to."""
    path = tmp_path_factory.mktemp("odd") / "pipe"
    os.mkfifo(path)
    return path


@pytest.fixture(scope="module")
def told(pipe: Path) -> dict[str, str]:
    """What each command says of an endless device and of the pipe."""
    done = subprocess.run(
        [sys.executable, "-c", _EVERY, str(pipe), *_COMMANDS],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=stretched(),
        check=True,
    )  # fmt: skip
    texts = dict.fromkeys(_COMMANDS, "")
    for part in done.stdout.split("== ")[1:]:
        command, _, text = part.partition("\n")
        texts[command] += text
    return texts


@pytest.mark.parametrize("command", _COMMANDS)
def test_endless_device_and_silent_pipe_are_refused(
    command: str, told: dict[str, str], pipe: Path
) -> None:
    text = told[command]
    assert "Traceback" not in text
    assert "it is a device, not a file" in text
    assert str(pipe) in text


_NAMING = (
    "roslaunch", "rosbag info", "ros2 bag info", "gz sdf -p", "doctor", "ros2 launch",
    "rosparam load", "new robot", "studio --folder", "view", "colcon build --base-paths",
)  # fmt: skip


def test_names_that_no_file_can_have_are_told(tmp_path: Path) -> None:
    every = _EVERY.replace('("/dev/zero", sys.argv[1])', "sys.argv[1:2]")
    done = subprocess.run(
        [sys.executable, "-c", every, "n" * 300, *_NAMING],
        cwd=tmp_path, capture_output=True, text=True, timeout=stretched(), check=True,
    )  # fmt: skip
    told = dict(part.split("\n", 1) for part in done.stdout.split("== ")[1:])
    assert list(told) == list(_NAMING)
    for text in told.values():
        assert "Traceback" not in text
        assert "n" * 60 in text
    fix = "n…: File name too long\n  fix: shorten it from 300 characters\n"
    assert told["rosparam load"].endswith(fix)


# Root may write everywhere, so the system's word is put in.
_READ_ONLY = """
import errno, os, sys
from pathlib import Path
from gazelle.cli.main import main
home, make = Path(os.environ["ROS_HOME"]), Path.mkdir

def refuse(path, *args, **options):
    if path == home:
        raise OSError(errno.EROFS, os.strerror(errno.EROFS), str(path))
    make(path, *args, **options)

Path.mkdir = refuse
sys.exit(main(sys.argv[1:]))
"""


@pytest.mark.parametrize("words", ["roscore", "roslaunch a.launch", "ros2 launch ./a.launch.py"])
def test_a_home_that_cannot_be_written_is_one_clear_error(
    words: str, tmp_path: Path, free_port: int
) -> None:
    """As in containers and on clusters."""
    home = tmp_path / "home"
    (tmp_path / "a.launch").write_text("<launch/>", encoding="utf-8")
    (tmp_path / "a.launch.py").write_text(
        "from launch import LaunchDescription as generate_launch_description\n", encoding="utf-8"
    )
    environ = {**os.environ, "ROS_HOME": str(home), "GAZELLE_PORT": str(free_port)}
    done = subprocess.run(
        [sys.executable, "-c", _READ_ONLY, *words.split()],
        cwd=tmp_path, env=environ, capture_output=True, text=True, timeout=stretched(), check=False,
    )  # fmt: skip
    assert done.returncode == 1
    assert done.stderr.endswith(
        f"{words.split(maxsplit=1)[0]}: {home}: Read-only file system\n"
        "  fix: name a place that you may write to (ls -ld shows whose one is); logs go below "
        "ROS_LOG_DIR or ROS_HOME, what is kept for next time below XDG_CACHE_HOME\n"
    )
