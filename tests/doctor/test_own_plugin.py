"""A plug-in of the user's own that raises: told at its line, by whatever led there."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.doctor.conftest import Examine, Write

from gazelle.doctor import Report

WORLD = """<sdf version="1.6"><world name="w">
<plugin name="race" filename="librace.so"/>
</world></sdf>"""
PLUGIN = """from gazelle.simulator.plugins.user import WorldPlugin

class Race(WorldPlugin):
    def load(self, world, parameters, node):
        {load}

    def on_update(self, time_s):
        {update}
"""
LAUNCH = """<launch>
<node name="gazebo" pkg="gazebo_ros" type="gzserver" args="$(find bot)/worlds/race.world"/>
</launch>"""


def _folder(written: Write, load: str = "pass", update: str = "pass") -> Path:
    files = {"worlds__race.world": WORLD, "launch__race.launch": LAUNCH}
    return written(**files, **{"plugins__race.py": PLUGIN.format(load=load, update=update)})


def _told(report: Report) -> list[tuple[str, int, str, list[str]]]:
    return [
        (
            item.span.file.rpartition("/")[2],
            item.span.line,
            item.message.rpartition("goes on: ")[2],
            [f"{place.file.rpartition('/')[2]}:{place.line}" for place in item.span.via],
        )
        for item in report.findings
        if item.code == "plugin.user-error" and item.span is not None
    ]


@pytest.mark.parametrize(
    ("code", "line", "words"),
    [
        ({"load": "parameters['speed']"}, 5, "in load(): KeyError: 'speed'"),
        ({"update": "1 / 0"}, 8, "in on_update(): ZeroDivisionError: division by zero"),
        ({"update": "time_s > 0.1 and nobody"}, 8, "in on_update(): NameError: name 'nobody'"),
    ],
)
@pytest.mark.parametrize("words_of", [("worlds/race.world",), ("bot", "race.launch"), ("bot",)])
def test_a_plugin_that_raises_is_told_at_its_line(
    written: Write,
    examined: Examine,
    words_of: tuple[str, ...],
    code: dict[str, str],
    line: int,
    words: str,
) -> None:
    report = examined(_folder(written, **code), *words_of)
    ((file, told_at, message, via),) = _told(report)
    assert (file, told_at, via) == ("race.py", line, ["race.world:2"])
    assert message.startswith(words)
    plugins = next(one for one in report.sections if one.name == "plugins")
    assert plugins.rows[0][2] == "your Python: fails"


def test_a_plugin_that_raises_later_is_told_by_the_probes(
    written: Write, examined: Examine
) -> None:
    robot = '<model name="ball"><link name="l"><inertial><mass>1</mass></inertial></link></model>'
    folder = _folder(written, update="time_s < 1.0 or nobody")
    world = folder / "worlds" / "race.world"
    world.write_text(world.read_text().replace("</world>", f"{robot}</world>"))
    assert _told(examined(folder, "worlds/race.world")) == []
    (told,) = _told(examined(folder, "worlds/race.world", probe=True))
    assert told[:2] == ("race.py", 8)


def test_a_plugin_that_does_its_work_is_not_told(written: Write, examined: Examine) -> None:
    assert _told(examined(_folder(written), "worlds/race.world")) == []
