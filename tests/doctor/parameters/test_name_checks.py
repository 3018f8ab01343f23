"""Pain 11: URDF, hardware, controllers and MoveIt do not mean the same names."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.shared_files import needs_shared

from gazelle.diagnostics import Diagnostics
from gazelle.doctor.parameters import check_description_text, check_package_parameters
from gazelle.doctor.report import Section
from gazelle.workspace import Workspace

FIXTURES = Path(__file__).parents[1] / "fixtures" / "pain_11_names"
LIFT = "c:\n  type: effort_controllers/JointPositionController\n  joint: lift\n"
PLUGIN = "<plugin>gazebo_ros2_control/GazeboSystem</plugin>"


def checked(name: str, root: Path) -> tuple[Diagnostics, tuple[Section, ...]]:
    workspace = Workspace.discover(environ={"HOME": str(root)}, cwd=root, extra=[root])
    found = Diagnostics()
    package = workspace.package(name)
    return found, check_package_parameters(package, workspace=workspace, diagnostics=found)


def test_one_table_of_names_that_are_missing_somewhere() -> None:
    found, _ = checked("arm_moveit_config", FIXTURES / "broken")
    (item,) = found.by_code("control.names-disagree")
    assert "the robot has no such joint; did you mean 'elbow'?" in item.message
    assert "no such controller is configured; did you mean 'arm_controller'?" in item.message
    assert str(item.span).endswith("ros2_controllers.yaml:9:24")


def test_joint_with_effort_limit_0_is_told_at_its_place() -> None:
    found, _ = checked("arm_moveit_config", FIXTURES / "broken")
    (item,) = found.by_code("control.zero-limit")
    assert str(item.span).endswith("arm.urdf:7:3")
    assert item.fix == 'write the motor\'s limit, as <limit effort="10" …/>'


def test_controller_claims_an_interface_that_is_not_there() -> None:
    found, _ = checked("arm_moveit_config", FIXTURES / "broken")
    (first,) = found.by_code("parameters.interface-claim")
    assert "Command interface with 'shoulder/position' does not exist" in first.message
    assert first.message.endswith("; 'wrist' lacks it, too")
    assert str(first.span).endswith("ros2_controllers.yaml:10:26")
    assert '<command_interface name="position"/>' in first.fix


@pytest.mark.parametrize(
    ("code", "place", "words", "fix"),
    [
        ("parameters.srdf-name", "arm.srdf:4:5", "Link 'tool' is not known to URDF", "'tool0'"),
        ("parameters.srdf-name", "arm.srdf:8:5", "Joint 'elbo' is not known to the", "'elbow'"),
        ("parameters.moveit-name", "joint_limits.yaml:4:3", "names joint 'wrists'", "'wrist'"),
        (
            "parameters.moveit-name",
            "kinematics.yaml:1:1",
            "No kinematics solver instantiated for group 'arms'",
            "'arm'",
        ),
    ],
)
def test_names_of_moveits_files(code: str, place: str, words: str, fix: str) -> None:
    found, _ = checked("arm_moveit_config", FIXTURES / "broken")
    (item,) = (item for item in found.by_code(code) if str(item.span).endswith(place))
    assert words in item.message
    assert item.fix == f"did you mean {fix}?"


def test_clean_twin_has_a_table_and_no_finding() -> None:
    found, (section,) = checked("arm_moveit_config", FIXTURES / "clean")
    assert list(found) == []
    assert section.columns == ("name", "URDF", "hardware", "controllers", "MoveIt")
    assert section.rows[0] == ("shoulder", "revolute", "effort", "arm_controller", "arm_controller")


def test_unrelated_robot_gives_no_finding(tmp_path: Path) -> None:
    for name, text in {
        "bot/package.xml": "<package format='2'><name>bot</name></package>",
        "bot/urdf/other.urdf": "<robot name='o'><link name='a'/></robot>",
        "bot/config/c.yaml": LIFT,
    }.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    found, sections = checked("bot", tmp_path)
    assert (list(found), sections) == ([], ())


def test_ros1_controller_of_another_interface(tmp_path: Path) -> None:
    urdf = """<robot name="o"><link name="a"/><link name="b"/>
