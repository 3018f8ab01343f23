from __future__ import annotations

import json
from pathlib import Path

import pytest

from gazelle.cli.main import main

SHAPE = '<collision><geometry><box size="0.1 0.2 0.3"/></geometry></collision>'


def urdf(iyy: str = "0.1", mass: str = "12", name: str = "a") -> str:
    return (
        f'<robot name="r">\n  <link name="{name}">\n    <inertial>\n      <mass value="{mass}"/>\n'
        f'      <inertia ixx="0.13" ixy="0" ixz="0" iyy="{iyy}" iyz="0" izz="0.05"/>\n'
        f"    </inertial>\n    {SHAPE}\n  </link>\n</robot>\n"
    )


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def check(*words: str) -> int:
    return main(["inertia", "--check", *words])


def test_clean_robot_ends_with_0_and_a_table(folder: Path, capsys) -> None:
    (folder / "r.urdf").write_text(urdf(), encoding="utf-8")
    assert check("r.urdf") == 0
    lines = capsys.readouterr().out.splitlines()
    head = "link mass kg kg/m³ equivalent box m shapes along its axes m verdict"
    assert lines[0].split() == head.split()
    assert lines[1].split()[:3] == ["a", "12", "2000"]
    assert lines[1].endswith("ok")
    assert lines[2] == "1 link: nothing is wrong"


def test_errors_end_with_2_and_show_place_fix_and_phrase(folder: Path, capsys) -> None:
    (folder / "r.urdf").write_text(urdf("-0.02"), encoding="utf-8")
    assert check("r.urdf") == 2
    out = capsys.readouterr().out
    assert "r.urdf:5:7: error: no body has the inertia of link 'a'" in out
    assert "[inertia.not-positive]" in out
    assert 'iyy="0.1"' in out
    assert "A link named ... has invalid inertia." in out
    assert "urdf.bad-inertia" not in out
    assert "1 link: 1 error, 0 warnings" in out


def test_warnings_end_with_1(folder: Path) -> None:
    large = urdf("0.9").replace("0.13", "0.9")
    (folder / "r.urdf").write_text(large, encoding="utf-8")
    assert check("r.urdf") == 1


def test_fix_prints_only_the_patch_and_says_how_to_apply_it(folder: Path, capsys) -> None:
    (folder / "r.urdf").write_text(urdf("-0.02"), encoding="utf-8")
    assert check("r.urdf", "--fix") == 2
    captured = capsys.readouterr()
    assert captured.out.startswith("--- r.urdf\n+++ r.urdf\n")
    assert "changes a; apply with: patch -p0 < THE_PATCH" in captured.err
    assert "inertia.not-positive" in captured.err


def test_patch_goes_to_a_file(folder: Path, capsys) -> None:
    (folder / "r.urdf").write_text(urdf("-0.02"), encoding="utf-8")
    assert check("r.urdf", "--fix", "--output", "fix.patch") == 2
    assert (folder / "fix.patch").read_text(encoding="utf-8").startswith("--- r.urdf\n")
    captured = capsys.readouterr()
    assert "patch -p0 < fix.patch" in captured.err
    assert "[inertia.not-positive]" in captured.out


def test_nothing_to_patch(folder: Path, capsys) -> None:
    (folder / "r.urdf").write_text(urdf(), encoding="utf-8")
    assert check("r.urdf", "--fix") == 0
    captured = capsys.readouterr()
    assert captured.out == ""
    assert "there is nothing to patch" in captured.err


def test_json_has_links_and_findings(folder: Path, capsys) -> None:
    (folder / "r.urdf").write_text(urdf("-0.02"), encoding="utf-8")
    check("r.urdf", "--json")
    found = json.loads(capsys.readouterr().out)
    (link,), (finding,) = found["links"], found["findings"]
    assert (link["link"], link["mass_kg"], link["verdict"]) == ("a", 12.0, "not-positive")
    assert link["density_kg_m3"] == pytest.approx(2000.0)
    assert (finding["code"], finding["severity"]) == ("inertia.not-positive", "error")
    assert (finding["line"], finding["column"]) == (5, 7)
    assert "<inertial>" in finding["fix"]


def test_xacro_arguments_are_passed_on(folder: Path, capsys) -> None:
    text = urdf(mass="$(arg mass)").replace(
        '<robot name="r">', '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'
    )
    (folder / "r.urdf.xacro").write_text(text, encoding="utf-8")
    assert check("r.urdf.xacro", "mass:=12") == 0
    assert check("r.urdf.xacro", "mass:=-1") == 2
    assert "link 'a' has a mass of -1 kg" in capsys.readouterr().out


def test_missing_file_is_an_error(folder: Path, capsys) -> None:
    assert check("nowhere.urdf") == 2
    assert "robot or model 'nowhere.urdf' not found" in capsys.readouterr().out


def test_missing_mesh_is_said(folder: Path, capsys) -> None:
    text = urdf().replace('<box size="0.1 0.2 0.3"/>', '<mesh filename="gone.stl"/>')
    (folder / "r.urdf").write_text(text, encoding="utf-8")
    assert check("r.urdf") != 0
    out = capsys.readouterr().out
    assert "gone.stl" in out
    assert "ok (no shapes to compare with)" in out


@pytest.mark.tutorial
def test_mira_is_fine(workspaces_dir: Path, monkeypatch, capsys) -> None:
    """M1: the table's values are plausible for the geometry."""
    monkeypatch.chdir(workspaces_dir / "catkin_ws")
    check("src/urdf_exam/urdf/mira_gazebo.urdf", "--json")
    found = json.loads(capsys.readouterr().out)
    assert [link["verdict"] for link in found["links"]] == ["ok"] * 7
