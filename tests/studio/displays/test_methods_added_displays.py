"""Displays by their classes: Gazelle's own, and those of pip packages."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import pytest
from tests.installed_packages import code_of_page, installed
from tests.studio.conftest import Talk
from tests.studio.page import Page, RefusedError

from gazelle.studio.displays.methods import find_display
from gazelle.studio.displays.registry import DISPLAYS
from gazelle.studio.settings.rviz_files import rviz_value

_POINTS = {"gazelle.displays": {"speed": "far_displays:SPEED"}}
_BROKEN = """
    from gazelle.studio.displays.display import Display

    def fails(message):
        return message.nothing

    OWN = Display("Map", "Another.", ("std_msgs/String",), drawn_as="Path")
    NOTHING = Display("Nothing", "Of no topic.", drawn_as="Path")
    LOOSE = Display("Loose", "Drawn by none.", ("std_msgs/String",), drawn_as="Pth")
    FAILS = Display("Fails", "Fails.", ("std_msgs/String",), drawn_as="Path", convert=fails)
"""
_ORIGIN = "entry point '{0} = far_displays:{0}' of far_displays 1.2 (gazelle.displays)"


def test_displays_are_found_by_the_classes_of_both_versions_of_rviz() -> None:
    assert find_display("rviz/WrenchStamped") is DISPLAYS["Wrench"]
    assert find_display("rviz_default_plugins/Wrench") is DISPLAYS["Wrench"]
    assert find_display("LaserScan") is DISPLAYS["LaserScan"]
    assert find_display("rviz/Nothing") is None


def test_a_package_adds_a_display_that_another_one_draws(
    page: Page, talk: Talk, tmp_path: Path
) -> None:
    with installed(tmp_path, "far_displays", code_of_page("A display of RViz"), _POINTS):
        assert find_display("rviz/LaserScan") is not None
        assert "far_displays" not in sys.modules
        added = page.call("display.list")
        assert added == {
            "displays": [
                {
                    "name": "Speed",
                    "about": "How fast a robot is, as an arrow.",
                    "types": ["geometry_msgs/TwistStamped"],
                    "aliases": [],
                    "streams": True,
                    "drawn_as": "Marker",
                }
            ],
            "problems": [],
        }
        stream = page.open("display", display="Speed", topic="/speed", fixed_frame="base_link")
        twist = {"linear": {"x": 1.5}}
        talk("/speed", "geometry_msgs/TwistStamped", header={"frame_id": "base_link"}, twist=twist)
        value = stream.next()
    (marker,) = value["message"]["markers"]
    assert value["poses"] == [[0, 0, 0, 0, 0, 0, 1]]
    assert [point["x"] for point in marker["points"]] == [0.0, 1.5]


def test_a_rviz_file_may_name_the_display_of_a_package(tmp_path: Path) -> None:
    file = """
        Visualization Manager:
          Displays: [{Class: far_displays/Speed, Name: Fast, Wheel Topic: {Value: speed}}]
    """
    source = code_of_page("A display of RViz").replace(
        'drawn_as="Marker"', 'drawn_as="Marker", topic_names=("Wheel Topic",)'
    )
    with installed(tmp_path, "far_displays", source, _POINTS):
        (display,) = rviz_value(file, "a.rviz")["displays"]
    assert (display["class"], display["topic"]) == ("Speed", "/speed")
    assert display["properties"] == {}


def test_displays_that_cannot_be_shown_are_told_where_they_are_asked_for(
    page: Page, tmp_path: Path
) -> None:
    names = ("LOOSE", "MISSING", "NOTHING", "OWN")
    points = {"gazelle.displays": {name: f"far_displays:{name}" for name in names}}
    problems = [
        f"{_ORIGIN.format('MISSING')} cannot be loaded: AttributeError: module 'far_displays' has "
        "no attribute 'MISSING'",
        f"{_ORIGIN.format('LOOSE')} adds the display 'Loose', drawn as 'Pth', which is none of "
        "Gazelle's displays with a topic; did you mean 'Path'?",
        f"{_ORIGIN.format('NOTHING')} adds the display 'Nothing', which shows no type of message",
        f"{_ORIGIN.format('OWN')} adds the display 'Map', which Gazelle has itself",
    ]
    with installed(tmp_path, "far_displays", _BROKEN, points):
        assert page.call("display.list") == {"displays": [], "problems": problems}
        with pytest.raises(RefusedError) as caught:
            page.open("display", display="far_displays/Loose", topic="/x", fixed_frame="map")
    assert str(caught.value) == "there is no display 'Loose'"
    assert caught.value.error["hint"] == " ".join(problems)


def test_a_message_that_cannot_be_converted_is_a_status(
    page: Page, talk: Talk, tmp_path: Path
) -> None:
    points = {"gazelle.displays": {"fails": "far_displays:FAILS"}}
    with installed(tmp_path, "far_displays", _BROKEN, points):
        stream = page.open("display", display="Fails", topic="/words", fixed_frame="map")
        talk("/words", "std_msgs/String", data="x")
        status: dict[str, Any] = stream.status.get(timeout=30)
    assert status["level"] == "error"
    assert status["text"] == (
        "std_msgs/msg/String cannot be converted: AttributeError: 'String' object has no attribute "
        "'nothing'"
    )
