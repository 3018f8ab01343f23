"""ROS 2 launch files, read without running them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from tests.shared_files import needs_shared

from gazelle.diagnostics import Diagnostics, Severity
from gazelle.doctor.launch_ros2 import LaunchReading, check_launch
from gazelle.workspace import Workspace

FIXTURES = Path(__file__).parents[1] / "fixtures" / "pain_12_launch_ros2"
Checked = tuple[Diagnostics, LaunchReading]
Check = Callable[..., Checked]
PYTHON = """
from launch import LaunchDescription
from launch_ros.actions import Node
def generate_launch_description():
    return LaunchDescription([{}])
"""


def checked(path: Path, root: Path, **arguments: str) -> Checked:
    workspace = Workspace.discover(environ={"HOME": str(root)}, cwd=root, extra=[root])
    found = Diagnostics()
    reading = check_launch(path, workspace=workspace, diagnostics=found, arguments=arguments)
    return found, reading


def fixture(kind: str) -> Checked:
    root = FIXTURES / kind
    return checked(root / "bot_bringup" / "launch" / "bot.launch.py", root)


@pytest.fixture
def check(tmp_path: Path) -> Check:
    """Checks a launch file of a package ``bot`` with these other files."""

    def run(name: str, text: str, files: dict[str, str] | None = None, **arguments: str) -> Checked:
        manifest = "<package format='3'><name>bot</name><version>0.1.0</version>"
        manifest += "<export><build_type>ament_cmake</build_type></export></package>"
        lists = "project(bot)\ninstall(DIRECTORY launch config DESTINATION share/bot)\n"
        lists += "ament_package()\n"
        base = {"package.xml": manifest, "CMakeLists.txt": lists, f"launch/{name}": text}
        for file, content in (base | (files or {})).items():
            path = tmp_path / "bot" / file
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(content, encoding="utf-8")
        return checked(tmp_path / "bot" / "launch" / name, tmp_path, **arguments)

    return run


@pytest.mark.parametrize(
    ("code", "place", "words", "fix"),
    [
        (
            "launch_ros2.package-missing",
            "bot.launch.py:41:27",
            "PackageNotFoundError: \"package 'bot_bringups' not found",
            "did you mean 'bot_bringup'?",
        ),
        (
            "launch_ros2.file-missing",
            "bot.launch.py:24:89",
            "package 'bot_bringup' has no 'rviz/bot.rviz'",
            "correct the path",
        ),
        (
            "launch_ros2.argument-undeclared",
            "bot.launch.py:25:38",
            "launch configuration 'use_sim_tim' does not exist",
            "did you mean 'use_sim_time'?",
        ),
        (
            "launch_ros2.argument-unknown",
            "bot.launch.py:37:13",
            "'guy' is given to robot.launch.py, which has no such argument",
            "did you mean 'gui'?",
        ),
        (
            "launch_ros2.argument-idle",
            "bot.launch.py:46:13",
            "argument 'speed' is declared and nothing reads it",
            "read it with LaunchConfiguration",
        ),
        (
            "launch_ros2.executable-missing",
            "robot.launch.py:11:52",
            "executable 'drive' not found on the libexec directory '…/lib/bot_bringup'",
            "did you mean 'drive.py'?",
        ),
        (
            "launch_ros2.controller-missing",
            "bot.launch.py:30:20",
            "The 'type' param was not defined for 'arm_controler'",
            "did you mean 'arm_controller'?",
        ),
        (
            "launch_ros2.clocks",
            "bot.launch.py:16:23",
            "robot_state_publisher has no use_sim_time that is true: it runs on the wall clock",
            "{'use_sim_time': True}",
        ),
        (
            "launch_ros2.unwrapped-command",
            "bot.launch.py:15:41",
            "Unable to parse the value of parameter robot_description as yaml",
            "ParameterValue(Command(…), value_type=str)",
        ),
        (
            "launch_ros2.command-words",
            "bot.launch.py:42:13",
            "Command joins its parts without blanks: 'xacro/",
            "write 'xacro ' with a blank at its end",
        ),
    ],
)
def test_every_mistake_has_place_and_fix(code: str, place: str, words: str, fix: str) -> None:
    found, _ = fixture("broken")
    (item,) = found.by_code(code)
    assert str(item.span).endswith(place)
    assert words in item.message
    assert fix in item.fix


def test_arguments_of_gazelles_own_launch_files_are_not_told_as_idle(check: Check) -> None:
    text = '<launch><include file="$(find-pkg-share gazebo_ros)/launch/gazebo.launch.py"/></launch>'
    found, reading = check("go.launch.xml", text)
    assert len(reading.launch_files) > 1
    assert found.by_code("launch_ros2.argument-idle") == ()


def test_clean_twin_says_only_that_it_was_read() -> None:
    found, reading = fixture("clean")
    (item,) = found
    assert (item.code, item.severity) == ("launch_ros2.static", Severity.INFO)
    assert item.message.startswith("the launch file was read, not run")
    (robot,) = reading.robots
    assert (robot.path.name, robot.mappings) == ("bot.urdf.xacro", {"sim": "true"})
    assert [path.name for path in reading.parameter_files] == ["controllers.yaml"]
    assert [path.name for path in reading.launch_files] == ["bot.launch.py", "robot.launch.py"]
    (section,) = reading.sections
    names = [row[0] for row in section.rows]
    assert names == ["robot_state_publisher", "rviz2", "ros2_control_node", "spawner", "drive.py"]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("def generate_launch_description(:\n", "not Python 3: invalid syntax"),
        ("print 'a'\n", "not Python 3"),
        ("x = 1\n", "has no generate_launch_description()"),
    ],
)
def test_files_that_cannot_be_read(check: Check, text: str, words: str) -> None:
    (item,) = check("a.launch.py", text)[0]
    assert (item.code, item.severity) == ("launch_ros2.unreadable", Severity.ERROR)
    assert words in item.message


def test_nothing_of_the_file_is_executed(check: Check, tmp_path: Path) -> None:
    mark = tmp_path / "mark"
    text = f"open({str(mark)!r}, 'w').write('x')\nimport os\nos.system('touch {mark}')\n"
    check("a.launch.py", text + PYTHON.format(""))
    assert not mark.exists()


def test_packages_of_another_place_are_one_notice(check: Check) -> None:
    nodes = "Node(package='nav2_route', executable='amcl'), Node(package='my_own', executable='x')"
    found, _ = check("a.launch.py", PYTHON.format(nodes))
    (item,) = found.by_code("launch_ros2.packages-elsewhere")
    assert item.severity is Severity.INFO
    assert "not in this workspace: my_own, nav2_route;" in item.message


def test_misspelt_executable_of_a_package_of_ros(check: Check) -> None:
    nodes = "Node(package='robot_state_publisher', executable='robot_state_publiser')"
    (item,) = check("a.launch.py", PYTHON.format(nodes))[0].by_code(
        "launch_ros2.executable-missing"
    )
    assert item.fix.startswith("did you mean 'robot_state_publisher'")


def test_compiled_executables_and_those_of_loops_are_known(check: Check) -> None:
    lists = "project(bot)\nforeach(n talker listener)\nadd_executable(${n} src/${n}.cpp)\n"
    lists += "endforeach()\ninstall(TARGETS talker listener DESTINATION lib/bot)\nament_package()\n"
    nodes = "Node(package='bot', executable='talker'), Node(package='bot', executable='camera')"
    found, _ = check("a.launch.py", PYTHON.format(nodes), {"CMakeLists.txt": lists})
    (item,) = found.by_code("launch_ros2.executable-missing")
    assert "has no executable 'camera'" in item.message
    assert item.fix == "it has listener, talker"


def test_parameter_file_that_is_not_installed(check: Check) -> None:
    text = (
        "import os\nfrom ament_index_python.packages import get_package_share_directory as share\n"
    )
    node = "Node(package='rviz2', executable='rviz2', parameters=[os.path.join(share('bot'), "
    node += "'params', 'a.yaml')])"
    files = {"params/a.yaml": "rviz2:\n  ros__parameters: {}\n"}
    found, reading = check("a.launch.py", text + PYTHON.format(node), files)
    (item,) = found.by_code("launch_ros2.not-installed")
    assert (
        "'params/a.yaml' of package 'bot' found in its source folder, not installed" in item.message
    )
    assert [path.name for path in reading.parameter_files] == ["a.yaml"]


def test_misspelt_argument_of_the_command_line(check: Check) -> None:
    text = "from launch.actions import DeclareLaunchArgument\n"
    text += "from launch.substitutions import LaunchConfiguration\n"
    nodes = "DeclareLaunchArgument('world', default_value='a'), "
    nodes += "Node(package='rviz2', executable='rviz2', name=LaunchConfiguration('world'))"
    found, _ = check("a.launch.py", text + PYTHON.format(nodes), wrld="b")
    (item,) = found.by_code("launch_ros2.argument-unknown")
    assert item.fix == "did you mean 'world'?"
    found, reading = check("a.launch.py", text + PYTHON.format(nodes), world="b")
    assert not found.by_code("launch_ros2.argument-unknown")
    assert reading.sections[0].rows[0][0] == "b"


@pytest.mark.parametrize(
    "read",
    [
        "[LaunchConfiguration(x).perform(c) for x in NAMES]",
        "c.launch_configurations",
        "LaunchConfiguration(variable_name=given())",
    ],
)
def test_arguments_whose_names_are_computed_may_be_read(check: Check, read: str) -> None:
    text = "from launch.actions import DeclareLaunchArgument, OpaqueFunction\n"
    text += "from launch.substitutions import LaunchConfiguration\n"
    text += f"def later(c, *rest):\n    return {read}\n"
    declared = "DeclareLaunchArgument('wor' + 'ld', default_value='a')"
    body = PYTHON.format(f"{declared}, OpaqueFunction(function=later)")
    found, _ = check("a.launch.py", text + body)
    assert not found.by_code("launch_ros2.argument-idle")
    found, _ = check("a.launch.py", text.replace(read, "c") + body)
    assert found.by_code("launch_ros2.argument-idle")


def test_launch_file_in_xml(check: Check) -> None:
    text = """<launch>
  <arg name="rate" default="10"/>
  <include file="$(find-pkg-share bot)/launch/b.launch.xml"/>
  <group><node pkg="bot" exec="talker" name="t">
    <param name="rate" value="$(var rate)"/>
    <param from="$(find-pkg-share bot)/config/a.yaml"/>
  </node></group>
  <node pkg="rviz2" exec="rviz2" args="$(var view)"/>
