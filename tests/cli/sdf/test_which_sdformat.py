"""Which sdformat ``gz sdf`` is."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.cli.main import main
from gazelle.cli.sdf.which_sdformat import sdformat_release
from gazelle.description.sdformat_emulation.release import Release

Capture = pytest.CaptureFixture[str]
_MODEL = '<sdf version="1.6"><model name="m"><link name="l"/></model></sdf>\n'
_PACKAGE = """<package format="3"><name>robot</name><version>0.1.0</version>
<description>A robot.</description><exec_depend>{depend}</exec_depend></package>"""


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder whose surroundings say nothing."""
    for name in ("ROS_DISTRO", "ROS_PACKAGE_PATH", "GAZEBO_MODEL_PATH", "GAZEBO_RESOURCE_PATH"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.chdir(tmp_path)
    (tmp_path / "m.sdf").write_text(_MODEL, encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize(
    ("environ", "release"),
    [
        ({}, Release.V9),
        ({"ROS_DISTRO": "noetic"}, Release.V9),
        ({"ROS_DISTRO": "humble"}, Release.V9),
        ({"ROS_DISTRO": "humble", "GZ_VERSION": "fortress"}, Release.V12),
        ({"ROS_DISTRO": "humble", "GZ_VERSION": "harmonic"}, Release.V14),
        ({"ROS_DISTRO": "jazzy"}, Release.V14),
        ({"ROS_DISTRO": "rolling"}, Release.V14),
        ({"ROS_DISTRO": "jazzy", "GAZEBO_MODEL_PATH": "/m"}, Release.V14),
        ({"GZ_VERSION": "harmonic"}, Release.V14),
        ({"GZ_SIM_RESOURCE_PATH": "/m"}, Release.V12),
        ({"IGN_GAZEBO_RESOURCE_PATH": "/m"}, Release.V12),
        ({"GAZEBO_MODEL_PATH": "/m"}, Release.V9),
    ],
)
def test_the_environment_says_which(here: Path, environ: dict[str, str], release: Release) -> None:
    assert sdformat_release(["-k", "m.sdf"], environ) is release


@pytest.mark.parametrize(
    ("depend", "release"),
    [("gazebo_ros", Release.V9), ("ros_gz_sim", Release.V12), ("gz_ros2_control", Release.V12)],
)
def test_the_packages_around_say_which(here: Path, depend: str, release: Release) -> None:
    (here / "package.xml").write_text(_PACKAGE.format(depend=depend), encoding="utf-8")
    assert sdformat_release(["-k", "m.sdf"], {"HOME": str(here)}) is release


@pytest.mark.parametrize(
    ("text", "release"),
    [
        ('<sdf version="1.7"/>', Release.V9),
        ('<sdf version="1.8"/>', Release.V12),
        ("<sdf version='1.9'/>", Release.V12),
        ("<sdf version='1.10'/>", Release.V14),
        ("<sdf version='1.12'/>", Release.V14),
        ('<sdf version="1.6"><plugin filename="gz-sim-imu-system"/></sdf>', Release.V12),
        ('<sdf version="1.6"><plugin name="ignition::gazebo::systems::Imu"/></sdf>', Release.V12),
    ],
)
def test_the_file_says_which(here: Path, text: str, release: Release) -> None:
    (here / "m.sdf").write_text(text, encoding="utf-8")
    assert sdformat_release(["-k", "m.sdf"], {}) is release


def test_the_options_say_which(here: Path) -> None:
    assert sdformat_release(["--degrees", "-p", "m.sdf"], {}) is Release.V12
    assert sdformat_release(["-v", "1.7", "-p", "m.sdf"], {"ROS_DISTRO": "jazzy"}) is Release.V9


def test_words_and_codes_are_those_of_the_newer_one(
    here: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    (here / "empty.sdf").write_text(_MODEL.replace('<link name="l"/>', ""), encoding="utf-8")
    (here / "no.sdf").write_text("This is no XML.\n", encoding="utf-8")
    assert main(["gz", "sdf", "-k", "m.sdf", "--no-findings"]) == 0
    assert capsys.readouterr().out == "Check complete\n"
    monkeypatch.setenv("ROS_DISTRO", "jazzy")
    assert main(["gz", "sdf", "-k", "m.sdf", "--no-findings"]) == 0
    assert capsys.readouterr().out == "Valid.\n"
    assert main(["gz", "sdf", "-k", "empty.sdf", "--no-findings"]) == 255
    assert "A model must have at least one link." in capsys.readouterr().err
    assert main(["gz", "sdf", "-k", "no.sdf", "--no-findings"]) == 255
    assert "Error Code 1: Msg: Unable to read file" in capsys.readouterr().err
    assert main(["gz", "help", "sdf"]) == 0
    assert "\n  gz sdf [options]\n" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("name", "new", "classic"),
    [
        ("topic", "--msgtype", "--world-name"),
        ("model", "--joint", "--spawn-file"),
        ("service", "--reqtype", ""),
        ("sim", "-s", ""),
    ],
)
def test_help_of_a_command_is_that_of_the_gazebo_in_use(
    here: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture, name: str, new: str, classic: str
) -> None:
    ways = (["gz", name, "--help"], ["gz", name, "-h"], ["gz", "help", name])
    for way in ways:
        assert main(way) == 0
        seen = capsys.readouterr()
        assert (classic or new) in seen.out + seen.err
    monkeypatch.setenv("ROS_DISTRO", "jazzy")
    for way in ways:
        assert main(way) == 0
        seen = capsys.readouterr()
        assert new in seen.out + seen.err
        assert not classic or classic not in seen.out + seen.err


def test_front_of_gz_is_that_of_the_gazebo_in_use(
    here: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    assert main(["gz", "help"]) == 0
    assert "Modify world properties" in capsys.readouterr().err
    monkeypatch.setenv("ROS_DISTRO", "jazzy")
    for words, code in ((["help"], 0), (["--help"], 0), ([], 255), (["nothing"], 255)):
        assert main(["gz", *words]) == code
        assert "Run and manage the Gazebo Simulator" in capsys.readouterr().out
    assert main(["gz", "--commands"]) == 0
    assert {"model", "sdf", "sim"} <= set(capsys.readouterr().out.split())


def test_commands_without_words_explain_themselves_as_the_new_ones_do(
    here: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    monkeypatch.setenv("ROS_DISTRO", "jazzy")
    assert main(["gz", "topic"]) == 0
    assert "--msgtype" in "".join(capsys.readouterr())
