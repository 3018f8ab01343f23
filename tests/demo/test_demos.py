"""The table of demos, and what it names: workspaces, launches, commands, panels."""

from __future__ import annotations

import os
import re
import shlex
import tomllib
from pathlib import Path

import pytest
import yaml

from gazelle.cli.commands import COMMANDS
from gazelle.cli.completion import subcommands
from gazelle.demo import (
    DEMOS,
    Demo,
    copy_demo,
    find_demo,
    panel_params,
    picture,
    workspace_folder,
)
from gazelle.diagnostics import Diagnostics
from gazelle.errors import GazelleError, NotFoundError
from gazelle.interfaces import fill, message_type, service_type
from gazelle.launch.node_commands import find_executable
from gazelle.workspace import Workspace

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"
_NAMES = [demo.name for demo in DEMOS]


@pytest.fixture(params=DEMOS, ids=_NAMES)
def demo(request: pytest.FixtureRequest) -> Demo:
    found: Demo = request.param
    return found


@pytest.fixture
def elsewhere(tmp_path: Path) -> Workspace:
    """What is found by name in a folder that has nothing to do with a demo."""
    return Workspace.discover(environ={"HOME": str(tmp_path)}, cwd=tmp_path)


def test_each_example_has_a_demo_and_comes_in_the_wheel() -> None:
    folders = {path.name for path in EXAMPLES.glob("*_ws")}
    assert {demo.workspace for demo in DEMOS} == folders
    hatch = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["hatch"]
    assert hatch["build"]["targets"]["wheel"]["force-include"] == {
        f"examples/{name}": f"gazelle/demo/workspaces/{name}" for name in folders
    }


def test_names_are_different_and_words() -> None:
    assert len(set(_NAMES)) == len(_NAMES)
    assert all(re.fullmatch(r"[a-z_]+", name) for name in _NAMES)


def test_packages_are_those_of_the_workspace(demo: Demo) -> None:
    source = workspace_folder(demo) / "src"
    assert demo.packages == tuple(sorted(path.name for path in source.iterdir()))
    versions = {
        Workspace.discover(extra=[source]).package(name).ros_version for name in demo.packages
    }
    assert versions == {demo.ros_version}


def test_commands_are_of_the_demo_s_ros(demo: Demo) -> None:
    own = {True: {"ros2"}, False: {"roslaunch", "rosrun"}}[demo.ros_version == 2]
    assert {argv[0] for argv in (demo.launch, *demo.programs)} <= own


def test_what_is_started_exists_in_every_folder(demo: Demo, elsewhere: Workspace) -> None:
    for argv in (demo.launch, *demo.programs):
        _check(list(argv), elsewhere, demo.ros_version)


def test_what_is_to_be_tried_exists_in_every_folder(demo: Demo, elsewhere: Workspace) -> None:
    assert 1 < len(demo.try_next) < 6
    for step in demo.try_next:
        program, *argv = shlex.split(step.command)
        assert program == "gazelle"
        _check(argv, elsewhere, demo.ros_version)


def test_panels_are_those_of_the_page(demo: Demo) -> None:
    texts = [path.read_text() for path in (ROOT / "studio" / "src").rglob("*.ts")]
    kinds = {kind for text in texts for kind in re.findall(r"kind: '(\w+)'", text)}
    aliases = {
        name
        for text in texts
        for names in re.findall(r"aliases: \[([^]]*)\]", text)
        for name in re.findall(r"'(\w+)'", names)
    }
    assert {panel.kind for panel in demo.panels} <= kinds | aliases
    for panel in demo.panels:
        file = panel_params(demo, panel).get("file")
        assert file is None or Path(file).is_file()


def test_a_line_of_text_fits_a_terminal(demo: Demo) -> None:
    assert all(len(line) <= 90 for line in demo.seen)
    assert len(demo.summary) <= 90


def test_a_name_that_is_not_there_gives_the_nearest() -> None:
    with pytest.raises(NotFoundError, match="demo 'scaut' not found; did you mean 'scout'"):
        find_demo("scaut")
    assert find_demo("scout").packages == ("scout_robot",)


def test_a_picture_is_there_or_none(demo: Demo) -> None:
    found = picture(demo)
    assert found is None or (found.suffix == ".webp" and found.is_file())


def test_a_copy_is_a_workspace_of_the_user_s(demo: Demo, tmp_path: Path) -> None:
    folder = tmp_path / "mine"
    assert copy_demo(demo, folder) == tuple(folder / "src" / name for name in demo.packages)
    written = {path.relative_to(folder) for path in folder.rglob("*") if path.is_file()}
    original = workspace_folder(demo)
    assert written == {
        path.relative_to(original)
        for path in original.rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    for path in written:
        assert (folder / path).read_bytes() == (original / path).read_bytes()
        is_program = (folder / path).read_bytes().startswith(b"#!")
        assert os.access(folder / path, os.X_OK) == is_program
    workspace = Workspace.discover(environ={"HOME": str(tmp_path)}, cwd=folder)
    assert workspace.package(demo.packages[0]).path == folder / "src" / demo.packages[0]


def test_a_copy_writes_over_nothing(tmp_path: Path) -> None:
    scout = find_demo("scout")
    (tmp_path / "mine").mkdir()
    copy_demo(scout, tmp_path / "mine")
    file = tmp_path / "mine" / "src" / "scout_robot" / "package.xml"
    file.write_text("changed")
    with pytest.raises(GazelleError, match="is there already, and nothing is written over it"):
        copy_demo(scout, tmp_path / "mine")
    with pytest.raises(GazelleError, match=r"gazelle demo scout --copy package\.xml_2"):
        copy_demo(scout, file)
    assert file.read_text() == "changed"


def _check(argv: list[str], workspace: Workspace, ros_version: int) -> None:
    """Check that a command's words name what there is."""
    name, *rest = argv
    assert name in COMMANDS
    if name == "ros2":
        name, *rest = rest
        assert name in subcommands("ros2")
    if rest and rest[0] in {"pub", "call"}:
        _check_message([word for word in rest if word not in {"--once", "-1"}], name)
    elif name in {"roslaunch", "launch"}:
        assert list(workspace.package(rest[0]).path.rglob(rest[1]))
    elif name in {"rosrun", "run"}:
        found = Diagnostics()
        assert find_executable(
            rest[0], rest[1], workspace=workspace, diagnostics=found, ros_version=ros_version
        )
        assert not found
    elif name in {"rosrun", "rosservice", "rostopic", "topic", "service"}:
        assert rest[0] in {"call", "echo", "pub"}


def _check_message(rest: list[str], name: str) -> None:
    verb, *words = rest
    if words[0] == "-r":
        words = words[2:]
    if verb == "call":
        if len(words) > 1:
            kind = service_type(words[1]).Request
            fill(kind(), yaml.safe_load(words[2])) if len(words) > 2 else kind()
        return
    assert name in {"rostopic", "topic"}
    message = message_type(words[1])()
    value = yaml.safe_load(words[2])
    fill(message, value if isinstance(value, dict) else {"data": value})