<joint name="lift" type="revolute"><parent link="a"/><child link="b"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
<transmission name="t"><type>transmission_interface/SimpleTransmission</type>
<joint name="lift"><hardwareInterface>hardware_interface/PositionJointInterface</hardwareInterface>
</joint><actuator name="m"/></transmission></robot>"""
    for name, text in {
        "bot/package.xml": "<package format='2'><name>bot</name></package>",
        "bot/urdf/bot.urdf": urdf,
        "bot/config/c.yaml": LIFT,
    }.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    found, _ = checked("bot", tmp_path)
    (item,) = found.by_code("parameters.interface-claim")
    words = "Could not find resource 'lift' in 'hardware_interface::EffortJointInterface'"
    assert words in item.message
    assert item.fix.endswith("or type: position_controllers/JointPositionController")


def test_robots_of_the_examples_agree(examples_dir: Path) -> None:
    found, (section,) = checked("heron_moveit_config", examples_dir / "arm_ws" / "src")
    assert list(found) == []
    assert [row[0] for row in section.rows] == [
        *(f"joint_{number}" for number in range(1, 7)),
        "finger_joint",
    ]
    found, (section,) = checked("courier_robot", examples_dir / "four_wheel_ws" / "src")
    assert list(found) == []
    assert ("head_swivel", "continuous", "position", "head", "") in section.rows


@needs_shared
def test_documents_robots_agree(workspaces_dir: Path) -> None:
    found, (section,) = checked("luck_robot", workspaces_dir / "ros2_ws" / "src")
    assert list(found) == []
    assert [row[0] for row in section.rows] == [f"joint_{number}" for number in range(1, 7)]
    found, (section,) = checked("urdf_exam", workspaces_dir / "catkin_ws" / "src")
    assert list(found) == []
    assert (
        "yaw_joint",
        "continuous",
        "effort",
        "yaw_joint_position_controller",
        "",
    ) in section.rows


@pytest.mark.parametrize(
    ("text", "count"),
    [
        (f"<robot>\n<!-- a: b -->{PLUGIN}</robot>", 1),
        (f"<robot>\n<!-- a:\nb --><!-- c #d -->{PLUGIN}</robot>", 2),
        (f"<robot>\n<!-- http://a:b -->{PLUGIN}</robot>", 0),
        (f'<robot name="a: b">{PLUGIN}</robot>', 1),
        ("<robot>\n<!-- a: b --></robot>", 0),
    ],
)
def test_colons_that_end_a_plain_text_of_yaml(text: str, count: int) -> None:
    found = Diagnostics()
    check_description_text(text, file="<text>", diagnostics=found)
    assert len(found.by_code("parameters.colon-in-description")) == count


def _written(root: Path, **files: str) -> None:
    manifest = '<package format="2"><name>bot</name><version>1.0.0</version></package>'
    for name, text in {"package.xml": manifest, **files}.items():
        path = root / "bot" / name.replace("__", "/")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def _arm(name: str, *joints: str) -> str:
    parts = ["<link name='l0'/>"]
    for index, joint in enumerate(joints):
        kind = "fixed" if joint == "flange" else "revolute"
        parts.append(
            f"<link name='l{index + 1}'/><joint name='{joint}' type='{kind}'><parent "
            f"link='l{index}'/><child link='l{index + 1}'/><axis xyz='0 0 1'/>"
            "<limit lower='-1' upper='1' effort='1' velocity='1'/></joint>"
        )
    return f"<robot name='{name}'>{''.join(parts)}</robot>"


def _list(*joints: str) -> str:
    kind = "type: FollowJointTrajectory"
    return f"controller_list:\n  - name: arm\n    {kind}\n    joints: [{', '.join(joints)}]\n"


def test_fixed_joints_that_no_file_names_are_no_disagreement(tmp_path: Path) -> None:
    arm = _arm("a", "one", "two", "flange")
    _written(tmp_path, **{"urdf__a.urdf": arm})
    _written(tmp_path, **{"config__controllers.yaml": _list("one", "two")})
    assert not checked("bot", tmp_path)[0].by_code("control.names-disagree")


def test_files_for_another_robot_of_the_package_are_not_compared(tmp_path: Path) -> None:
    _written(tmp_path, **{"urdf__a.urdf": _arm("a", "one", "two", "three")})
    _written(tmp_path, **{"urdf__b.urdf": _arm("b", "j1", "j2")})
    _written(tmp_path, **{"config__a__controllers.yaml": _list("one", "two", "three")})
    _written(tmp_path, **{"config__b__controllers.yaml": _list("j1", "j2")})
    assert not checked("bot", tmp_path)[0].by_code("control.names-disagree")
    _written(tmp_path, **{"config__b__controllers.yaml": _list("j1", "jj2")})
    assert checked("bot", tmp_path)[0].by_code("control.names-disagree")


SLIDE = """<robot name="o"><link name="a"/><link name="b"/>
<joint name="lift" type="revolute"><parent link="a"/><child link="b"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
<ros2_control name="h" type="system"><joint name="lift"><command_interface name="effort"/>
<state_interface name="position"/><state_interface name="velocity"/></joint></ros2_control>
</robot>"""
SLIDE_YAML = """controller_manager:
  ros__parameters:
    arm: {{type: joint_trajectory_controller/JointTrajectoryController}}
