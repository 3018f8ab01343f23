"""Small worlds for the laws."""

from __future__ import annotations

import math
from types import SimpleNamespace

import pytest

from gazelle.description.model import (
    Box,
    Collision,
    Cylinder,
    Inertial,
    Joint,
    JointAxis,
    JointType,
    Link,
    Model,
    Physics,
    Plane,
    Sphere,
    Surface,
    World,
)
from gazelle.engine import Engine
from gazelle.geometry import Pose

G = 9.8
RESTING = Pose((0, 0, 0.1))
ORIGIN = Pose()


def ground(tilt: float = 0.0, **surface) -> Model:
    plane = Collision("collision", Plane(), surface=Surface(**surface))
    pose = Pose.from_xyz_rpy((0.0, 0.0, 0.0), (0.0, tilt, 0.0))
    return Model("ground", pose, static=True, links=(Link("link", collisions=(plane,)),))


def block(name="block", pose=RESTING, mass=2.0, edge=0.2, **surface) -> Model:
    inertia = mass * edge**2 / 6
    link = Link(
        "link",
        inertial=Inertial(mass, inertia_kg_m2=(inertia, 0, 0, inertia, 0, inertia)),
        collisions=(Collision("box", Box((edge, edge, edge)), surface=Surface(**surface)),),
    )
    return Model(name, pose, links=(link,))


def ball(name="ball", pose=RESTING, mass=1.0, radius=0.1, **surface) -> Model:
    inertia = 0.4 * mass * radius**2
    link = Link(
        "link",
        inertial=Inertial(mass, inertia_kg_m2=(inertia, 0, 0, inertia, 0, inertia)),
        collisions=(Collision("sphere", Sphere(radius), surface=Surface(**surface)),),
    )
    return Model(name, pose, links=(link,))


def roller(name="roller", pose=ORIGIN, mass=1.0, radius=0.1, length=0.2) -> Model:
    spin, turn = 0.5 * mass * radius**2, mass * (3 * radius**2 + length**2) / 12
    lying = Pose.from_xyz_rpy((0, 0, 0), (math.pi / 2, 0, 0))
    link = Link(
        "link",
        inertial=Inertial(mass, inertia_kg_m2=(turn, 0, 0, spin, 0, turn)),
        collisions=(Collision("cylinder", Cylinder(radius, length), lying),),
    )
    return Model(name, pose, links=(link,))


def on_slope(tilt: float, height: float, along: float = 0.0) -> Pose:
    sin, cos = math.sin(tilt), math.cos(tilt)
    point = (height * sin + along * cos, 0.0, height * cos - along * sin)
    return Pose.from_xyz_rpy(point, (0.0, tilt, 0.0))


def arm(kind=JointType.REVOLUTE, axis=None, mass=1.0, length=1.0, name="arm", **more) -> Model:
    """A point mass at the end of a light rod that hangs on the world at its origin."""
    point = Inertial(mass, Pose((0.0, 0.0, -length)), (1e-6, 0, 0, 1e-6, 0, 1e-6))
    joint = Joint("joint", kind, "world", "rod", axis=axis or JointAxis((0, 1, 0)), **more)
    return Model(name, links=(Link("rod", inertial=point),), joints=(joint,))


def wheel(inertia=0.01, name="wheel", mass=1.0, **axis) -> Model:
    """A wheel on the world, turning about z: gravity does not matter."""
    inertial = Inertial(mass, inertia_kg_m2=(inertia, 0, 0, inertia, 0, inertia))
    joint = Joint("joint", JointType.CONTINUOUS, "world", "disc", axis=JointAxis(**axis))
    return Model(name, links=(Link("disc", inertial=inertial),), joints=(joint,))


def engine(*models: Model, step_s: float = 0.001, **world) -> Engine:
    return Engine(World(models=models, physics=Physics(max_step_size_s=step_s), **world))


@pytest.fixture(scope="session")
def build() -> SimpleNamespace:
    """Builders of models and engines."""
    return SimpleNamespace(
        G=G,
        arm=arm,
        ball=ball,
        block=block,
        engine=engine,
        ground=ground,
        on_slope=on_slope,
        roller=roller,
        wheel=wheel,
    )
