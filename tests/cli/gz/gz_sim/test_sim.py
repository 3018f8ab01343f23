"""``gz sim`` and ``ign gazebo``."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from gazelle.cli.gz.gz_sim.sim import read_sim
from gazelle.cli.gz.options import GzError

Run = Callable[..., Any]
WORLD = """<sdf version="1.9"><world name="hall">
  <physics name="fast" type="ode"><max_step_size>0.001</max_step_size></physics>
  <model name="ball"><pose>0 0 1 0 0 0</pose><link name="body">
    <inertial><mass>1</mass></inertial>
    <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
  </link></model></world></sdf>
"""


@pytest.fixture
def world_file(tmp_path: Path) -> str:
    file = tmp_path / "hall.sdf"
    file.write_text(WORLD, encoding="utf-8")
    return str(file)


@pytest.mark.parametrize(
    ("words", "server"),
    [
        ("-s -r w.sdf", ["w.sdf"]),
        ("-sr w.sdf", ["w.sdf"]),
        ("-r -v4 w.sdf", ["w.sdf", "--verbose"]),
        ("-rv 4 w.sdf", ["w.sdf", "--verbose"]),
        ("-v w.sdf -r", ["w.sdf", "--verbose"]),
        ("-v 1 -r w.sdf", ["w.sdf"]),
        ("--verbose=3 -r", ["--verbose"]),
        ("w.sdf", ["w.sdf", "--pause"]),
        ("-r --iterations 50 --seed=7", ["--iters", "50", "--seed", "7"]),
        ("-s -r --headless-rendering", []),
    ],
)
def test_words_of_gzserver(words: str, server: list[str]) -> None:
    start = read_sim(words.split())
    assert start.server_words == server
    assert start.notes == []


def test_what_has_no_effect_is_told() -> None:
    words = "-r --physics-engine gz-physics-dartsim-plugin --record -z 500 --render-engine ogre2"
    assert read_sim(words.split()).notes == [
        "--physics-engine gz-physics-dartsim-plugin has no effect here: MuJoCo does the physics",
        "--record has no effect here: no state.log is written here; gz log -d 1 and ros2 bag "
        "record write bags",
        "-z 500 has no effect here: the world's real_time_factor and max_step_size say how fast "
        "it runs",
        "--render-engine ogre2 has no effect here",
    ]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            "--iteratons 5",
            "gz sim has no option '--iteratons'; did you mean '--iterations' or "
            "'--versions' or '--version'?",
        ),
        ("--iterations many", "--iterations needs a whole number, not 'many'"),
        ("--seed", "--seed needs a value"),
        ("a.sdf b.sdf", "a world is named already ('a.sdf'); what is 'b.sdf'?"),
        ("-q", "gz sim has no option '-q'; see gz sim --help"),
    ],
)
def test_odd_words_are_told(words: str, said: str) -> None:
    with pytest.raises(GzError) as raised:
        read_sim(words.split())
    assert str(raised.value) == said


def test_help_and_version(gz: Run) -> None:
    assert "gz sim [options] [file]" in gz("sim", "--help").out
    assert gz("help", "sim").out == gz("sim", "-h").out
    assert gz("sim", "--version").out.startswith("Gazelle ")
    found = gz("sim", "--paws")
    assert (found.code, found.err[:30]) == (255, "gz sim has no option '--paws';")


def test_folder_is_no_world(gz: Run, tmp_path: Path) -> None:
    found = gz("sim", "-s", str(tmp_path))
    assert found.code == 255
    assert found.err == f"'{tmp_path}' is a folder; gz sim wants a file of SDF with a world\n"


def test_worlds_are_not_downloaded(gz: Run) -> None:
    found = gz("sim", "-s", "https://fuel.gazebosim.org/1.0/openrobotics/worlds/shapes")
    assert found.code == 255
    assert found.err.startswith("Unable to find or download file https://fuel.gazebosim.org/")
    assert "lies on a server and nothing is downloaded: give the path of a local file" in found.err


def test_world_runs_its_iterations(gazelle: Run, world_file: str) -> None:
    run = gazelle("gz", "sim", "-s", "-r", "--iterations", "50", f"file://{world_file}")
    assert run.wait() == 0
    assert "at 0.050000000 s" in run.text


def test_fortress_and_paused_start(gazelle: Run, world_file: str) -> None:
    run = gazelle("ign", "gazebo", "-s", world_file)
    run.wait_for_line("the world is paused, as gz sim has it without -r; gz world -p 0 lets it go")
    run.eventually(lambda: run.graph.has_service("/_gazebo/control_world"))
    assert "Gazebo ROS API Plugin" not in run.text
    assert run.stop() == 0


def test_world_that_is_not_there(gazelle: Run) -> None:
    run = gazelle("gz", "sim", "-s", "-r", "no_such.sdf")
    assert run.wait() == 255
    assert "Unable to find or download file no_such.sdf: 'no_such.sdf' not found" in run.text


def test_world_of_gazebo_comes_up_by_its_name(gazelle: Run) -> None:
    run = gazelle("gz", "sim", "-s", "-r", "--iterations", "50", "empty.sdf")
    assert run.wait() == 0
    assert "at 0.050000000 s" in run.text


def test_world_of_gazebo_that_is_not_here_says_where_it_is(gz: Run) -> None:
    found = gz("sim", "-s", "quadcopter.sdf")
    assert found.code == 255
    assert "'quadcopter.sdf' ships with gz-sim (rotors)" in found.err
    assert "take the file from https://github.com/gazebosim/gz-sim, examples/worlds" in found.err


def test_world_of_gz_tells_its_statistics_under_its_true_name(
    gazelle: Run, world_file: str
) -> None:
    run = gazelle("gz", "sim", "-s", world_file)
    run.eventually(lambda: run.graph.has_service("/_gazebo/control_world"))
    topics = gazelle("gz", "topic", "-l")
    assert topics.wait() == 0
    assert "/world/hall/stats" in topics.lines
    services = gazelle("gz", "service", "-l")
    assert services.wait() == 0
    assert "/world/hall/control" in services.lines
    echo = gazelle("gz", "topic", "-e", "-t", "/world/hall/stats", "-n", "1")
    assert echo.wait() == 0
    assert any("real_time_factor" in line for line in echo.lines)
    assert any("nsec: 1000000" in line for line in echo.lines)
