"""Bases on wheels: every wheel rolls without slip about the same centre."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from tests.control.controllers.type_bench import Scenario, TypeBench
from tests.control.controllers.wheeled_bench import rolling, steered, twist
from tests.control.plant import PlantJoint

from gazelle.description.model import Collision, Cylinder, Joint, JointAxis, JointType, Link, Model
from gazelle.geometry import Pose

__all__ = ["ROWS"]

X, Z = 0.5, 0.25
Y = -0.2
RADIUS = 0.2
BASE, TRACK = 1.0, 0.6


@dataclass(frozen=True)
class _Wheels:
    """Where wheels are, in the frame that the odometry is about.

    Attributes:
        driven, steered: place (x, y) in m by joint.
        rollers: direction (x, y) that each wheel drives in, for wheels that let the base slide.
    """

    topic: str
    odometry: str
    driven: Mapping[str, tuple[float, float]]
    steered: Mapping[str, tuple[float, float]]
    driven_is_steered: bool = False
    angle_is_commanded: bool = False


def _velocity_at(place: tuple[float, float], turn: float) -> tuple[float, float]:
    return X - turn * place[1], turn * place[0]


def rolls_without_slip(bench: TypeBench, wheels: _Wheels) -> None:
    """Wheels turn at speed / radius and stand along their path; odometry is on the circle."""
    angle = math.atan(Z * BASE / X)
    bench.run(2.001, wheels.topic, twist(X, z=angle if wheels.angle_is_commanded else Z))
    for name, place in wheels.driven.items():
        forward, sideways = _velocity_at(place, Z)
        speed = math.hypot(forward, sideways) if wheels.driven_is_steered else forward
        assert bench.command(f"{name}/velocity") == pytest.approx(speed / RADIUS), name
    for name, place in wheels.steered.items():
        forward, sideways = _velocity_at(place, Z)
        wanted = math.atan2(sideways, forward)
        assert bench.command(f"{name}/position") == pytest.approx(wanted), name
    message = bench.messages(wheels.odometry)[-1]
    velocity, position = message.twist.twist, message.pose.pose.position
    assert (velocity.linear.x, velocity.angular.z) == pytest.approx((X, Z))
    turned = 2 * math.asin(message.pose.pose.orientation.z)
    assert turned == pytest.approx(Z * 2.0, abs=2e-3)
    radius = X / Z
    wanted = (radius * math.sin(turned), radius * (1 - math.cos(turned)))
    assert (position.x, position.y) == pytest.approx(wanted, abs=2e-3)


def slides(bench: TypeBench, about: tuple[str, str, Mapping[str, tuple[Any, Any]]]) -> None:
    """Each wheel turns as fast as the base moves along its drive; odometry is the twist's path."""
    topic, odometry, wheels = about
    bench.run(2.001, topic, twist(X, Y, Z))
    for name, (place, along) in wheels.items():
        there = np.array([X - Z * place[1], Y + Z * place[0]])
        assert bench.command(f"{name}/velocity") == pytest.approx(there @ along / RADIUS), name
    message = bench.messages(odometry)[-1]
    velocity, position = message.twist.twist, message.pose.pose.position
    assert (velocity.linear.x, velocity.linear.y, velocity.angular.z) == pytest.approx((X, Y, Z))
    # Ideal wheels stand at the first update, so 2 s of motion are measured.
    sine, cosine = math.sin(2 * Z) / Z, (1 - math.cos(2 * Z)) / Z
    wanted = (X * sine - Y * cosine, X * cosine + Y * sine)
    assert (position.x, position.y) == pytest.approx(wanted, abs=1e-9)


COVARIANCES = {
    "pose_covariance_diagonal": [0.001] * 6,
    "twist_covariance_diagonal": [0.002] * 6,
}
SIDES = {"left": (0.0, TRACK / 2), "right": (0.0, -TRACK / 2)}
FRONT = {"fl": (BASE, TRACK / 2), "fr": (BASE, -TRACK / 2)}
CORNERS = {
    f"{end}{side}": (x, y)
    for end, x in (("f", BASE / 2), ("r", -BASE / 2))
    for side, y in (("l", TRACK / 2), ("r", -TRACK / 2))
}
LIBRARY = ("~/reference", "~/odometry")


def _joints(*names: str, steers: tuple[str, ...] = ()) -> list[PlantJoint]:
    return [*rolling(*names), *steered(*steers)]


def _corners_model() -> Model:
    links, joints = [Link("base")], []
    wheel = (Collision("c", Cylinder(RADIUS, 0.1)),)
    kind, axis = JointType.CONTINUOUS, JointAxis()
    for name, (x, y) in CORNERS.items():
        links += [Link(f"{name}_knuckle"), Link(f"{name}_wheel", collisions=wheel)]
        at = Pose((x, y, 0.0))
        joints += [
            Joint(f"s{name}", kind, "base", f"{name}_knuckle", at, axis),
            Joint(name, kind, f"{name}_knuckle", f"{name}_wheel", at, axis),
        ]
    return Model("robot", links=tuple(links), joints=tuple(joints))


def _mecanum() -> dict[str, tuple[Any, Any]]:
    # A roller at 45 degrees passes on what the wheel's axle does not: drive (1, ∓1) in x and y.
    signs = {"fl": -1.0, "fr": 1.0, "rr": -1.0, "rl": 1.0}
    return {name: (CORNERS[name], np.array([1.0, sign])) for name, sign in signs.items()}


