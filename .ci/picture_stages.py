"""What the pictures of README and docs show: which commands are typed, and what of the page is taken."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

__all__ = ["STAGES", "Film", "Shot", "Stage", "Typed"]

_Line = tuple[str, str]
"""A command without ``gazelle``, and the pattern of a line that it prints when it has come up."""


def _nothing(_: Any) -> None:
    pass


class Shot(NamedTuple):
    """A picture of the page or of one of its panels, ``NAME-light.webp`` and ``NAME-dark.webp``.

    Attributes:
        name: of the files.
        panels: the page opens with these; with its usual ones where there are none.
        of: the panel that is pictured, all of the page if empty.
        typed: commands typed beside, when the page is open.
        act: what a person does on the page.
        wait_s: how long is waited then.
        size: of the page, in px.
    """

    name: str
    panels: tuple[str, ...] = ()
    of: str = ""
    typed: tuple[_Line, ...] = ()
    act: Callable[[Any], None] = _nothing
    wait_s: float = 3.0
    size: tuple[int, int] = (1120, 700)


class Film(NamedTuple):
    """A moving picture of the page, ``NAME.webp``.

    Attributes:
        name: of the file.
        panels: as in `Shot`; so are `of`, `typed`, `act`, `wait_s` and `size`.
        frames: how many.
        every_s: a frame is taken each time this has passed.
        shown_ms: how long it is shown.
        width: of the file in px; 0 leaves it.
        quality: of WebP, 0 to 100.
    """

    name: str
    panels: tuple[str, ...] = ()
    of: str = ""
    typed: tuple[_Line, ...] = ()
    act: Callable[[Any], None] = _nothing
    wait_s: float = 3.0
    size: tuple[int, int] = (1120, 700)
    frames: int = 60
    every_s: float = 0.3
    shown_ms: int = 120
    width: int = 0
    quality: int = 50


class Typed(NamedTuple):
    """A picture of a terminal: a command and what it prints."""

    name: str
    line: str
    columns: int = 100
    lines: int = 40
    environ: Mapping[str, str] = MappingProxyType({"FORCE_COLOR": "1"})


class Stage(NamedTuple):
    """Pictures taken while the same commands run.

    Attributes:
        workspace: the folder of ``examples`` in a copy of which everything is typed.
        commands: typed first, each in a terminal of its own.
        rows: the pictures.
        prepare: changes the copy before.
    """

    workspace: str
    commands: tuple[_Line, ...]
    rows: tuple[Shot | Film | Typed, ...]
    prepare: Callable[[Path], None] = _nothing


_SPAWNED = "Successfully spawned entity"
_SHOWN = r"rqt\w*: http"

STAGES = (
    Stage(
        "scout_ws",
        (("roslaunch scout_robot scout.launch", _SPAWNED),),
        (
            Shot("gazebo", ("gazebo",)),
            Shot("rviz", ("rviz",)),
            Shot("node_graph", ("rqt_graph",), "rqt_graph"),
            Shot(
                "plot",
                ("rqt_plot",),
                "rqt_plot",
                typed=(
                    ("rqt_plot /odom/twist/twist/linear/x /odom/twist/twist/angular/z", _SHOWN),
                    (
                        "rostopic pub -r 10 /cmd_vel geometry_msgs/Twist "
                        "'{linear: {x: 0.2}, angular: {z: 0.5}}'",
                        "",
                    ),
                ),
                wait_s=12.0,
                size=(900, 420),
            ),
            Shot("tf_tree", ("rqt_tf_tree",), "rqt_tf_tree", size=(900, 560)),
            Shot("topics", ("rqt_topic",), "rqt_topic", size=(900, 480)),
        ),
    ),
)
