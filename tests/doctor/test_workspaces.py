"""Packages that are known to run, examples and documents: what the doctor says is true."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.doctor.conftest import codes
from tests.shared_files import SHARED, shared_cases

from gazelle.doctor import Options, Report, examine
from gazelle.workspace import Workspace

EXAMPLES = Path(__file__).parents[2] / "examples"
OWN_LAUNCHES: list[tuple[str, str, list[str]]] = [
    ("scout_ws", "scout_robot scout.launch", []),
    ("four_wheel_ws", "courier_robot courier.launch", []),
    ("arm_ws", "heron_bringup heron.launch.py", []),
    # Written for the PR2, whose transmissions had no interface.
    ("pr2_style_ws", "tandem_controller robot.launch", ["control.hardware-interface-missing"] * 2),
    ("own_plugin_ws", "gust_plugins gust.launch", []),
]
# Workspace, words, arguments, environment: exactly these warnings and errors, each of them true.
LAUNCHES: list[tuple[str, str, dict[str, str], dict[str, str], list[str]]] = [
    ("catkin_ws", "urdf_exam mira_spawn.launch", {}, {}, []),
    ("catkin_ws", "urdf_exam mira_spawn_controller.launch", {}, {}, []),
    ("catkin_ws", "urdf_exam mira_spawn_camera.launch", {}, {}, []),
    # A 1:5,311 pair of masses; five keys with a wrong spelling; wheels that are not where the
    # plug-in says; wheel frames of the plug-in beside those of robot_state_publisher.
    ("catkin_ws", "slam_robot slam_robot_gazebo.launch", {},
     {"GAZEBO_MODEL_PATH": "gazebo_models"},
     ["doctor.frame-published-twice", *["inertia.mass-ratio"] * 2,
      *["parameter.unknown"] * 5, "plugin.wheel-geometry"]),
    ("turtlebot3_ws", "turtlebot3_gazebo turtlebot3_world.launch", {},
     {"TURTLEBOT3_MODEL": "waffle"}, []),
    ("turtlebot3_ws", "turtlebot3_gazebo turtlebot3_empty_world.launch", {},
     {"TURTLEBOT3_MODEL": "burger"}, []),
    ("turtlebot3_ws", "turtlebot3_gazebo turtlebot3_gazebo_rviz.launch", {},
     {"TURTLEBOT3_MODEL": "waffle_pi"}, []),
    ("turtlebot3_ws", "turtlebot3_bringup turtlebot3_model.launch", {},
     {"TURTLEBOT3_MODEL": "burger"}, []),
    ("turtlebot3_ws", "turtlebot3_bringup turtlebot3_remote.launch", {},
     {"TURTLEBOT3_MODEL": "burger"}, []),
    # The base has no inertia: right for RViz, and true of Gazebo.
    ("catkin_ws", "urdf_tutorial display.launch",
     {"model": "{urdf_tutorial}/urdf/mobile_robot.urdf"}, {}, []),
]  # fmt: skip


def _examined(
    folder: Path, words: str, arguments: dict[str, str], environ: dict[str, str], home: Path
) -> Report:
    places = {"urdf_tutorial": str(folder / "src" / "urdf_tutorial")}
    chosen = {key: text.format(**places) for key, text in arguments.items()}
    variables = {"HOME": str(home), "PATH": "/usr/bin:/bin", **environ}
    if "GAZEBO_MODEL_PATH" in variables:
        variables["GAZEBO_MODEL_PATH"] = str(folder.parent / variables["GAZEBO_MODEL_PATH"])
    workspace = Workspace.discover(environ=variables, cwd=folder)
    options = Options(arguments=chosen, environ=variables)
    return examine(words.split(), workspace=workspace, options=options, cwd=folder)


@pytest.mark.reference
@pytest.mark.parametrize(
    ("folder", "words", "arguments", "environ", "expected"),
    [
        *((EXAMPLES / name, words, {}, {}, expected) for name, words, expected in OWN_LAUNCHES),
        *shared_cases(*((SHARED / "workspaces" / row[0], *row[1:]) for row in LAUNCHES)),
    ],
    ids=lambda value: value.replace(" ", "-") if isinstance(value, str) else "",
)
def test_launch_that_runs_has_no_false_warning(
    folder: Path,
    words: str,
    arguments: dict[str, str],
    environ: dict[str, str],
    expected: list[str],
    tmp_path: Path,
) -> None:
    report = _examined(folder, words, arguments, environ, tmp_path)
    assert codes(report) == expected, [str(item) for item in report.findings]


@pytest.mark.tutorial
@pytest.mark.parametrize(
    ("folder", "package", "lines"),
    [
        (EXAMPLES / "pr2_style_ws", "tandem_controller", [94]),
        *shared_cases((SHARED / "workspaces/catkin_ws", "tutorial_controller", [127, 134])),
    ],
)
def test_p1_tags_of_2011_get_notices(
    folder: Path, package: str, lines: list[int], tmp_path: Path
) -> None:
    report = _examined(folder, f"{package} robot.launch", {}, {}, tmp_path)
    old = [item for item in report.findings if item.code == "urdf.old-controller"]
    assert [item.span.line for item in old if item.span] == lines
    assert report.exit_code < 2
    (tags,) = [section for section in report.sections if section.name == "tags"]
    assert [row[0] for row in tags.rows if row[2] == "urdf.old-controller"] == [
        f"robot.xml:{line}" for line in lines
    ]


@pytest.mark.reference
@pytest.mark.parametrize(
    ("folder", "words", "sent"),
    [
        (EXAMPLES / "scout_ws", "scout_robot scout.launch", {"odom → base_footprint"}),
        *shared_cases(
            (
                SHARED / "workspaces/catkin_ws",
                "slam_robot slam_robot_gazebo.launch",
                # Recorded from Gazebo 11: odom → base_footprint → both wheels at 100 Hz.
                {
                    "odom → base_footprint",
                    "base_footprint → left_wheel_link",
                    "base_footprint → right_wheel_link",
                },
            )
        ),
    ],
)
def test_first_moments_show_the_transforms_that_real_gazebo_sends(
    folder: Path, words: str, sent: set[str], tmp_path: Path
) -> None:
    report = _examined(folder, words, {}, {}, tmp_path)
    (frames,) = [section for section in report.sections if section.name == "frames"]
    simulated = {row[0].strip() for row in frames.rows if row[2] == "/gazebo"}
    assert simulated == sent
