"""What the pictures of README and docs show: commands typed, and what of the page is taken."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
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
        typed: commands typed before the page is opened.
        act: what a person does on the page.
        wait_s: how long is waited then.
        size: of the page, in px.
        card: there is a picture for the gallery, too, which shows this panel alone.
        card_zoom: turns of the wheel away from it.
        recorded: the page is one that ``gazelle record`` writes, with these words.
    """

    name: str
    panels: tuple[str, ...] = ()
    of: str = ""
    typed: tuple[_Line, ...] = ()
    act: Callable[[Any], None] = _nothing
    wait_s: float = 3.0
    size: tuple[int, int] = (1120, 700)
    recorded: str = ""
    card: str = ""
    card_zoom: int = 0


class Film(NamedTuple):
    """A moving picture, ``NAME.webp``, which ``gazelle record`` makes.

    Attributes:
        name: of the file.
        line: the words after ``gazelle record -o NAME.webp``.
        typed: commands typed just before.
    """

    name: str
    line: str
    typed: tuple[_Line, ...] = ()


class Typed(NamedTuple):
    """A picture of a terminal: a command and what it prints."""

    name: str
    line: str
    columns: int = 100
    lines: int = 40


Row = Shot | Film | Typed


def files_of(row: Row) -> tuple[str, ...]:
    """Return the names of a picture's files in ``docs/pictures``."""
    if isinstance(row, Film):
        return (f"{row.name}.webp",)
    return (f"{row.name}-light.webp", f"{row.name}-dark.webp")


class Stage(NamedTuple):
    """Pictures taken while the same commands run.

    Attributes:
        commands: typed first, each in a terminal of its own; one of them prints the page's address.
        rows: the pictures.
        workspace: the folder of ``examples`` in a copy of which everything is typed.
        prepare: changes the folder before.
    """

    commands: tuple[_Line, ...]
    rows: tuple[Row, ...]
    workspace: str = ""
    prepare: Callable[[Path], None] = _nothing


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


_DRIVES = (f"rostopic pub -r 10 /cmd_vel geometry_msgs/Twist {_TWIST}", "")


def _demo(
    name: str,
    *rows: Row,
    of: str = "gz",
    zoom: int = 0,
    until_s: float = 5.0,
    workspace: str = "",
    typed: tuple[_Line, ...] = (),
) -> Stage:
    """A demo that runs: as it begins, with its card in the gallery, and pictures of it."""
    first = Shot(name, typed=typed, wait_s=until_s, card=of, card_zoom=zoom)
    return Stage(((f"demo {name} --no-browser", "there after"),), (first, *rows), workspace)


def _panel(
    name: str,
    kind: str,
    *steps: Callable[[Any], None],
    typed: tuple[_Line, ...] = (),
    size: tuple[int, int] = (900, 480),
) -> Shot:
    """One panel alone, after some steps."""
    return Shot(name, (kind,), kind, typed, _steps(*steps), size=size)


_BEFORE_THE_CRATE = (
    "rosservice call /gazebo/set_model_state '{model_state: {model_name: scout, pose: "
    "{position: {x: -1.0, y: -0.4}, orientation: {w: 1.0}}}}'",
    "success: True",
)

_SCOUT = _demo(
    "scout",
    _panel(
        "camera",
        "rqt_image_view",
        _fill("Image topic", "/camera/rgb/image_raw"),
        typed=(_BEFORE_THE_CRATE,),
        size=(640, 540),
    ),
    _panel(
        "depth", "rqt_image_view", _fill("Image topic", "/camera/depth/image_raw"), size=(640, 540)
    ),
    Shot("sensors", typed=(("rviz -d src/scout_robot/rviz/scout.rviz", "http"),), wait_s=6.0),
    _panel("node_graph", "rqt_graph", size=(900, 520)),
    _panel("tf_tree", "rqt_tf_tree", size=(900, 560)),
    _panel(
        "service_caller",
        "rqt_service_caller",
        _fill("Service", "/gazebo/get_world_properties"),
        _press("Call"),
        size=(900, 420),
    ),
    _panel(
        "plot",
        "rqt_plot",
        _fill("Topic field", "/odom/pose/pose/position/x", "/odom/pose/pose/position/y"),
        _wait(12),
        typed=(_DRIVES,),
        size=(900, 400),
    ),
    _panel("topics", "rqt_topic", _wait(2), _tick("/imu")),
    _panel("steering", "rqt_robot_steering", size=(760, 460)),
    _panel("reconfigure", "rqt_reconfigure", _press("/gazebo", "option")),
    _panel(
        "publisher",
        "rqt_publisher",
        _fill("Topic", "/cmd_vel"),
        _wait(2),
        _press("Add"),
        _fill("angular.z", "sin(t)"),
        size=(900, 420),
    ),
    Typed("echo", "rostopic echo -n 1 /odom", columns=80, lines=24),
    workspace="scout_ws",
)

