"""What of a robot collides, with what and how deep."""

from __future__ import annotations

import copy
from dataclasses import replace
from functools import cached_property

import numpy as np

from gazelle.diagnostics import Diagnostics
from gazelle.motion.collision.collision_model import collision_bodies
from gazelle.motion.collision.contacts import CollisionContact, SceneContacts
from gazelle.motion.collision.continuous import Sweeper, Verdict
from gazelle.motion.joint_space import FloatArray, SweptMotions
from gazelle.motion.model import JointGroup
from gazelle.motion.scene import PlanningScene

__all__ = ["CollisionChecker"]

_LIMIT_TOLERANCE = 1e-9
_ENDLESS = float(np.finfo(np.float64).max)
"""What a joint without limits must be within: what is no number is nowhere."""


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
        self._bodies = collision_bodies(scene, self.diagnostics)
        self._sweeper = Sweeper(scene, self.group, self._bodies)
        self._contacts = SceneContacts(scene, self.group, self._bodies, self.diagnostics)
        size = len(scene.robot.variables if self.group is None else self.group.variables)
        self._lower, self._upper = np.full(size, -_ENDLESS), np.full(size, _ENDLESS)
        if self.group is not None:
            space = self.group.space
            self._lower = np.where(space.continuous, -_ENDLESS, space.lower - _LIMIT_TOLERANCE)
            self._upper = np.where(space.continuous, _ENDLESS, space.upper + _LIMIT_TOLERANCE)

    def copy(self) -> CollisionChecker:
        """Return a checker of the same scene that another thread may use."""
        other = copy.copy(self)
        other._sweeper = self._sweeper.copy()
        other._contacts = self._contacts.copy()
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
        other.__dict__.pop("_constant", None)
        other.scene = scene
        other._bodies = tuple(
            replace(body, T_frame_body=scene.objects[body.owner.name].T_frame_object)
            if body.is_object
            else body
            for body in self._bodies
        )
        other._sweeper = self._sweeper.follow(scene, other._bodies)
        other._contacts = self._contacts.follow(scene)
        return other

    def is_valid(self, q: FloatArray) -> bool:
        """Return whether `q` (n,) is within the limits and free of collisions."""
        if not self._is_within(q) or self._constant:
            return False
        verdict = self._sweeper.state(q)
        if verdict is Verdict.DOUBTFUL:
            return not self._contacts.touches(q)
        return verdict is Verdict.FREE

    def motion_is_valid(self, q0: FloatArray, q1: FloatArray, step: float) -> bool:
        """Return whether the straight way between `q0` and `q1`, (n,), is free; see `Validity`.

        Wherever there is room, all of it is known to be free, not only states on it.
        """
        if not self._is_within(q1) or self._constant:
            return False
        verdict, doubtful = self._sweeper.motion(q0, q1, step)
        if verdict is Verdict.DOUBTFUL:
            return not any(self._contacts.touches(q) for q in doubtful)
        return verdict is Verdict.FREE

    def swept_motions(self) -> SweptMotions | None:
        """Return what kernels need to check motions, None where something overlaps for good."""
        if self._constant:
            return None
        return SweptMotions(self._lower, self._upper, self._sweeper.arguments)

    def why(self, q: FloatArray) -> str:
        """Return what forbids `q` (n,): joints outside their limits, pairs that collide."""
        reasons: list[str] = []
        if self.group is not None:
            reasons += self.group.space.outside(q, _LIMIT_TOLERANCE)
        reasons += [str(contact) for contact in self.contacts(q)]
        return "; ".join(reasons)

    def contacts(self, q: FloatArray) -> tuple[CollisionContact, ...]:
        """Return the deepest contact at `q` (n,) of every pair that collides, the deepest first."""
        found: dict[tuple[str, str], CollisionContact] = {}
        for contact in (*self._constant, *self._contacts.contacts(q)):
            key = contact.first.name, contact.second.name
            if key not in found or contact.depth_m > found[key].depth_m:
                found[key] = contact
        return tuple(sorted(found.values(), key=lambda item: -item.depth_m))

    def distance_m(self, q: FloatArray, *, most_m: float = 1.0) -> float:
        """Return the distance at `q` (n,) to the nearest thing that may not be touched.

        It is negative inside and `most_m` when nothing is nearer.
        """
        nearest = min((-contact.depth_m for contact in self._constant), default=most_m)
        return min(nearest, self._contacts.distance_m(q, most_m))

    @cached_property
    def _constant(self) -> tuple[CollisionContact, ...]:
        """What overlaps in every configuration."""
        return tuple(self._contacts.constant()) if self._sweeper.has_constant_neighbours else ()

    def _is_within(self, q: FloatArray) -> bool:
        return bool(((q >= self._lower) & (q <= self._upper)).all())
