"""The world as rays meet it: one instance per collision or visual, moved with the links."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from threading import RLock
from typing import Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Collision, Light, Link, Material, Model, Visual, World
from gazelle.diagnostics import Diagnostics
from gazelle.geometry import Pose
from gazelle.sensors.embree import InstancedScene
from gazelle.sensors.ray_surfaces import Surface, surface_of

__all__ = ["SHADOW_BIT", "Instance", "LinkPoses", "PlacedLight", "RayScene", "SceneKind"]

SceneKind = Literal["visuals", "collisions"]

SHADOW_BIT = 1 << 31
"""Bit of an instance's mask that says it casts shadows; the others are its visibility flags."""


class LinkPoses(Protocol):
    """What `RayScene.update` reads of an engine's snapshot."""

    @property
    def link_names(self) -> Sequence[str]:
        """``model::link``, one per row of `T`."""

    @property
    def T(self) -> NDArray[np.float64]:
        """(N, 7): x y z in metres, qx qy qz qw, of each link in the world."""


@dataclass(frozen=True, slots=True, eq=False)
class Instance:
    """One collision or visual in the world.

    Attributes:
        link: ``model::link`` that carries it.
        name: of the collision or visual.
        surface: what it shows; shared.
        T_link_surface: 4×4, with the shape's scale.
        material: overrides the surface's own when not None.
        opacity: 1 − SDF ``<transparency>``.
        retro: ``<laser_retro>``.
        mask: visibility flags and `SHADOW_BIT`.
    """

    link: str
    name: str
    surface: Surface
    T_link_surface: NDArray[np.float64]
    material: Material | None = None
    opacity: float = 1.0
    retro: float = 0.0
    mask: int = 0xFFFFFFFF


@dataclass(frozen=True, slots=True)
class PlacedLight:
    """A light and where it stands; `link` is empty for the world's own lights."""

    light: Light
    link: str
    T_world_light: Pose


class RayScene:
    """Everything a ray can meet in a world, and the lights.

    `scan` and `render` hold `lock` while they work, and so does `update`: a scene shows one
    moment at a time. Threads that must not wait for each other need scenes of their own;
    surfaces are shared between scenes.

    Attributes:
        world: what it was built from.
        kind: ``visuals`` (cameras, GPU lasers) or ``collisions`` (``ray`` sensors).
        diagnostics: what was found about meshes on the way.
        instances: in the order of Embree's ``instID``.
        T_world_surface: (N, 4, 4) float32 of the instances, as of the last update.
        retro: (N,) float32 ``laser_retro`` of the instances.
        revision: raised by each `rebuild`.
        lock: held by whoever uses or changes the scene.
    """

    def __init__(
        self,
        world: World,
        *,
        kind: SceneKind = "visuals",
        diagnostics: Diagnostics | None = None,
    ) -> None:
        """Build the scene with every link at its initial pose.

        Raises:
            EmbreeError: Embree cannot be loaded.
        """
        self.kind: SceneKind = kind
        self.diagnostics = Diagnostics() if diagnostics is None else diagnostics
        self.lock = RLock()
        self.revision = 0
        self.rebuild(world)

    def rebuild(self, world: World) -> None:
        """Take over a world whose models changed; links stand at their initial poses again.

        Meshes that are still used are not built again. Call `update` afterwards.
        """
        with self.lock:
            self.world = world
            self.instances = tuple(_instances(world, self.kind, self.diagnostics))
            self._start = _start_matrices(world)
            self.T_world_surface = np.zeros((len(self.instances), 4, 4), np.float32)
            self._local = np.zeros((len(self.instances), 4, 4))
            for number, instance in enumerate(self.instances):
                self._local[number] = instance.T_link_surface
                self.T_world_surface[number] = self._start[instance.link] @ instance.T_link_surface
            self.retro = np.array([item.retro for item in self.instances], np.float32)
            self._scene = InstancedScene(
                [item.surface.sub_scene for item in self.instances],
                self.T_world_surface,
                [item.mask for item in self.instances],
            )
            self._names: Sequence[str] | None = None
            self._last = np.zeros((0, 7))
            self.revision += 1

    @property
    def handle(self) -> int:
        """Address of the ``RTCScene``."""
        return self._scene.handle

    def update(self, snapshot: LinkPoses) -> int:
        """Move the instances of links that moved since the last update.

        Links that the snapshot does not name stay where they are (static models).

        Returns:
            how many instances moved.
        """
        with self.lock:
            if snapshot.link_names is not self._names:
                self._learn_names(snapshot.link_names)
            moved_rows = (self._last != snapshot.T).any(axis=1)
            if not moved_rows.any():
                return 0
            self._last = np.array(snapshot.T, np.float64)
            moved = np.flatnonzero(moved_rows[self._row] & self._named)
            if len(moved):
                matrices = _matrices(self._last[self._row[moved]])
                self.T_world_surface[moved] = matrices @ self._local[moved]
                self._scene.move(moved, self.T_world_surface)
            return len(moved)

    def lights(self) -> tuple[PlacedLight, ...]:
        """Return the world's and the links' lights where they are now."""
        placed = [PlacedLight(item, "", item.T_parent_light) for item in self.world.lights]
        for model in self.world.models:
            for link in model.links:
                if link.lights:
                    name = f"{model.name}::{link.name}"
                    T_world_link = self.link_pose(name)
                    placed += [
                        PlacedLight(item, name, T_world_link @ item.T_parent_light)
                        for item in link.lights
                    ]
        return tuple(placed)

    def link_pose(self, name: str) -> Pose:
        """Return where a link (``model::link``) is, as of the last update.

        Raises:
            KeyError: the world has no such link.
        """
        if self._names is not None and name in self._names:
            x, y, z, *quat = self._last[list(self._names).index(name)].tolist()
            return Pose((x, y, z), (quat[0], quat[1], quat[2], quat[3]))
        return Pose.from_matrix(self._start[name])

    def _learn_names(self, names: Sequence[str]) -> None:
        rows = {name: row for row, name in enumerate(names)}
        self._row = np.array([rows.get(item.link, 0) for item in self.instances], np.intp)
        self._named = np.array([item.link in rows for item in self.instances], bool)
        self._last = np.full((len(names), 7), np.nan)
        self._names = names


