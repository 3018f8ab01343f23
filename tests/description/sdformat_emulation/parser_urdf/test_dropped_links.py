from __future__ import annotations

from gazelle.description.sdformat_emulation.parser_urdf import (
    DroppedLink,
    dropped_links,
    lumped_links,
)

from .making import BOX, joint, link, robot


def test_chains_of_fixed_joints_end_in_the_link_that_stays() -> None:
    root = robot(
        link("base"), link("mast"), link("camera"), link("wheel"),
        joint("fixed", "base", "mast"), joint("fixed", "mast", "camera"),
        joint("continuous", "mast", "wheel"),
    )  # fmt: skip
    assert lumped_links(root) == {"camera": "base", "mast": "base"}
    assert dropped_links(root) == ()


def test_a_frame_without_inertia_is_lumped_and_nothing_is_lost() -> None:
    root = robot(
        link("base"), link("optical", f"<visual>{BOX}</visual>", mass=None),
        joint("fixed", "base", "optical"),
    )  # fmt: skip
    assert lumped_links(root) == {"optical": "base"}
    assert dropped_links(root) == ()


def test_all_below_a_link_without_inertia_is_lost() -> None:
    root = robot(
        link("base"), link("arm", mass=None), link("hand"), link("finger"),
        link("tiny", mass="1e-7"),
        joint("continuous", "base", "arm"), joint("continuous", "arm", "hand"),
        joint("fixed", "hand", "finger"), joint("continuous", "base", "tiny"),
    )  # fmt: skip
    assert dropped_links(root) == (
        DroppedLink("arm", "base_arm", "it has no <inertial>", "arm"),
        DroppedLink("hand", "arm_hand", "it hangs on 'arm', which has no <inertial>", "arm"),
        DroppedLink("finger", "hand_finger", "it is lumped into 'hand', which is left out", "arm"),
        DroppedLink(
            "tiny", "base_tiny", "it weighs 1e-07 kg, which counts as nothing", "tiny"
        ),
    )  # fmt: skip


def test_a_wheel_on_a_lumped_bracket_without_inertia_is_lost() -> None:
    root = robot(
        link("base"), link("bracket", mass=None), link("wheel"),
        joint("fixed", "base", "bracket"), joint("continuous", "bracket", "wheel"),
    )  # fmt: skip
    reason = "it hangs on 'bracket', which has no <inertial>"
    assert dropped_links(root) == (DroppedLink("wheel", "bracket_wheel", reason, "bracket"),)
    assert lumped_links(root) == {"bracket": "base"}


def test_nothing_is_known_about_a_refused_robot() -> None:
    root = robot(link("a"), link("b"))
    assert (lumped_links(root), dropped_links(root)) == ({}, ())
