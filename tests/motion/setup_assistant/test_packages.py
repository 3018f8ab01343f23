"""Config packages on disk: written, read, changed, written again."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest
from tests.motion.setup_assistant.conftest import HERON, proposed, seven_of

from gazelle.description.moveit import read_moveit_config
from gazelle.diagnostics import Diagnostics, Severity
from gazelle.doctor import examine
from gazelle.motion.setup_assistant import (
    FileState,
    SetupAssistantConfig,
    SetupAssistantError,
    planned_files,
    read_config_package,
    write_package,
)
from gazelle.workspace import Workspace

_ARM_WS = HERON.parents[3]


def _read(folder: Path) -> SetupAssistantConfig:
    workspace = Workspace.discover(environ={}, cwd=folder, extra=[_ARM_WS])
    config, _ = read_config_package(folder, workspace=workspace, diagnostics=Diagnostics())
    return config


def _states(config: SetupAssistantConfig, folder: Path) -> dict[str, FileState]:
    return {item.path: item.state for item in planned_files(config, folder)}


@pytest.mark.parametrize("ros_version", [1, 2])
def test_what_is_read_of_a_written_package_is_written_the_same(
    tmp_path: Path, ros_version: int
) -> None:
    for config in (seven_of(ros_version), proposed(HERON, ros_version)[0]):
        folder = tmp_path / config.package_name
        written = write_package(config, folder)
        assert {item.state for item in written} == {FileState.NEW}
        assert set(_states(_read(folder), folder).values()) == {FileState.SAME}


@pytest.mark.parametrize("ros_version", [1, 2])
def test_move_group_reads_a_written_package_without_a_finding(
    tmp_path: Path, ros_version: int
) -> None:
    config = seven_of(ros_version)
    folder = tmp_path / config.package_name
    write_package(config, folder)
    found = Diagnostics()
    read = read_moveit_config(folder, diagnostics=found)
    assert not list(found), [str(item) for item in found]
    assert read is not None
    assert [one.name for one in read.controllers] == ["arm_controller", "hand_controller"]
    assert read.kinematics["arm"].solver == "kdl_kinematics_plugin/KDLKinematicsPlugin"
    assert read.srdf.groups[0].chains == config.srdf.groups[0].chains


@pytest.mark.parametrize("ros_version", [1, 2])
def test_the_doctor_has_nothing_to_say_of_a_written_package(
    tmp_path: Path, ros_version: int
) -> None:
    config = seven_of(ros_version)
    folder = tmp_path / "src" / config.package_name
    write_package(config, folder)
    report = examine([str(folder)], cwd=tmp_path)
    # The arm of these tests has a link whose mass is not where its shape is.
    told = [str(item) for item in report.findings if not item.code.startswith("inertia.")]
    findings = [item for item in report.findings if not item.code.startswith("inertia.")]
    assert all(item.severity is Severity.INFO for item in findings), told
    assert "package.undeclared" not in {item.code for item in findings}, told


def test_edited_files_are_kept_and_named_and_written_when_asked(tmp_path: Path) -> None:
    config = seven_of(2)
    folder = tmp_path / config.package_name
    write_package(config, folder)
    path = "config/kinematics.yaml"
    text = (folder / path).read_text(encoding="utf-8")
    (folder / path).write_text(text + "# mine\n", encoding="utf-8")

    faster = replace(config, velocity_scaling=0.5)
    states = _states(faster, folder)
    assert states[path] is FileState.EDITED
    assert states["config/joint_limits.yaml"] is FileState.CHANGED
    written = {item.path for item in write_package(faster, folder)}
    assert written == {"config/joint_limits.yaml", ".setup_assistant"}
    assert (folder / path).read_text(encoding="utf-8").endswith("# mine\n")
    # It still counts as edited the next time.
    assert _states(faster, folder)[path] is FileState.EDITED
    assert {item.path for item in write_package(faster, folder, overwrite=[path])} >= {path}
    assert (folder / path).read_text(encoding="utf-8") == text


def test_what_nobody_knows_is_kept(tmp_path: Path) -> None:
    config = seven_of(2)
    folder = tmp_path / config.package_name
    write_package(config, folder)

    def change(path: str, old: str, new: str) -> None:
        text = (folder / path).read_text(encoding="utf-8")
        assert old in text
        (folder / path).write_text(text.replace(old, new, 1), encoding="utf-8")

    change("config/seven.srdf", "</robot>", '<tool kind="x"><part n="1"/></tool></robot>')
    change(".setup_assistant", "  gazelle:", "  theirs: {a: 1}\n  gazelle:")
    change("config/kinematics.yaml", "arm:\n", "arm:\n  epsilon: 0.001\n")
    change("config/joint_limits.yaml", "  joint1:\n", "  joint1:\n    max_jerk: 5.0\n")
    change("config/ros2_controllers.yaml", "update_rate: 100", "update_rate: 250")
    change(
        "config/moveit_controllers.yaml",
        "    default: true",
        "    default: true\n    parallel: true",
    )
    read = _read(folder)
    texts = {item.path: item.text for item in planned_files(read, folder)}
    assert '<tool kind="x">' in texts["config/seven.srdf"]
    assert "theirs:\n    a: 1" in texts[".setup_assistant"]
    assert "epsilon: 0.001" in texts["config/kinematics.yaml"]
    assert "max_jerk: 5.0" in texts["config/joint_limits.yaml"]
    assert "update_rate: 250" in texts["config/ros2_controllers.yaml"]
    assert "parallel: true" in texts["config/moveit_controllers.yaml"]


def test_a_fixed_root_is_fixed_in_gazebo_too(tmp_path: Path) -> None:
    texts = {item.path: item.text for item in planned_files(seven_of(2), tmp_path)}
    assert "<child>base</child>" in texts["config/seven.urdf.xacro"]
    texts = {item.path: item.text for item in planned_files(seven_of(1), tmp_path)}
    assert "<child>base</child>" in texts["config/gazebo_seven.urdf.xacro"]
    assert "PositionJointInterface" in texts["config/gazebo_seven.urdf.xacro"]


def test_sensors_are_written_as_each_ros_has_them(tmp_path: Path) -> None:
    sensor = {"sensor_plugin": "occupancy_map_monitor/PointCloudOctomapUpdater"}
    for ros_version in (1, 2):
        config = replace(seven_of(ros_version), sensors=(sensor,))
        folder = tmp_path / str(ros_version)
        write_package(config, folder)
        assert _read(folder).sensors == (sensor,)


def test_a_folder_that_is_no_config_package_is_told(tmp_path: Path) -> None:
    message = re.escape(f"{tmp_path} has no file .setup_assistant: it is no package of")
    with pytest.raises(SetupAssistantError, match=message):
        _read(tmp_path)
