"""ROS 2 parameter files: node names, wildcards, places, mistakes."""

from __future__ import annotations

from pathlib import Path

import pytest

from gazelle.control.parameter_sources.ros2_controller_parameters import FileSource
from gazelle.diagnostics import Diagnostics

LUCK = """\
controller_manager:
  ros__parameters:
    update_rate: 100
    arm_controller:
      type: joint_trajectory_controller/JointTrajectoryController

arm_controller:
  ros__parameters:
    joints: [joint_1, joint_2]
    gains:
      joint_1: {p: 1e3, d: 50.0}
    constraints.goal_time: 0.5
"""


def _source(
    tmp_path: Path, text: str, *, namespace: str = "/"
) -> tuple[FileSource, Diagnostics, Path]:
    path = tmp_path / "controllers.yaml"
    path.write_text(text, encoding="utf-8")
    found = Diagnostics()
    return FileSource([path], namespace, found), found, path


def test_type_comes_from_the_manager_and_parameters_from_the_node(tmp_path: Path) -> None:
    source, found, path = _source(tmp_path, LUCK)
    assert source.controllers() == ("arm_controller",)
    wanted = "joint_trajectory_controller/JointTrajectoryController"
    assert source.controller_type("arm_controller") == wanted
    assert source.manager_tree()["update_rate"] == 100
    tree = source.tree("arm_controller")
    assert tree["gains"]["joint_1"] == {"p": 1000.0, "d": 50.0}
    assert tree["constraints"] == {"goal_time": 0.5}
    assert not list(found)
    span = source.span("arm_controller", "gains.joint_1.p")
    assert span is not None
    assert str(span) == f"{path}:11:17"


@pytest.mark.parametrize(
    ("head", "namespace", "applies"),
    [
        ("/**", "/arm", True),
        ("/arm/**", "/arm", True),
        ("/arm/*", "/arm", True),
        ("/*", "/arm", False),
        ("/arm/ctrl", "/arm", True),
        ("arm/ctrl", "/arm", True),
        ("ctrl", "/arm", False),
        ("ctrl", "/", True),
        ("/other/**", "/arm", False),
    ],
)
def test_node_names_and_wildcards_choose_the_sections(
    tmp_path: Path, head: str, namespace: str, applies: bool
) -> None:
    text = f'"{head}":\n  ros__parameters:\n    p: 1\n'
    source, _, _ = _source(tmp_path, text, namespace=namespace)
    assert source.tree("ctrl") == ({"p": 1} if applies else {})


def test_namespace_as_a_level_of_its_own(tmp_path: Path) -> None:
    text = "arm:\n  ctrl:\n    ros__parameters:\n      p: 1\n"
    source, _, _ = _source(tmp_path, text, namespace="/arm")
    assert source.tree("ctrl") == {"p": 1}


def test_later_sections_and_overrides_win(tmp_path: Path) -> None:
    text = LUCK + '"/**":\n  ros__parameters:\n    gains:\n      joint_1: {p: 7.0}\n'
    source, _, _ = _source(tmp_path, text)
    assert source.tree("arm_controller")["gains"]["joint_1"] == {"p": 7.0, "d": 50.0}
    source.set("arm_controller", "gains.joint_1.d", 8.0)
    assert source.tree("arm_controller")["gains"]["joint_1"] == {"p": 7.0, "d": 8.0}
    assert source.span("arm_controller", "gains.joint_1.d") is None


def test_type_may_stand_in_the_controllers_own_section(tmp_path: Path) -> None:
    text = "ctrl:\n  ros__parameters:\n    type: a/B\n"
    source, _, _ = _source(tmp_path, text)
    assert source.controllers() == ("ctrl",)


def test_file_without_ros_parameters_is_read_and_told(tmp_path: Path) -> None:
    source, found, path = _source(tmp_path, "ctrl:\n  type: a/B\n  p: 2\n")
    assert source.tree("ctrl") == {"type": "a/B", "p": 2}
    (only,) = found
    assert only.code == "control.no-ros-parameters"
    assert str(only).startswith(f"{path}:1:1")
    assert "Cannot have a value before ros__parameters" in str(only)


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("a: [1, 2\n", "parameter file is not YAML"),
        ("a: [1, 2\n", "while parsing a flow sequence, which goes on to 2:1"),
        ("- 1\n", "a parameter file is a mapping of node names"),
        ("a:\n  ros__parameters:\n    x: !what 3\n", "this value cannot be read"),
        ("a:\n  ros__parameters:\n    [x]: 3\n", "a name of a parameter is a word"),
        (
            "a:\n  ros__parameters: &x\n    b: *x\n",
            "not read: an alias stands inside the very list or mapping that it names",
        ),
    ],
)
def test_damaged_files_are_reported_with_their_place(
    tmp_path: Path, text: str, wanted: str
) -> None:
    source, found, path = _source(tmp_path, text)
    source.tree("a")
    (only,) = found
    assert only.code == "control.parameter-file"
    assert wanted in only.message
    assert only.span is not None
    assert only.span.file == str(path)


def test_tags_make_no_objects(tmp_path: Path) -> None:
    text = "a:\n  ros__parameters:\n    x: !!python/object/apply:os.getcwd []\n    y: !!int 3\n"
    source, _, _ = _source(tmp_path, text)
    assert source.tree("a") == {"x": [], "y": 3}


def test_missing_and_binary_files_are_reported(tmp_path: Path) -> None:
    binary = tmp_path / "binary.yaml"
    binary.write_bytes(b"\xff\xfe\x00")
    found = Diagnostics()
    FileSource([tmp_path / "none.yaml", binary], "/", found)
    assert [item.code for item in found] == ["control.parameter-file"] * 2
    assert "No such file" in str(found) or "cannot be read" in next(iter(found)).message


def test_double_key_is_reported_and_the_last_one_counts(tmp_path: Path) -> None:
    source, found, _ = _source(tmp_path, "a:\n  ros__parameters:\n    p: 1\n    p: 2\n")
    assert source.tree("a") == {"p": 2}
    (only,) = found
    assert only.code == "control.double-parameter"
    assert only.span is not None
    assert only.span.line == 4


def test_a_file_that_a_spawner_names_counts_for_its_controller_only(tmp_path: Path) -> None:
    raw, substituted = tmp_path / "raw.yaml", tmp_path / "substituted.yaml"
    text = "arm: {{ros__parameters: {{joint: '{0}', type: a/B}}}}\n"
    raw.write_text(text.format("$(var prefix)1"))
    substituted.write_text(text.format("joint1"))
    source = FileSource((), "", Diagnostics())
    source.set("", "arm.params_file", [str(substituted)])
    source.set("", "states.params_file", [str(raw)])
    source.take_named("arm")
    source.take_named("states")
    assert source.tree("arm")["joint"] == "joint1"
    assert source.controller_type("arm") == "a/B"
    assert not source.tree("states")
