"""Pain 8: layouts and values of parameter files."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from tests.shared_files import SHARED, shared_cases

from gazelle.diagnostics import Diagnostics, Severity
from gazelle.doctor.parameters import check_package_parameters, check_parameter_file
from gazelle.workspace import Workspace

EXAMPLES = Path(__file__).parents[3] / "examples"

FIXTURES = Path(__file__).parents[1] / "fixtures" / "pain_08_parameters"
Check = Callable[..., Diagnostics]


def package(name: str, root: Path) -> Diagnostics:
    workspace = Workspace.discover(environ={"HOME": str(root)}, cwd=root, extra=[root])
    diagnostics = Diagnostics()
    check_package_parameters(workspace.package(name), workspace=workspace, diagnostics=diagnostics)
    return diagnostics


@pytest.fixture
def check(tmp_path: Path) -> Check:
    """Checks a text as a parameter file."""

    def run(text: str, ros_version: int | None = None, joints: tuple[str, ...] = ()) -> Diagnostics:
        path = tmp_path / "file.yaml"
        path.write_text(text, encoding="utf-8")
        diagnostics = Diagnostics()
        check_parameter_file(path, diagnostics=diagnostics, ros_version=ros_version, joints=joints)
        return diagnostics

    return run


@pytest.mark.parametrize(
    ("code", "line", "words", "fix"),
    [
        (
            "parameters.layout",
            13,
            "'ros_parameters' is no 'ros__parameters'",
            "did you mean 'ros__p",
        ),
        ("parameters.empty", 10, "(No value at line 10)", "ros__parameters: {}"),
        ("control.double-parameter", 16, "key 'arm_controller' is there twice, first in", "remove"),
        ("parameters.word-as-flag", 18, "Value type 'bool' do not belong at line_num 18", "'y'"),
        ("parameters.number-form", 24, "010 of 'p' is read as 8", "write 10"),
        ("parameters.mixed-list", 25, "Value type 'double' do not belong at line_num 25", "1.0"),
        (
            "parameter.unknown",
            21,
            "'state_publish_rat' is not one of",
            "'state_publish_rate'",
        ),
        ("parameters.wrong-type", 22, "is of type {double}, setting it to {integer} is", "20.0"),
        ("parameters.colon-in-description", 3, "<!-- hardware: Gazebo --> has a colon", "':'"),
    ],
)
def test_every_mistake_of_the_ros2_file_has_place_and_fix(
    code: str, line: int, words: str, fix: str
) -> None:
    items = package("ros2_arm", FIXTURES / "broken").by_code(code)
    (item,) = (found for found in items if found.span is not None and found.span.line == line)
    assert words in item.message
    assert fix in item.fix
    assert item.span is not None
    assert item.span.column > 0


def test_node_that_is_named_twice_has_the_parameters_of_both() -> None:
    items = package("ros2_arm", FIXTURES / "broken").by_code("control.double-parameter")
    (item,) = (found for found in items if found.span is not None and found.span.line == 16)
    assert str(item.severity) == "info"
    assert item.message.endswith("rcl adds the two up, programs in Python see the last one only")


def test_ros2_layout_in_a_ros1_package_and_names_as_flags() -> None:
    found = package("ros1_arm", FIXTURES / "broken")
    (layout,) = found.by_code("parameters.ros2-layout")
    assert "/controller/ros__parameters/type. Gazelle looks through it" in layout.message
    (flag,) = found.by_code("parameters.word-as-flag")
    assert flag.message == "roslaunch reads on of 'joint' as true, not as a name"
    assert (flag.fix, flag.span and flag.span.line) == ("write 'on' with quotes", 5)
    (number,) = found.by_code("parameter.number-as-text")
    assert number.fix == "write 0.001"


@pytest.mark.parametrize("name", ["ros2_arm", "ros1_arm"])
def test_clean_twins_have_no_finding(name: str) -> None:
    assert list(package(name, FIXTURES / "clean")) == []


def test_ros1_layout_in_a_ros2_setting(check: Check) -> None:
    text = "arm_controller:\n  type: effort_controllers/JointPositionController\n  joint: a\n"
    (item,) = check(text, 2).by_code("control.no-ros-parameters")
    assert "Cannot have a value before ros__parameters" in item.message
    assert item.fix == "write: arm_controller: / ros__parameters: / …"
    assert not check(text, 1).by_code("control.no-ros-parameters")


def test_value_beside_the_parameters_of_a_node(check: Check) -> None:
    (item,) = check("arm:\n  use_sim_time: true\n  ros__parameters: {a: 1}\n")
    assert item.code == "parameters.layout"
    assert item.message.startswith("'use_sim_time' stands beside 'ros__parameters'")
    assert (item.severity, item.span and item.span.line) == (Severity.ERROR, 2)


def test_tab_and_bad_yaml_say_what_to_do(check: Check) -> None:
    (tab,) = check("a:\n\tb: 1\n")
    assert (tab.code, tab.fix) == ("control.parameter-file", "indent with spaces")
    assert "found character '\\t' that cannot start any token" in tab.message
    (colon,) = check("a: b: c\n")
    assert colon.fix == "put the value in quotes, or correct the indentation"


def test_words_and_numbers_of_each_generation(check: Check) -> None:
    text = "a_controller:\n  type: joint_state_controller/JointStateController\n  {}\n"
    assert not check(text.format("extra_joints: [x, y]"), 1).by_code("parameters.word-as-flag")
    assert check(text.format("extra_joints: [x, off]"), 1).by_code("parameters.word-as-flag")
    assert check(text.format("on: 3"), 1).by_code("parameters.word-as-flag")
    assert check(text.format("at: 12:30:45"), 1).by_code("parameters.number-form")
    assert not check(text.format("flag: yes"), 1).by_code("parameters.word-as-flag")
    assert not check(text.format("id: '010'"), 1).by_code("parameters.number-form")
    node = "n:\n  ros__parameters:\n    {}\n"
    assert not check(node.format("rate: 1e-3"), 2).by_code("parameter.number-as-text")
    assert check(node.format("frame: n"), 2).by_code("parameters.word-as-flag")
    assert not check(node.format("enabled: on"), 2).by_code("parameters.word-as-flag")
    assert check(node.format("axes: on"), 2, ("on",)).by_code("parameters.word-as-flag")
    assert check(node.format("names: [a, 1]"), 2).by_code("parameters.mixed-list")


def test_octal_numbers_that_python_does_not_print_are_no_findings(check: Check) -> None:
    assert [item.code for item in check(f"a: 0{'7' * 6000}\n", 1)] == []


def test_files_of_moveit_and_of_other_programs_are_left_alone(check: Check) -> None:
    for text in (
        "arm:\n  kinematics_solver: kdl/KDL\n  timeout: 1e-3\n",
        "image: left.png\nresolution: [640, 480]\n",
        "- a\n- b\n",
        "a: $(arg x)\n",
        "",
    ):
        assert list(check(text, 2)) == [], text


_MAP = """image: {image}
resolution: 0.05
origin: {origin}
negate: 0
occupied_thresh: 0.65
free_thresh: 0.196
"""


@pytest.mark.parametrize(
    ("image", "origin", "code", "line", "words"),
    [
        ("file.yaml", "[0, 0.0, 0]", "", 0, ""),
        ("file.yaml", "!!python/tuple [0, 0, 0]", "map.no-yaml", 3, "constructor for the tag"),
        ("file.yaml", "[0, 0]", "map.bad-value", 3, "'origin' is [0, 0], not [x, y, yaw]"),
        ("none.pgm", "[0, 0.0, 0]", "map.no-image", 1, "there is no such file"),
    ],
)
def test_a_map_is_read_as_the_map_server_does(
    check: Check, image: str, origin: str, code: str, line: int, words: str
) -> None:
    found = list(check(_MAP.format(image=image, origin=origin)))
    assert [item.code for item in found] == ([code] if code else [])
    for item in found:
        assert words in item.message
        assert item.span is not None
        assert item.span.line == line


def test_launch_files_of_a_package_are_no_parameter_files(tmp_path: Path) -> None:
    folder = tmp_path / "bot"
    (folder / "config").mkdir(parents=True)
    (folder / "package.xml").write_text(
        "<package format='3'><name>bot</name><version>0.1.0</version>"
        "<export><build_type>ament_cmake</build_type></export></package>",
        encoding="utf-8",
    )
    for name in ("bot.launch.yml", "bot_launch.yaml", "config/start.yaml"):
        (folder / name).write_text("launch:\n- arg: x: y\n", encoding="utf-8")
    assert list(package("bot", tmp_path)) == []
    (folder / "config" / "a.yaml").write_text("a: x: y\n", encoding="utf-8")
    (found,) = package("bot", tmp_path)
    assert found.message.startswith("parameter file is not YAML")


def test_aliases_that_never_end_or_stand_for_too_much_are_told(check: Check) -> None:
    (loop,) = check("a: &a\n  b: *a\n")
    assert "an alias stands inside the very list or mapping that it names" in loop.message
    bomb = "a0: &a0 [1, 2, 3, 4, 5, 6, 7, 8, 9]\n"
    for level in range(1, 9):
        bomb += f"a{level}: &a{level} [{', '.join([f'*a{level - 1}'] * 9)}]\n"
    (found,) = check(bomb)
    assert "values, aliases followed are above the limit of" in found.message
    (deep,) = check("[" * 9000)
    assert "nested deeper than 64" in deep.message


@pytest.mark.parametrize(
    ("workspace", "names"),
    [
        (EXAMPLES / "arm_ws", ("heron_bringup", "heron_moveit_config")),
        (EXAMPLES / "four_wheel_ws", ("courier_robot",)),
        (EXAMPLES / "pr2_style_ws", ("tandem_controller",)),
        (EXAMPLES / "scout_ws", ("scout_robot",)),
        *shared_cases(
            (SHARED / "workspaces/catkin_ws", ("urdf_exam", "slam_robot", "urdf_tutorial")),
            (SHARED / "workspaces/ros2_ws", ("luck_gazebo", "luck_robot")),
        ),
    ],
)
def test_parameter_files_that_run_have_no_finding(workspace: Path, names: tuple[str, ...]) -> None:
    for name in names:
        assert list(package(name, workspace / "src")) == []


def test_parameters_in_place_of_ros__parameters_is_told_once(check: Check) -> None:
    text = "n:\n  ros__parameters:\n    a: 1\nm:\n  parameters:\n    b: 1\n    c: 2\n"
    (item,) = check(text, 2).by_code("parameters.layout")
    assert (item.span and item.span.line, item.fix) == (5, "did you mean 'ros__parameters'?")
    assert "'parameters' is taken for the name of a node" in item.message


MANAGER = "controller_manager:\n  ros__parameters:\n    c:\n      {}\n"


@pytest.mark.parametrize(
    ("text", "line", "fix"),
    [
        (
            MANAGER.format("type: joint_state_broadcaster/JointStateBroadcsater"),
            4,
            "did you mean 'joint_state_broadcaster/JointStateBroadcaster'",
        ),
        (
            "c:\n  type: effort_controllers/JointPositionContorller\n  joint: a\n",
            2,
            "did you mean 'effort_controllers/JointPositionController'",
        ),
        (MANAGER.format("tyep: own/Controller"), 4, "did you mean 'type' for 'tyep'?"),
    ],
)
def test_controller_type_that_is_misspelt(check: Check, text: str, line: int, fix: str) -> None:
    (item,) = check(text).by_code("parameters.controller-type")
    assert item.span is not None
    assert item.span.line == line
    assert item.fix.startswith(fix)


def test_controllers_of_a_packages_own_are_nobodys_slip(check: Check) -> None:
    text = MANAGER.format("type: my_controllers/Balance")
    assert check(text).by_code("parameters.controller-type") == ()
