"""Files of a package that are no robots on their own."""

from __future__ import annotations

import time

import pytest
from tests.doctor.conftest import Examine, Write, codes

from gazelle.doctor.dry_start import dry_start

CONFIG = "<model><name>m</name><sdf version='1.6'>model.sdf</sdf></model>"
SUN = "<sdf version='1.6'><light type='directional' name='sun'/></sdf>"
GROUND = """<sdf version='1.6'><model name='ground_plane'><static>true</static><link name='link'>
<collision name='c'><geometry><plane><normal>0 0 1</normal></plane></geometry></collision></link>
</model></sdf>"""
REAL = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro"><link name="a"><inertial>
<mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
<link name="b"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>
</inertial></link><joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint>
<ros2_control name="Arduino" type="system"><hardware><plugin>{}</plugin></hardware>
<joint name="j"><command_interface name="velocity"/></joint></ros2_control>
<gazebo><plugin name="c" filename="libgazebo_ros2_control.so"/></gazebo></robot>"""


@pytest.mark.parametrize("text", [SUN, GROUND])
def test_models_of_every_empty_world_are_none_too_many(
    written: Write, examined: Examine, text: str
) -> None:
    folder = written(**{"models__m__model.config": CONFIG, "models__m__model.sdf": text})
    assert set(codes(examined(folder, "bot"))) <= {"package.manifest"}
    assert codes(examined(folder, "models/m/model.sdf")) == []


def test_model_that_a_program_makes_is_a_notice_in_a_package(
    written: Write, examined: Examine
) -> None:
    folder = written(
        **{"models__m__model.config": CONFIG, "models__m__model.sdf.jinja": "{{ name }}"}
    )
    report = examined(folder, "bot")
    assert set(codes(report)) <= {"package.manifest"}
    (found,) = (item for item in report.findings if item.code == "sdf.no-model")
    assert "right where others use its meshes only, or a program makes it" in found.message
    assert "sdf.no-model" in codes(examined(folder, "models/m/model.config"))


def test_robot_that_needs_arguments_is_a_notice_in_a_package(
    written: Write, examined: Examine
) -> None:
    text = '<robot name="$(arg name)" xmlns:xacro="http://www.ros.org/wiki/xacro"/>'
    folder = written(**{"urdf__bot.urdf.xacro": text})
    (found,) = (item for item in examined(folder, "bot").findings if "$(arg" in item.message)
    assert (found.code, str(found.severity)) == ("doctor.needs-arguments", "info")
    assert "xacro.argument-missing" in codes(examined(folder, "urdf/bot.urdf.xacro"))


@pytest.mark.parametrize(
    ("plugin", "severity"),
    [("diffdrive_arduino/Arduino", "warning"), ("gazebo_ros2_control/GazeboSytem", "error")],
)
def test_driver_of_the_real_robot_is_no_error(
    written: Write, examined: Examine, plugin: str, severity: str
) -> None:
    folder = written(**{"robot.urdf": REAL.format(plugin)})
    (found,) = (
        item
        for item in examined(folder, "robot.urdf").findings
        if item.code == "control.hardware-plugin"
    )
    assert str(found.severity) == severity
    assert found.message.endswith("right for the real robot") is (severity == "warning")


def test_plugin_without_a_file_is_passed_over(written: Write, examined: Examine) -> None:
    """sdformat writes this when a world is saved from Gazebo's window."""
    plugin = "<plugin name='__default__' filename='__default__'/>"
    text = GROUND.replace("</link>", f"<visual name='v'>{plugin}</visual></link>{plugin}")
    folder = written(**{"m.sdf": text.replace("ground_plane", "m")})
    found = [item.code for item in examined(folder, "m.sdf").findings]
    assert [code for code in found if "plugin" in code] == []


def test_every_one_of_several_files_is_examined(written: Write, examined: Examine) -> None:
    folder = written(
        **{"one.yaml": "a: &a [*a]\n", "two.yaml": "a: b: c\n", "three.yaml": "a: 1\n"}
    )
    found = examined(folder, "three.yaml", "one.yaml", "two.yaml").findings
    places = sorted(item.span.file.rpartition("/")[2] for item in found if item.span)
    assert places == ["one.yaml", "two.yaml"]


URDF_CHAIN = """<link name="b{1}"/><joint name="j{1}" type="fixed"><parent link="b{0}"/>
<child link="b{1}"/></joint>"""
SDF_CHAIN = """<link name="b{1}"/><joint name="j{1}" type="revolute"><axis><xyz>0 0 1</xyz></axis>
<parent>b{0}</parent><child>b{1}</child></joint>"""


@pytest.mark.parametrize(
    ("name", "start", "part", "end", "most"),
    [
        ("chain.urdf", "<robot name='r'><link name='b0'/>", URDF_CHAIN, "</robot>", "1000 links"),
        (
            "chain.sdf",
            "<sdf version='1.6'><model name='r'><link name='b0'/>",
            SDF_CHAIN,
            "</model></sdf>",
            "500 moving joints",
        ),
    ],
)
def test_chain_of_twenty_thousand_links_is_soon_found_too_long(
    written: Write, examined: Examine, name: str, start: str, part: str, end: str, most: str
) -> None:
    text = start + "\n".join(part.format(n, n + 1) for n in range(20_000)) + end
    folder = written(**{name: text})
    begun = time.thread_time()
    report = examined(folder, name)
    assert time.thread_time() - begun < 30.0
    (found,) = (item for item in report.findings if item.code == "doctor.spawn-fails")
    assert f"has a chain of more than {most}, up to joint 'j" in found.message


