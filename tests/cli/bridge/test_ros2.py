"""``gazelle bridge ros2`` as a program, without ROS."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.cli.bridge import main

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
