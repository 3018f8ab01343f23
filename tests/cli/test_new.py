"""``gazelle new``."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.cli.main import main


@pytest.fixture(autouse=True)
def _in_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH"):
        monkeypatch.delenv(name, raising=False)


def test_new_lists_what_it_wrote_and_how_to_start_it(tmp_path, capsys) -> None:
    assert main(["new", "world", "my_world"]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "my_world/CMakeLists.txt",
        "my_world/launch/my_world.launch",
        "my_world/package.xml",
        "my_world/worlds/my_world.world",
        "",
        "start it:   gazelle roslaunch my_world my_world.launch",
        "look at it: gazelle view my_world",
    ]
    assert (tmp_path / "my_world" / "package.xml").is_file()


def test_packages_go_into_a_workspaces_src(tmp_path, capsys) -> None:
    (tmp_path / "src").mkdir()
    assert main(["new", "package", "my_node", "--ros2"]) == 0
    assert (tmp_path / "src" / "my_node" / "setup.py").is_file()
    assert "its node:   gazelle ros2 run my_node hello" in capsys.readouterr().out
    assert main(["new", "package", "other", "--into", "elsewhere"]) == 0
    assert (tmp_path / "elsewhere" / "other" / "CMakeLists.txt").is_file()


def test_a_second_time_is_refused(capsys) -> None:
    assert main(["new", "robot", "my_bot"]) == 0
    assert main(["new", "robot", "my_bot"]) == 1
    err = capsys.readouterr().err
    assert "my_bot is there already; nothing was written:\n    CMakeLists.txt\n" in err


def test_names_of_known_packages_are_refused(tmp_path, capsys) -> None:
    assert main(["new", "robot", "gazebo_ros"]) == 1
    assert "new: there is a package 'gazebo_ros' already:" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_bad_names_are_refused(tmp_path, capsys) -> None:
    assert main(["new", "robot", "My-Bot"]) == 1
    assert "(REP 144); 'my_bot' would do" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_a_robot_without_a_name_or_with_its_file_opens_the_setup_assistant(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("ROS_NAMESPACE", "/")
    started: list[list[str]] = []
    monkeypatch.setattr("gazelle.nodes.__main__.main", lambda words: started.append(words) or 0)
    node = "moveit_setup_assistant/moveit_setup_assistant"
    assert main(["new", "robot"]) == 0
    assert main(["new", "robot", "arm.urdf"]) == 1
    assert "new: there is no file arm.urdf" in capsys.readouterr().err
    (tmp_path / "arm.urdf").write_text("<robot/>", encoding="utf-8")
    assert main(["new", "robot", "arm.urdf"]) == 0
    assert started == [[node], [node, "--urdf_path", "arm.urdf"]]


def test_other_packages_need_a_name(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["new", "world"])
    assert "the name of the package is missing" in capsys.readouterr().err
