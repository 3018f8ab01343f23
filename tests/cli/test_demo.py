"""``gazelle demo``: what it prints, copies and starts."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle import announcements, kernels
from gazelle.announcements import announced_by
from gazelle.cli.completion import candidates
from gazelle.cli.demo import _Processes
from gazelle.cli.main import main
from gazelle.demo import DEMOS
from gazelle.graph import Node
from gazelle.kernels import AREAS, KernelSource


def test_without_a_name_all_are_listed(capsys: Any) -> None:
    assert main(["demo"]) == 0
    listed = capsys.readouterr().out
    assert main(["demo", "--list"]) == 0
    assert capsys.readouterr().out == listed
    assert listed.startswith("demos:\n  scout ")
    for demo in DEMOS:
        assert f"  {demo.name} " in listed
        assert f"{demo.summary} (ROS {demo.ros_version})\n" in listed
    assert "gazelle demo NAME --copy DIR" in listed


def test_help_begins_with_it(capsys: Any) -> None:
    assert main(["--help"]) == 0
    assert "commands:\n  demo " in capsys.readouterr().out


def test_a_wrong_name_gives_the_nearest(capsys: Any) -> None:
    assert main(["demo", "scot"]) == 1
    assert "demo 'scot' not found; did you mean 'scout'" in capsys.readouterr().err


def test_names_are_completed() -> None:
    assert candidates("gazelle", ["demo", "bal"]) == ["balancer"]
    assert candidates("gazelle", ["dem"]) == ["demo"]


def test_a_copy_says_what_to_type_next(tmp_path: Path, capsys: Any) -> None:
    folder = tmp_path / "my arm"
    assert main(["demo", "arm", "--copy", str(folder)]) == 0
    text = capsys.readouterr().out
    assert f"wrote {folder}/src/heron_bringup, " in text
    assert f"\n  cd '{folder}'\n  gazelle ros2 launch heron_bringup heron.launch.py\n" in text
    assert "\n  gazelle ros2 run heron_bringup pick_and_place    # in another terminal\n" in text
    assert main(["demo", "arm", "--copy", str(folder)]) == 1
    assert "is there already, and nothing is written over it" in capsys.readouterr().err


def test_beside_a_running_world_it_says_how_to_start(robot: Node, port: int, capsys: Any) -> None:
    robot.create_publisher("/clock", "rosgraph_msgs/Clock")
    assert main(["demo", "scout", "--no-browser"]) == 1
    assert f"GAZELLE_PORT={port + 1} gazelle demo scout" in capsys.readouterr().err


def test_that_kernels_are_compiled_is_passed_on(
    monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    monkeypatch.setattr(announcements, "_told", set())
    monkeypatch.setattr(kernels.dispatch, "area_of", lambda _: AREAS[0])
    told: list[str] = []
    with announced_by(told.append):
        kernels.dispatch.tell(KernelSource(main))
    shown = _Processes(DEMOS[0], is_verbose=False)
    shown._read(io.StringIO(f"[INFO] [gazebo]: {told[0]}\nanother line\n"))
    assert capsys.readouterr().out == (
        "  compiling the kernels of cameras for this machine: up to 1 s of computing, once "
        "('gazelle warm' does it ahead)\n"
    )


@pytest.mark.slow(6)
def test_a_demo_runs_until_it_is_interrupted(
    gazelle: Callable[..., Any], free_port: int, tmp_path: Path
) -> None:
    run = gazelle("demo", "scout", "--no-browser", cwd=tmp_path, GAZELLE_STUDIO="1")
    run.wait_for_line("Ctrl-C ends it")
    for line in (
        "started:  gazelle roslaunch scout_robot scout.launch",
        "page:     http://127.0.0.1:",
        "there after ",
        "An orange robot",
        "      gazelle rosrun scout_robot scout_teleop.py",
    ):
        assert line in run.text
    asked = gazelle("rostopic", "echo", "-n", "1", "/odom", cwd=tmp_path, port=free_port)
    assert asked.wait() == 0
    assert "child_frame_id" in asked.text
    assert run.stop() == 0
    assert "Traceback" not in run.text


@pytest.mark.slow(4)
def test_who_wants_no_page_has_none(gazelle: Callable[..., Any], tmp_path: Path) -> None:
    run = gazelle("demo", "turtles", cwd=tmp_path, GAZELLE_STUDIO="0")
    run.wait_for_line("Ctrl-C ends it")
    assert "page:" not in run.text
    assert run.stop() == 0
