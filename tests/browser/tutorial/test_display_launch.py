"""T11: the mobile robot in 3D with a slider for each joint, in all of the document's formats."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from tests.browser.scene.rviz_page import RvizPage
from tests.browser.tutorial.terminal import Session
from tests.shared_files import SHARED, shared_cases

pytestmark = [pytest.mark.tutorial, pytest.mark.slow]

_OWN = Path(__file__).parents[2] / "workspaces/ros1/src/shown_robot"
_DOCUMENT = SHARED / "workspaces/catkin_ws/src/urdf_tutorial"
_LINKS = 4
_WHEEL = "base_to_left_wheel"


# A page takes seconds: our own robot is shown where the document's is not there.
class Shown(NamedTuple):
    """A package, its launch file and the robot's file in it."""

    folder: Path
    launch: str
    model: str


@pytest.fixture
def display(session: Any, look: Any) -> Any:
    """``roslaunch urdf_tutorial display.launch model:=…`` and the page it opens."""

    def begin(shown: Shown) -> tuple[Session, RvizPage]:
        line = f"roslaunch {shown.folder.name} {shown.launch} model:={shown.model}"
        launched = session(line, cwd=shown.folder)
        launched.shows(launched.first, "rviz")
        return launched, RvizPage(look(launched.url, size=(1280, 800)), launched)

    return begin


@pytest.mark.parametrize(
    "shown",
    shared_cases(Shown(_DOCUMENT, "display.launch", "urdf/mobile_robot.urdf"))
    or [Shown(_OWN, "show.launch", "urdf/barrow.urdf")],
    ids=lambda shown: shown.model,
)
def test_slider_turns_the_wheel_of_the_robot(display: Any, shown: Shown) -> None:
    launched, page = display(shown)
    page.shows("RobotModel", links=_LINKS, placed=_LINKS)
    sliders = page.seen.panel("joint_state_publisher_gui")
    slider = sliders.get_by_role("slider", name=_WHEEL)
    names = [each.get_attribute("aria-label") for each in sliders.get_by_role("slider").all()]
    assert sorted(names) == ["base_to_caster_wheel", "base_to_left_wheel", "base_to_right_wheel"]
    turned = _turns(launched, "left_wheel")
    launched.eventually(lambda: turned)
    assert turned[-1] == pytest.approx(0.0, abs=1e-3)
    box = slider.bounding_box()
    middle = box["y"] + box["height"] / 2
    page.drag((box["x"] + box["width"] / 2, middle), (box["x"] + box["width"] * 0.75, middle))
    # A quarter of the slider is a quarter turn.
    launched.eventually(lambda: abs(abs(turned[-1]) - math.pi / 2) < 0.25)
    page.seen.shot("turned")
    sliders.get_by_role("button", name="Center").click()
    launched.eventually(lambda: abs(turned[-1]) < 1e-3)


@pytest.mark.parametrize(
    "shown",
    shared_cases(
        Shown(_DOCUMENT, "display.launch", "urdf/mobile_robot.urdf.xacro"),
        Shown(_DOCUMENT, "display.launch", "urdf/mobile_robot_stl.urdf"),
    )
    or [Shown(_OWN, "show.launch", "urdf/barrow.urdf.xacro")],
    ids=lambda shown: shown.model,
)
def test_other_formats_of_the_robot_are_drawn(display: Any, shown: Shown) -> None:
    _, page = display(shown)
    links = 1 if "stl" in shown.model else _LINKS
    page.shows("RobotModel", links=links, placed=links)
    assert page.display("RobotModel")["level"] == "ok"
    page.seen.shot()


def _turns(launched: Session, frame: str) -> list[float]:
    """The angles about y that a frame has had on tf."""
    angles: list[float] = []

    def take(message: Any) -> None:
        for item in message.transforms:
            if item.child_frame_id == frame:
                turn = item.transform.rotation
                angles.append(2 * math.atan2(turn.y, turn.w))

    launched.first.node.create_subscription("/tf", "tf2_msgs/msg/TFMessage", take)
    return angles
