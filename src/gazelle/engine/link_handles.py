"""Handles of links, and the forces on them that last for a time."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gazelle.engine.mujoco_library import mujoco
from gazelle.engine.state import Acceleration, Velocity
from gazelle.geometry import Pose, Vector3, cross

if TYPE_CHECKING:
    from gazelle.description.model import Link
    from gazelle.engine.engine import Engine

__all__ = ["LinkHandle", "TimedWrench", "WrenchTable"]


Array = NDArray[np.float64]
_ORIGIN: Vector3 = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True, eq=False)
class TimedWrench:
    """A wrench on a link.

    Attributes:
        link: ``model::link``.
        force_n: world frame, (3,).
        torque_nm: about the centre of mass, world frame, (3,).
        until: first step at which it no longer acts, None for ever.
    """

    link: str
    force_n: Array
    torque_nm: Array
    until: int | None


class LinkHandle:
    """A link of a running world; stays valid while the link exists, whatever is spawned."""

    __slots__ = ("_body", "_engine", "_revision", "name")

    def __init__(self, engine: Engine, name: str) -> None:
        self.name = name
        self._engine = engine
        self._revision = -1
        self._body = -1
        self._index()

    def __repr__(self) -> str:
        return f"LinkHandle({self.name!r})"

    @property
    def link(self) -> Link:
        """The description."""
        return self._engine.description_of_link(self.name)

    @property
    def mass_kg(self) -> float:
        """Mass, 0 for a link without one and for static ones."""
        return float(self._engine.model.body_mass[self._index()])

    @property
    def is_static(self) -> bool:
        """Whether it can never move."""
        return int(self._engine.model.body_weldid[self._index()]) == 0

    def T_world_link(self) -> Pose:
        """Return the pose in the world."""
        body = self._index()
        data = self._engine.fresh_data()
        x, y, z = data.xpos[body].tolist()
        qw, qx, qy, qz = data.xquat[body].tolist()
        return Pose((x, y, z), (qx, qy, qz, qw))

    def com_world(self) -> Array:
        """Return the centre of mass, (3,), world frame."""
        return np.array(self._engine.fresh_data().xipos[self._index()])

    def velocity_world(self) -> Velocity:
        """Return the velocity of the link's origin, world frame."""
        return self._velocity(mujoco.mjtObj.mjOBJ_XBODY)

    def com_velocity_world(self) -> Velocity:
        """Return the velocity of the centre of mass, world frame."""
        return self._velocity(mujoco.mjtObj.mjOBJ_BODY)

    def acceleration_world(self) -> Acceleration:
        """Return the acceleration of the link's origin in the last step, world frame.

        It is the coordinate acceleration: 0 at rest, gravity in free fall. An accelerometer
        measures it minus gravity.
        """
        body = self._index()
        result = np.zeros(6)
        if self.is_static or self._engine.is_asleep(body):
            return Acceleration(result[:3], result[3:])
        data = self._engine.data_with_accelerations(body)
        model = self._engine.model
        mujoco.mj_objectAcceleration(model, data, mujoco.mjtObj.mjOBJ_XBODY, body, result, 0)
        return Acceleration(result[3:] + model.opt.gravity, result[:3].copy())

    def apply_wrench(
        self,
        force_n: Vector3 | Array = _ORIGIN,
        torque_nm: Vector3 | Array = _ORIGIN,
        *,
        point_link_m: Vector3 | Array | None = None,
        duration_ns: int | None = None,
    ) -> TimedWrench:
        """Apply a force and a torque in the world frame; `Engine.end_wrench` ends what it returns.

        Args:
            force_n: (3,), world frame.
            torque_nm: (3,), world frame, added to the moment of the force.
            point_link_m: (3,), where the force acts, in the link's frame at this moment; the
                centre of mass when None. The moment is kept while the wrench lasts, as Gazebo does.
            duration_ns: how long it acts, at least one step; None for ever
                (until `clear_wrenches`).
        """
        force = np.asarray(force_n, dtype=np.float64)
        torque = np.array(torque_nm, dtype=np.float64)
        if point_link_m is not None:
            point = self.T_world_link().transform(np.asarray(point_link_m, dtype=np.float64))
            torque = torque + cross(point - self.com_world(), force)
        return self._engine.add_wrench(self.name, force, torque, duration_ns)

    def clear_wrenches(self) -> None:
        """End all wrenches on this link."""
        self._engine.clear_wrenches(self.name)

    def set_pose(self, T_world_link: Pose) -> None:
        """Move the link, and with it everything its joints connect to it, to a pose."""
        self._engine.move_tree(self._index(), self.T_world_link(), T_world_link)

    def set_velocity(
        self, linear_m_s: Vector3 | Array = _ORIGIN, angular_rad_s: Vector3 | Array = _ORIGIN
    ) -> None:
        """Give the link's origin a velocity, (3,) each, world frame; the robot moves along."""
        self._engine.set_tree_velocity(
            self._index(), np.asarray(linear_m_s, float), np.asarray(angular_rad_s, float)
        )

    def _velocity(self, kind: object) -> Velocity:
        body = self._index()
        data = self._engine.data_with_velocities()
        result = np.zeros(6)
        mujoco.mj_objectVelocity(self._engine.model, data, kind, body, result, 0)
        return Velocity(result[3:].copy(), result[:3].copy())

    def _index(self) -> int:
        if self._revision != self._engine.revision:
            self._body = self._engine.body_id(self.name)
            self._revision = self._engine.revision
        return self._body


@dataclass(slots=True)
class WrenchTable:
    """All wrenches that act now; `changed` tells that the sums must be written again."""

    items: list[TimedWrench] = field(default_factory=list)
    changed: bool = False

    def add(self, item: TimedWrench) -> None:
        """Let a wrench act from now on."""
        self.items.append(item)
        self.changed = True

    def copy(self) -> WrenchTable:
        """Return a copy for a saved state; the wrenches themselves never change."""
        return WrenchTable(list(self.items), self.changed)

    def remove(self, item: TimedWrench) -> None:
        """End one wrench; one that has ended already is left alone."""
        kept = [other for other in self.items if other is not item]
        self.changed = self.changed or len(kept) != len(self.items)
        self.items = kept

    def clear(self, links: frozenset[str] | None = None) -> None:
        """Remove the wrenches on some links, or all."""
        kept = [] if links is None else [item for item in self.items if item.link not in links]
        self.changed = self.changed or len(kept) != len(self.items)
        self.items = kept

    def steps_until_change(self, step: int, wanted: int) -> int:
        """Return how many of the wanted steps can be made before a wrench ends."""
        if not self.items:
            return wanted
        ends = [item.until - step for item in self.items if item.until is not None]
        return max(1, min([wanted, *ends]))

    def expire(self, step: int) -> None:
        """Drop wrenches that have ended."""
        if not self.items:
            return
        kept = [item for item in self.items if item.until is None or item.until > step]
        self.changed = self.changed or len(kept) != len(self.items)
        self.items = kept

    def sums(self) -> dict[str, Array]:
        """Return force and torque together, (6,), by link."""
        sums: dict[str, Array] = {}
        for item in self.items:
            total = sums.setdefault(item.link, np.zeros(6))
            total[:3] += item.force_n
            total[3:] += item.torque_nm
        return sums
