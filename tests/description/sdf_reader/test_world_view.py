"""Where ``<gui>`` has the window's camera."""

from __future__ import annotations

import pytest

from gazelle.description.read_context import ReadContext
from gazelle.description.sdf_reader import read_sdf
from gazelle.description.xml import parse_xml
from gazelle.diagnostics import Diagnostics


@pytest.mark.parametrize(
    "gui",
    [
        "<camera name='user_camera'><pose>1 2 3 0 0.5 0</pose></camera>",
        "<plugin name='3D View' filename='MinimalScene'>"
        "<camera_pose>1 2 3 0 0.5 0</camera_pose></plugin>",
    ],
)
def test_the_window_looks_from_where_the_world_file_says(gui: str) -> None:
    diagnostics = Diagnostics()
    text = f"<sdf version='1.6'><world name='w'><gui>{gui}</gui></world></sdf>"
    tag = parse_xml(text, "<text>", diagnostics)
    assert tag is not None
    (world,) = read_sdf(tag, context=ReadContext(None, diagnostics, "<text>")).worlds
    assert not list(diagnostics)
    view = world.scene.T_world_view
    assert view is not None
    assert view.position_m == (1.0, 2.0, 3.0)
    assert view.rpy_rad[1] == pytest.approx(0.5)


def test_a_world_without_gui_has_no_view() -> None:
    diagnostics = Diagnostics()
    tag = parse_xml("<sdf version='1.6'><world name='w'/></sdf>", "<text>", diagnostics)
    assert tag is not None
    (world,) = read_sdf(tag, context=ReadContext(None, diagnostics, "<text>")).worlds
    assert world.scene.T_world_view is None


def test_what_the_page_does_not_take_from_the_camera_is_told() -> None:
    diagnostics = Diagnostics()
    gui = "<camera><pose>1 2 3 0 0 0</pose><view_controller>fps</view_controller></camera>"
    text = f"<sdf version='1.6'><world name='w'><gui>{gui}</gui></world></sdf>"
    tag = parse_xml(text, "<text>", diagnostics)
    assert tag is not None
    read_sdf(tag, context=ReadContext(None, diagnostics, "<text>"))
    (found,) = diagnostics
    assert found.message == "<view_controller> in <camera> is legal and not simulated"
