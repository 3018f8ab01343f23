"""Inertia that a macro writes: a file, an expanded file, a launch and `inertia --check` agree."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from tests.doctor.conftest import Examine, Write

from gazelle.cli.inertia import main as inertia
from gazelle.description.source_maps import remember
from gazelle.description.xacro import expand_xacro
from gazelle.diagnostics import Diagnostics
from gazelle.doctor import Report
from gazelle.workspace import Workspace

BOX = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:macro name="box_inertia" params="m:=1000 x:=1 y:=1 z:=1 k:=1">
  <inertial>
    <mass value="${m}"/>
    <inertia ixx="${k*m*(y*y+z*z)/12}" iyy="${m*(x*x+z*z)/12}" izz="${m*(x*x+y*y)/12}"
             ixy="0" ixz="0" iyz="0"/>
  </inertial>
</xacro:macro>
</robot>"""
ROBOT = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:include filename="inertia.xacro"/>
<link name="base">
  <collision><geometry><box size="1 1 1"/></geometry></collision>
  {base}
</link>
<xacro:macro name="arm" params="name *block">
  <link name="${{name}}">
    <collision><geometry><box size="1 1 1"/></geometry></collision>
    <xacro:insert_block name="block"/>
  </link>
  <joint name="j" type="continuous">
    <parent link="base"/><child link="${{name}}"/><origin xyz="3 0 0"/>
  </joint>
</xacro:macro>
<xacro:arm name="arm">{arm}</xacro:arm>
</robot>"""
LAUNCH = """<launch>
<param name="robot_description" command="$(find xacro)/xacro $(find bot)/urdf/bot.urdf.xacro"/>
<node name="gazebo" pkg="gazebo_ros" type="gzserver"/>
<node name="spawn" pkg="gazebo_ros" type="spawn_model"
      args="-urdf -param robot_description -model bot"/>
</launch>"""
GOOD = "<xacro:box_inertia/>"
PLAIN = (
    '<inertial><mass value="1000"/><inertia ixx="166" iyy="166" izz="166" ixy="0" ixz="0" '
    'iyz="0"/></inertial>'
)
CASES = {
    "inside a link": (GOOD, PLAIN, []),
    "by call": ('<xacro:call macro="box_inertia"/>', PLAIN, []),
    "under a condition": (f'<xacro:if value="1">{GOOD}</xacro:if>', PLAIN, []),
    "under none": (f'<xacro:if value="0">{GOOD}</xacro:if>', PLAIN, [("inertia.missing", 3)]),
    "none": ("", PLAIN, [("inertia.missing", 3)]),
    "without mass": ('<xacro:box_inertia m="0"/>', PLAIN, [("inertia.mass", 4)]),
    "of negative mass": ('<xacro:box_inertia m="-1"/>', PLAIN, [("inertia.mass", 4)]),
    "of zeros": ('<xacro:box_inertia x="0" y="0" z="0"/>', PLAIN, [("inertia.not-positive", 5)]),
    "of no body": ('<xacro:box_inertia k="9"/>', PLAIN, [("inertia.triangle", 5)]),
    "of a block": (GOOD, PLAIN.replace('ixx="166"', 'ixx="999"'), [("inertia.triangle", 16)]),
}


def _inertia_in(report: Report) -> list[tuple[str, int]]:
    return sorted(
        (item.code, item.span.line if item.span else 0)
        for item in report.findings
        if item.code.startswith(("inertia.", "urdf."))
    )


@pytest.mark.parametrize("case", CASES)
def test_every_way_to_look_at_it_says_the_same(
    written: Write,
    examined: Examine,
    case: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    base, arm, expected = CASES[case]
    files = {"urdf__inertia.xacro": BOX, "urdf__bot.urdf.xacro": ROBOT.format(base=base, arm=arm)}
    folder = written(**files, **{"launch__bot.launch": LAUNCH})
    robot = folder / "urdf" / "bot.urdf.xacro"
    assert _inertia_in(examined(folder, "urdf/bot.urdf.xacro")) == expected
    assert _inertia_in(examined(folder, "bot", "bot.launch")) == expected
    monkeypatch.chdir(folder)
    inertia(["--check", str(robot), "--json"])
    checked = json.loads(capsys.readouterr().out)["findings"]
    assert [(item["code"], item["line"]) for item in checked] == expected
    _expand(robot, folder)
    plain = examined(folder, "urdf/expanded.urdf")
    assert _inertia_in(plain) == expected
    assert all(item.span is None or item.span.file.endswith(".xacro") for item in plain.findings)


@pytest.mark.parametrize("case", CASES)
def test_what_another_xacro_expanded_is_judged_as_its_source(
    written: Write, examined: Examine, case: str
) -> None:
    base, arm, expected = CASES[case]
    files = {"urdf__inertia.xacro": BOX, "urdf__bot.urdf.xacro": ROBOT.format(base=base, arm=arm)}
    folder = written(**files)
    _expand(folder / "urdf" / "bot.urdf.xacro", folder, is_remembered=False)
    codes = [code for code, _ in _inertia_in(examined(folder, "urdf/expanded.urdf"))]
    assert codes == [code for code, _ in expected]


def _expand(robot: Path, folder: Path, *, is_remembered: bool = True) -> None:
    workspace = Workspace.discover(environ={}, cwd=folder)
    expanded = expand_xacro(robot, mappings={}, workspace=workspace, diagnostics=Diagnostics())
    assert expanded is not None
    if is_remembered:
        remember(expanded)
    robot.with_name("expanded.urdf").write_text(expanded.text, encoding="utf-8")