_ARM = _demo(
    "arm",
    Film(
        "pick_and_place",
        "--seconds 12 --fps 12 --eye 1.1 -1.3 0.9 --look-at 0.25 0 0.3",
        typed=(
            ("ros2 service call /reset_world std_srvs/srv/Empty", "response"),
            ("ros2 run heron_bringup pick_and_place", ""),
        ),
    ),
    Shot(
        "motion_planning",
        ("rviz", "motion_planning"),
        act=_steps(_wait(4), _choose("Goal state", "up"), _wait(1), _press("Plan")),
        wait_s=6.0,
    ),
    _panel("joints", "joint_state_publisher_gui", size=(520, 480)),
    until_s=9.0,
    zoom=3,
)

_GOAL = (
    "ros2 topic pub --once /goal_pose geometry_msgs/msg/PoseStamped '{header: {frame_id: map}, "
    "pose: {position: {x: %s, y: %s}, orientation: {w: 1.0}}}'"
)

_MAPPING = _demo(
    "mapping",
    Shot(
        "navigation",
        typed=(
            ("rviz2 -d src/surveyor_robot/rviz/mapping.rviz", "http"),
            (_GOAL % (-2.5, 1.5), ""),
        ),
        wait_s=5.0,
    ),
    Shot("replay", recorded="--seconds 20", wait_s=6.0),
    until_s=10.0,
    typed=((_GOAL % (2.0, -0.6), ""),),
    workspace="mapping_ws",
)


def _break(folder: Path) -> None:
    """Slips as people make them: a mesh's name, a joint's parent, a topic."""
    robot = folder / "src" / "scout_robot" / "urdf" / "scout.urdf.xacro"
    text = robot.read_text(encoding="utf-8")
    for right, wrong in (("meshes/body.stl", "meshes/bodi.stl"), ('base_footprint"/>', 'base"/>')):
        text = text.replace(right, wrong, 1)
    robot.write_text(text, encoding="utf-8")


_BROKEN = Stage(
    (
        ("roslaunch scout_robot scout.launch", ""),
        ("studio --no-browser", "Studio: http"),
    ),
    (
        Typed("doctor", "doctor scout_robot scout.launch", columns=96),
        Shot("findings", ("gazebo", "findings"), "findings", size=(1500, 560)),
    ),
    "scout_ws",
    _break,
)

_ASSISTANT = Stage(
    (("studio --no-browser", "Studio: http"),),
    (
        Shot(
            "setup_assistant",
            ("moveit_setup_assistant",),
            act=_steps(
                _fill("Robot file", "package://heron_description/urdf/heron.urdf.xacro"),
                _press("Load"),
                _wait(5),
                _press("Self-Collisions", "tab"),
                _press("Find pairs"),
            ),
            wait_s=6.0,
        ),
    ),
    "arm_ws",
)

_EMPTY = Stage((("studio --no-browser", "Studio: http"),), (Shot("start", wait_s=4.0),))

STAGES = (
    _BROKEN,
    _ASSISTANT,
    _SCOUT,
    _demo("four_wheels"),
    _ARM,
    _MAPPING,
    _demo("balancer", until_s=9.0),
    _demo("turtles", of="turtlesim", until_s=12.0),
    _demo("playground"),
    _demo("plugin", zoom=9),
    _demo("controller", until_s=12.0),
    # Last, for it shows the demos' cards.
    _EMPTY,
)
