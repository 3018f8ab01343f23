"""Good and broken robots, and what the real ``check_urdf`` made of each."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any, NamedTuple

from tests.shared_files import SHARED

__all__ = ["OWN", "SAMPLES", "Recorded", "RecordedRobots"]

_WORKSPACES = Path(__file__).parents[1] / "workspaces"


class Recorded(NamedTuple):
    """One run of the real ``check_urdf``."""

    text: str
    code: int
    out: str
    err: str


class RecordedRobots:
    """A folder of robots, one mechanism in each, with the recorded runs.

    Attributes:
        robots: folder of the URDFs.
        said: folder of the records.
        drawing: what ``urdf_to_graphviz`` drew of the robot ``good``.
    """

    def __init__(self, robots: Path, said: Path, drawing: Path) -> None:
        self.robots, self.said, self.drawing = robots, said, drawing

    @property
    def names(self) -> list[str]:
        return sorted(path.stem for path in self.robots.glob("*.urdf"))

    def file(self, name: str) -> Path:
        return self.robots / f"{name}.urdf"

    def text(self, name: str) -> str:
        return self.file(name).read_text(encoding="utf-8")

    def run(self, name: str) -> Recorded:
        """Return what ``check_urdf`` made of a robot: ``run("good")``."""
        answer = (self.said / f"{name}.txt").read_text(encoding="utf-8")
        match: Any = re.fullmatch(
            r"\$ [^\n]*\n\[exit (\d+)\]\n\[stdout\]\n(.*?)\[stderr\]\n?(.*)", answer, re.DOTALL
        )
        assert match is not None, name
        return Recorded(self.text(name), int(match[1]), match[2], match[3])


OWN = RecordedRobots(
    Path(__file__).parent / "robots",
    _WORKSPACES / "recorded" / "check_urdf",
    _WORKSPACES / "recorded" / "urdf_to_graphviz" / "good.gv",
)
_ORACLES = SHARED / "oracles"
SAMPLES = RecordedRobots(
    _ORACLES / "urdf",
    _ORACLES / "check_urdf",
    _ORACLES / "urdf_to_graphviz" / "urdf_to_graphviz" / "good_bot.gv",
)
