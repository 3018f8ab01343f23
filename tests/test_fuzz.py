"""Damaged files end in diagnostics, never in a crash: 3,000 of them, the same ones every time."""

from __future__ import annotations

import random
import re
from collections.abc import Callable
from pathlib import Path

import pytest

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
COUNT = 750
WORDS = ("", "nan", "1e999", "-1", "1,5", "../..", "$(find x)", "<", "&amp;", "é", "0 0 0", "true")
DEFINITION = """# a message
std_msgs/Header header
uint8 MODE_A=1
string<=10 NAME="x"
float64[] values
geometry_msgs/Point[3] corners
int32 count 5
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
