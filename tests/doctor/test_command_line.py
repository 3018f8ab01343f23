"""One examination as a whole: nothing is left behind, nothing is said twice."""

from __future__ import annotations

import os
import socket
import subprocess
import threading
from pathlib import Path
from typing import Any

import pytest
from tests.doctor.conftest import FIXTURES, Examine, Write

from gazelle.doctor import Options, examine

NAMES = FIXTURES / "pain_23_namespaces" / "clean"


def test_nothing_is_started(examined: Examine, monkeypatch: pytest.MonkeyPatch) -> None:
    examining = threading.get_ident()

    def refuse_to(owner: type, name: str) -> None:
        original = getattr(owner, name)

        def call(*args: Any, **keys: Any) -> Any:
            # What earlier tests left may be at work meanwhile.
            assert threading.get_ident() != examining, "the doctor starts nothing"
            return original(*args, **keys)

        monkeypatch.setattr(owner, name, call)

    refuse_to(socket.socket, "connect")
    refuse_to(socket.socket, "bind")
    refuse_to(subprocess.Popen, "__init__")
    refuse_to(threading.Thread, "start")
    environ = dict(os.environ)
    report = examined(NAMES, "pain_23_namespaces", "robot.launch")
    assert report.exit_code == 0
    assert dict(os.environ) == environ


def test_controllers_that_spawners_name_run(examined: Examine) -> None:
    report = examined(NAMES, "pain_23_namespaces", "robot.launch")
    (table,) = [section for section in report.sections if section.name == "controllers"]
    assert [row[1:4:2] for row in table.rows] == [
        ("joint_states", "active"),
        ("left", "active"),
        ("right", "active"),
    ]


def test_frames_of_simulator_and_nodes_make_one_tree(examined: Examine) -> None:
    folder = FIXTURES / "pain_13_frames" / "clean"
    report = examined(folder, "pain_13_frames", "robot.launch")
    (table,) = [section for section in report.sections if section.name == "frames"]
    assert table.rows[0] == ("odom → base_link", "moving", "/gazebo")
    assert ("  base_link → laser_link", "static", "/state_publisher") in table.rows
    assert len(table.rows) == 5


def test_every_plugin_has_a_row_that_says_what_runs(examined: Examine) -> None:
    folder = FIXTURES / "pain_17_plugins" / "broken"
    report = examined(folder, "pain_17_plugins", "robot.launch")
    tables = {section.name: section for section in report.sections}
    assert tables["plugins"].rows == (
        ("libgazebo_ros_diff_drive.so", "robot", "diff_drive", "robot.urdf:101"),
        ("libarm_cannon.so", "robot", "NOT THERE: compiled code", "robot.urdf:117"),
    )
    assert [row[0] for row in tables["tags"].rows] == ["robot.urdf:113"]


def test_finding_of_a_file_that_two_launches_include_is_said_once(
    written: Write, examined: Examine
) -> None:
    part = '<launch><node pkg="nowhere" type="t" name="n"/></launch>'
    whole = '<launch><include file="$(find bot)/launch/part.launch"/></launch>'
    folder = written(
        **{
            "launch__one.launch": whole,
            "launch__part.launch": part,
            "launch__two.launch": whole,
        }
    )
    found = examined(folder, "bot").findings
    assert [item.code for item in found if item.code.endswith("packages-elsewhere")] == [
        "doctor.packages-elsewhere"
    ]


def test_robot_alone_is_brought_up_in_an_empty_world(examined: Examine) -> None:
    folder = FIXTURES / "pain_17_plugins" / "broken" / "pain_17_plugins"
    report = examined(folder, "urdf/robot.urdf")
    assert report.kind == "robot"
    assert "plugin.unknown" in [item.code for item in report.findings]
    assert report.exit_code == 1


def test_world_alone_is_brought_up(examined: Examine) -> None:
    folder = FIXTURES / "pain_03_uris" / "clean" / "pain_03_uris"
    report = examined(folder, "worlds/field.world")
    assert (report.kind, report.exit_code) == ("world", 0)


def test_a_line_of_gazelles_own_files_is_told_as_the_users_include(
    examined: Examine, written: Write
) -> None:
    text = '<launch>\n<include file="$(find gazebo_ros)/launch/empty_world.launch">\n'
    text += '<arg name="paused" value="true"/></include></launch>'
    path = written(**{"go.launch": text}) / "go.launch"
    report = examined(path.parent, "go.launch")
    (finding,) = [item for item in report.findings if item.code == "doctor.paused"]
    assert finding.span is not None
    assert (finding.span.file, finding.span.line, finding.span.via) == (str(path), 2, ())


def test_a_file_of_another_workspace_is_examined_as_from_there(
    written: Write, tmp_path: Path
) -> None:
    launch = '<launch><include file="$(find bot)/launch/b.launch"/></launch>'
    folder = written(**{"launch__a.launch": launch, "launch__b.launch": "<launch/>"})
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    options = Options(environ={"HOME": str(tmp_path)})
    report = examine([str(folder / "launch" / "a.launch")], options=options, cwd=elsewhere)
    (item,) = report.findings
    assert item.code == "doctor.other-workspace"
    assert item.message == (
        f"package 'bot' is in a workspace that is not in use in '{elsewhere}': it is examined as "
        "from its own folder"
    )
    assert item.fix == f"cd {folder}"
    assert list(examine(["launch/a.launch"], options=options, cwd=folder).findings) == []
