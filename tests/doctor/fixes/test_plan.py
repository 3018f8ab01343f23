"""Every fix that is offered is a fix: a mistake is made, the fix applied, the file is as it was."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any, Literal

import pytest
from tests.doctor.conftest import Examine, Write, codes

from gazelle.doctor import Options
from gazelle.doctor.fixes import FixPlan, plan_fixes, write_fixes
from gazelle.errors import GazelleError
from gazelle.workspace.scaffold import create_package

ROBOT1, ROBOT2 = "urdf/bot1.urdf.xacro", "urdf/bot2.urdf.xacro"
LAUNCH1, LAUNCH2 = "launch/bot1.launch", "launch/bot2.launch.py"
# File, what stands there, what somebody writes. The first place counts.
MISTAKES = (
    # Names.
    (LAUNCH1, 'pkg="gazebo_ros"', 'pkg="gazeob_ros"'),
    (LAUNCH1, "$(arg gui)", "$(arg giu)"),
    (LAUNCH1, "$(find gazebo_ros)", "$(find gazebo_rso)"),
    (LAUNCH1, "empty_world.launch", "empyt_world.launch"),
    (LAUNCH1, 'type="spawn_model"', 'type="spwan_model"'),
    (LAUNCH1, "-param robot_description", "-param robot_desciption"),
    (LAUNCH1, '<arg name="gui" value', '<arg naem="gui" value'),
    (LAUNCH1, "urdf/bot1.urdf.xacro", "urdf/bto1.urdf.xacro"),
    (ROBOT1, '<parent link="base_footprint"/>', '<parent link="base_footprnit"/>'),
    (ROBOT1, '<child link="caster_link"/>', '<child link="castre_link"/>'),
    (ROBOT1, 'type="continuous"', 'type="continous"'),
    (ROBOT1, '<material name="light"/>', '<material name="lihgt"/>'),
    (ROBOT1, '<sphere radius="${caster_radius}"', '<sphere raduis="${caster_radius}"'),
    (ROBOT1, "${wheel_width}", "${wheel_widht}"),
    (ROBOT1, "<xacro:cylinder_inertial", "<xacro:cylnider_inertial"),
    ("urdf/gazebo.xacro", 'reference="caster_link"', 'reference="castre_link"'),
    ("urdf/gazebo.xacro", "libgazebo_ros_camera.so", "libgazebo_rso_camera.so"),
    ("urdf/gazebo.xacro", '<sensor type="ray"', '<sensor type="rya"'),
    ("package.xml", "<exec_depend>xacro</exec_depend>", "<exec_depend>xaco</exec_depend>"),
    (LAUNCH2, 'package="robot_state_publisher"', 'package="robot_state_publsher"'),
    (LAUNCH2, 'executable="robot_state_publisher"', 'executable="robot_state_publsher"'),
    (LAUNCH2, 'LaunchConfiguration("wander")', 'LaunchConfiguration("wadner")'),
    (LAUNCH2, 'executable="wander"', 'execuatble="wander"'),
    ("bot2/wander.py", "import LaserScan", "import LaserScna"),
    ("bot2/wander.py", "from geometry_msgs.msg", "from geomerty_msgs.msg"),
    ("setup.py", "bot2.wander:main", "bot2.wadner:main"),
    # What a reader stumbles on.
    (ROBOT1, '<parent link="base_link"/>', '<parent link="base_link">'),
    (ROBOT1, '<child link="caster_link"/>', '<child link="caster_link/>'),
    (ROBOT1, "</visual>", "</visula>"),
    (ROBOT1, "${wheel_width}", "${wheel_width"),
    (LAUNCH2, '"wander", default_value="true"),', '"wander", default_value="true")'),
    ("scripts/wander.py", "class Wander:", "class Wander"),
    # Numbers.
    (ROBOT1, '<axis xyz="0 1 0"/>', '<axis xyz="1 0 0"/>'),
)


@pytest.mark.parametrize("version", [1, 2])
def test_each_mistake_is_mended_as_it_was(version: Literal[1, 2], tmp_path: Path) -> None:
    package = _package(version, tmp_path / "src")
    mistakes = [row for row in MISTAKES if _has(package / row[0], row[1])]
    assert len(mistakes) >= 8
    wrong = []
    for file, right, mistake in mistakes:
        path = package / file
        text = path.read_text("utf-8")
        path.write_text(text.replace(right, mistake, 1), "utf-8")
        plan = _plan(tmp_path, f"src/{package.name}/", only_certain=False)
        after = plan.texts.get(str(path), ("", ""))[1]
        if after.split() != text.split() or plan.left:
            wrong.append((mistake, plan.diff, [str(item) for item in plan.left]))
        path.write_text(text, "utf-8")
    assert wrong == []


def test_many_mistakes_go_in_one_plan(tmp_path: Path, examined: Examine) -> None:
    package = _package(1, tmp_path / "src")
    texts = {}
    for file, right, mistake in MISTAKES[:3] + MISTAKES[8:10]:
        path = package / file
        texts.setdefault(path, path.read_text("utf-8"))
        path.write_text(path.read_text("utf-8").replace(right, mistake, 1), "utf-8")
    plan = _plan(tmp_path, "bot1")
    assert len(plan.mended) >= 5
    assert plan.left == ()
    assert {path: path.read_text("utf-8") for path in texts} != texts, "a plan writes nothing"
    write_fixes(plan)
    assert {path: path.read_text("utf-8") for path in texts} == texts
    assert codes(examined(tmp_path, "bot1")) == []


def test_two_tags_that_are_left_open_in_one_file(tmp_path: Path) -> None:
    package = _package(1, tmp_path / "src")
    text = (package / ROBOT1).read_text("utf-8")
    _spoil(package / ROBOT1, '<parent link="base_footprint"/>', '<parent link="base_footprint">')
    _spoil(package / ROBOT1, '<child link="caster_link"/>', '<child link="caster_link">')
    plan = _plan(tmp_path, "bot1", only_certain=False)
    assert [item.finding.code for item in plan.mended] == ["xml.malformed", "xml.malformed"]
    assert plan.texts[str(package / ROBOT1)][1] == text


def test_diff_names_files_as_git_takes_them(tmp_path: Path) -> None:
    package = _package(1, tmp_path / "src")
    _spoil(package / LAUNCH1, "$(arg gui)", "$(arg giu)")
    plan = _plan(tmp_path, "bot1")
    assert plan.folder == (tmp_path / "src").resolve()
    assert plan.diff.startswith(f"--- a/bot1/{LAUNCH1}\n+++ b/bot1/{LAUNCH1}\n@@ ")
    assert '-    <arg name="gui" value="$(arg giu)"/>\n' in plan.diff
    assert '+    <arg name="gui" value="$(arg gui)"/>\n' in plan.diff


def test_estimates_are_left_to_the_user(tmp_path: Path, written: Write) -> None:
    folder = written(**{"urdf/bot.urdf": _ARM.format(limit="")})
    assert _plan(folder, "urdf/bot.urdf").mended == ()
    plan = _plan(folder, "urdf/bot.urdf", only_certain=False)
    ((_, after),) = plan.texts.values()
    assert '<limit lower="-3.1416" upper="3.1416" effort="10" velocity="1"/>' in after


def test_exchanged_limits_are_certain(written: Write) -> None:
    limit = '<limit lower="1" upper="-1" effort="2" velocity="3"/>'
    folder = written(**{"urdf/bot.urdf": _ARM.format(limit=limit)})
    ((_, after),) = _plan(folder, "urdf/bot.urdf").texts.values()
    assert '<limit lower="-1" upper="1" effort="2" velocity="3"/>' in after


def test_a_fix_that_brings_another_finding_is_none(written: Write) -> None:
    """The name that is near belongs to a link that has a parent already."""
    text = _ARM.format(limit='<limit lower="-1" upper="1" effort="2" velocity="3"/>')
    text = text.replace("</robot>", '<joint name="j2" type="fixed"><parent link="base"/>'
                        '<child link="arn"/></joint></robot>')  # fmt: skip
    plan = _plan(written(**{"urdf/bot.urdf": text}), "urdf/bot.urdf", only_certain=False)
    assert plan.mended == ()
    assert [item.code for item in plan.left] == ["urdf.child-missing"]


def test_file_changed_meanwhile_is_not_overwritten(tmp_path: Path) -> None:
    package = _package(1, tmp_path / "src")
    _spoil(package / LAUNCH1, "$(arg gui)", "$(arg giu)")
    plan = _plan(tmp_path, "bot1")
    text = (package / LAUNCH1).read_text("utf-8") + "<!-- mine -->\n"
    (package / LAUNCH1).write_text(text, "utf-8")
    with pytest.raises(GazelleError, match="has changed since it was looked at; nothing is"):
        write_fixes(plan)
    assert (package / LAUNCH1).read_text("utf-8") == text


def test_mode_and_line_ends_of_a_file_stay(tmp_path: Path) -> None:
    package = _package(1, tmp_path / "src")
    path = package / "scripts" / "wander.py"
    mode = path.stat().st_mode
    text = path.read_bytes().replace(b"\n", b"\r\n")
    path.write_bytes(text.replace(b"class Wander:", b"class Wander"))
    write_fixes(_plan(tmp_path, "bot1"))
    assert path.read_bytes() == text
    assert path.stat().st_mode == mode


_ARM = """<robot name="bot">
  <link name="base"/>
  <link name="arm">
    <inertial><mass value="1"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
  </link>
  <joint name="j" type="revolute">
    <parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
    {limit}
  </joint>
</robot>
"""


def _package(version: Literal[1, 2], folder: Path) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    create_package("robot", f"bot{version}", folder, ros_version=version)
    return folder / f"bot{version}"


def _has(path: Path, text: str) -> bool:
    return path.is_file() and text in path.read_text("utf-8")


def _spoil(path: Path, right: str, wrong: str) -> None:
    path.write_text(path.read_text("utf-8").replace(right, wrong, 1), "utf-8")


def _plan(folder: Path, *words: str, **keys: Any) -> FixPlan:
    foreign = ("AMENT_", "GAZEBO_", "GZ_", "ROS_")
    environ = {key: text for key, text in os.environ.items() if not key.startswith(foreign)}
    environ["HOME"] = str(folder)
    return plan_fixes(words, options=Options(environ=environ), cwd=folder, **keys)
