"""What of a robot collides, with what and how deep."""

from __future__ import annotations

import copy
import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from gazelle.diagnostics import Diagnostics
from gazelle.engine.library import mujoco
from gazelle.motion.collision.building import (
    CollisionModel,
    Owner,
    build_collision_model,
    may_touch,
)
from gazelle.motion.model import JointGroup
from gazelle.motion.scene import PlanningScene
from gazelle.motion.space import FloatArray

__all__ = ["CollisionChecker", "CollisionContact"]

_LIMIT_TOLERANCE = 1e-9
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


class CollisionChecker:
    """Says whether a group's configurations are free; the `Validity` of motion planning.

    With a group, only pairs count of which the group moves at least one, as in MoveIt: what is
    wrong elsewhere does not keep an arm from moving. Not for use in several threads at once; make
    a `copy` for each.

    Attributes:
        scene: what there is; joints outside the group stand where it says.
        group: whose configurations are asked about; None for whole robots.
        diagnostics: shapes that cannot be collided.
    """

    def __init__(
        self,
        scene: PlanningScene,
        group: str | JointGroup | None = None,
        *,
        diagnostics: Diagnostics | None = None,
    ) -> None:
        self.scene = scene
        self.group = scene.robot.group(group) if isinstance(group, str) else group
        self.diagnostics = Diagnostics() if diagnostics is None else diagnostics
        self._built = build_collision_model(scene, self.diagnostics)
        self._model = self._built.model
        active = self._active()
        self._model.geom_contype[:] = np.where(active, _ACTIVE, _STILL)
        self._model.geom_conaffinity[:] = np.where(active, _ACTIVE | _STILL, _ACTIVE)
        self._prepare()

    def copy(self) -> CollisionChecker:
        """Return a checker of the same scene that another thread may use."""
        other = copy.copy(self)
        other._set_up_data()
        return other

    def follow(self, scene: PlanningScene) -> CollisionChecker:
        """Return a checker of another scene; nothing is rebuilt when only poses differ."""
        old = self.scene
        same_things = scene.objects.keys() == old.objects.keys() and all(
            item.shapes is old.objects[name].shapes for name, item in scene.objects.items()
        )
        same = scene.robot is old.robot and scene.attached == old.attached
        same = same and scene.allowed == old.allowed and scene.padding_m == old.padding_m
        if not (same and same_things):
            return CollisionChecker(scene, self.group, diagnostics=self.diagnostics)
        other = copy.copy(self)
        other.scene = scene
        other._prepare()
        return other

    def is_valid(self, q: FloatArray) -> bool:
        """Return whether `q` is within the limits and free of collisions."""
        if ((q < self._lower) | (q > self._upper)).any():
            return False
        return not self._constant and not self._touches(q)

    def motion_is_valid(self, q0: FloatArray, q1: FloatArray, step: float) -> bool:
        """Return whether the straight way is free; see `Validity`."""
        if not self.is_valid(q1):
            return False
        way = q1 - q0
        count = math.ceil(float(np.linalg.norm(way)) / step)
        # The middle first, then the middles of the halves: what is wrong is found early.
        stride = 1
        while stride < count:
            stride *= 2
        stride //= 2
        while stride >= 1:
            for index in range(stride, count, 2 * stride):
                if self._touches(q0 + way * (index / count)):
                    return False
            stride //= 2
        return True

    def why(self, q: FloatArray) -> str:
        """Return what forbids `q`: joints outside their limits, pairs that collide."""
        reasons: list[str] = []
        if self.group is not None:
            reasons += self.group.space.outside(q, _LIMIT_TOLERANCE)
        reasons += [str(contact) for contact in self.contacts(q)]
        return "; ".join(reasons)

    def contacts(self, q: FloatArray) -> tuple[CollisionContact, ...]:
        """Return the deepest contact of every pair that collides, the deepest pair first."""
        self._touches(q)
        found: dict[tuple[str, str], CollisionContact] = {}
        for contact in (*self._constant, *self._current()):
            key = contact.first.name, contact.second.name
            if key not in found or contact.depth_m > found[key].depth_m:
                found[key] = contact
        return tuple(sorted(found.values(), key=lambda item: -item.depth_m))

    def distance_m(self, q: FloatArray, *, most_m: float = 1.0) -> float:
        """Return the distance to the nearest thing that may not be touched.

        It is negative inside and `most_m` when nothing is nearer.
        """
        self._touches(q)
        nearest = min((-contact.depth_m for contact in self._constant), default=most_m)
        for first, second in self._pairs():
            found = mujoco.mj_geomDistance(self._model, self._data, first, second, most_m, None)
            nearest = min(nearest, float(found))
        return nearest

    def _prepare(self) -> None:
        self._kinematics, self._collision = mujoco.mj_kinematics, mujoco.mj_collision
        self._set_up_variables(self._built)
        self._set_up_data()
        self._constant = tuple(self._constant_contacts(self._active()))

    def _set_up_data(self) -> None:
        built, scene = self._built, self.scene
        self._data = mujoco.MjData(self._model)
        for name, number in built.mocaps.items():
            pose = scene.objects[name].T_frame_object
            self._data.mocap_pos[number] = pose.position_m
            self._data.mocap_quat[number] = pose.quat_wxyz
        self._data.qpos[built.addresses] = scene.positions
        self._kinematics(self._model, self._data)

    def _set_up_variables(self, built: CollisionModel) -> None:
        robot, group = self.scene.robot, self.group
        indices = np.arange(len(robot.variables)) if group is None else group.indices
        self._addresses = built.addresses[indices]
        lower = np.full(len(indices), -np.inf)
        upper = np.full(len(indices), np.inf)
        if group is not None:
            free = group.space.continuous
            lower = np.where(free, -np.inf, group.space.lower - _LIMIT_TOLERANCE)
            upper = np.where(free, np.inf, group.space.upper + _LIMIT_TOLERANCE)
        self._lower, self._upper = lower, upper
        own = set() if group is None else set(group.variables)
        rules = [
            (built.addresses[place], group.variables.index(leader), factor, offset)
            for place, name in enumerate(robot.variables)
            for leader, factor, offset in (robot.mimic_of(name),)
            if group is not None and leader in own and leader != name
        ]
        self._followers = np.array([rule[0] for rule in rules], dtype=np.intp)
        self._leaders = np.array([rule[1] for rule in rules], dtype=np.intp)
        self._factors = np.array([rule[2] for rule in rules])
        self._offsets = np.array([rule[3] for rule in rules])

    def _touches(self, q: FloatArray) -> bool:
        data = self._data
        data.qpos[self._addresses] = q
        if len(self._followers):
            data.qpos[self._followers] = self._factors * q[self._leaders] + self._offsets
        self._kinematics(self._model, data)
        self._collision(self._model, data)
        return bool(data.ncon > 0)

    def _active(self) -> Any:
        owners = self._built.owners
        if self.group is None:
            return np.array([owner.kind != "object" for owner in owners], dtype=np.bool_)
        moved = set(self.group.moved_links)
        return np.array([owner.link in moved for owner in owners], dtype=np.bool_)

    def _current(self) -> Iterator[CollisionContact]:
        owners = self._built.owners
        for contact in self._data.contact:
            first, second = sorted((int(contact.geom1), int(contact.geom2)))
            sign = 1.0 if first == contact.geom1 else -1.0
            x, y, z = (float(value) for value in contact.pos)
            u, v, w = (sign * float(value) for value in contact.frame[:3])
            depth = -float(contact.dist)
            yield CollisionContact(owners[first], owners[second], depth, (x, y, z), (u, v, w))

    def _constant_contacts(self, active: Any) -> Iterator[CollisionContact]:
        """Yield what overlaps in every configuration: solids that nothing moves apart."""
        model, owners = self._model, self._built.owners
        group = model.body_weldid[model.geom_bodyid]
        still = np.isin(group, [0, *(model.body_weldid[model.body_mocapid >= 0])])
        for first in range(model.ngeom):
            for second in range(first + 1, model.ngeom):
                together = group[first] == group[second] or (still[first] and still[second])
                if not together or not (active[first] or active[second]):
                    continue
                one, other = owners[first], owners[second]
                if one is other or may_touch(self.scene, one, other):
                    continue
                found = mujoco.mj_geomDistance(model, self._data, first, second, 0.01, None)
                if found < 0:
                    yield CollisionContact(one, other, -float(found))

    def _pairs(self) -> Iterator[tuple[int, int]]:
        owners, active = self._built.owners, self._active()
        for first in range(len(owners)):
            for second in range(first + 1, len(owners)):
                if not (active[first] or active[second]) or owners[first] is owners[second]:
                    continue
                if not may_touch(self.scene, owners[first], owners[second]):
                    yield first, second
