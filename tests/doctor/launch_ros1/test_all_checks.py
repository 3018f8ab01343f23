"""Launches made wrong in one way, in text."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from xml.sax.saxutils import escape

import pytest
from tests.doctor.conftest import Examine, Write, codes

from gazelle.doctor import Report
from gazelle.doctor.dry_start import bringup as start_module
from gazelle.errors import EngineError

Launch = Callable[..., Report]

WORLD = '<include file="$(find gazebo_ros)/launch/empty_world.launch">{}</include>'
QUIET = WORLD.format('<arg name="gui" value="false"/>')
_LINK = (
    '<link name="{}"><inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" '
    'iyz="0" izz="0.01"/></inertial></link>'
)


def _description(*parts: str) -> str:
    text = escape(f"<robot name='r'>{''.join(parts)}</robot>", {'"': "&quot;"})
    return f'<param name="robot_description" value="{text}"/>'


ROBOT = _description(_LINK.format("a"))
ROLLING = _description(
    _LINK.format("a"),
    _LINK.format("b"),
    '<joint name="j" type="continuous"><parent link="a"/><child link="b"/></joint>',
)
SPAWN = '<node name="spawn" pkg="gazebo_ros" type="spawn_model" args="{}"{}/>'
ARGS = "-urdf -model r -param robot_description"
STATES = '<node name="rsp" pkg="robot_state_publisher" type="robot_state_publisher"/>'


@pytest.fixture
def launched(written: Write, examined: Examine) -> Launch:
    """Examines the text of a launch file."""

    def run(*elements: str, **files: str) -> Report:
        folder = written(**{"one.launch": f"<launch>{''.join(elements)}</launch>"}, **files)
        return examined(folder, "bot", "one.launch")

    return run


def test_robot_in_an_empty_world_is_clean(launched: Launch) -> None:
    assert codes(launched(QUIET, ROBOT, SPAWN.format(ARGS, ""))) == []


@pytest.mark.parametrize(
    ("word", "code"), [("required", "doctor.required-ends"), ("respawn", "doctor.respawn-ends")]
)
def test_spawner_that_ends_is_neither_required_nor_respawned(
    launched: Launch, word: str, code: str
) -> None:
    assert codes(launched(QUIET, ROBOT, SPAWN.format(ARGS, f' {word}="true"'))) == [code]
    # With -b it stays and takes its model away in the end.
    assert codes(launched(QUIET, ROBOT, SPAWN.format(f"{ARGS} -b", f' {word}="true"'))) == []


def test_parameters_of_nodes_that_change_nothing_are_told_where_they_stand(
    launched: Launch,
) -> None:
    node = (
        '<node name="m" pkg="gmapping" type="slam_gmapping">\n<param name="particles" value="30"/>'
    )
    report = launched(f'{node}<param name="delta" value="0.1"/></node>')
    (found,) = [item for item in report.findings if item.code == "parameter.idle"]
    assert found.message.startswith("'/m': parameter 'particles' has no effect here: the map is")
    assert found.span is not None and found.span.line == 2


def test_paused_world_is_a_notice_unless_a_spawner_unpauses(launched: Launch) -> None:
    paused = WORLD.format('<arg name="paused" value="true"/>')
    assert "doctor.paused" in codes(launched(paused, ROBOT, SPAWN.format(ARGS, "")), "info")
    spawn = SPAWN.format(f"{ARGS} -unpause", "")
    assert "doctor.paused" not in codes(launched(paused, ROBOT, spawn), "info")


@pytest.mark.parametrize(
    ("args", "reason"),
    [
        ("-urdf -model r -topic description", "a description on topic /description"),
        (f"{ARGS} -wait table", "model 'table', which no spawner before it brings"),
        (f"{ARGS} -gazebo_namespace /gazbo", "service /gazbo/spawn_urdf_model"),
    ],
)
def test_spawner_that_waits_for_ever_is_told(launched: Launch, args: str, reason: str) -> None:
    report = launched(QUIET, ROBOT, SPAWN.format(args, ""))
    (found,) = [item for item in report.findings if item.code == "doctor.spawn-waits"]
    assert reason in found.message


@pytest.mark.parametrize(
    ("args", "reason"),
    [
        ("-urdf -model r -param description", "the parameter is '/description'"),
        ("-urdf -param robot_description", "the following arguments are required: -model"),
        ("-sdf -model r -file /nowhere.sdf", "specified file /nowhere.sdf does not exist"),
        ("-sdf -model r -database no_such_model", "Failure"),
    ],
)
def test_spawner_that_fails_says_why(launched: Launch, args: str, reason: str) -> None:
    report = launched(QUIET, ROBOT, SPAWN.format(args, ""))
    told = (*report.findings, *report.consequences)
    (found,) = [item for item in told if item.code == "doctor.spawn-fails"]
    assert reason in found.message
    assert found.span is not None


def test_second_model_of_a_name_fails(launched: Launch) -> None:
    twice = SPAWN.format(ARGS, "") + SPAWN.format(ARGS, "").replace('"spawn"', '"again"')
    report = launched(QUIET, ROBOT, twice)
    (found,) = [item for item in report.findings if item.code == "doctor.spawn-fails"]
    assert "'/again' cannot bring its model into the world" in found.message
    assert "entity already exists" in found.message


def test_simulator_that_cannot_start_is_told(
    launched: Launch, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_args: object, **_keys: object) -> None:
        raise EngineError("too many bodies")

    monkeypatch.setattr(start_module, "WorldServer", refuse)
    report = launched(QUIET)
    (found,) = [item for item in report.findings if item.code == "doctor.start-fails"]
    assert found.message == "the simulator '/gazebo' cannot start: too many bodies"


def test_nothing_follows_from_a_parameter_that_could_not_be_made(launched: Launch) -> None:
    command = '<param name="robot_description" command="false"/>'
    assert codes(launched(command, STATES)) == ["launch.param-command-failed"]


def test_node_nobody_knows_makes_missing_joint_states_uncertain(launched: Launch) -> None:
    wheel = "doctor.joint-without-state"
    spawn = SPAWN.format(ARGS, "")
    assert wheel in codes(launched(QUIET, ROLLING, spawn, STATES))
    driver = '<node name="driver" pkg="bot" type="driver"/>'
    assert wheel not in codes(launched(QUIET, ROLLING, spawn, STATES, driver), "info")


@pytest.mark.parametrize("package", ["amcl", "joy", "move_base", "rqt_graph"])
def test_nodes_of_navigation_send_no_joint_states(launched: Launch, package: str) -> None:
    node = f'<node name="n" pkg="{package}" type="{package}"/>'
    report = launched(QUIET, ROLLING, SPAWN.format(ARGS, ""), STATES, node)
    assert "doctor.joint-without-state" in codes(report)


def test_amcl_connects_the_map_with_the_odometry(launched: Launch) -> None:
    rename = '<param name="odom_frame_id" value="wheels"/>'
    node = f'<node name="n" pkg="amcl" type="amcl">{rename}</node>'
    report = launched(QUIET, ROBOT, SPAWN.format(ARGS, ""), STATES, node)
    (table,) = (section for section in report.sections if section.name == "frames")
    assert ("map → wheels", "moving", "/n") in table.rows


@pytest.mark.parametrize(
    ("package", "kind", "row"),
    [
        ("amcl", "amcl", None),
        ("robot_pose_ekf", "robot_pose_ekf", ("odom_combined → base_footprint", "moving", "/n")),
        ("topic_tools", "mux", None),
    ],
)
def test_frames_of_a_built_in_node_are_those_of_its_row(
    launched: Launch, package: str, kind: str, row: tuple[str, str, str] | None
) -> None:
    silent = '<param name="tf_broadcast" value="false"/>'
    node = f'<node name="n" pkg="{package}" type="{kind}" args="a b">{silent}</node>'
    report = launched(QUIET, ROBOT, SPAWN.format(ARGS, ""), STATES, node)
    rows = [row for section in report.sections if section.name == "frames" for row in section.rows]
    assert rows == ([row] if row else [])


@pytest.mark.parametrize(
    ("parameters", "row"),
    [
        ("", ("odom → base_link", "moving", "/n")),
        ('<param name="world_frame" value="map"/>', ("map → odom", "moving", "/n")),
        ('<param name="publish_tf" value="false"/>', None),
    ],
)
def test_filter_of_robot_localization_sends_what_its_world_frame_asks_for(
    launched: Launch, parameters: str, row: tuple[str, str, str] | None
) -> None:
    node = '<node name="n" pkg="robot_localization" type="ekf_localization_node">{}</node>'
    report = launched(QUIET, ROBOT, SPAWN.format(ARGS, ""), STATES, node.format(parameters))
    rows = [row for section in report.sections if section.name == "frames" for row in section.rows]
    assert rows == ([row] if row else [])


def test_cartographer_leaves_the_frames_open_and_the_joints_not(launched: Launch) -> None:
    node = '<node name="n" pkg="cartographer_ros" type="cartographer_node"/>'
    found = codes(launched(QUIET, ROLLING, SPAWN.format(ARGS, ""), STATES, node))
    assert "doctor.joint-without-state" in found
    assert "doctor.frames-apart" not in found


def test_xacro_in_a_comment_is_expanded_enough(launched: Launch) -> None:
    robot = _description(_LINK.format("a"), "<!-- <xacro:arm parent='a'/> -->")
    assert "doctor.description-not-expanded" not in codes(launched(QUIET, robot))
    open_ = _description(_LINK.format("a"), "<xacro:arm parent='a'/>")
    assert "doctor.description-not-expanded" in codes(launched(QUIET, open_))


@pytest.mark.parametrize(
    ("name", "is_slip"),
    [("amcl/use_map_topic", False), ("use_simtime", True), ("use_simulated_time", True)],
)
def test_only_a_slip_for_the_clock_is_one(launched: Launch, name: str, is_slip: bool) -> None:
    report = launched(f'<param name="{name}" value="true"/>')
    assert ("doctor.sim-time-name" in codes(report)) is is_slip


def test_finding_about_a_value_stands_in_the_yaml_file(written: Write, examined: Examine) -> None:
    text = "use_sim_time: true\nbot:\n  use_sim_time: true\n"
    load = '<launch><rosparam file="$(find bot)/c.yaml" ns="a"/></launch>'
    folder = written(**{"one.launch": load, "c.yaml": text})
    found = [
        item
        for item in examined(folder, "bot", "one.launch").findings
        if item.code == "doctor.sim-time-name"
    ]
    spans = [(Path(item.span.file).name, item.span.line) for item in found if item.span]
    assert spans == [("c.yaml", 1), ("c.yaml", 3)]
    assert all(item.span and item.span.via[0].file.endswith("one.launch") for item in found)


def test_part_of_a_launch_lacks_its_robot_by_right(written: Write, examined: Examine) -> None:
    part = f"<launch>{QUIET}{SPAWN.format(ARGS, '')}{STATES}</launch>"
    folder = written(**{"part.launch": part})
    lacks = {"doctor.no-description", "doctor.spawn-fails"}
    alone = examined(folder, "bot", "part.launch").findings
    assert {str(item.severity) for item in alone if item.code in lacks} == {"error"}
    wide = [item for item in examined(folder, "bot").findings if item.code in lacks]
    assert {str(item.severity) for item in wide} == {"info"}
    assert all("right where the launch that includes this one" in item.message for item in wide)


def test_launch_that_needs_the_environment_is_a_notice_in_a_package(
    written: Write, examined: Examine
) -> None:
    folder = written(**{"one.launch": '<launch><arg name="a" value="$(env LIDAR_HOST)"/></launch>'})
    (found,) = (item for item in examined(folder, "bot").findings if "LIDAR_HOST" in item.message)
    assert (found.code, str(found.severity)) == ("doctor.needs-arguments", "info")
    assert "launch.env-missing" in codes(examined(folder, "bot", "one.launch"))


def test_missing_joint_states_are_a_notice_where_no_robot_is(launched: Launch) -> None:
    report = launched(ROLLING, STATES)
    (found,) = [item for item in report.findings if item.code == "doctor.joint-without-state"]
    assert str(found.severity) == "info"
    assert "right where another launch brings the robot to life" in found.message


def test_remap_for_everyone_is_used_by_one(launched: Launch) -> None:
    remap = '<remap from="joint_states" to="states"/>'
    assert "doctor.remap-unused" not in codes(launched(remap, QUIET, ROBOT, STATES))
    wrong = '<remap from="joint_state" to="states"/>'
    assert "doctor.remap-unused" in codes(launched(wrong, QUIET, ROBOT, STATES))


def test_remap_of_a_service_in_a_script_is_used(launched: Launch) -> None:
    script = "import rospy\nrospy.Service('reset', None, None)\n"
    node = '<node name="n" pkg="bot" type="n.py"><remap from="{}" to="a"/></node>'
    assert codes(launched(node.format("reset"), **{"scripts__n.py": script})) == [
        "launch.not-executable"
    ]
    assert "doctor.remap-unused" in codes(
        launched(node.format("clear"), **{"scripts__n.py": script})
    )


def test_parameter_of_a_navigation_planner_is_no_misspelled_clock(launched: Launch) -> None:
    assert codes(launched('<param name="planner/sim_time" value="1.5"/>')) == []


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ("", "parameter '/robot_description' is empty"),
        ("3", "'/rsp' ends at once: robot_description is no robot"),
    ],
)
def test_description_that_is_no_robot_is_told(launched: Launch, value: str, message: str) -> None:
    report = launched(f'<param name="robot_description" value="{value}"/>', STATES)
    (found,) = report.findings
    assert found.code == "doctor.no-description"
    assert message in found.message


def test_arguments_with_an_open_quote_are_told(launched: Launch) -> None:
    report = launched(QUIET, ROBOT, SPAWN.format("-urdf -model 'r -param robot_description", ""))
    assert "doctor.bad-arguments" in codes(report)
    assert any("No closing quotation" in item.message for item in report.findings)


def test_source_list_that_holds_numbers_does_no_harm(launched: Launch) -> None:
    names = '<rosparam param="source_list">[a, 3]</rosparam>'
    node = '<node name="jsp" pkg="joint_state_publisher" type="joint_state_publisher">{}</node>'
    assert codes(launched(ROBOT, node.format(names))) == []
