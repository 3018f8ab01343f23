from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from gazelle.description.checks.inertia_patch import make_patch

from .conftest import Judged, inertial, judged, link, robot
from .test_inertia import SDF_TENSOR, sdf


def patched(found: Judged, folder: Path) -> Judged:
    """Apply the patch with the real program and judge again."""
    patch = make_patch(found.findings, folder=folder)
    assert patch.folder == folder.resolve()
    command = ["patch", "-p0", "--fuzz=0"]
    data = patch.text.encode("utf-8", "surrogateescape")
    done = subprocess.run(command, input=data, cwd=folder, capture_output=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return judged(found.file)


JOINT = '  <joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint>\n'


def test_patch_replaces_and_inserts_and_the_recheck_is_clean(judge, tmp_path: Path) -> None:
    text = robot(link(inertial(moments=(1, 2, 9))), link("<!-- none -->", name="b"), JOINT)
    found = judge(text)
    assert sorted(found.codes) == ["inertia.missing", "inertia.triangle"]
    patch = make_patch(found.findings, folder=tmp_path)
    assert patch.text.startswith("--- robot.urdf\n+++ robot.urdf\n@@ ")
    assert patch.links == ("a", "b")
    assert patched(found, tmp_path).codes == []
    lines = found.file.read_text(encoding="utf-8").splitlines()
    assert lines[2:4] == ["    <inertial>", '      <origin xyz="0 0 0" rpy="0 0 0"/>']
    assert lines[9:11] == ['  <link name="b">', "    <inertial>"]


def test_clean_file_needs_no_patch(judge, tmp_path: Path) -> None:
    patch = make_patch(judge(robot(link(inertial()))).findings, folder=tmp_path)
    assert (patch.text, patch.links, patch.notes) == ("", (), ())


def test_sdf_is_patched(judge, tmp_path: Path) -> None:
    found = judge(sdf("<mass>12</mass>" + SDF_TENSOR.replace("0.1<", "0.02<")), "model.sdf")
    assert found.codes == ["inertia.triangle"]
    assert patched(found, tmp_path).codes == []


@pytest.mark.parametrize(
    "change",
    [
        lambda text: text.replace("\n", "\r\n"),
        lambda text: "\n\n" + text,
        lambda text: text.rstrip("\n"),
        lambda text: text.replace("<robot", "<!-- Größe ≥ 1 --><robot"),
        lambda text: text.replace("    <inertial>", "\t<inertial>"),
    ],
    ids=["crlf", "blank lines first", "no newline at the end", "not ascii", "tabs"],
)
def test_files_of_every_shape_are_patched(judge, tmp_path: Path, change) -> None:
    found = judge(change(robot(link(inertial(moments=(1, 2, 9))))))
    if "\r\n" in change("a\n"):
        found.file.write_bytes(change(robot(link(inertial(moments=(1, 2, 9))))).encode())
        found = judged(found.file)
    assert found.codes == ["inertia.triangle"]
    assert patched(found, tmp_path).codes == []


def test_empty_link_element_is_opened(judge, tmp_path: Path) -> None:
    found = judge('<robot name="r">\n  <link name="a"/>\n</robot>\n')
    (finding,) = found.findings
    body = judge(robot(link("")), "other.urdf").findings[0].body
    patch = make_patch([finding._replace(body=body)], folder=tmp_path)
    assert '-  <link name="a"/>\n+  <link name="a">\n+    <inertial>\n' in patch.text
    assert "+    </inertial>\n+  </link>\n" in patch.text


def test_xacro_link_is_patched_in_the_included_file(judge, tmp_path: Path) -> None:
    part = robot(link(inertial(moments=(1, 2, 9)))).replace(' name="r"', "")
    (tmp_path / "part.xacro").write_text(part, encoding="utf-8")
    found = judge(
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
        '  <xacro:include filename="part.xacro"/>\n</robot>\n',
        "robot.urdf.xacro",
    )
    assert found.codes == ["inertia.triangle"]
    assert found.place == ("part.xacro", 6, 7)
    assert "--- part.xacro\n" in make_patch(found.findings, folder=tmp_path).text
    assert patched(found, tmp_path).codes == []


def test_link_of_a_macro_is_left_with_a_note(judge, tmp_path: Path) -> None:
    inside = link(inertial(moments=(1, 2, 9)), name="${n}")
    found = judge(
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
        f'<xacro:macro name="part" params="n">\n{inside}</xacro:macro>\n'
        '<xacro:part n="a"/>\n</robot>\n',
        "robot.urdf.xacro",
    )
    patch = make_patch(found.findings, folder=tmp_path)
    assert patch.text == ""
    (note,) = patch.notes
    assert "robot.urdf.xacro:3:3: link 'a' stays: it comes from <xacro:macro> at" in note


def test_condition_does_not_hinder_a_patch(judge, tmp_path: Path) -> None:
    inside = link(inertial(moments=(1, 2, 9)))
    found = judge(
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
        f'<xacro:if value="true">\n{inside}</xacro:if>\n</robot>\n',
        "robot.urdf.xacro",
    )
    assert found.codes == ["inertia.triangle"]
    assert patched(found, tmp_path).codes == []


def test_files_elsewhere_get_names_below_a_shared_folder(judge, tmp_path: Path) -> None:
    found = judge(robot(link(inertial(moments=(1, 2, 9)))))
    (tmp_path / "here").mkdir()
    patch = make_patch(found.findings, folder=tmp_path / "here")
    assert patch.folder == tmp_path.resolve()
    assert patch.text.startswith("--- robot.urdf\n")


def test_file_that_changed_meanwhile_is_left_with_a_note(judge, tmp_path: Path) -> None:
    found = judge(robot(link(inertial(moments=(1, 2, 9)))))
    found.file.write_text("<robot/>", encoding="utf-8")
    patch = make_patch(found.findings, folder=tmp_path)
    assert patch.text == ""
    assert "no element starts at" in patch.notes[0]
