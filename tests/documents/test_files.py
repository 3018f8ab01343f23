"""Files with names that cannot be, limits of size, and versions of saved files."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.description.loader import load_models, load_world
from gazelle.diagnostics import Diagnostics
from gazelle.documents import scaled
from gazelle.documents.files import exists, is_file, is_folder, names_matching, refused_version
from gazelle.errors import GazelleError, UserFileError
from gazelle.launch.ros1.loader import load_launch_text
from gazelle.workspace import Workspace


def test_limits_are_as_they_are_without_the_variable(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("GAZELLE_LIMITS", raising=False)
    assert scaled(7) == 7


def test_the_variable_is_a_factor(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("GAZELLE_LIMITS", "2.5")
    assert scaled(10) == 25


@pytest.mark.parametrize("text", ["0", "-1", "many", "nan", "inf"])
def test_other_values_are_told(monkeypatch: pytest.MonkeyPatch, text: str) -> None:
    monkeypatch.setenv("GAZELLE_LIMITS", text)
    with pytest.raises(GazelleError, match=f"GAZELLE_LIMITS='{text}' is not a number above 0"):
        scaled(1)


def test_known_versions_are_read() -> None:
    assert refused_version("the map", 1, 2) == ""
    assert refused_version("the map", 2, 2) == ""


def test_a_newer_version_says_what_would_read_it() -> None:
    assert refused_version("the map", 3, 2) == (
        "the map is of version 3, saved by a newer Gazelle; this one reads versions up to 2 "
        "(pip install --upgrade gazelle-sim)"
    )


@pytest.mark.parametrize("version", [0, -1, "1", None, True, 1.0])
def test_what_is_no_version_is_told(version: object) -> None:
    assert "which is none: versions are 1, 2, 3 …" in refused_version("the map", version, 2)


_LONG = "a" * 5000

_ADDRESSES = [
    f"{start}{_LONG}" for start in ("", "/", "file://", "package://p/", "package://", "model://")
]


def test_names_that_cannot_be_are_not_there(tmp_path: Path) -> None:
    (tmp_path / "a").touch()
    assert (exists(tmp_path), is_folder(tmp_path), is_file(tmp_path)) == (True, True, False)
    assert (exists(tmp_path / "a"), is_file(str(tmp_path / "a"))) == (True, True)
    for name in (_LONG, "a\0b", ""):
        assert not (exists(name) or is_file(name) or is_folder(name))


def test_patterns_find_names_in_a_folder_and_those_that_cannot_be_find_none(
    tmp_path: Path,
) -> None:
    for name in ("b.py", "a.py", "in/ner/c.py", ".hidden.py"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    assert names_matching("*.py", tmp_path) == ["a.py", "b.py"]
    assert names_matching("**/*.py", tmp_path) == ["a.py", "b.py", "in/ner/c.py"]
    for pattern in ("a/*" * 5000, "a\0*", "**.pyx", ""):
        assert names_matching(pattern, tmp_path) == []


@pytest.mark.parametrize("address", _ADDRESSES, ids=lambda address: address[:12])
def test_descriptions_with_such_names_are_read(address: str) -> None:
    mesh = f'<collision><geometry><mesh filename="{address}"/></geometry></collision>'
    robot = f'<robot name="r"><link name="l">{mesh}</link></robot>'
    world = (
        f'<sdf version="1.6"><world name="w"><include><uri>{address}</uri></include></world></sdf>'
    )
    for workspace in (Workspace.discover(extra=[]), None):
        diagnostics = Diagnostics()
        load_models(robot, workspace=workspace, diagnostics=diagnostics)
        load_models(address, workspace=workspace, diagnostics=diagnostics)
        assert {"load.not-found"} <= {item.code for item in diagnostics.errors}
        try:
            load_world(world, workspace=workspace, diagnostics=Diagnostics())
        except UserFileError as error:
            assert error.diagnostics


@pytest.mark.parametrize(
    "element",
    [
        f'<include file="{_LONG}"/>',
        f'<rosparam file="{_LONG}"/>',
        f'<param name="a" textfile="{_LONG}"/>',
        f'<param name="a" binfile="{_LONG}"/>',
        f'<param name="a" command="xacro {_LONG}"/>',
    ],
    ids=lambda element: element[:16],
)
def test_launch_files_with_such_names_are_told(element: str) -> None:
    diagnostics = Diagnostics()
    workspace = Workspace.discover(extra=[])
    load_launch_text(
        f"<launch>{element}</launch>", {}, workspace=workspace, diagnostics=diagnostics
    )
    assert diagnostics.errors
