"""``gazelle bridge ros2`` as a program, without ROS."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.bridge.ros2 import About
from gazelle.cli.bridge import main
from gazelle.cli.bridge import ros2 as module

Run = Callable[..., Any]


def test_help_names_the_option(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["ros2", "--help"])
    assert "--python PATH" in capsys.readouterr().out


def test_python_without_rclpy_is_told(gazelle: Run, tmp_path: Path) -> None:
    run = gazelle("bridge", "ros2", "--python", str(tmp_path / "python"))
    assert run.wait() == 1
    assert "no Python with ROS 2's rclpy was found [bridge.no-rclpy]" in run.text
    assert f"{tmp_path}/python (--python): [Errno 2] No such file or directory" in run.text
    assert "ROS says: ModuleNotFoundError: No module named 'rclpy'" in run.text


def test_domain_is_a_number(gazelle: Run) -> None:
    run = gazelle("bridge", "ros2", ROS_DOMAIN_ID="500")
    assert run.wait() == 1
    assert "ROS_DOMAIN_ID is '500', not a number from 0 to 232" in run.text


class _Joined:
    """ROS 2 that has been joined, as far as the command looks; it ends at once."""

    about = About("/usr/bin/python3", "rmw_fastrtps_cpp", "humble", 7, ())

    def __init__(self, *_args: object) -> None: ...

    def on_end(self, listener: Callable[[], None]) -> None:
        listener()

    def close(self) -> None: ...


@pytest.mark.parametrize(
    ("reach", "out", "err"),
    [
        (
            "",
            "the bridge has joined ROS 2: rmw_fastrtps_cpp, domain 0, this machine only\n"
            "  rclpy of /usr/bin/python3\n"
            "  every user of this machine can reach it: ROS 2 asks nobody for a password\n",
            "",
        ),
        (
            "SUBNET",
            "the bridge has joined ROS 2: rmw_fastrtps_cpp, domain 0, other machines too\n"
            "  rclpy of /usr/bin/python3\n",
            "gazelle bridge ros2: other machines can reach it, and ROS 2 asks nobody for a "
            "password; unset ROS_AUTOMATIC_DISCOVERY_RANGE and ROS_LOCALHOST_ONLY for this "
            "machine only\n",
        ),
    ],
    ids=["machine", "network"],
)
def test_bridge_says_who_can_reach_it(
    reach: str, out: str, err: str, monkeypatch: pytest.MonkeyPatch, free_port: int,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.setattr(module, "Bridge", _Joined)
    monkeypatch.setenv("GAZELLE_PORT", str(free_port))
    monkeypatch.delenv("ROS_LOCALHOST_ONLY", raising=False)
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", reach)
    assert main(["ros2"]) == 0
    assert capsys.readouterr() == (out, err)
