"""``catkin``: build, config, clean, list, locate."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from gazelle.cli.catkin import main
from gazelle.workspace.building.packages import BuildError

Captured = pytest.CaptureFixture[str]


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Two packages made with ``catkin create pkg``; the current folder is the workspace."""
    (tmp_path / "src").mkdir()
    monkeypatch.chdir(tmp_path / "src")
    assert main(["create", "pkg", "base"]) == 0
    assert main(["create", "pkg", "arm", "--catkin-deps", "base"]) == 0
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_building_prints_the_lines_of_catkin_tools(workspace: Path, capsys: Captured) -> None:
    capsys.readouterr()
    assert main(["build"]) == 0
    lines = re.sub(r"\d+\.\d+", "T", capsys.readouterr().out).splitlines()
    begin = lines.index("[build] Found 2 packages in T seconds.")
    assert [" ".join(line.split()) for line in lines[begin + 1 :]] == [
        "Starting >>> base",
        "Finished <<< base [ T seconds ]",
        "Starting >>> arm",
        "Finished <<< arm [ T seconds ]",
        "[build] Summary: All 2 packages succeeded!",
        "[build] Warnings: None.",
        "[build] Abandoned: None.",
        "[build] Failed: None.",
        "[build] Runtime: T seconds total.",
    ]
    assert (workspace / "devel/setup.bash").is_file()
    assert not (workspace / "install").exists()


def test_a_failure_abandons_what_needs_it(workspace: Path, capsys: Captured) -> None:
    (workspace / "src/base/CMakeLists.txt").write_text("project(base\n")
    assert main(["build"]) == 1
    printed = capsys.readouterr()
    assert "[build] Summary: 0 of 2 packages succeeded.\n" in printed.out
    assert "[build]   Abandoned: arm\n[build]   Failed:    base\n" in printed.out
    assert "Errors << base" in printed.err
    assert "project( is never closed" in printed.err


def test_the_configuration_is_kept(workspace: Path, capsys: Captured) -> None:
    assert main(["init"]) == 0
    assert main(["config", "--install", "--install-space", "there"]) == 0
    assert main(["build", "base", "--no-deps"]) == 0
    assert (workspace / "there/share/base/package.xml").is_file()
    assert not (workspace / "there/share/arm").exists()
    capsys.readouterr()
    assert main(["locate", "-i", "base"]) == 0
    assert main(["locate", "arm"]) == 0
    assert main(["list", "-u"]) == 0
    assert capsys.readouterr().out.splitlines() == [
        str(workspace / "there/share/base"),
        str(workspace / "src/arm"),
        "base",
        "arm",
    ]


def test_clean_removes_spaces_and_never_sources(workspace: Path, capsys: Captured) -> None:
    main(["build"])
    assert main(["clean", "-y"]) == 0
    assert not (workspace / "devel").exists()
    assert (workspace / "src/arm/package.xml").is_file()
    main(["config", "--devel-space", "src"])
    with pytest.raises(BuildError, match="apart from its sources"):
        main(["clean", "-y"])
    main(["config", "--devel-space", ".."])
    with pytest.raises(BuildError, match="is not a folder of the workspace"):
        main(["clean", "-y"])


def test_outside_of_a_workspace_it_says_what_to_do(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(BuildError, match="run 'catkin init' in its top folder"):
        main(["build"])


def test_unknown_packages_and_verbs_are_named(workspace: Path, capsys: Captured) -> None:
    with pytest.raises(BuildError, match="'amr' is not in the workspace; did you mean 'arm'"):
        main(["build", "amr"])
    assert main(["biuld"]) == 2
    assert "did you mean 'build'?" in capsys.readouterr().err


def test_a_broken_configuration_is_named(workspace: Path) -> None:
    main(["init"])
    file = workspace / ".catkin_tools/profiles/default/config.yaml"
    file.write_text("install: [")
    with pytest.raises(BuildError, match=r"(?s)config\.yaml.*remove it to start anew"):
        main(["build"])
