"""``gazelle view`` on files, packages, models and worlds."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from gazelle.cli.main import main
from gazelle.sensors import warm_up
from gazelle.workspace.scaffold import create_package

ARM = """<robot name="arm">
  <link name="base"><visual><geometry><box size="0.2 0.2 0.2"/></geometry></visual></link>
  <link name="bar"><visual><origin xyz="0.5 0 0"/><geometry><box size="1 0.1 0.1"/></geometry>
  </visual></link>
  <joint name="hinge" type="continuous">
    <parent link="base"/><child link="bar"/><axis xyz="0 0 1"/>
  </joint>
</robot>"""


@pytest.fixture(autouse=True)
def _in_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "GAZEBO_MODEL_PATH"):
        monkeypatch.delenv(name, raising=False)
    (tmp_path / "arm.urdf").write_text(ARM)


def _picture(path: str) -> np.ndarray:
    with Image.open(path) as image:
        assert image.format == "PNG"
        return np.asarray(image)


def test_a_file_becomes_a_picture_beside_us(tmp_path, capsys) -> None:
    assert main(["view", "arm.urdf"]) == 0
    assert capsys.readouterr().out == "arm.png: 800x600\n"
    assert _picture("arm.png").shape == (600, 800, 3)


def test_pictures_are_the_same_bytes_every_time(tmp_path) -> None:
    words = ["view", "arm.urdf", "--size", "120x90", "--show", "visuals,frames,joints", "-o"]
    assert main([*words, "a.png"]) == 0
    assert main([*words, "b.png"]) == 0
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_joint_turns_what_is_seen_and_background_is_ours() -> None:
    words = ["view", "arm.urdf", "--size", "120x90", "--background", "#102030"]
    camera = ["--camera", "0", "0", "5", "--look-at", "0", "0", "0"]
    assert main([*words, *camera, "-o", "a.png"]) == 0
    assert main([*words, *camera, "--joint", "hinge=1.5707963", "-o", "b.png"]) == 0
    first = (_picture("a.png") != (16, 32, 48)).any(axis=2)
    second = (_picture("b.png") != (16, 32, 48)).any(axis=2)
    # The bar points right, then up.
    assert first[45, 85]
    assert not first[20, 60]
    assert second[20, 60]
    assert not second[45, 85]


def test_a_package_shows_its_robot_and_a_named_file(capsys) -> None:
    # Of kernels that have to be compiled the first picture tells.
    warm_up(lambda text: None)
    create_package("robot", "my_bot", Path())
    assert main(["view", "my_bot", "--size", "80x60"]) == 0
    assert main(["view", "my_bot", "my_bot.world", "--size", "80x60", "-o", "w.png"]) == 0
    assert main(["view", "./my_bot/", "--size", "80x60", "-o", "again.png"]) == 0
    assert Path("again.png").read_bytes() == Path("my_bot.png").read_bytes()
    # The world has its own grey background, the robot the studio's.
    assert _picture("my_bot.png")[0, 0].tolist() == [237, 240, 245]
    assert _picture("w.png")[0, 0].tolist() != [237, 240, 245]
    assert capsys.readouterr().err == ""


def test_models_and_worlds_are_found_by_name(capsys) -> None:
    assert main(["view", "coke_can", "--size", "80x60"]) == 0
    assert main(["view", "shapes.world", "--size", "80x60"]) == 0
    assert capsys.readouterr().out == "coke_can.png: 80x60\nshapes.png: 80x60\n"


def test_a_package_with_several_robots_wants_one_named(capsys) -> None:
    create_package("robot", "my_bot", Path())
    for name in ("big", "small"):
        Path(f"my_bot/urdf/{name}.urdf").write_text(ARM)
    Path("my_bot/urdf/my_bot.urdf.xacro").unlink()
    Path("my_bot/worlds/my_bot.world").unlink()
    assert main(["view", "my_bot"]) == 1
    err = capsys.readouterr().err
    assert "name one: gazelle view my_bot big.urdf" in err
    assert "urdf/big.urdf, urdf/small.urdf" in err
    assert main(["view", "my_bot", "bigg.urdf"]) == 1
    assert "robot file 'bigg.urdf' not found; did you mean 'big.urdf'?" in capsys.readouterr().err


def test_missing_files_and_names_give_the_nearest(capsys) -> None:
    assert main(["view", "arn.urdf"]) == 1
    err = capsys.readouterr().err
    assert "robot, model or world 'arn.urdf' not found; did you mean 'arm.urdf'" in err
    Path("empty").mkdir()
    assert main(["view", "./empty"]) == 1
    assert "robot, model or world './empty' not found" in capsys.readouterr().err
    assert main(["view", "coke_cann"]) == 1
    assert "did you mean 'coke_can'" in capsys.readouterr().err


def test_unknown_joint_and_overlay_give_the_nearest(capsys) -> None:
    assert main(["view", "arm.urdf", "--joint", "hing=1"]) == 1
    assert "joint 'hing' not found; did you mean 'hinge'" in capsys.readouterr().err
    assert main(["view", "arm.urdf", "--show", "frame"]) == 1
    assert "overlay 'frame' not found; did you mean 'frames'" in capsys.readouterr().err


def test_bad_files_are_explained(tmp_path, capsys) -> None:
    (tmp_path / "bad.urdf").write_text("<robot name='r'><link/></robot>")
    assert main(["view", "bad.urdf"]) == 1
    assert "[urdf.link-no-name]" in capsys.readouterr().err
    assert not (tmp_path / "bad.png").exists()


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (["--size", "big"], "'big' is no size; write it as 800x600"),
        (["--size", "4x4"], "4x4 pixels do not do for 1 view(s)"),
        (["--joint", "hinge"], "'hinge' is no position; write it as joint=0.5"),
        (["--background", "nocolour"], "'nocolour' is no colour"),
        (["-o", "out.jpg"], "'out.jpg': pictures are PNG files"),
        (["-o", "no/where.png"], "cannot write no/where.png"),
        (["--look-at", "0", "0", "0"], "--look-at needs --camera"),
        (["a", "b"], "name one FILE, PACKAGE or MODEL, or PACKAGE and FILE"),
    ],
)
def test_wrong_options_are_explained(words: list[str], text: str, capsys) -> None:
    with pytest.raises(SystemExit) as caught:
        main(["view", "arm.urdf", *words])
    assert caught.value.code == 2
    assert text in capsys.readouterr().err
