"""``gazelle convert`` as people call it."""

from __future__ import annotations

import stat
from pathlib import Path

import mujoco
import pytest

from gazelle.cli.main import main
from gazelle.description.loader import load_models
from gazelle.diagnostics import Diagnostics

BOX = '<geometry><box size="0.1 0.2 0.3"/></geometry>'
URDF = f"""<robot name="r">
  <link name="a"><inertial><mass value="2"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0"
    izz="0.1"/></inertial><visual>{BOX}</visual><collision>{BOX}</collision></link>
</robot>
"""
SDF = (
    '<sdf version="1.6"><model name="m"><link name="l"><visual name="v"><geometry><cylinder>'
    "<radius>0.1</radius><length>1</length></cylinder></geometry></visual></link></model></sdf>"
)
EGG = (
    '<sdf version="1.9"><model name="m"><link name="l"><visual name="egg"><geometry><ellipsoid>'
    "<radii>1 1 2</radii></ellipsoid></geometry></visual></link></model></sdf>"
)
MJCF = (
    '<mujoco model="bot"><worldbody><geom type="plane" size="1 1 1"/><body name="b"><freejoint/>'
    '<geom size="0.1" mass="3"/></body></worldbody></mujoco>'
)
FILES = {"r.urdf": URDF, "m.sdf": SDF, "egg.sdf": EGG, "bot.xml": MJCF}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for name, text in FILES.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def convert(*words: str) -> int:
    return main(["convert", *words])


def usage_error(capsys, *words: str) -> str:
    with pytest.raises(SystemExit) as stop:
        convert(*words)
    assert stop.value.code == 2
    return str(capsys.readouterr().err)


def models(path: Path):
    return load_models(path, workspace=None, diagnostics=Diagnostics())


@pytest.mark.parametrize("target", ["urdf", "sdf", "mjcf"])
@pytest.mark.parametrize("source", ["r.urdf", "m.sdf", "bot.xml"])
def test_every_format_becomes_every_other(folder, capsys, source, target) -> None:
    if (source, target) == ("bot.xml", "mjcf"):
        assert "'bot.xml' is MJCF already" in usage_error(capsys, source, "-o", "new.mjcf")
        return
    assert convert(source, "-o", f"new.{target}") == 0
    out = capsys.readouterr().out
    assert out.startswith(f"new.{target}: {target.upper()}")
    if target == "mjcf":
        assert mujoco.MjModel.from_xml_path(f"new.{target}").nbody == 2
    else:
        names = {link.name for model in models(folder / f"new.{target}") for link in model.links}
        assert names & {"a", "l", "b"}


def test_sdf_is_what_sdformat_makes(folder, capsys) -> None:
    assert convert("r.urdf", "-o", "-", "--to", "sdf") == 0
    twelve = capsys.readouterr().out
    assert convert("r.urdf", "--to", "sdf", "--sdformat", "9") == 0
    nine = capsys.readouterr().out
    assert twelve.splitlines()[0] == "<sdf version='1.9'>"
    assert nine.splitlines()[0] == "<sdf version='1.7'>"
    assert "<collision name='a_collision'>" in twelve


def test_what_sdformat_says_is_passed_on(folder, capsys) -> None:
    Path("two.urdf").write_text(
        URDF.replace("</robot>", '<link name="b"/><link name="c"/></robot>'), encoding="utf-8"
    )
    assert convert("two.urdf", "-o", "two.sdf") == 1
    err = capsys.readouterr().err
    assert "sdformat 12 says: " in err
    assert "[convert.sdformat]" in err
    assert "sdformat 12 refuses 'two.urdf'" in err
    assert not Path("two.sdf").exists()


def test_xacro_arguments_are_taken(folder, capsys) -> None:
    text = URDF.replace("<robot", '<robot xmlns:xacro="http://ros.org/wiki/xacro"').replace(
        '"2"', '"$(arg mass)"'
    )
    text = text.replace("<link", '<xacro:arg name="mass" default="1"/><link', 1)
    Path("x.urdf.xacro").write_text(text, encoding="utf-8")
    for target in ("x.urdf", "x.sdf", "x.xml"):
        assert convert("x.urdf.xacro", "-o", target, "mass:=7") == 0
    assert models(Path("x.urdf"))[0].links[0].inertial.mass_kg == 7
    assert "<mass>7</mass>" in Path("x.sdf").read_text(encoding="utf-8")
    assert mujoco.MjModel.from_xml_path("x.xml").body_mass[1] == 7


def test_existing_files_need_force(folder, capsys) -> None:
    Path("new.urdf").write_text("precious", encoding="utf-8")
    assert "'new.urdf' exists; add -f to replace it" in usage_error(
        capsys, "m.sdf", "-o", "new.urdf"
    )
    assert Path("new.urdf").read_text(encoding="utf-8") == "precious"
    assert convert("m.sdf", "-o", "new.urdf", "-f") == 0
    assert models(Path("new.urdf"))[0].name == "m"


def test_existing_company_needs_force_too(folder, capsys) -> None:
    mesh = folder / "new_files" / "l_egg.stl"
    mesh.parent.mkdir()
    mesh.write_bytes(b"precious")
    assert convert("egg.sdf", "-o", "new.urdf") == 1
    assert "exists and is another file; add -f" in capsys.readouterr().err
    assert mesh.read_bytes() == b"precious"
    assert not Path("new.urdf").exists()
    assert convert("egg.sdf", "-o", "new.urdf", "-f") == 0
    assert mesh.stat().st_size > 1000
    assert "new.urdf: URDF of 'm', 1 link, 0 joints, 1 file beside it" in capsys.readouterr().out


