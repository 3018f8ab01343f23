"""What words mean to the doctor, and what it says to words that mean nothing."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.doctor.conftest import FIXTURES, Examine, Write, codes

from gazelle.doctor.target import find_target, package_at
from gazelle.errors import GazelleError, NotFoundError
from gazelle.workspace import Workspace

FRAMES = FIXTURES / "pain_13_frames" / "clean"


def _workspace(folder: Path) -> Workspace:
    return Workspace.discover(environ={"HOME": str(folder)}, cwd=folder)


def test_package_and_file_are_found_as_roslaunch_finds_them() -> None:
    target = find_target(["pain_13_frames", "robot.launch"], _workspace(FRAMES), FRAMES)
    assert [path.name for path in target.files] == ["robot.launch"]
    assert target.name == "pain_13_frames robot.launch"


def test_no_words_mean_the_package_around_the_current_folder() -> None:
    inside = FRAMES / "pain_13_frames" / "urdf"
    target = find_target([], _workspace(inside), inside)
    assert [package.name for package in target.packages] == ["pain_13_frames"]


def test_no_words_in_a_workspace_mean_all_its_packages(tmp_path: Path) -> None:
    for name in ("one", "two"):
        folder = tmp_path / "src" / name
        folder.mkdir(parents=True)
        (folder / "package.xml").write_text(f"<package><name>{name}</name></package>")
    target = find_target([], _workspace(tmp_path), tmp_path)
    assert [package.name for package in target.packages] == ["one", "two"]


def test_file_of_a_package_knows_its_package() -> None:
    package = package_at(FRAMES / "pain_13_frames" / "launch", _workspace(FRAMES))
    assert package is not None
    assert package.name == "pain_13_frames"


def test_mistyped_package_names_the_nearest() -> None:
    with pytest.raises(NotFoundError, match="did you mean 'pain_13_frames'"):
        find_target(["pain_13_frame"], _workspace(FRAMES), FRAMES)


def test_mistyped_file_of_a_package_names_the_nearest_and_what_there_is() -> None:
    with pytest.raises(NotFoundError) as caught:
        find_target(["pain_13_frames", "robt.launch"], _workspace(FRAMES), FRAMES)
    assert "did you mean 'robot.launch'" in str(caught.value)
    assert "files there: package.xml, robot.launch, robot.urdf" in str(caught.value)


def test_three_words_that_are_no_files_are_refused() -> None:
    with pytest.raises(NotFoundError, match="give one target, or files of one launch"):
        find_target(["a", "b", "c"], _workspace(FRAMES), FRAMES)


def test_empty_folder_says_what_can_be_named(tmp_path: Path) -> None:
    with pytest.raises(GazelleError, match=r"gazelle doctor PACKAGE \| FOLDER \| FILE"):
        find_target([], _workspace(tmp_path), tmp_path)


def test_folder_without_anything_is_told(tmp_path: Path, examined: Examine) -> None:
    (tmp_path / "notes").mkdir()
    (tmp_path / "notes" / "todo.txt").write_text("milk")
    report = examined(tmp_path, "notes")
    assert codes(report) == ["doctor.nothing"]
    assert report.kind == "folder"


def test_binary_file_is_refused(tmp_path: Path, examined: Examine) -> None:
    (tmp_path / "robot.urdf").write_bytes(b"\x7fELF\0\0\0\1")
    report = examined(tmp_path, "robot.urdf")
    assert codes(report) == ["doctor.unknown-file"]
    assert "is a binary file" in report.findings[0].message


def test_text_of_another_kind_is_refused(tmp_path: Path, examined: Examine) -> None:
    (tmp_path / "notes.txt").write_text("milk")
    (tmp_path / "page.xml").write_text("<html/>")
    assert "is no XML, YAML or launch file" in examined(tmp_path, "notes.txt").findings[0].message
    assert "outermost element is <html>" in examined(tmp_path, "page.xml").findings[0].message


def test_unreadable_file_is_told(
    tmp_path: Path, examined: Examine, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "robot.urdf").write_text("<robot name='r'/>")

    def refuse(self: Path, *_args: object, **_keys: object) -> None:
        raise PermissionError(13, "Permission denied", str(self))

    monkeypatch.setattr(Path, "open", refuse)
    report = examined(tmp_path, "robot.urdf")
    assert codes(report) == ["doctor.unreadable"]
    assert "Permission denied" in report.findings[0].message


def test_manifest_means_its_package(examined: Examine) -> None:
    report = examined(FRAMES, "pain_13_frames/package.xml")
    assert report.kind == "package"
    assert any(section.name == "frames" for section in report.sections)


def test_included_files_are_not_examined_again(written: Write, examined: Examine) -> None:
    folder = written(
        **{
            "launch__all.launch": '<launch><include file="$(find bot)/launch/part.launch">'
            '<arg name="ns" value="a"/></include></launch>',
            "launch__part.launch": '<launch><arg name="ns"/>'
            '<node pkg="nowhere" type="t" name="n" ns="$(arg ns)"/></launch>',
        }
    )
    report = examined(folder, "bot")
    assert [code for code in codes(report) if "launch" in code or "elsewhere" in code] == [
        "doctor.packages-elsewhere"
    ]
    assert not [item for item in report.findings if item.code == "doctor.needs-arguments"]


def test_launch_file_that_needs_arguments_is_told_with_the_words(
    written: Write, examined: Examine
) -> None:
    folder = written(
        **{"launch__one.launch": '<launch><arg name="model" doc="which robot"/></launch>'}
    )
    (found,) = [
        item for item in examined(folder, "bot").findings if item.code == "doctor.needs-arguments"
    ]
    assert found.message == "'one.launch' needs arguments and is not started: model (which robot)"
    assert found.fix.endswith("launch/one.launch model:=…")
    assert "doctor.needs-arguments" not in codes(
        examined(folder, "bot", "one.launch", model="a"), "info"
    )


def test_piece_of_a_xacro_robot_is_left_out(written: Write, examined: Examine) -> None:
    space = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
    folder = written(
        **{
            "urdf__all.urdf.xacro": f'<robot name="r" {space}>'
            '<xacro:include filename="size.xacro"/><xacro:property name="size" value="1"/>'
            '<link name="a"><visual><geometry><box size="${size} 1 1"/></geometry></visual></link>'
            "</robot>",
            "urdf__size.xacro": f'<robot {space}><xacro:property name="b" value="${{size}}"/>'
            "</robot>",
            "urdf__colours.xacro": f'<robot name="c" {space}><material name="red"/></robot>',
        }
    )
    assert codes(examined(folder, "bot"), "error") == []


def test_include_cycle_ends(written: Write, examined: Examine) -> None:
    again = '<launch><include file="$(find bot)/launch/{}.launch"/></launch>'
    folder = written(
        **{"launch__a.launch": again.format("b"), "launch__b.launch": again.format("a")}
    )
    assert codes(examined(folder, "bot", "a.launch")) == ["launch.include-cycle"]
