"""``gazelle doctor --fix``: a diff first, a question, and nothing that nobody agreed to."""

from __future__ import annotations

import io
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from gazelle.cli.doctor import main
from gazelle.workspace.scaffold import create_package

WRONG, RIGHT = 'pkg="gazeob_ros"', 'pkg="gazebo_ros"'


class _Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


@pytest.fixture
def launch(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A launch file with a package's name that is misspelt."""
    (tmp_path / "src").mkdir()
    create_package("robot", "bot", tmp_path / "src", ros_version=1)
    path = tmp_path / "src" / "bot" / "launch" / "bot.launch"
    path.write_text(path.read_text("utf-8").replace(RIGHT, WRONG), "utf-8")
    monkeypatch.chdir(tmp_path)
    yield path


def test_nothing_is_written_where_nobody_can_be_asked(
    launch: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["bot", "--fix"]) == 2
    shown = capsys.readouterr()
    assert shown.out.startswith("--- a/bot/launch/bot.launch\n+++ b/bot/launch/bot.launch\n")
    assert f"{RIGHT} type" in shown.out
    folder = launch.parents[2]
    assert f"mends 1 finding in 1 file of '{folder}'; 0 findings would be left" in shown.err
    assert shown.err.endswith("add --yes to write it\ngazelle doctor: nothing is written\n")
    assert WRONG in launch.read_text("utf-8")


def test_yes_writes_and_the_exit_code_is_that_of_what_is_left(
    launch: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["bot", "--fix", "--yes"]) == 0
    assert f"written: {launch}" in capsys.readouterr().err
    assert WRONG not in launch.read_text("utf-8")
    assert main(["bot", "--fix", "--yes"]) == 0
    assert "nothing to mend with certainty" in capsys.readouterr().err


@pytest.mark.parametrize(("answer", "is_written"), [("y\n", True), ("\n", False), ("no\n", False)])
def test_a_person_is_asked(
    launch: Path, monkeypatch: pytest.MonkeyPatch, answer: str, is_written: bool
) -> None:
    monkeypatch.setattr(sys, "stdin", _Terminal(answer))
    monkeypatch.setattr(sys, "stdout", _Terminal())
    main(["bot", "--fix"])
    assert (RIGHT in launch.read_text("utf-8").replace("find gazebo_ros", "")) == is_written


def test_estimates_are_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "arm.urdf"
    path.write_text(_ARM, "utf-8")
    assert main([str(path), "--fix"]) == 2
    assert "nothing to mend with certainty; --fix-all tries more" in capsys.readouterr().err
    assert main([str(path), "--fix-all", "--yes"]) == 1, (
        "nothing to compute the base's inertia from"
    )
    assert '<limit lower="-3.1416"' in path.read_text("utf-8")


def test_fix_does_not_go_with_json(launch: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(["bot", "--fix", "--json"])
    assert end.value.code == 2
    assert "--fix prints a diff" in capsys.readouterr().err


def test_yes_alone_means_nothing_and_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["--yes"])
    assert "--yes goes with --fix or --fix-all" in capsys.readouterr().err


_ARM = """<robot name="bot">
  <link name="base"/>
  <link name="arm">
    <inertial><mass value="1"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
  </link>
  <joint name="j" type="revolute">
    <parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
  </joint>
</robot>
"""