def _omni(count: int, radius: float) -> dict[str, tuple[Any, Any]]:
    angles = {f"w{k}": 2 * math.pi * k / count for k in range(count)}
    return {
        name: (
            (radius * math.cos(angle), radius * math.sin(angle)),
            np.array([math.sin(angle), -math.cos(angle)]),
        )
        for name, angle in angles.items()
    }


ROWS = (
    Scenario(
        "diff_drive_controller/DiffDriveController",
        rolls_without_slip,
        {
            "left_wheel": "left",
            "right_wheel": "right",
            "wheel_separation": TRACK,
            "wheel_radius": RADIUS,
            "publish_rate": 1000,
            **COVARIANCES,
        },
        _joints("left", "right"),
        about=_Wheels("~/cmd_vel", "~/odom", SIDES, {}),
    ),
    Scenario(
        "diff_drive_controller/DiffDriveController",
        rolls_without_slip,
        {
            "left_wheel_names": ["left"],
            "right_wheel_names": ["right"],
            "wheel_separation": TRACK,
            "wheel_radius": RADIUS,
            "publish_rate": 2000.0,
        },
        _joints("left", "right"),
        2,
        _Wheels("~/cmd_vel", "~/odom", SIDES, {}),
    ),
    Scenario(
        "ackermann_steering_controller/AckermannSteeringController",
        rolls_without_slip,
        {
            "rear_wheel": "rear",
            "front_steer": "steer",
            "wheel_separation_h": BASE,
            "wheel_radius": RADIUS,
            "publish_rate": 1000,
            **COVARIANCES,
        },
        _joints("rear", steers=("steer",)),
        about=_Wheels(
            "~/cmd_vel",
            "~/odom",
            {"rear": (0.0, 0.0)},
            {"steer": (BASE, 0.0)},
            angle_is_commanded=True,
        ),
    ),
    Scenario(
        "ackermann_steering_controller/AckermannSteeringController",
        rolls_without_slip,
        {
            "traction_joints_names": ["right", "left"],
            "steering_joints_names": ["fr", "fl"],
            "wheelbase": BASE,
            "traction_wheels_radius": RADIUS,
            "traction_track_width": TRACK,
        },
        _joints("right", "left", steers=("fr", "fl")),
        2,
        _Wheels(*LIBRARY, SIDES, FRONT),
    ),
    Scenario(
        "bicycle_steering_controller/BicycleSteeringController",
        rolls_without_slip,
        {
            "traction_joints_names": ["rear"],
            "steering_joints_names": ["front"],
            "wheelbase": BASE,
            "traction_wheel_radius": RADIUS,
        },
        _joints("rear", steers=("front",)),
        2,
        _Wheels(*LIBRARY, {"rear": (0.0, 0.0)}, {"front": (BASE, 0.0)}),
    ),
    Scenario(
        "tricycle_steering_controller/TricycleSteeringController",
        rolls_without_slip,
        {
            "traction_joints_names": ["right", "left"],
            "steering_joints_names": ["front"],
            "wheelbase": BASE,
            "traction_wheels_radius": RADIUS,
            "traction_track_width": TRACK,
        },
        _joints("right", "left", steers=("front",)),
        2,
        _Wheels(*LIBRARY, SIDES, {"front": (BASE, 0.0)}),
    ),
    Scenario(
        "tricycle_controller/TricycleController",
        rolls_without_slip,
        {
            "traction_joint_name": "wheel",
            "steering_joint_name": "steer",
            "wheelbase": BASE,
            "wheel_radius": RADIUS,
        },
        _joints("wheel", steers=("steer",)),
        2,
        _Wheels(
            "~/cmd_vel",
            "~/odom",
            {"wheel": (BASE, 0.0)},
            {"steer": (BASE, 0.0)},
            driven_is_steered=True,
        ),
    ),
    Scenario(
        "four_wheel_steering_controller/FourWheelSteeringController",
        rolls_without_slip,
        {
            "front_wheel": ["fl", "fr"],
            "rear_wheel": ["rl", "rr"],
            "front_steering": ["sfl", "sfr"],
            "rear_steering": ["srl", "srr"],
            "publish_rate": 1000,
            **COVARIANCES,
        },
        _joints(*CORNERS, steers=tuple(f"s{name}" for name in CORNERS)),
        about=_Wheels(
            "~/cmd_vel",
            "~/odom",
            CORNERS,
            {f"s{name}": place for name, place in CORNERS.items()},
            driven_is_steered=True,
        ),
        model=_corners_model(),
    ),
    Scenario(
        "mecanum_drive_controller/MecanumDriveController",
        slides,
        {
            "front_left_wheel_command_joint_name": "fl",
            "front_right_wheel_command_joint_name": "fr",
            "rear_right_wheel_command_joint_name": "rr",
            "rear_left_wheel_command_joint_name": "rl",
            "kinematics": {
                "wheels_radius": RADIUS,
                "sum_of_robot_center_projection_on_X_Y_axis": BASE / 2 + TRACK / 2,
                "base_frame_offset": {"x": 0.0, "y": 0.0, "theta": 0.0},
            },
            "reference_timeout": 0.5,
        },
        _joints(*CORNERS),
        2,
        (*LIBRARY, _mecanum()),
    ),
    Scenario(
        "omni_wheel_drive_controller/OmniWheelDriveController",
        slides,
        {
            "wheel_names": ["w0", "w1", "w2"],
            "wheel_offset": 0.0,
            "robot_radius": 0.3,
            "wheel_radius": RADIUS,
        },
        _joints("w0", "w1", "w2"),
        2,
        ("~/cmd_vel", "~/odom", _omni(3, 0.3)),
    ),
)