WHOLE = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:property name="side" value="{side}"/>
<xacro:include filename="parts/shapes.xacro"/><link name="a"><xacro:cube mass="1"/></link>
</robot>"""
SHAPES = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:include filename="box.xacro"/>
</robot>"""
PART = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:macro name="cube" params="mass">
<inertial><mass value="${mass}"/><inertia ixx="${side}" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>
</inertial></xacro:macro><material name="m"><color rgba="${side} 0 0 1"/></material></robot>"""


@pytest.mark.parametrize("name", ["parts/box.xacro", "parts/shapes.xacro"])
def test_a_part_of_a_robot_is_examined_as_that(
    written: Write, examined: Examine, name: str
) -> None:
    files = {"urdf__bot.urdf.xacro": WHOLE.format(side=1), "urdf__parts__shapes.xacro": SHAPES}
    folder = written(**files, **{"urdf__parts__box.xacro": PART})
    report = examined(folder, f"urdf/{name}")
    (found,) = (item for item in report.findings if item.code == "doctor.part")
    part = name.rpartition("/")[2]
    assert (
        found.message == f"'{part}' is a part of 'bot.urdf.xacro', which is examined in its place"
    )
    assert codes(report) == []


def test_what_is_wrong_with_a_part_is_told_there(written: Write, examined: Examine) -> None:
    files = {"urdf__bot.urdf.xacro": WHOLE.format(side=3), "urdf__parts__shapes.xacro": SHAPES}
    folder = written(**files, **{"urdf__parts__box.xacro": PART})
    report = examined(folder, "urdf/parts/box.xacro")
    (found,) = (item for item in report.findings if item.code == "inertia.triangle")
    assert found.span is not None
    assert found.span.file.endswith("parts/box.xacro")


def test_a_file_that_no_robot_includes_is_examined_alone(written: Write, examined: Examine) -> None:
    folder = written(**{"urdf__box.xacro": PART})
    assert "xacro.undefined-name" in codes(examined(folder, "urdf/box.xacro"))


def _arms(arms: int, joints: int) -> str:
    """Return a robot of arms on one base, all of whose joints turn."""
    inertial = '<inertial><mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" '
    inertial += 'ixz="0" iyz="0"/></inertial>'
    lines = [f'<robot name="r"><link name="base">{inertial}</link>']
    for arm in range(arms):
        above = "base"
        for at in range(joints):
            name = f"a{arm}_{at}"
            lines.append(f'<link name="{name}">{inertial}</link>')
            lines.append(f'<joint name="j_{name}" type="continuous"><parent link="{above}"/>')
            lines.append(f'<child link="{name}"/><axis xyz="0 1 0"/></joint>')
            above = name
    return "\n".join([*lines, "</robot>"])


def test_robot_of_thousands_of_joints_is_checked_and_not_brought_up(
    written: Write, examined: Examine, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("gazelle.doctor.examine_file._MAX_MOVING_JOINTS", 20)
    folder = written(**{"urdf__large.urdf": _arms(3, 7), "urdf__small.urdf": _arms(2, 10)})
    brought_up: list[object] = []
    real = dry_start
    monkeypatch.setattr(
        "gazelle.doctor.examine_file.dry_start",
        lambda *words, **keys: brought_up.append(words) or real(*words, **keys),
    )
    report = examined(folder, "urdf/large.urdf")
    (found,) = (item for item in report.findings if item.code == "doctor.too-many-joints")
    assert str(found.severity) == "info"
    assert "it has 21 joints that move, more than 20 take long" in found.message
    assert "plug-ins, controllers and contacts are not tried" in found.message
    assert found.fix.endswith("GAZELLE_LIMITS=10 for ten times, or add --probe")
    assert "robot.root-inertia" in codes(report, "info")
    assert not brought_up
    small = examined(folder, "urdf/small.urdf")
    assert "doctor.too-many-joints" not in codes(small, "info")
    assert "robot.root-inertia" in codes(small, "info")
    assert len(brought_up) == 1


def test_chain_that_the_engine_refuses_is_told_however_long_it_is(
    written: Write, examined: Examine, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("gazelle.doctor.examine_file._MAX_MOVING_JOINTS", 20)
    monkeypatch.setattr("gazelle.engine.kinematic_tree._MAX_CHAIN", 10)
    folder = written(**{"urdf__chain.urdf": _arms(1, 30)})
    report = examined(folder, "urdf/chain.urdf")
    (found,) = (item for item in report.findings if item.code == "doctor.spawn-fails")
    assert "a chain of more than 10 moving joints, up to joint 'j_a0_10'" in found.message
    assert "doctor.too-many-joints" not in codes(report, "info")
