"""``ros2 pkg``: list, executables, prefix and xml."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.cli.ros2 import main
from gazelle.diagnostics import Diagnostics
from gazelle.workspace.building.build import BuildOptions, build_package
from gazelle.workspace.building.packages import find_packages

Captured = pytest.CaptureFixture[str]


@pytest.fixture
def source(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Captured) -> Path:
    """Package ``bot`` with executable ``walk``; the current folder is its workspace."""
    for name in ("ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH"):
        monkeypatch.delenv(name, raising=False)
    (tmp_path / "src").mkdir()
    monkeypatch.chdir(tmp_path / "src")
    words = ["bot", "--build-type", "ament_python", "--node-name", "walk", "--license", "MIT"]
    assert main(["pkg", "create", *words]) == 0
    monkeypatch.chdir(tmp_path)
    capsys.readouterr()
    return tmp_path / "src/bot"


@pytest.fixture
def prefix(source: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The same package installed and sourced, away from its sources."""
    (package,) = find_packages([source], Diagnostics())
    build_package(package, BuildOptions(tmp_path / "build", tmp_path / "install"))
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path / "install/bot"))
    (tmp_path / "else").mkdir()
    monkeypatch.chdir(tmp_path / "else")
    return tmp_path / "install/bot"


def test_an_installed_package_has_prefix_share_and_executables(
    prefix: Path, capsys: Captured
) -> None:
    for words in (["prefix", "bot"], ["prefix", "--share", "bot"], ["executables", "bot"],
                  ["executables", "--full-path", "bot"]):  # fmt: skip
        assert main(["pkg", *words]) == 0
    assert capsys.readouterr().out.splitlines() == [
        str(prefix),
        str(prefix / "share/bot"),
        "bot walk",
        str(prefix / "lib/bot/walk"),
    ]


def test_a_package_in_source_is_its_own_prefix(source: Path, capsys: Captured) -> None:
    assert main(["pkg", "prefix", "bot"]) == 0
    printed = capsys.readouterr()
    assert printed.out == f"{source}\n"
    assert "'bot' is not installed: this is its source folder" in printed.err


def test_packages_are_listed_with_built_in_ones(source: Path, capsys: Captured) -> None:
    assert main(["pkg", "list"]) == 0
    names = capsys.readouterr().out.split()
    assert {"bot", "robot_state_publisher", "turtlesim"} <= set(names)
    assert names == sorted(names)


def test_built_in_nodes_are_executables(source: Path, capsys: Captured) -> None:
    assert main(["pkg", "executables", "robot_state_publisher"]) == 0
    assert "robot_state_publisher robot_state_publisher\n" in capsys.readouterr().out
    assert main(["pkg", "executables"]) == 0
    assert "bot walk\n" in capsys.readouterr().out


def test_the_manifest_and_its_tags(source: Path, capsys: Captured) -> None:
    assert main(["pkg", "xml", "bot", "-t", "test_depend"]) == 0
    assert capsys.readouterr().out.split()[:2] == ["ament_copyright", "ament_flake8"]
    assert main(["pkg", "xml", "bot"]) == 0
    text = capsys.readouterr().out
    assert text.startswith('<package format="3">\n')
    assert text.endswith("</package>\n")


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["prefix", "bto"], "Package 'bto' not found"),
        (["executables", "bto"], "did you mean 'bot'"),
        (["xml", "bot", "-t", "verson"], "XML tag not found\n  did you mean 'version'"),
    ],
)
def test_what_is_not_there_is_named(
    source: Path, words: list[str], said: str, capsys: Captured
) -> None:
    assert main(["pkg", *words]) == 1
    assert said in capsys.readouterr().err
