#!/usr/bin/env python3
"""Draws the pictures of the ways things go: the layers, a scan's way, a command's, a source's.

    python .ci/pictures.py [FOLDER]

Layers come from the table on that page. Colours are those of a light page, or of a dark one where
the reader's system is dark.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Sequence
from html import escape
from pathlib import Path
from typing import NamedTuple

__all__ = ["COMMAND", "CPP", "SCAN", "Lane", "Step", "layers", "pictures"]

_ROOT = Path(__file__).resolve().parents[1]
_WIDTH = 860
_CHARACTER = 6.7
_STYLE = """
  text { font: 13px ui-sans-serif, system-ui, sans-serif; fill: #1f2933; }
  .name { font-weight: 600; } .small { font-size: 12px; fill: #52606d; }
  rect { fill: #f5f7fa; stroke: #9aa5b1; } .lane { fill: none; stroke-dasharray: 5 4; }
  path { fill: none; stroke: #52606d; stroke-width: 1.5; } #tip { fill: #52606d; }
  @media (prefers-color-scheme: dark) {
    text { fill: #e4e7eb; } .small { fill: #9aa5b1; } #tip { fill: #9aa5b1; }
    rect { fill: #1f2933; stroke: #616e7c; } .lane { fill: none; } path { stroke: #9aa5b1; }
  }
"""


class Step(NamedTuple):
    """What a module does with what passes it."""

    module: str
    does: str


class Lane(NamedTuple):
    """A process and the steps in it, from the first to the last.

    Attributes:
        process: its name in the picture.
        steps: from the first to the last.
        source: the lane whose last step its first one takes from.
    """

    process: str
    steps: Sequence[Step]
    source: int = 0


SCAN = (
    Lane(
        "simulator",
        (
            Step("gazelle.simulator.scheduler", "says when the lidar is due, if somebody listens"),
            Step("gazelle.engine.state", "a snapshot: where all links are after this step"),
            Step("gazelle.sensors.ray_scene", "moves the shapes of Embree's scene there"),
            Step("gazelle.sensors.lidar", "casts the rays: a record of ranges in metres"),
            Step("gazelle.sensors.noise_streams", "adds noise from the sensor's own seed"),
            Step("gazelle.simulator.plugins.laser", "fills a LaserScan: frame, stamp, limits"),
            Step("gazelle.interfaces.codec", "writes it as CDR bytes, once for all who listen"),
            Step("gazelle.graph.publisher", "puts it on the graph, over Zenoh's local link"),
        ),
    ),
    Lane(
        "node of the user",
        (
            Step("gazelle.graph.subscription", "takes the bytes from the link"),
            Step(
                "gazelle.graph.callback_queue",
                "keeps them in a queue of the size that was asked for",
            ),
            Step("gazelle.compat.rospy.topics", "makes the message, calls the user's callback"),
        ),
    ),
    Lane(
        "page",
        (
            Step("gazelle.studio.subscriptions", "takes the bytes, while a display of it is open"),
            Step("gazelle.studio.displays.points", "makes points and colours, as the display says"),
            Step("gazelle.studio.streams", "sends a binary frame when the page has room"),
        ),
    ),
)

COMMAND = (
    Lane(
        "keyboard",
        (
            Step("gazelle.nodes.teleop", "makes a Twist of a key"),
            Step("gazelle.graph.publisher", "puts it on /cmd_vel"),
        ),
    ),
    Lane(
        "simulator",
        (
            Step("gazelle.graph.subscription", "takes it from the link"),
            Step(
                "gazelle.simulator.input_validation",
                "refuses what is no number, or beyond any world",
            ),
            Step("gazelle.simulator.plugins.diff_drive", "takes the last one at each update"),
            Step(
                "gazelle.simulator.plugins.diff_drive_kinematics",
                "turns it into speeds of two wheels",
            ),
            Step("gazelle.engine.motors", "drives the joints, up to the torque of the tag"),
            Step("gazelle.engine.engine", "takes the step: MuJoCo, contacts, friction"),
            Step("gazelle.simulator.plugins.drive_odometry", "/odom and its transform come back"),
        ),
    ),
)

CPP = (
    Lane(
        "launch, rosrun, catkin_make, colcon build",
        (
            Step("gazelle.launch.cpp_nodes", "finds all programs of C++ that are about to start"),
            Step("gazelle.cpp.interfaces", "makes headers of messages, services, actions, .cfg"),
            Step("gazelle.cpp.building.cmake", "lets CMake read CMakeLists.txt; ROS is Gazelle's"),
            Step("gazelle.cpp.building.runtime", "compiles the libraries behind the headers, once"),
            Step("gazelle.cpp.building.build", "lets ninja compile on all cores what has changed"),
        ),
    ),
    Lane(
        "node",
        (
            Step("gazelle.cpp.host", "loads the program and runs its main() in this process"),
            Step("gazelle.cpp.host.table", "functions of C by which C++ asks for what is outside"),
            Step("gazelle.cpp.host.topics", "publishes and subscribes as nodes in Python do"),
            Step("gazelle.graph.publisher", "puts it on the graph, over Zenoh's local link"),
        ),
    ),
)


def main(arguments: list[str]) -> int:
    """Write the pictures into a folder."""
    folder = Path(arguments[0]) if arguments else _ROOT / "docs" / "pictures"
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in pictures().items():
        (folder / name).write_text(text, encoding="utf-8", newline="\n")
    return 0


def pictures() -> dict[str, str]:
    """Return the SVG texts by the names of their files."""
    return {
        "layers.svg": _stack(layers()),
        "scan.svg": _way("A scan on its way from the world to a node and to the page", SCAN),
        "command.svg": _way("A command on its way from a key to the wheels", COMMAND),
        "cpp.svg": _way("A source file on its way to a node of the graph", CPP),
    }


def layers() -> list[Step]:
    """Return the rows of the architecture's table, from low to high."""
    text = (_ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
    table = text.partition("## Layers")[2].partition("\n## ")[0]
    rows = [line.split("|") for line in table.splitlines() if line.startswith("| `gazelle")]
    return [Step(_names(row[1]), _first(row[2])) for row in rows]


def _names(cell: str) -> str:
    names = re.findall(r"`gazelle\.?([\w.]*)`", cell)
    shown = [name or "gazelle" for name in names if not name.startswith("_")]
    return ", ".join(shown[:3]) + (" …" if len(shown) > 3 else "")


def _first(cell: str) -> str:
    words = re.split(r"[;:]", re.sub(r"`", "", cell.strip()))[0]
    room = int((_WIDTH - 300) / _CHARACTER)
    return words if len(words) <= room else words[:room].rpartition(" ")[0] + " …"


def _stack(rows: list[Step]) -> str:
    height, parts = 30, []
    for number, row in enumerate(reversed(rows)):
        y = 44 + number * height
        parts.append(_box(12, y, _WIDTH - 24, height - 6))
        parts.append(_text(24, y + 17, row.module, "name"))
        parts.append(_text(300, y + 17, row.does, "small"))
    title = "Each layer imports only what lies below it"
    return _svg(title, 56 + len(rows) * height, parts)


def _way(title: str, lanes: Sequence[Lane]) -> str:
    parts, y, ends = [], 48, list[int]()
    for number, lane in enumerate(lanes):
        height = 36 + 34 * len(lane.steps)
        parts.append(_box(12, y, _WIDTH - 24, height, "lane"))
        parts.append(_text(48, y + 20, lane.process, "small"))
        for row, step in enumerate(lane.steps):
            top = y + 30 + 34 * row
            parts.append(_box(48, top, 330, 26))
            parts.append(_text(60, top + 18, step.module.removeprefix("gazelle."), "name"))
            parts.append(_text(396, top + 18, step.does, "small"))
            if row:
                parts.append(_arrow(f"M213 {top - 8}V{top - 1}"))
        if number and lane.source == number - 1:
            parts.append(_arrow(f"M213 {ends[-1]}V{y + 29}"))
        elif number:
            parts.append(_arrow(f"M48 {ends[lane.source] - 13}H30V{y + 43}H47"))
        ends.append(y + 30 + 34 * len(lane.steps) - 8)
        y += height + 14
    return _svg(title, y, parts)


def _arrow(way: str) -> str:
    return f'<path d="{way}" marker-end="url(#arrow)"/>'


def _svg(title: str, height: int, parts: list[str]) -> str:
    arrow = (
        '<marker id="arrow" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7"'
        ' orient="auto"><polygon id="tip" points="0,0 8,4 0,8"/></marker>'
    )
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH} {height}"'
        f' width="{_WIDTH}" height="{height}" role="img" aria-label="{escape(title)}">'
    )
    lines = [head, f"<style>{_STYLE}</style>", f"<defs>{arrow}</defs>"]
    return "\n".join([*lines, _text(12, 26, title, "name"), *parts, "</svg>", ""])


def _box(x: int, y: int, width: int, height: int, kind: str = "") -> str:
    named = f' class="{kind}"' if kind else ""
    return f'<rect{named} x="{x}" y="{y}" width="{width}" height="{height}" rx="5"/>'


def _text(x: int, y: int, text: str, kind: str) -> str:
    return f'<text class="{kind}" x="{x}" y="{y}">{escape(text)}</text>'


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