arm:
  ros__parameters:
    joints: [lift]
    command_interfaces: [effort]
    state_interfaces: [position, {state}]
    gains:
      {joint}: {{p: 1.0}}
"""


def _slide(
    tmp_path: Path, state: str = "velocity", joint: str = "lift", **more: str
) -> Diagnostics:
    manifest = "<package format='3'><name>bot</name><export><build_type>ament_cmake</build_type>"
    files = {
        "bot/package.xml": f"{manifest}</export></package>",
        "bot/urdf/bot.urdf": SLIDE,
        "bot/config/c.yaml": SLIDE_YAML.format(state=state, joint=joint),
        **more,
    }
    for name, text in files.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return checked("bot", tmp_path)[0]


def test_controller_whose_names_are_the_robot_s(tmp_path: Path) -> None:
    assert not _slide(tmp_path).by_code("parameters.interface-claim")
    assert not _slide(tmp_path).by_code("parameters.gains-joint")


def test_state_interface_that_no_joint_has(tmp_path: Path) -> None:
    (item,) = _slide(tmp_path, state="veloicty").by_code("parameters.interface-claim")
    assert "needs the state interface 'veloicty' of joint 'lift', which has position, " in (
        item.message
    )
    assert item.fix == "did you mean 'velocity'?"
    assert str(item.span).endswith("c.yaml:8:34")


def test_gains_of_a_joint_that_the_controller_does_not_have(tmp_path: Path) -> None:
    (item,) = _slide(tmp_path, joint="litf").by_code("parameters.gains-joint")
    assert item.message == (
        "controller 'arm' has gains of joint 'litf', which is none of its joints: lift; they have "
        "no effect"
    )
    assert item.fix == "did you mean 'lift'?"


def test_moveit_controller_whose_joints_are_spelt_otherwise(tmp_path: Path) -> None:
    moveit = "moveit_simple_controller_manager:\n  controller_names: [arm]\n  arm:\n"
    moveit += "    type: FollowJointTrajectory\n    joitns: [lift]\n"
    found = _slide(tmp_path, **{"bot/config/moveit_controllers.yaml": moveit})
    (item,) = found.by_code("parameters.moveit-name")
    assert item.message.startswith("MoveIt's controller 'arm' has no 'joints' and has 'joitns'")
    assert item.fix == "did you mean 'joints' for 'joitns'?"
