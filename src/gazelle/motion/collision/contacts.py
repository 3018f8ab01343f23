"""What of a scene touches, how deep and how near: MuJoCo's answers."""

from __future__ import annotations

import copy
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from gazelle.diagnostics import Diagnostics
from gazelle.engine.mujoco_library import mujoco
from gazelle.motion.collision.collision_model import (
    CollisionBody,
    CollisionModel,
    Owner,
    build_collision_model,
    may_touch,
)
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.model import JointGroup
from gazelle.motion.scene import PlanningScene

__all__ = ["CollisionContact", "SceneContacts"]

_ACTIVE, _STILL = 1, 2


@dataclass(frozen=True)
class CollisionContact:
    """Two that overlap.

    Attributes:
        first: a link, thing or attached thing.
        second: what it overlaps with.
        depth_m: how far they reach into each other; negative for a padded link that is near.
        position_m: a point between both surfaces, in the robot's frame.
        normal: direction from the first to the second.
    """

    first: Owner
    second: Owner
    depth_m: float
    position_m: tuple[float, float, float] = (0.0, 0.0, 0.0)
    normal: tuple[float, float, float] = (0.0, 0.0, 1.0)

    def __str__(self) -> str:
        return f"{self.first} collides with {self.second} ({1000 * self.depth_m:.1f} mm deep)"


class SceneContacts:
    """A scene compiled for MuJoCo, once it is asked something.

    Not for use in several threads at once; make a `copy` for each.

    Attributes:
        scene: what there is.
        group: with one, only pairs count of which it moves at least one.
    """

    def __init__(
        self,
        scene: PlanningScene,
        group: JointGroup | None,
        bodies: Sequence[CollisionBody],
        diagnostics: Diagnostics,
    ) -> None:
        self.scene = scene
        self.group = group
        self._bodies = bodies
        self._diagnostics = diagnostics

    def copy(self) -> SceneContacts:
        """Return one that another thread may use."""
        other = copy.copy(self)
        other.__dict__.pop("_data", None)
        return other

    def follow(self, scene: PlanningScene) -> SceneContacts:
        """Return one of a scene with the same things elsewhere; what is compiled is kept."""
        other = self.copy()
        other.scene = scene
        return other

    def touches(self, q: FloatArray) -> bool:
        """Return whether something touches at `q` (n,) that could be elsewhere."""
        data = self._data
        data.qpos[self._addresses] = q
        for follower, leader, factor, offset in self._rules:
            data.qpos[follower] = factor * q[leader] + offset
        mujoco.mj_kinematics(self._model, data)
        mujoco.mj_collision(self._model, data)
        return bool(data.ncon > 0)

    def contacts(self, q: FloatArray) -> Iterator[CollisionContact]:
        """Yield all contacts at `q` (n,) of pairs that could be elsewhere."""
        self.touches(q)
        owners = self._built.owners
        for contact in self._data.contact:
            first, second = sorted((int(contact.geom1), int(contact.geom2)))
            sign = 1.0 if first == contact.geom1 else -1.0
            x, y, z = (float(value) for value in contact.pos)
            u, v, w = (sign * float(value) for value in contact.frame[:3])
            depth = -float(contact.dist)
            yield CollisionContact(owners[first], owners[second], depth, (x, y, z), (u, v, w))

    def constant(self) -> Iterator[CollisionContact]:
        """Yield what overlaps in every configuration: solids that nothing moves apart."""
        model, owners, active = self._model, self._built.owners, self._active()
        weld = model.body_weldid[model.geom_bodyid]
        still = np.isin(weld, [0, *(model.body_weldid[model.body_mocapid >= 0])])
        for first in range(model.ngeom):
            for second in range(first + 1, model.ngeom):
                together = weld[first] == weld[second] or (still[first] and still[second])
                if not together or not (active[first] or active[second]):
                    continue
                one, other = owners[first], owners[second]
                if one is other or may_touch(self.scene, one, other):
                    continue
                found = mujoco.mj_geomDistance(model, self._data, first, second, 0.01, None)
                if found < 0:
                    yield CollisionContact(one, other, -float(found))

    def distance_m(self, q: FloatArray, most_m: float) -> float:
        """Return the distance at `q` (n,) to what may not be touched, `most_m` at most."""
        self.touches(q)
        nearest = most_m
        for first, second in self._pairs():
            found = mujoco.mj_geomDistance(self._model, self._data, first, second, most_m, None)
            nearest = min(nearest, float(found))
        return nearest

    @cached_property
    def _built(self) -> CollisionModel:
        built = build_collision_model(self.scene, self._bodies, self._diagnostics)
        active = np.array([self._moves(owner) for owner in built.owners], dtype=np.bool_)
        built.model.geom_contype[:] = np.where(active, _ACTIVE, _STILL)
        built.model.geom_conaffinity[:] = np.where(active, _ACTIVE | _STILL, _ACTIVE)
        return built

    @property
    def _model(self) -> Any:
        return self._built.model

    @cached_property
    def _data(self) -> Any:
        data = mujoco.MjData(self._model)
        for name, number in self._built.mocaps.items():
            pose = self.scene.objects[name].T_frame_object
            data.mocap_pos[number] = pose.position_m
            data.mocap_quat[number] = pose.quat_wxyz
        data.qpos[self._built.addresses] = self.scene.positions
        mujoco.mj_kinematics(self._model, data)
        return data

    @cached_property
    def _addresses(self) -> Any:
        indices = np.arange(len(self.scene.robot.variables))
        return self._built.addresses[indices if self.group is None else self.group.indices]

    @cached_property
    def _rules(self) -> tuple[tuple[int, int, float, float], ...]:
        if self.group is None:
            return ()
        rules = self.scene.robot.followers_of(self.group.variables)
        places = self._built.addresses
        return tuple(
            (int(places[place]), leader, factor, offset) for place, leader, factor, offset in rules
        )

    def _moves(self, owner: Owner) -> bool:
        if self.group is None:
            return owner.kind != "object"
        return owner.link in self.group.moved_links

    def _active(self) -> Any:
        return np.array([self._moves(owner) for owner in self._built.owners], dtype=np.bool_)

    def _pairs(self) -> Iterator[tuple[int, int]]:
        owners, active = self._built.owners, self._active()
        for first in range(len(owners)):
            for second in range(first + 1, len(owners)):
                if not (active[first] or active[second]) or owners[first] is owners[second]:
                    continue
                if not may_touch(self.scene, owners[first], owners[second]):
                    yield first, second
