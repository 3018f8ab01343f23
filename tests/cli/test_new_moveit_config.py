"""``gazelle new moveit_config``."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.motion.setup_assistant.robots import chain, link

from gazelle.cli.main import main

_FEW = ("--trials", "50")


@pytest.fixture(autouse=True)
def _in_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH"):
        monkeypatch.delenv(name, raising=False)
    robot = f'<robot name="picker">{link("base")}{chain("", "base", 4)}</robot>'
    (tmp_path / "picker.urdf").write_text(robot, encoding="utf-8")


def test_it_lists_files_shows_the_proposal_and_says_what_to_type_next(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["new", "moveit_config", "picker.urdf", "--ros2", *_FEW]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "picker_moveit_config/.setup_assistant"
    assert "picker_moveit_config/launch/demo.launch.py" in lines
    rows = {line.split("   ")[0]: line.split("   ")[-1].strip() for line in lines if "   " in line}
    assert rows["group arm"] == "base to link_4"
    assert rows["pose arm/home"] == "0, 0, 0, 0"
    assert rows["virtual joint virtual_joint"] == "fixed, world to base"
    assert lines[-3:] == [
        "plan with it:   gazelle ros2 launch picker_moveit_config demo.launch.py",
        "in Gazebo:      gazelle ros2 launch picker_moveit_config gazebo.launch.py",
        "look for slips: gazelle doctor picker_moveit_config",
    ]
    assert (tmp_path / "picker_moveit_config" / "config" / "picker.urdf").is_file()


def test_ros_1_is_the_default_and_its_commands_are_roslaunchs(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["new", "moveit_config", "picker.urdf", *_FEW]) == 0
    out = capsys.readouterr().out
    assert "plan with it:   gazelle roslaunch picker_moveit_config demo.launch\n" in out


def test_groups_are_those_that_are_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ("--group", "short=base:link_2", "--ee", "grip=link_3", "--name", "other_config")
    assert main(["new", "moveit_config", "picker.urdf", *words, *_FEW]) == 0
    srdf = (tmp_path / "other_config" / "config" / "picker.srdf").read_text(encoding="utf-8")
    assert '<group name="short">\n        <chain base_link="base" tip_link="link_2"/>' in srdf
    assert '<group name="grip">\n        <joint name="joint_4"/>' in srdf


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--group", "arm=base"), "'arm=base' is not understood; write --group NAME=BASE:TIP"),
        (("--group", "arm=base:link_9"), "link 'link_9' not found; did you mean"),
        (("--group", "arm=link_2:base"), "no joint that moves is between link 'link_2' and 'base'"),
        (("--ee", "hand=link_4"), "no joint that moves is below link 'link_4'"),
        (("--name", "Bad"), "'Bad' is no name for a package"),
        (("--trials", "0"), "--trials: at least one is needed"),
    ],
)
def test_what_cannot_be_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], words: tuple[str, ...], message: str
) -> None:
    assert main(["new", "moveit_config", "picker.urdf", *_FEW, *words]) == 1
    assert message in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["picker.urdf"]


def test_a_package_that_is_there_is_updated_only_when_asked_and_keeps_what_was_edited(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["new", "moveit_config", "picker.urdf", *_FEW]
    assert main([*words, "--update"]) == 1
    assert "picker_moveit_config is not there; leave --update out" in capsys.readouterr().err
    assert main(words) == 0
    assert main(words) == 1
    assert "is there already; nothing was written (--update" in capsys.readouterr().err
    file = tmp_path / "picker_moveit_config" / "launch" / "demo.launch"
    file.write_text("<launch/>", encoding="utf-8")
    capsys.readouterr()
    assert main([*words, "--update"]) == 0
    assert "edited since they were written, and kept" in capsys.readouterr().out
    assert file.read_text(encoding="utf-8") == "<launch/>"
    assert main([*words, "--update", "--overwrite", "launch/demo.launch"]) == 0
    assert "<launch/>" not in file.read_text(encoding="utf-8")
    assert main([*words, "--update", "--overwrite", "launch/x"]) == 1
    assert "'launch/x' is no file that the package is written of" in capsys.readouterr().err
