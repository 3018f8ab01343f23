"""``ign sdf`` and the front ``ign``."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.cli.main import main
from gazelle.cli.sdf.sdf_file import QUIET

Capture = pytest.CaptureFixture[str]

_MODEL = """<?xml version="1.0"?>
<sdf version="1.9"><model name="m">
  <link name="a"><inertial><mass>2</mass></inertial></link>
  <link name="b"><pose>0 0 1 0 0 1.5707963267948966</pose></link>
  <joint name="j" type="fixed"><parent>a</parent><child>b</child></joint>
</model></sdf>
"""


@pytest.fixture
def model(tmp_path: Path) -> str:
    """A file with two links, one of them turned."""
    file = tmp_path / "model.sdf"
    file.write_text(_MODEL, encoding="utf-8")
    return str(file)


def test_good_file_is_valid(model: str, capsys: Capture) -> None:
    assert main(["ign", "sdf", "-k", model]) == 0
    assert capsys.readouterr().out == "Valid.\n"


def test_bad_file_fails_with_numbers_and_with_our_place(tmp_path: Path, capsys: Capture) -> None:
    file = tmp_path / "bad.sdf"
    file.write_text(_MODEL.replace(">b<", ">zz<"), encoding="utf-8")
    assert main(["ign", "sdf", "--check", str(file)]) == 255
    said = capsys.readouterr()
    assert said.out == ""
    assert "Error Code 19: Msg: Child frame with name[zz] specified by joint" in said.err
    assert (
        "error: child frame with name 'zz' specified by joint with name 'j' not found" in said.err
    )
    main(["ign", "sdf", "--check", str(file), QUIET])
    assert "[sdf.bad-joint]" not in capsys.readouterr().err


def test_missing_file_is_said_as_ign_says_it(capsys: Capture) -> None:
    assert main(["ign", "sdf", "-p", "nofile.sdf"]) == 255
    assert (
        capsys.readouterr().err
        == f"Error: File [{Path('nofile.sdf').absolute()}] does not exist.\n"
    )
    assert main(["ign", "sdf", "-k", "nofile.sdf"]) == 255
    assert "Error Code 1: Msg: Unable to read file:" in capsys.readouterr().err


def test_printed_angles_in_degrees(model: str, capsys: Capture) -> None:
    assert main(["ign", "sdf", "-p", "--degrees", model]) == 0
    expected = "<pose degrees='true' rotation_format='euler_rpy'>0 0 1   0 0 90</pose>"
    assert expected in capsys.readouterr().out


def test_angles_snap_within_the_tolerance(model: str, capsys: Capture) -> None:
    Path(model).write_text(_MODEL.replace("1.5707963267948966", "1.5"), encoding="utf-8")
    main(["ign", "sdf", "-p", "--snap-to-degrees", "45", model])
    assert ">0 0 1   0 0 85.9437</pose>" in capsys.readouterr().out
    main(["ign", "sdf", "-p", "--snap-to-degrees", "45", "--snap-tolerance", "5", model])
    assert ">0 0 1   0 0 90</pose>" in capsys.readouterr().out
    assert main(["ign", "sdf", "-p", "--snap-to-degrees", "0", model]) == 255
    assert "Degree interval to snap to must be more than 0" in capsys.readouterr().out


def test_included_models_can_stay_includes(
    model: str, tmp_path: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    world = tmp_path / "w.world"
    world.write_text(
        '<sdf version="1.9"><world name="w"><include><uri>model.sdf</uri></include></world></sdf>',
        encoding="utf-8",
    )
    monkeypatch.chdir(tmp_path)
    main(["ign", "sdf", "-p", str(world)])
    assert "<model name='m'>" in capsys.readouterr().out
    main(["ign", "sdf", "-p", "-i", str(world)])
    assert "<include>\n      <uri>model.sdf</uri>\n    </include>" in capsys.readouterr().out


def test_mass_and_centre_of_a_model(model: str, capsys: Capture) -> None:
    assert main(["ign", "sdf", "--inertial-stats", model]) == 0
    out = capsys.readouterr().out
    assert "Total mass of the model: 3\n" in out
    assert "X: 0\nY: 0\nZ: 0.333333\n" in out
    # Two unit inertias and masses of 2 kg and 1 kg, 1 m apart: 2 + 2/3.
    assert "2.66667  0        0" in out


def test_graphs_of_frames_and_poses(model: str, capsys: Capture) -> None:
    assert main(["ign", "sdf", "-g", "frame", model]) == 0
    assert "  5 -> 4 [label=1];\n" in capsys.readouterr().out
    assert main(["ign", "sdf", "-g", "tree", model]) == 0
    assert capsys.readouterr().err == 'Only "pose" and "frame" graph types are supported\n'


def test_specification_is_described_with_types_and_defaults(capsys: Capture) -> None:
    assert main(["ign", "sdf", "-d"]) == 0
    out = capsys.readouterr().out
    assert "<element name ='mass' required ='0' type ='double' default ='1'>" in out
    assert main(["ign", "sdf", "-d", "1.5"]) == 255


def test_front_names_what_to_use_instead(capsys: Capture) -> None:
    assert main(["ign", "msg", "-l"]) == 255
    assert capsys.readouterr().err == ("gazelle: ign msg is not here; use rosmsg show\n")
    assert main(["ign", "sdf", "--versions"]) == 0
    assert capsys.readouterr().out == "12.3.0\n"
    assert main(["ign", "sdf", "--force-version", "9", "-k", "x"]) == 255
    assert "I cannot find this command in version [9]" in capsys.readouterr().out
    assert main(["ign", "sdf", "-x"]) == 255
    assert "-k [ --check ] arg" in capsys.readouterr().out
