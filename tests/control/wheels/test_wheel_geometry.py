"""Wheel parameters of controllers beside the robot's geometry."""

from __future__ import annotations

import pytest
from tests.control.controllers.wheeled_bench import WheeledBench, rolling

from gazelle.control.controllers.diff_drive_controller import DiffDriveController
from gazelle.description.model import (
    Box,
    Collision,
    Cylinder,
    Joint,
    JointAxis,
    JointType,
    Link,
    Model,
    Shape,
)
from gazelle.diagnostics import Diagnostic
from gazelle.geometry import Pose

WHEEL = Cylinder(0.1, 0.05)
PARAMETERS = {
    "left_wheel_names": ["left"],
    "right_wheel_names": ["right"],
    "wheel_separation": 0.5,
    "wheel_radius": 0.1,
}


def _model(shape: Shape) -> Model:
    links = [Link("base")]
    joints = []
    for name, y in (("left", 0.25), ("right", -0.25)):
        links.append(Link(f"{name}_wheel", collisions=(Collision("c", shape),)))
        joints.append(
            Joint(name, JointType.CONTINUOUS, "base", f"{name}_wheel", Pose((0.0, y, 0.0)),
                  JointAxis((0.0, 1.0, 0.0)))
        )  # fmt: skip
    return Model("robot", links=tuple(links), joints=tuple(joints))


def _said(change: dict[str, float], shape: Shape = WHEEL) -> list[Diagnostic]:
    bench = WheeledBench(
        DiffDriveController,
        rolling("left", "right"),
        {**PARAMETERS, **change},
        model=_model(shape),
        ros_version=2,
    )
    return list(bench.diagnostics.by_code("control.wheel-geometry"))


@pytest.mark.parametrize(
    "change",
    [
        {},
        {"wheel_separation": 0.53},
        {"wheel_radius": 0.097},
        # Skid-steered robots are calibrated with it.
        {"wheel_separation_multiplier": 1.875},
    ],
)
def test_values_near_the_geometry_and_multipliers_are_in_order(change: dict[str, float]) -> None:
    assert _said(change) == []


def test_wrong_separation_is_told_with_its_effect() -> None:
    (item,) = _said({"wheel_separation": 1.0})
    assert "wheel_separation is 1 m, but 'left' and 'right' stand 0.5 m apart" in item.message
    assert item.message.endswith("yaw rates and odometry are off by a factor of 2")
    assert item.fix == "write wheel_separation: 0.5"


def test_diameter_in_place_of_a_radius_is_told() -> None:
    (item,) = _said({"wheel_radius": 0.2})
    assert "wheel_radius is 0.2 m, but the wheel of 'left' has a radius of 0.1 m" in item.message
    assert item.message.endswith("speeds and odometry are off by a factor of 0.5")


def test_radius_of_other_shapes_is_not_guessed() -> None:
    assert _said({"wheel_radius": 0.2}, Box((0.1, 0.1, 0.1))) == []
