"""Small worlds whose every distance is known on paper."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray

from gazelle.description.model import (
    Box,
    Collision,
    Light,
    Link,
    Material,
    Model,
    Scene,
    Shape,
    Visual,
    World,
)
from gazelle.geometry import IDENTITY_POSE, Pose
from gazelle.sensors import RayScene


@dataclass(frozen=True)
class Poses:
    """A snapshot as the engine makes them."""

    link_names: tuple[str, ...]
    T: NDArray[np.float64]


@pytest.fixture(scope="session")
def poses() -> Callable[..., Poses]:
    def make(**links: Pose) -> Poses:
        rows = [[*pose.position_m, *pose.quat_xyzw] for pose in links.values()]
        return Poses(tuple(f"thing::{name}" for name in links), np.array(rows))

    return make


@pytest.fixture(scope="session")
def link() -> Callable[..., Link]:
    """A link whose one visual and one collision have the same shape."""

    def make(
        name: str,
        shape: Shape,
        pose: Pose = IDENTITY_POSE,
        *,
        material: Material | None = None,
        retro: float = 0.0,
        **visual: object,
    ) -> Link:
        seen = Visual(f"{name}_visual", shape, material=material, laser_retro=retro, **visual)
        touched = Collision(f"{name}_collision", shape, laser_retro=retro)
        return Link(name, pose, visuals=(seen,), collisions=(touched,))

    return make


@pytest.fixture(scope="session")
def world_of() -> Callable[..., World]:
    def make(*links: Link, lights: tuple[Light, ...] = (), **scene: object) -> World:
        return World(models=(Model("thing", links=links),), lights=lights, scene=Scene(**scene))

    return make


@pytest.fixture
def scene_of(world_of: Callable[..., World]) -> Callable[..., RayScene]:
    def make(*links: Link, kind: str = "visuals", **world: object) -> RayScene:
        return RayScene(world_of(*links, **world), kind=kind)

    return make


@pytest.fixture(scope="session")
def room(link: Callable[..., Link]) -> tuple[Link, ...]:
    """Walls at x = ±4, y = ±3 and a floor at z = 0."""
    return (
        link("east", Box((0.2, 10.0, 3.0)), Pose((4.1, 0.0, 1.5))),
        link("west", Box((0.2, 10.0, 3.0)), Pose((-4.1, 0.0, 1.5))),
        link("north", Box((10.0, 0.2, 3.0)), Pose((0.0, 3.1, 1.5))),
        link("south", Box((10.0, 0.2, 3.0)), Pose((0.0, -3.1, 1.5))),
        link("floor", Box((20.0, 20.0, 1.0)), Pose((0.0, 0.0, -0.5))),
    )