def _instances(world: World, kind: SceneKind, diagnostics: Diagnostics) -> list[Instance]:
    found = []
    for model in world.models:
        for link in model.links:
            shapes = link.visuals if kind == "visuals" else link.collisions
            for item in shapes:
                made = _instance(model, link, item, diagnostics)
                if made is not None:
                    found.append(made)
    return found


def _instance(
    model: Model, link: Link, item: Visual | Collision, diagnostics: Diagnostics
) -> Instance | None:
    found = surface_of(item.shape, diagnostics, endless=isinstance(item, Collision))
    if found is None:
        return None
    surface, scale = found
    name = f"{model.name}::{link.name}"
    if isinstance(item, Collision):
        T_link_surface = item.T_link_collision.matrix() @ scale
        return Instance(name, item.name, surface, T_link_surface, retro=item.laser_retro)
    shadow = SHADOW_BIT if item.cast_shadows else 0
    return Instance(
        name,
        item.name,
        surface,
        item.T_link_visual.matrix() @ scale,
        material=item.material,
        opacity=1.0 - item.transparency,
        retro=item.laser_retro,
        mask=(item.visibility_flags & ~SHADOW_BIT) | shadow,
    )


def _start_matrices(world: World) -> dict[str, NDArray[np.float64]]:
    return {
        f"{model.name}::{link.name}": (model.T_world_model @ link.T_model_link).matrix()
        for model in world.models
        for link in model.links
    }


def _matrices(poses: NDArray[np.float64]) -> NDArray[np.float64]:
    """Turn (N, 7) poses into (N, 4, 4) matrices."""
    x, y, z, w = poses[:, 3:].T
    matrices = np.zeros((len(poses), 4, 4))
    matrices[:, 0, 0] = 1 - 2 * (y * y + z * z)
    matrices[:, 0, 1] = 2 * (x * y - z * w)
    matrices[:, 0, 2] = 2 * (x * z + y * w)
    matrices[:, 1, 0] = 2 * (x * y + z * w)
    matrices[:, 1, 1] = 1 - 2 * (x * x + z * z)
    matrices[:, 1, 2] = 2 * (y * z - x * w)
    matrices[:, 2, 0] = 2 * (x * z - y * w)
    matrices[:, 2, 1] = 2 * (y * z + x * w)
    matrices[:, 2, 2] = 1 - 2 * (x * x + y * y)
    matrices[:, :3, 3] = poses[:, :3]
    matrices[:, 3, 3] = 1
    return matrices
