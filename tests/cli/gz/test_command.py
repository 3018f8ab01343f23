"""``gz sdf`` and the front ``gz``."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.cli.main import main

Capture = pytest.CaptureFixture[str]

_URDF = """<robot name="my_robot"><link name="base"><inertial><mass value="1"/>
<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link></robot>"""


@pytest.mark.tutorial
def test_urdf_becomes_sdf(tmp_path: Path, capsys: Capture) -> None:
    file = tmp_path / "my_urdf.urdf"
    file.write_text(_URDF, encoding="utf-8")
    assert main(["gz", "sdf", "--print", str(file)]) == 0
    out = capsys.readouterr().out
    assert out.startswith("<sdf version='1.7'>\n  <model name='my_robot'>\n    <link name='base'>")
    converted = tmp_path / "my_sdf.sdf"
    converted.write_text(out, encoding="utf-8")
    assert main(["gz", "sdf", "-k", str(converted)]) == 0
    assert capsys.readouterr().out == "Check complete\n"


@pytest.mark.tutorial
def test_stages_of_the_tutorial_model_are_printed_and_the_first_has_no_link(
    workspaces_dir: Path, capsys: Capture
) -> None:
    verdicts = []
    for file in sorted((workspaces_dir / "gazebo_models" / "stages").glob("*.sdf")):
        assert main(["gz", "sdf", "-p", str(file), "--no-findings"]) == 0
        assert capsys.readouterr().out.startswith("<sdf version='1.7'>\n  <model name=")
        code = main(["ign", "sdf", "-k", str(file), "--no-findings"])
        said = capsys.readouterr()
        assert (code == 0) == (said.out == "Valid.\n")
        if code:
            assert "Error Code 16: Msg: A model must have at least one link." in said.err
        verdicts.append(code == 0)
    assert verdicts == [False, True, True, True, True, True, True]


def test_broken_file_ends_with_zero_as_gz_does(tmp_path: Path, capsys: Capture) -> None:
    file = tmp_path / "broken.sdf"
    file.write_text("<sdf version='1.7'><model name='m'>", encoding="utf-8")
    assert main(["gz", "sdf", "-k", str(file)]) == 0
    said = capsys.readouterr()
    assert said.out == ""
    assert "Error parsing XML in file" in said.err
    assert "Error: SDF parsing the xml failed" in said.err


def test_missing_file_is_said_as_gz_says_it(capsys: Capture) -> None:
    assert main(["gz", "sdf", "-p", "nofile.sdf"]) == 0
    err = capsys.readouterr().err
    assert err.startswith("Error: File doesn't exist[nofile.sdf]\n")
    assert "Error finding file [nofile.sdf]." in err


def test_other_commands_are_named_in_one_line(capsys: Capture) -> None:
    assert main(["gz", "physics", "-g", "0,0,0"]) == 255
    assert capsys.readouterr().err.startswith("gazelle: gz physics is not here; use rosservice")
    assert main(["gz", "sdf", "-c", "old.sdf"]) == 255
    assert "use gz sdf -p old.sdf > NEW.sdf" in capsys.readouterr().err
    assert main(["gz", "nonsense"]) == 255
    assert "Usage:  gz <command>" in capsys.readouterr().err


def test_help_and_wrong_options(capsys: Capture) -> None:
    assert main(["gz", "sdf", "--help"]) == 0
    assert "-p [ --print ] arg" in capsys.readouterr().err
    assert main(["gz", "sdf", "-p"]) == 0
    assert capsys.readouterr().err == "Invalid arguments\n"
    assert main(["gz", "sdf", "-d"]) == 0
    assert "<element name ='sdf' required ='1'>" in capsys.readouterr().out
    assert main(["gz", "sdf", "-v", "1.3", "-d"]) == 255
