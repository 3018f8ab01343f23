"""What is said to be elsewhere is not here, and what is said to do its work is."""

from __future__ import annotations

import re

import pytest

from gazelle.errors import NotFoundError
from gazelle.node_specs.registry import builtin_executables, builtin_packages, node_spec
from gazelle.node_specs.unavailable_packages import (
    PACKAGES,
    PROGRAMS,
    Sends,
    missing_node,
    missing_package,
    replacement_of,
    unavailable_packages,
    what_it_sends,
)
from gazelle.workspace.environment_paths import builtin_package_names

# The words of the sentences that are packages, and have to be here.
_NAMED = re.compile(r"`(\w+)`")


def test_no_package_that_is_elsewhere_is_here() -> None:
    here = builtin_packages() | builtin_package_names()
    assert sorted(unavailable_packages() & here) == []


def test_every_package_and_program_elsewhere_is_named_once() -> None:
    names = [row.name for row in PACKAGES]
    assert sorted(names) == sorted(set(names))
    programs = [(row.package, row.executable) for row in PROGRAMS]
    assert sorted(programs) == sorted(set(programs))


def test_a_program_that_is_elsewhere_is_no_node_of_its_package_which_is_here() -> None:
    for row in PROGRAMS:
        assert node_spec(row.package, row.executable) is None
        assert builtin_executables(row.package), row


def test_nodes_that_do_the_work_of_a_program_are_nodes_of_its_package() -> None:
    for row in PROGRAMS:
        named = [name for name in _NAMED.findall(row.instead) if name not in builtin_packages()]
        assert set(named) <= set(builtin_executables(row.package)), row


@pytest.mark.parametrize(
    ("node", "sends"),
    [
        (("image_proc", "image_proc"), Sends.NOTHING),
        (("rqt_unheard_of", "rqt_unheard_of"), Sends.NOTHING),
        (("rtabmap_ros", "rtabmap"), Sends.TRANSFORMS),
        (("robot_localization", "ukf_localization_node"), Sends.TRANSFORMS),
        (("usb_cam", "usb_cam_node"), Sends.ANYTHING),
        (("bot", "driver"), Sends.ANYTHING),
    ],
)
def test_what_a_node_elsewhere_sends_is_known_of_some(node: tuple[str, str], sends: Sends) -> None:
    assert what_it_sends(*node) is sends


def test_a_panel_of_rqt_has_its_own_sentence_before_that_of_its_family() -> None:
    assert "switch_controllers" in replacement_of("rqt_controller_manager")
    assert replacement_of("rqt_else", 1).startswith("rqt_else is a panel of rqt that is not here;")
    assert replacement_of("rqt_common_plugins") == replacement_of("rqt_else").replace(
        "rqt_else", "rqt_common_plugins"
    )
    assert replacement_of("catkin") == ""


def test_a_package_that_is_known_to_exist_says_nothing_of_a_near_name() -> None:
    near = NotFoundError("package", "catkin", nearest=("catkim",))
    assert missing_package(near, 1) == ("package 'catkin' not found; did you mean 'catkim'?", "")
    known = NotFoundError("package", "usb_cam", nearest=("usb_can",))
    assert missing_package(known, 1)[1].startswith("usb_cam is the driver of a real camera")


def test_a_program_that_is_known_to_be_missing_says_what_does_its_work() -> None:
    assert missing_node("joy", "game_controller_node").startswith("game_controller_node is SDL's")
    assert missing_node("joy", "joy_node") == ""
