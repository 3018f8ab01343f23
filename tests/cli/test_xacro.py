"""``xacro`` as a command: output files, exit codes, and our words behind the program's own."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from gazelle.cli.check_urdf import main as check_urdf
from gazelle.cli.xacro import main

_ROBOT = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="part" params="name mass">
    <link name="${name}">
      <inertial><mass value="${mass}"/>
        <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    </link>
  </xacro:macro>
  <xacro:part name="a" mass="$(arg mass)"/>
</robot>
"""


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a robot, and a cache of its own."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    (tmp_path / "r.xacro").write_text(_ROBOT, encoding="utf-8")
    return tmp_path


def test_result_goes_to_standard_output(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["r.xacro", "mass:=2"]) == 0
    shown = capsys.readouterr()
    assert '<mass value="2"/>' in shown.out
    assert shown.err == ""


def test_output_file_gets_the_bytes_and_its_folder(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["r.xacro", "mass:=2"]) == 0
    text = capsys.readouterr().out
    assert main(["r.xacro", "mass:=2", "-o", "new/folder/r.urdf"]) == 0
    assert (here / "new/folder/r.urdf").read_text(encoding="utf-8") == text
    assert [item.name for item in (here / "new/folder").iterdir()] == ["r.urdf"]
    assert (here / "new/folder/r.urdf").stat().st_mode & 0o777 == (
        here / "r.xacro"
    ).stat().st_mode & 0o777


def test_output_through_a_link_keeps_link_and_mode(here: Path) -> None:
    (here / "real.urdf").write_text("old", encoding="utf-8")
    (here / "real.urdf").chmod(0o600)
    (here / "link.urdf").symlink_to("real.urdf")
    assert main(["r.xacro", "mass:=2", "-o", "link.urdf"]) == 0
    assert (here / "link.urdf").is_symlink()
    assert "<robot" in (here / "real.urdf").read_text(encoding="utf-8")
    assert (here / "real.urdf").stat().st_mode & 0o777 == 0o600


def test_output_may_be_a_device_and_not_a_folder(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["r.xacro", "mass:=2", "-o", os.devnull]) == 0
    assert not Path(os.devnull).is_file()
    assert main(["r.xacro", "mass:=2", "-o", "."]) == 2
    assert "error: Failed to open output:" in capsys.readouterr().err


def test_failed_run_writes_nothing_and_explains_behind_the_programs_words(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["r.xacro", "-o", "r.urdf"]) == 2
    shown = capsys.readouterr()
    assert not (here / "r.urdf").exists()
    assert shown.out == ""
    assert shown.err.startswith(
        "error: Undefined substitution argument mass\n"
        "when instantiating macro: part (r.xacro)\nin file: r.xacro\n"
        "r.xacro:8:30: error: $(arg mass) has no value [xacro.argument-missing]\n"
    )


def test_quiet_run_says_nothing_of_the_stack(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["-q", "r.xacro"]) == 2
    assert "when instantiating macro" not in capsys.readouterr().err


def test_verbose_run_ends_with_a_traceback(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["-v", "r.xacro"]) == 1
    assert "Traceback (most recent call last)" in capsys.readouterr().err


def test_broken_xml_is_code_2_however_verbose(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (here / "b.xacro").write_text("<robot><a></robot>", encoding="utf-8")
    assert main(["-v", "b.xacro"]) == 2
    shown = capsys.readouterr().err
    assert shown.startswith("XML parsing error: mismatched tag: line 1, column 12\n")
    assert "b.xacro:1:8: error: not well-formed XML: mismatched tag: <a> has no end" in shown


def test_old_options_are_noticed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--inorder", "--xacro-ns", "r.xacro", "mass:=2"]) == 0
    shown = capsys.readouterr().err
    assert "in-order processing became default in ROS Melodic" in shown
    assert "xacro: option --xacro-ns has no effect" in shown


def test_expanded_file_leads_back_to_the_xacro_line(
    here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["r.xacro", "mass:=-1", "-o", "r.urdf"]) == 0
    check_urdf(["r.urdf"])
    shown = capsys.readouterr().err
    assert f"{here}/r.xacro:4:7: error: link 'a' has the mass -1 kg [urdf.negative-mass]" in shown
    assert f"  from {here}/r.xacro:8:3" in shown