def test_files_are_written_whole_with_usual_rights(folder) -> None:
    assert convert("m.sdf", "-o", "new.urdf") == 0
    assert stat.S_IMODE(Path("new.urdf").stat().st_mode) & 0o600 == 0o600
    assert sorted(path.name for path in folder.iterdir()) == sorted([*FILES, "new.urdf"])


def test_standard_output_holds_the_text_alone(folder, capsys) -> None:
    assert convert("egg.sdf", "--to", "urdf") == 0
    out, err = capsys.readouterr()
    assert out.startswith('<?xml version="1.0"?>')
    assert out.rstrip().endswith("</robot>")
    assert "a mesh in its place needs a file to be written beside" in err


def test_unknown_endings_and_formats_are_explained(folder, capsys) -> None:
    assert "the ending of 'a.txt' does not say" in usage_error(capsys, "m.sdf", "-o", "a.txt")
    assert "no format is given; add --to urdf" in usage_error(capsys, "m.sdf")
    assert "there is no folder 'no'" in usage_error(capsys, "m.sdf", "-o", "no/a.urdf")
    assert "is a folder" in usage_error(capsys, "m.sdf", "-o", ".", "--to", "urdf")
    words = ("m.sdf", "-o", "a.sdf", "--package", "p")
    assert "--package is for URDF" in usage_error(capsys, *words)


def test_several_models_need_a_name(folder, capsys) -> None:
    one = SDF.split(">", 1)[1].removesuffix("</sdf>")
    two = one.replace('name="m"', 'name="n"')
    text = f'<sdf version="1.9"><world name="w">{one}{two}</world></sdf>'
    Path("w.world").write_text(text, encoding="utf-8")
    assert convert("w.world", "-o", "w.urdf") == 1
    err = capsys.readouterr().err
    assert "there are 2 models: m, n" in err
    assert "[convert.several-models]" in err
    assert convert("w.world", "-o", "w.urdf", "--model", "n") == 0
    assert models(Path("w.urdf"))[0].name == "n"
    assert convert("w.world", "-o", "n.xml", "--model", "n") == 0
    assert mujoco.MjModel.from_xml_path("n.xml").body(1).name == "n::l"
    assert convert("w.world", "-o", "x.urdf", "--model", "mm") == 1
    assert "models there: m, n" in capsys.readouterr().err


def test_scenery_of_mjcf_is_left_out_of_a_urdf(folder, capsys) -> None:
    assert convert("bot.xml", "-o", "bot.urdf") == 0
    assert "only 'bot' is written, without scenery" in capsys.readouterr().err
    [model] = models(Path("bot.urdf"))
    assert model.links[0].inertial.mass_kg == 3


def test_broken_sources_are_explained(folder, capsys) -> None:
    assert convert("nothing.urdf", "-o", "a.urdf") == 1
    assert "nothing.urdf" in capsys.readouterr().err
    assert convert("nothing.urdf", "-o", "a.sdf") == 1
    assert "[load.not-found]" in capsys.readouterr().err
    Path("bad.xml").write_text("<mujoco><worldbody><geom/></worldbody></mujoco>", encoding="utf-8")
    assert convert("bad.xml", "-o", "a.urdf") == 1
    assert "MuJoCo refuses the file" in capsys.readouterr().err
    Path("empty.xml").write_text("<mujoco/>", encoding="utf-8")
    assert convert("empty.xml", "-o", "a.urdf") == 1
    assert "there is no model in the file" in capsys.readouterr().err
    Path("bad.urdf").write_text("<robot", encoding="utf-8")
    assert convert("bad.urdf", "-o", "a.mjcf") == 1
    assert "[xml.malformed]" in capsys.readouterr().err


def test_mjcf_given_to_other_commands_is_explained() -> None:
    found = Diagnostics()
    load_models(MJCF, workspace=None, diagnostics=found)
    [item] = found.by_code("load.unknown-format")
    assert "gazelle convert FILE -o robot.urdf" in item.fix


_MASS = (
    '<inertial><mass value="1"/>'
    '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
)
_TWO = (
    '<robot name="r"><link name="a">{root}</link><link name="b">{mass}</link>'
    '<joint name="j" type="continuous"><parent link="a"/><child link="b"/>{more}</joint></robot>'
)


def test_a_robot_that_would_lose_every_link_is_refused(folder, capsys) -> None:
    (folder / "r.urdf").write_text(_TWO.format(root="", mass=_MASS, more=""), encoding="utf-8")
    assert convert("r.urdf", "-o", "r.sdf") != 0
    said = " ".join(capsys.readouterr().err.split())
    assert "leaves out every link of 'r.urdf'" in said
    assert "convert.no-links" in said
    assert not (folder / "r.sdf").exists()


def test_a_mimic_that_the_sdf_cannot_say_is_named(folder, capsys) -> None:
    mimic = '<mimic joint="k"/>'
    (folder / "r.urdf").write_text(_TWO.format(root=_MASS, mass=_MASS, more=mimic), "utf-8")
    assert convert("r.urdf", "-o", "r.sdf") == 0
    assert "joint 'j' follows 'k' no more" in capsys.readouterr().err
