"""What the pictures of README and docs show: which commands are typed, and what of the page is taken."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any, NamedTuple

__all__ = ["STAGES", "Film", "Shot", "Stage", "Typed", "files_of"]

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


def files_of(row: Shot | Film | Typed) -> tuple[str, ...]:
    """Return the names of a picture's files."""
    if isinstance(row, Film):
        return (f"{row.name}.webp",)
    return (f"{row.name}-light.webp", f"{row.name}-dark.webp")


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
_TWIST = "'{linear: {x: 0.25}, angular: {z: 0.4}}'"


def _steps(*steps: Callable[[Any], None]) -> Callable[[Any], None]:
    def act(page: Any) -> None:
        for step in steps:
            step(page)

    return act


def _press(name: str, role: str = "button") -> Callable[[Any], None]:
    return lambda page: page.get_by_role(role, name=name, exact=True).first.click()


def _fill(label: str, *texts: str) -> Callable[[Any], None]:
    """Each text is typed into a field and ended with Enter."""

    def act(page: Any) -> None:
        field = page.get_by_label(label, exact=True).first
        for text in texts:
            field.fill("")
            field.fill(text)
            field.press("Enter")

    return act


def _choose(label: str, option: str) -> Callable[[Any], None]:
    return lambda page: page.get_by_label(label, exact=True).first.select_option(option)


def _wait(seconds: float) -> Callable[[Any], None]:
    return lambda page: page.wait_for_timeout(seconds * 1000)


def _tick(*topics: str) -> Callable[[Any], None]:
    def act(page: Any) -> None:
        for topic in topics:
            page.get_by_label(f"Subscribe {topic}", exact=True).click()

    return act


def _drag(panel: str, to: tuple[float, float]) -> Callable[[Any], None]:
    """Turn the view of a panel by a drag from its middle."""

    def act(page: Any) -> None:
        box = page.locator(f"[data-panel='{panel}'] canvas").first.bounding_box()
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + to[0], y + to[1], steps=5)
        page.mouse.up()

    return act


def _zoom(panel: str, notches: int) -> Callable[[Any], None]:
    def act(page: Any) -> None:
        page.locator(f"[data-panel='{panel}'] canvas").first.hover()
        for _ in range(abs(notches)):
            page.mouse.wheel(0, -120 if notches > 0 else 120)
            page.wait_for_timeout(60)

    return act


_DRIVES = (f"rostopic pub -r 10 /cmd_vel geometry_msgs/Twist {_TWIST}", "")

_SCOUT = Stage(
    "scout_ws",
    (("roslaunch scout_robot scout.launch", _SPAWNED),),
    (
        Shot("gazebo", ("gazebo",)),
        Shot("rviz", ("rviz",)),
        Shot("node_graph", ("rqt_graph",), "rqt_graph", size=(900, 520)),
        Shot("tf_tree", ("rqt_tf_tree",), "rqt_tf_tree", size=(900, 560)),
        Shot(
            "service_caller",
            ("rqt_service_caller",),
            "rqt_service_caller",
            act=_steps(_fill("Service", "/gazebo/get_world_properties"), _press("Call")),
            size=(900, 420),
        ),
        Shot(
            "image_view",
            ("rqt_image_view",),
            "rqt_image_view",
            act=_fill("Image topic", "/camera/rgb/image_raw"),
            size=(760, 560),
        ),
        Shot(
            "plot",
            ("rqt_plot",),
            "rqt_plot",
            typed=(_DRIVES,),
            act=_fill(
                "Topic field", "/odom/twist/twist/linear/x", "/odom/twist/twist/angular/z"
            ),
            wait_s=12.0,
            size=(900, 400),
        ),
        Shot(
            "topics",
            ("rqt_topic",),
            "rqt_topic",
            act=_steps(_wait(2), _tick("/clock", "/odom", "/scan")),
            size=(900, 480),
        ),
        Shot("console", ("rqt_console",), "rqt_console", size=(900, 400)),
        Shot("steering", ("rqt_robot_steering",), "rqt_robot_steering", size=(760, 480)),
        Shot(
            "reconfigure",
            ("rqt_reconfigure",),
            "rqt_reconfigure",
            act=_press("/gazebo", "option"),
            size=(900, 480),
        ),
        Shot(
            "publisher",
            ("rqt_publisher",),
            "rqt_publisher",
            act=_steps(_fill("Topic", "/cmd_vel"), _wait(2), _press("Add"), _fill("angular.z", "sin(t)")),
            size=(900, 420),
        ),
    ),
)

_ARM = Stage(
    "arm_ws",
    (("ros2 launch heron_bringup heron.launch.py", "You can start planning now"),),
    (
        Film(
            "arm",
            ("gazebo",),
            "gazebo",
            typed=(("ros2 run heron_bringup pick_and_place", ""),),
            size=(1120, 700),
            frames=60,
            every_s=0.4,
        ),
        Shot("motion_planning", ("rviz", "motion_planning"), act=_wait(4)),
        Shot(
            "joints", ("joint_state_publisher_gui",), "joint_state_publisher_gui", size=(520, 480)
        ),
    ),
)

_TURTLES = Stage(
    "scout_ws",
    (("roscore", ""), ("rosrun turtlesim turtlesim_node", "Spawning turtle")),
    (Shot("turtlesim", ("turtlesim",), "turtlesim", size=(620, 660)),),
)

STAGES = (_SCOUT, _ARM, _TURTLES)
