"""``catkin_create_pkg``: files and lines of the original."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from gazelle.cli.catkin_create_pkg import main
from gazelle.workspace.building.cmake_syntax import read_commands
from gazelle.workspace.package_xml import read_manifest

Captured = pytest.CaptureFixture[str]


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def test_the_package_of_the_tutorial(tmp_path: Path, capsys: Captured) -> None:
    assert main(["beginner_tutorials", "std_msgs", "rospy", "roscpp"]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "Created file beginner_tutorials/package.xml",
        "Created file beginner_tutorials/CMakeLists.txt",
        "Created folder beginner_tutorials/include/beginner_tutorials",
        "Created folder beginner_tutorials/src",
        f"Successfully created files in {tmp_path / 'beginner_tutorials'}. "
        "Please adjust the values in package.xml.",
    ]
    manifest = read_manifest(tmp_path / "beginner_tutorials/package.xml")
    assert (manifest.name, manifest.version, manifest.format) == ("beginner_tutorials", "0.0.0", 2)
    assert manifest.depends == ("catkin", "roscpp", "rospy", "std_msgs")
    assert manifest.licenses == ("TODO",)


_REAL = shutil.which("catkin_create_pkg", path="/usr/bin") or ""
_WORDS = [
    ["bot", "std_msgs", "rospy", "roscpp"],
    ["bot", "rospy", "-V", "1.2.3", "-D", "A bot", "-l", "MIT", "-m", "ann", "-a", "ben"],
    ["bot"],
    ["bot", "rospy", "-s", "Eigen3", "Boost"],
]


@pytest.mark.reference
@pytest.mark.skipif(not _REAL, reason="the real catkin_create_pkg is not installed")
@pytest.mark.parametrize("words", _WORDS if _REAL else _WORDS[:1])
def test_commands_and_fields_are_those_of_the_real_one(
    words: list[str], tmp_path: Path, capsys: Captured
) -> None:
    (tmp_path / "real").mkdir()
    done = subprocess.run(
        [_REAL, *words], cwd=tmp_path / "real", capture_output=True, text=True, check=True
    )
    main(words)
    own = capsys.readouterr().out.replace(str(tmp_path), str(tmp_path / "real"))
    assert own == done.stdout
    for path in ("real/bot", "bot"):
        assert (tmp_path / path / "package.xml").is_file()
    kept = [_read(tmp_path / path) for path in ("bot", "real/bot")]
    assert kept[0] == kept[1]


def _read(folder: Path) -> object:
    text = (folder / "CMakeLists.txt").read_text()
    commands = [
        (command.name, [argument.text for argument in command.arguments])
        for command in read_commands(text)[0]
    ]
    manifest = read_manifest(folder / "package.xml")
    return [item for item in commands if item[0] != "cmake_minimum_required"], (
        manifest.version, manifest.description, sorted(manifest.dependencies),
        manifest.maintainers, manifest.licenses,
        [item.name for item in manifest.exports if item.name != "metapackage"],
    )  # fmt: skip


def test_nothing_is_overwritten(tmp_path: Path, capsys: Captured) -> None:
    main(["bot"])
    (tmp_path / "bot/package.xml").write_text("mine")
    with pytest.raises(SystemExit) as caught:
        main(["bot"])
    assert caught.value.code == 2
    assert f"File exists: {tmp_path / 'bot/package.xml'}" in capsys.readouterr().err
    assert (tmp_path / "bot/package.xml").read_text() == "mine"


@pytest.mark.parametrize(
    ("words", "said"),
    [(["../bot"], "'../bot' is no name"), (["bot", "-V", "1"], "does not follow version")],
)
def test_what_cannot_be_is_refused(words: list[str], said: str, capsys: Captured) -> None:
    with pytest.raises(SystemExit):
        main(words)
    assert said in capsys.readouterr().err


def test_an_unusual_name_is_warned_of(tmp_path: Path, capsys: Captured) -> None:
    assert main(["Bad-Name"]) == 0
    assert '"Bad-Name" does not follow the naming conventions' in capsys.readouterr().err
    assert (tmp_path / "Bad-Name/package.xml").is_file()


def test_a_metapackage_has_run_dependencies_only(tmp_path: Path) -> None:
    assert main(["--meta", "bot", "one", "two"]) == 0
    manifest = read_manifest(tmp_path / "bot/package.xml")
    assert [tuple(item) for item in manifest.dependencies] == [
        ("buildtool_depend", "catkin"),
        ("exec_depend", "one"),
        ("exec_depend", "two"),
    ]
    assert [item.name for item in manifest.exports] == ["metapackage"]
    assert "catkin_metapackage()" in (tmp_path / "bot/CMakeLists.txt").read_text()


def test_boost_components_are_found_and_declared(tmp_path: Path) -> None:
    assert main(["bot", "-b", "thread", "system"]) == 0
    text = (tmp_path / "bot/CMakeLists.txt").read_text()
    assert "find_package(Boost REQUIRED COMPONENTS system thread)" in text
    assert "boost" in read_manifest(tmp_path / "bot/package.xml").depends
