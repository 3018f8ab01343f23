"""A robot that a launch file expands keeps the lines of its xacro file in every process."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from gazelle.description.robot_description import read_text
from gazelle.diagnostics import Diagnostics
from gazelle.launch.ros1.loader import load_launch_files
from gazelle.workspace import Workspace

ROBOT = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="part" params="name">
    <link name="${name}"/>
    <gazebo reference="other"/>
  </xacro:macro>
  <xacro:part name="base"/>
</robot>
"""
SCRIPT = """import subprocess, sys
text = subprocess.run(
    [sys.executable, "-m", "gazelle.cli", "xacro", sys.argv[1]], capture_output=True, text=True
).stdout
print(text.replace(*sys.argv[2:]))
"""


@pytest.mark.parametrize(
    ("command", "name", "leads_back"),
    [
        ("$(find xacro)/xacro $(dirname)/r.xacro", "base", True),
        ("{python} $(dirname)/make.py {file} base base", "base", True),
        # What another program has changed is no longer what these lines say.
        ("{python} $(dirname)/make.py {file} base trunk", "trunk", False),
    ],
)
def test_text_of_a_param_command_leads_back_when_it_is_that_very_text(
    command: str, name: str, leads_back: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    file = tmp_path / "r.xacro"
    file.write_text(ROBOT, encoding="utf-8")
    (tmp_path / "make.py").write_text(SCRIPT, encoding="utf-8")
    launch = tmp_path / "a.launch"
    command = command.format(file=file, python=sys.executable)
    param = f'<param name="robot_description" command="{command}"/>'
    launch.write_text(f"<launch>{param}</launch>", encoding="utf-8")
    diagnostics = Diagnostics()
    workspace = Workspace.discover(environ={}, cwd=tmp_path)
    config = load_launch_files([launch], {}, workspace=workspace, diagnostics=diagnostics)
    assert not diagnostics.errors, [str(item) for item in diagnostics]
    root = read_text(str(config.params["/robot_description"]), Diagnostics())
    assert root is not None
    (link,) = root.find_all("link")
    assert link.attributes["name"] == name
    assert (link.span.file == str(file)) is leads_back
    assert (str(link.span) == f"{file}:3:5") is leads_back
    assert [str(call) for call in link.span.via] == [f"{file}:6:3"] * leads_back
