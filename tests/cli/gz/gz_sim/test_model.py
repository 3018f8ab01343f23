"""``gz model`` in the new Gazebo's words."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.cli.main import main
from gazelle.simulator import Simulation

Run = Callable[..., Any]


def test_models_are_listed(world: Simulation, gz: Run) -> None:
    assert gz("model", "--list").out == "Available models:\n    - ground_plane\n    - arm\n"


def test_model_is_shown(world: Simulation, gz: Run) -> None:
    shown = gz("model", "-m", "arm").out
    assert shown.startswith(
        "Model:\n  - Name: arm\n  - Pose [ XYZ (m) ] [ RPY (rad) ]:\n"
        "    [1.000000 -0.500000 0.150000]\n    [0.000000 0.000000 0.250000]\n"
    )
    assert "  - Link\n    - Name: bob\n    - Parent: arm\n    - Mass (kg): 1.000000\n" in shown
    assert "      [0.500000 0.000000 0.000000]\n" in shown
    assert "  - Joint\n    - Name: swing\n    - Parent: arm\n    - Type: revolute\n" in shown


def test_parts_are_chosen(world: Simulation, gz: Run) -> None:
    shown = gz("model", "-m", "arm", "-l", "bob").out
    assert shown.startswith("  - Link\n    - Name: bob\n")
    assert "base" not in shown
    assert "Joint" not in shown
    assert gz("model", "-m", "arm", "-j").out.count("- Joint") == 1
    assert gz("model", "-m", "arm", "-l", "-j").out.count("- Link") == 2


def test_fortress_shows_the_pose_in_its_layout(world: Simulation, gz: Run) -> None:
    assert main(["ign", "model", "-m", "arm", "-p"]) == 0
    assert gz("model", "-m", "arm", "-p").out == "1 -0.5 0.15 0 0 0.25\n"


def test_unknown_names_are_told(world: Simulation, gz: Run) -> None:
    assert "did you mean 'arm'?" in gz("model", "-m", "arn", "-l").err
    assert "model[arm] has no link[bib]; did you mean 'bob'?" in (
        gz("model", "-m", "arm", "-l", "bib").err
    )
    assert "model[arm] has no joint[x]; joints: swing" in gz("model", "-m", "arm", "-j", "x").err
    assert "-m MODEL names the model" in gz("model", "-l").err
    assert "gz topic -l names what sensors publish" in gz("model", "-m", "arm", "--sensor").err
