"""The environment of launched nodes."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

from gazelle.launch.environment import command_folder, is_own_command, node_environment
from gazelle.workspace import Workspace

_MANIFEST = "<package><name>{}</name><version>0.0.0</version><description/></package>"


@pytest.mark.parametrize("given", [None, "", "other"])
def test_nodes_find_the_packages_of_the_folder_the_launch_started_in(
    tmp_path: Path, given: str | None
) -> None:
    for place, name in (("here/src", "mine"), ("other", "theirs")):
        folder = tmp_path / place / name
        folder.mkdir(parents=True)
        (folder / "package.xml").write_text(_MANIFEST.format(name), encoding="utf-8")
    environ = {} if given is None else {"ROS_PACKAGE_PATH": given and str(tmp_path / given)}
    workspace = Workspace.discover(environ=environ, cwd=tmp_path / "here")
    path = node_environment({"PATH": "", **environ}, workspace)["ROS_PACKAGE_PATH"]
    folders = path.split(os.pathsep)
    assert folders == [
        *([str(tmp_path / "other")] if given else []),
        str(tmp_path / "here" / "src"),
    ]
    elsewhere = Workspace.discover(environ={"ROS_PACKAGE_PATH": path}, cwd=tmp_path)
    assert elsewhere.package("mine").path == tmp_path / "here/src/mine"


@pytest.mark.parametrize(
    ("words", "own"),
    [
        ([sys.executable, "-m", "gazelle.nodes", "amcl/amcl"], True),
        ([sys.executable, "-m", "http.server"], False),
        ([sys.executable, "robot.py"], False),
        (["gzserver", "empty.world"], True),
        (["exec gz sim -r empty.sdf"], True),
        (["gz sim empty.sdf; sleep 5"], False),
        (["sleep", "5"], False),
        ([""], False),
    ],
)
def test_commands_of_ours_are_told_from_others(words: list[str], own: bool) -> None:
    assert is_own_command(words, str(command_folder())) is own
