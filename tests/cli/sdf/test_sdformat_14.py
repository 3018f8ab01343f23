"""What ``gz sdf`` says where sdformat 14 is in use, and 12 does not."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.cli.main import main

Capture = pytest.CaptureFixture[str]
MODEL = """<sdf version="{version}"><model name="m"><link name="l">
  <strange/><own:mark xmlns:own="urn:own"/>{inside}
</link></model></sdf>"""
CONE = """<collision name="c"><density>500</density><geometry>
  <cone><radius>0.5</radius><length>1</length></cone></geometry></collision>"""
INERTIAL = """<inertial><mass value="1"/>
  <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>"""
ROBOT = f"""<robot name="r"><link name="base">{INERTIAL}</link>
  <joint name="rack" type="continuous"><parent link="base"/><child link="gear"/>
    <mimic joint="lead" multiplier="2"/></joint>
  <link name="gear">{INERTIAL}</link>
  <joint name="lead" type="continuous"><parent link="base"/><child link="wheel"/></joint>
  <link name="wheel">{INERTIAL}</link>
  <joint name="mount" type="fixed"><origin xyz="1 2 3"/>
    <parent link="base"/><child link="plate"/></joint>
  <link name="plate"/>
  <joint name="hinge" type="continuous"><parent link="plate"/><child link="light"/></joint>
  <link name="light"/>
</robot>"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    for name in ("GZ_VERSION", "IGNITION_VERSION", "SDF_PATH", "GAZEBO_MODEL_PATH"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("ROS_DISTRO", "jazzy")
    (tmp_path / "m.sdf").write_text(MODEL.format(version="1.11", inside=CONE), encoding="utf-8")
    (tmp_path / "r.urdf").write_text(ROBOT, encoding="utf-8")
    return tmp_path


def run(capsys: Capture, *words: str) -> tuple[int, str, str]:
    code = main(["gz", "sdf", *words, "--no-findings"])
    return (code, *capsys.readouterr())


def test_elements_that_are_not_known_are_warned_of(folder: Path, capsys: Capture) -> None:
    code, out, err = run(capsys, "-k", "m.sdf")
    assert (code, out) == (0, "Valid.\n")
    lines = err.splitlines()
    # The file is read twice.
    assert len(lines) == 2
    place = f'[/sdf/model[@name="m"]/link[@name="l"]/strange:{folder}/m.sdf:L2]'
    assert lines[0].endswith(
        f"{place}: XML Element[strange], child of element[link], not defined in SDF. "
        "Copying[strange] as children of [link]."
    )


def test_sdformat_12_passes_over_them(
    folder: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROS_DISTRO", "humble")
    text = MODEL.format(version="1.9", inside="")
    (folder / "m.sdf").write_text(text, encoding="utf-8")
    assert run(capsys, "-k", "m.sdf") == (0, "Valid.\n", "")


@pytest.mark.parametrize("version", ["1.6", "1.9", "1.10", "1.11"])
def test_documents_are_printed_as_sdf_1_11(folder: Path, capsys: Capture, version: str) -> None:
    (folder / "m.sdf").write_text(MODEL.format(version=version, inside=CONE), encoding="utf-8")
    code, out, err = run(capsys, "-p", "m.sdf")
    assert code == 0
    assert out.startswith("<sdf version='1.11'>")
    assert "<density>500</density>" in out
    assert "Converter" not in err


def test_a_newer_version_than_it_knows_is_told(folder: Path, capsys: Capture) -> None:
    (folder / "m.sdf").write_text(MODEL.format(version="1.12", inside=""), encoding="utf-8")
    assert "Unable to convert from SDF version 1.12 to 1.11" in run(capsys, "-k", "m.sdf")[2]


def test_errors_have_the_numbers_of_14(folder: Path, capsys: Capture) -> None:
    text = '<sdf version="1.9"><model name="m"/></sdf>'
    (folder / "m.sdf").write_text(text, encoding="utf-8")
    code, _out, err = run(capsys, "-k", "m.sdf")
    assert code == 255
    assert "Error Code 17: Msg: A model must have at least one link." in err


def test_mimic_and_the_names_of_lumped_links_are_kept(folder: Path, capsys: Capture) -> None:
    out = run(capsys, "-p", "r.urdf")[1]
    assert "<mimic joint='lead'>" in out
    assert "<multiplier>2</multiplier>" in out
    assert "<frame name='mount' attached_to='base'>" in out
    assert "<frame name='plate' attached_to='mount'>" in out
    assert "<static>" not in out


def test_a_link_without_mass_is_warned_of(folder: Path, capsys: Capture) -> None:
    err = run(capsys, "-p", "r.urdf")[2]
    start = "Error Code 19: Msg: urdf2sdf: "
    assert f"{start}link[light] has no <inertial> block defined. Please ensure" in err
    assert f"{start}parent joint[hinge] ignored." in err
    assert f"{start}link[light] is not modeled in sdf." in err
    assert "link[plate]" not in err


def test_bare_names_are_found_on_sdf_path(
    folder: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    (folder / "models").mkdir()
    (folder / "models" / "one.sdf").write_text(MODEL.format(version="1.9", inside=""))
    world = "<sdf version='1.9'><world name='w'><include><uri>one.sdf</uri></include></world></sdf>"
    (folder / "w.sdf").write_text(world, encoding="utf-8")
    assert run(capsys, "-k", "w.sdf")[0] == 255
    monkeypatch.setenv("SDF_PATH", str(folder / "models"))
    assert run(capsys, "-k", "w.sdf")[0] == 0


def test_the_help_names_its_specification(folder: Path, capsys: Capture) -> None:
    assert "Default version (1.11)." in run(capsys, "--help")[1]
    code, _out, err = run(capsys, "-d", "1.9")
    assert (code, err) == (
        255,
        "gazelle: gz sdf describes SDF 1.11 here, not 1.9; others: gz sdf -d with"
        " ROS_DISTRO=noetic (1.7), humble (1.9), jazzy (1.11)\n",
    )
