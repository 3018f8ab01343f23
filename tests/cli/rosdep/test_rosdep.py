"""``rosdep``: an answer for every key."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.cli.rosdep import main
from gazelle.cli.rosdep.keys import Kind, judge
from gazelle.workspace import Workspace

Captured = pytest.CaptureFixture[str]
_MANIFEST = """<package format="2"><name>{0}</name><version>0.1.0</version>
<description>x</description><maintainer email="a@example.org">a</maintainer><license>MIT</license>
<buildtool_depend>catkin</buildtool_depend>{1}</package>"""


@pytest.fixture
def source(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Package ``arm`` that needs a bit of everything, and ``base``."""
    keys = ("base", "rospy", "sensor_msgs", "hls_lfcd_lds_driver", "python3-numpy", "rospyy")
    depends = "".join(f"<depend>{key}</depend>" for key in keys)
    for name, text in (("arm", depends), ("base", "")):
        folder = tmp_path / "src" / name
        folder.mkdir(parents=True)
        (folder / "package.xml").write_text(_MANIFEST.format(name, text))
    for name in ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.chdir(tmp_path)
    return tmp_path / "src"


def test_install_answers_every_key_and_ends_well(source: Path, capsys: Captured) -> None:
    words = ["install", "--from-paths", "src", "--ignore-src", "-r", "-y", "--rosdistro", "noetic"]
    assert main(words) == 0
    advice = "put its sources into src: its nodes are compiled here"
    assert capsys.readouterr().out.splitlines() == [
        "comes with Gazelle: rospy sensor_msgs",
        "needed by compilers and build tools only: catkin",
        "Python modules that are installed: python3-numpy",
        f"hls_lfcd_lds_driver: third-party package, mostly compiled; {advice}  [arm]",
        "rospyy: no package of ROS that Gazelle knows; did you mean 'rospy'?  [arm]",
        "#Nothing was installed; 2 of 6 keys are not met, see above",
    ]


def test_skipped_keys_are_left_out(source: Path, capsys: Captured) -> None:
    words = ["--from-paths", "src", "--skip-keys", "hls_lfcd_lds_driver rospyy", "-q"]
    assert main(["install", *words]) == 0
    assert capsys.readouterr().out == "#All required rosdeps installed successfully\n"
    assert main(["check", *words]) == 0
    assert capsys.readouterr().out == "All system dependencies have been satisfied\n"


def test_check_fails_when_something_is_missing(source: Path, capsys: Captured) -> None:
    assert main(["check", "--from-paths", "src"]) == 1
    assert capsys.readouterr().out.endswith("All system dependencies have not been satisfied\n")


def test_keys_are_listed(source: Path, capsys: Captured) -> None:
    assert main(["keys", "arm", "-i"]) == 0
    assert capsys.readouterr().out.split() == [
        "catkin", "hls_lfcd_lds_driver", "python3-numpy", "rospy", "rospyy", "sensor_msgs",
    ]  # fmt: skip


def test_init_and_update_have_nothing_to_do(capsys: Captured) -> None:
    assert main(["init"]) == 0
    assert main(["update"]) == 0
    assert capsys.readouterr().out.count("Nothing to do") == 2


def test_a_missing_package_and_a_wrong_verb_are_named(source: Path, capsys: Captured) -> None:
    assert main(["install", "amr"]) == 1
    assert "Missing resource amr" in capsys.readouterr().err
    assert main(["instal"]) == 64
    assert "did you mean 'install'" in capsys.readouterr().err
    assert main(["install"]) == 1
    assert "Please enter packages, or --from-paths FOLDER" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("key", "kind"),
    [
        ("gazebo_ros", Kind.BROUGHT),
        ("joint_trajectory_controller", Kind.BROUGHT),
        ("rclpy", Kind.BROUGHT),
        ("ament_lint_auto", Kind.BUILD_ONLY),
        ("python3-yaml", Kind.PYTHON),
        ("python3-a-module-nobody-has", Kind.PYTHON_MISSING),
        ("velodyne_simulator", Kind.COMPILED),
        ("libsdl2-dev", Kind.UNKNOWN),
    ],
)
def test_kinds_of_keys(key: str, kind: Kind, tmp_path: Path) -> None:
    workspace = Workspace.discover(environ={"HOME": str(tmp_path)}, cwd=tmp_path)
    assert judge(key, workspace, ()).kind is kind


@pytest.mark.tutorial
def test_the_documents_workspaces_need_no_more_than_is_here(
    workspaces_dir: Path, capsys: Captured
) -> None:
    for name in ("catkin_ws", "ros2_ws"):
        assert main(["check", "--from-paths", str(workspaces_dir / name / "src"), "-i"]) == 0
    assert "have not" not in capsys.readouterr().out
