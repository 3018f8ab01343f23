"""Damaged files end in diagnostics, never in a crash: 3,000 of them, the same ones every time."""

from __future__ import annotations

import random
import re
from collections.abc import Callable
from pathlib import Path

import pytest
from tests.control.plant import PlantJoint, make_robot
from tests.control.recording_ports import RecordingPorts

from gazelle.control.controller_manager import ControllerManager
from gazelle.control.sources.files import FileSource
from gazelle.control.sources.yaml_file import read_parameter_text
from gazelle.description.context import ReadContext
from gazelle.description.sdf import read_sdf
from gazelle.description.urdf import read_urdf
from gazelle.diagnostics import Diagnostics
from gazelle.errors import GazelleError, UserFileError
from gazelle.interfaces.definition import Generation
from gazelle.interfaces.parser import parse_message
from gazelle.launch.xml1.loader import load_launch_text
from gazelle.workspace import Workspace

SCOUT = Path(__file__).parents[1] / "examples" / "scout_ws" / "src" / "scout_robot"
COUNT = 600
WORDS = ("", "nan", "1e999", "-1", "1,5", "../..", "$(find x)", "<", "&amp;", "é", "0 0 0", "true")
DEFINITION = """# a message
std_msgs/Header header
uint8 MODE_A=1
string<=10 NAME="x"
float64[] values
geometry_msgs/Point[3] corners
int32 count 5
"""


CONTROLLERS = """\
controller_manager:
  ros__parameters:
    update_rate: 100
    states: {type: joint_state_broadcaster/JointStateBroadcaster}
    arm: {type: joint_trajectory_controller/JointTrajectoryController}
    base: {type: diff_drive_controller/DiffDriveController}
    lift: {type: effort_controllers/JointPositionController}
arm:
  ros__parameters:
    joints: [a, b]
    command_interfaces: [effort]
    state_interfaces: [position, velocity]
    constraints: {goal_time: 0.5, a: {trajectory: 0.1, goal: 0.01}}
    gains: {a: {p: 10.0, i: 0.1, d: 1e-1, i_clamp: 1.0}, b: {p: 5.0}}
"base":
  ros__parameters:
    left_wheel_names: ["a"]
    right_wheel_names: ["b"]
    wheel_separation: 0.4
    wheel_radius: .1
    pose_covariance_diagonal: [0.001, 0.001, 0.001, 0.001, 0.001, 0.03]
    linear.x.max_velocity: 1.0
lift:
  ros__parameters: {joint: a, pid: {p: 1.0, i: 0.0, d: 0.0}}
"""


def _damaged(text: str, seed: int) -> str:
    """Return the text with one to four of its parts cut, doubled, swapped or replaced."""
    chance = random.Random(seed)
    for _ in range(chance.randint(1, 4)):
        start = chance.randrange(len(text))
        end = min(len(text), start + chance.choice((1, 3, 10, 60, 300)))
        piece = text[start:end]
        other = chance.randrange(len(text))
        new = chance.choice(
            (
                "",
                piece * 2,
                text[other : other + len(piece)],
                chance.choice(WORDS),
                piece.swapcase(),
            )
        )
        text = text[:start] + new + text[end:]
        if not text:
            return "<"
    return text


def _read_urdf(text: str, diagnostics: Diagnostics, workspace: Workspace) -> None:
    read_urdf(text, context=ReadContext(workspace, diagnostics, "<fuzz>", None))


def _read_sdf(text: str, diagnostics: Diagnostics, workspace: Workspace) -> None:
    read_sdf(text, context=ReadContext(workspace, diagnostics, "<fuzz>", None))


def _read_launch(text: str, diagnostics: Diagnostics, workspace: Workspace) -> None:
    load_launch_text(text, {}, workspace=workspace, diagnostics=diagnostics)


def _read_definition(text: str, diagnostics: Diagnostics, workspace: Workspace) -> None:
    del workspace
    parse_message(text, "p/msg/M", Generation.ROS2, file="<fuzz>", diagnostics=diagnostics)


def _read_controllers(text: str, diagnostics: Diagnostics, workspace: Workspace) -> None:
    """Read a parameter file, and make and run the controllers it describes on ideal joints."""
    del workspace
    source = FileSource((), "/", diagnostics)
    source.add_sections(read_parameter_text(text, "<fuzz>", diagnostics))
    robot, _ = make_robot([PlantJoint("a"), PlantJoint("b")], generation=2)
    manager = ControllerManager(
        robot,
        namespace="/",
        make_ports=lambda name: RecordingPorts(subscribed=False),
        source=source,
        diagnostics=diagnostics,
        update_rate_hz=1000.0,
    )
    for name in source.controllers():
        manager.load(name)
        manager.configure(name)
        manager.switch([name], [], strict=False)
    for tick in range(3):
        manager.update(tick * 1_000_000, 1_000_000)
    manager.close()


def _urdf_text() -> str:
    """Return the example robot, expanded; the seed of the URDF cases."""
    from gazelle.description.xacro import expand_xacro

    workspace, diagnostics = Workspace.discover(extra=[SCOUT]), Diagnostics()
    expanded = expand_xacro(
        SCOUT / "urdf" / "scout.urdf.xacro", workspace=workspace, diagnostics=diagnostics
    )
    assert expanded is not None
    return expanded.text


def _launch_text() -> str:
    """Return the example's launch file without its command, which damage would turn into others."""
    text = (SCOUT / "launch" / "scout.launch").read_text()
    return re.sub(r'command="[^"]*"', 'value="a robot"', text)


SOURCES: dict[str, tuple[Callable[[], str], Callable[[str, Diagnostics, Workspace], None]]] = {
    "urdf": (_urdf_text, _read_urdf),
    "sdf": ((SCOUT / "worlds" / "workshop.world").read_text, _read_sdf),
    "launch": (_launch_text, _read_launch),
    "definition": (lambda: DEFINITION, _read_definition),
    "controllers": (lambda: CONTROLLERS, _read_controllers),
}


@pytest.mark.parametrize("kind", SOURCES)
def test_damaged_files_end_in_diagnostics(kind: str) -> None:
    assert refusals(kind, COUNT) > COUNT // 10


def refusals(kind: str, count: int) -> int:
    """Read damaged files of a kind; return how many were refused, fail at the first crash."""
    make, read = SOURCES[kind]
    text, workspace = make(), Workspace.discover(extra=[SCOUT])
    refused = 0
    for seed in range(count):
        diagnostics = Diagnostics()
        damaged = _damaged(text, seed)
        try:
            read(damaged, diagnostics, workspace)
        except (UserFileError, GazelleError):
            refused += 1
        except Exception as error:
            raise AssertionError(f"{kind}, seed {seed}: {error!r}\n{damaged[:2000]}") from error
        refused += bool(diagnostics.errors)
    return refused