</launch>"""
    found, reading = check(
        "a.launch.xml", text, {"config/a.yaml": "t:\n  ros__parameters: {a: 1}\n"}
    )
    (include,) = found.by_code("launch_ros2.file-missing")
    assert include.span is not None
    assert (include.span.line, include.fix) == (3, "did you mean 'a.launch.xml'?")
    (executable,) = found.by_code("launch_ros2.executable-missing")
    assert "'talker'" in executable.message
    (argument,) = found.by_code("launch_ros2.argument-undeclared")
    assert argument.message.startswith("launch configuration 'view' does not exist")
    assert [path.name for path in reading.parameter_files] == ["a.yaml"]
    assert reading.sections[0].rows[0] == ("t", "bot", "talker", "rate, a.yaml", "a.launch.xml:4")


def test_launch_file_in_yaml(check: Check) -> None:
    text = """launch:
- arg:
    name: rate
    default: "10"
- node:
    pkg: bot
    exec: talker
    name: t
    param:
    - name: rate
      value: $(var rat)
- include:
    file: $(find-pkg-share bot)/launch/none.launch.yaml
    arg:
    - name: a
      value: b
"""
    found, reading = check("a.launch.yaml", text)
    (argument,) = found.by_code("launch_ros2.argument-undeclared")
    assert argument.span is not None
    assert (argument.span.line, argument.fix) == (10, "did you mean 'rate'?")
    assert found.by_code("launch_ros2.file-missing")
    assert reading.sections[0].rows[0][:3] == ("t", "bot", "talker")


@pytest.mark.parametrize(
    ("text", "line", "words", "fix"),
    [
        (
            "launch:\n- arg: name: x\n",
            2,
            "not YAML: mapping values are not allowed here",
            "put the value into quotes: it holds ': '",
        ),
        (
            "launch:\n- node:\n    pkg: bot\n    exec: !!python/name:os.system\n",
            4,
            "not YAML: could not determine a constructor for the tag",
            "mend it at the place shown",
        ),
    ],
)
def test_a_broken_launch_file_in_yaml_is_told_as_the_launch_tells_it(
    check: Check, text: str, line: int, words: str, fix: str
) -> None:
    found, _ = check("a.launch.yaml", text)
    (item,) = found.errors
    assert (item.code, item.fix) == ("ros2_launch.bad-file", fix)
    assert item.message.startswith(words)
    assert item.span is not None
    assert item.span.line == line


def test_files_that_include_each_other_come_to_an_end(check: Check) -> None:
    text = '<launch><include file="$(dirname)/a.launch.xml"/></launch>'
    found, reading = check("a.launch.xml", text)
    assert not found.errors
    assert [path.name for path in reading.launch_files] == ["a.launch.xml"]


def test_launch_file_of_an_example(examples_dir: Path) -> None:
    root = examples_dir / "arm_ws" / "src"
    found, reading = checked(root / "heron_bringup" / "launch" / "heron.launch.py", root)
    assert {item.severity for item in found} == {Severity.INFO}
    assert [row[2] for row in reading.sections[0].rows][:4] == [
        "robot_state_publisher",
        "spawn_entity.py",
        "spawner",
        "move_group",
    ]


@needs_shared
def test_documents_launch_file(workspaces_dir: Path) -> None:
    root = workspaces_dir / "ros2_ws" / "src"
    found, reading = checked(root / "luck_gazebo" / "launch" / "gazebo_moveit.launch.py", root)
    assert {item.code for item in found} == {"launch_ros2.static"}
    (robot,) = reading.robots
    assert robot.path == root / "luck_robot" / "config" / "luck_description.urdf.xacro"
    assert robot.mappings["use_sim"] == "true"
    assert [row[2] for row in reading.sections[0].rows] == [
        "robot_state_publisher",
        "spawn_entity.py",
        "spawner",
        "spawner",
        "move_group",
        "rviz2",
    ]


def test_path_that_is_only_kept_or_asked_about_may_be_missing(check: Check) -> None:
    text = (
        "import os\nfrom ament_index_python.packages import get_package_share_directory as share\n"
    )
    text += "kept = os.path.join(share('bot'), 'config', 'user.yaml')\n"
    text += "asked = os.path.join(share('bot'), 'config', 'more.yaml')\n"
    text += "extra = [asked] if os.path.exists(asked) else []\n"
    text += "opened = open(os.path.join(share('bot'), 'urdf', 'bot.urdf')).read()\n"
    found, _ = check("a.launch.py", text + PYTHON.format(""))
    (item,) = found.by_code("launch_ros2.file-missing")
    assert "has no 'urdf/bot.urdf'" in item.message


def test_argument_that_has_to_be_given_is_a_warning(check: Check) -> None:
    text = "from launch.substitutions import LaunchConfiguration\n"
    node = "Node(package='rviz2', executable='rviz2', name=LaunchConfiguration('robot_ip'))"
    (item,) = check("a.launch.py", text + PYTHON.format(node))[0].by_code(
        "launch_ros2.argument-undeclared"
    )
    assert item.severity is Severity.WARNING
    assert item.message.endswith("the launch stops there, unless robot_ip:=… is given")
    found, _ = check("a.launch.py", text + PYTHON.format(node), robot_ip="127.0.0.1")
    assert not found.by_code("launch_ros2.argument-undeclared")


def test_spawned_controllers_of_generated_parameters_are_not_judged(check: Check) -> None:
    text = "from ament_index_python.packages import get_package_share_directory as share\n"
    text += "made = generate(share('bot') + '/config/c.yaml')\n"
    nodes = "Node(package='controller_manager', executable='ros2_control_node', parameters=[made]),"
    nodes += "Node(package='controller_manager', executable='spawner', arguments=['left_arm'])"
    found, _ = check("a.launch.py", text + PYTHON.format(nodes))
    assert not found.by_code("launch_ros2.controller-missing")


@pytest.mark.parametrize(("made", "codes"), [({}, ["launch_ros2.file-missing"]), (
    {"launch/sim.launch.py.in": "# @VERSION@"}, [],
)])  # fmt: skip
def test_file_that_cmake_configures_is_there(
    check: Check, made: dict[str, str], codes: list[str]
) -> None:
    """ros_gz_sim makes its gz_sim.launch.py so."""
    text = PYTHON.format(
        "IncludeLaunchDescription(get_package_share_directory('bot') + '/launch/sim.launch.py')"
    ).replace(
        "from launch import LaunchDescription",
        "from launch import LaunchDescription\n"
        "from launch.actions import IncludeLaunchDescription\n"
        "from ament_index_python.packages import get_package_share_directory",
    )
    found, _ = check("one.launch.py", text, made)
    assert [item.code for item in found if item.severity is Severity.ERROR] == codes


def test_argument_that_a_node_does_not_take(check: Check) -> None:
    node = "Node(\n    package='bot',\n    execuatble='go',\n)"
    found, _ = check("bot.launch.py", PYTHON.format(node))
    (item,) = found.by_code("launch_ros2.keyword")
    assert item.message == "Node() got an unexpected keyword argument 'execuatble'"
    assert item.fix.startswith("did you mean 'executable'")
    assert str(item.span).endswith("bot.launch.py:7:5")


def test_a_name_of_a_node_is_told_at_its_own_line(check: Check) -> None:
    node = "Node(\n    package='gazbeo_ros',\n    executable='spawn_entity.py',\n)"
    found, _ = check("bot.launch.py", PYTHON.format(node))
    (item,) = found.by_code("launch_ros2.package-missing")
    assert str(item.span).endswith("bot.launch.py:6:13")


def test_comma_that_was_forgotten_in_a_launch_file(check: Check) -> None:
    nodes = "\n  Node(package='a', executable='b')\n  Node(package='c', executable='d'),\n"
    found, _ = check("bot.launch.py", PYTHON.format(nodes))
    (item,) = found.by_code("launch_ros2.unreadable")
    assert str(item.span).endswith("bot.launch.py:6:35")
    assert item.fix == "write a comma at the end of line 6"


def test_words_of_roslaunch_are_no_arguments_of_a_node(check: Check) -> None:
    node = "Node(package='bot', executable='go', args=['a'], parms=[{}])"
    found, _ = check("bot.launch.py", PYTHON.format(node))
    fixes = [item.fix for item in found.by_code("launch_ros2.keyword")]
    assert fixes == ["did you mean 'arguments'?", "did you mean 'parameters'?"]


def test_quotes_in_a_command_are_the_shells(check: Check) -> None:
    robot = "<robot name='r' xmlns:xacro='http://ros.org/wiki/xacro'>"
    robot += "<xacro:arg name='prefix' default=''/><link name='$(arg prefix)a'/></robot>"
    command = "Node(package='p', executable='e', parameters=[{'robot_description': "
    command += "Command(['xacro ', get_package_share_directory('bot') + '/config/r.xacro', "
    command += "' prefix:=', LaunchConfiguration('prefix')])}])"
    text = "from ament_index_python.packages import get_package_share_directory\n"
    text += "from launch.actions import DeclareLaunchArgument\n"
    text += "from launch.substitutions import Command, LaunchConfiguration\n"
    argument = "DeclareLaunchArgument('prefix', default_value='\"\"'), "
    _, reading = check("r.launch.py", text + PYTHON.format(argument + command),
                       {"config/r.xacro": robot})  # fmt: skip
    (source,) = reading.robots
    assert source.mappings.get("prefix", "") == ""


def test_words_in_quotes_are_one_argument_of_a_spawner(check: Check) -> None:
    launch = "<launch><node pkg='controller_manager' exec='ros2_control_node'>"
    launch += "<param from='$(find-pkg-share bot)/config/c.yaml'/></node>"
    launch += "<node pkg='controller_manager' exec='spawner' "
    launch += "args=\"arm --controller-ros-args '-r ~/a:=/b'\"/></launch>"
    kind = "joint_trajectory_controller/JointTrajectoryController"
    lines = f"controller_manager:\n  ros__parameters:\n    arm:\n      type: {kind}\n"
    found, _ = check("c.launch.xml", launch, {"config/c.yaml": lines})
    assert not found.by_code("launch_ros2.controller-missing")


def test_names_that_a_launch_file_does_not_define(check: Check) -> None:
    node = "Node(package='rviz2', executable='rviz2', parameters=[{'use_sim_time': true}])"
    found, _ = check("a.launch.py", PYTHON.format(node))
    (item,) = found.by_code("launch_ros2.name")
    assert item.message == "name 'true' is not defined (NameError)"
    assert item.fix == "did you mean 'True'?"


def test_description_that_is_not_returned(check: Check) -> None:
    text = PYTHON.format("").replace("return LaunchDescription", "LaunchDescription")
    found, _ = check("a.launch.py", text)
    (item,) = found.by_code("launch_ros2.returns-nothing")
    assert item.message == "generate_launch_description() returns nothing: nothing is launched"
    assert item.fix == "write return before it"
    assert item.span is not None
    assert (item.span.line, item.span.column) == (5, 5)
