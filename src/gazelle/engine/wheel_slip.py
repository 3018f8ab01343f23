"""Wheels that slip in proportion to the force on them, as ODE's ``slip1`` and ``slip2``.

ODE lets a contact slide at the speed slip · F under the friction force F. MuJoCo's contacts have no
such law. So a wheel that slips carries its collisions on a slip body of next to no mass that
turns about the wheel's axle and slides along it with dampers of r²/slip and 1/slip: it
sticks to the ground by the contact's own friction, up to μN, and the wheel moves against it with
slip · F. It is put back to the middle of the wheel every few steps, which a contact without
memory does not feel.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import (
    Collision,
    Cylinder,
    Joint,
    JointAxis,
    Link,
    Sphere,
    World,
)
from gazelle.engine.kinematic_tree import TreeLink
from gazelle.engine.mjspec_joints import implicit_damping
from gazelle.engine.mujoco_library import mujoco
from gazelle.engine.scoped_names import joint_part, scoped, slip_body

__all__ = [
    "CENTRING_STEPS",
    "Slip",
    "WheelSlips",
    "add_slip_body",
    "copy_contact_weights",
    "described_slips",
]


CENTRING_STEPS = 10
"""Tyres are put back after at most so many steps."""

_MIN_SLIP = 1e-8
"""Stands for none, m/s per N: a wheel under 100 N creeps a micrometre a second."""

_ALONG = 0.99
_MASS_KG = 1e-6
_SPIN, _SLIDE = "slip-spin", "slip-slide"


class Slip(NamedTuple):
    """Slip of one wheel.

    Attributes:
        lateral: along the axle, m/s per N.
        longitudinal: in the rolling direction, m/s per N.
        radius_m: of the wheel.
    """

    lateral: float
    longitudinal: float
    radius_m: float


def add_slip_body(body: Any, link: str, joint: str, entry: TreeLink) -> Any:
    """Add the body that carries a wheel's collisions, and return it."""
    assert entry.joint is not None
    T_link_joint = entry.link.T_model_link.inverse() @ entry.joint.T_model_joint
    axis = list(T_link_joint.rotate((entry.joint.axis or JointAxis()).xyz))
    added = body.add_body(name=slip_body(link))
    added.explicitinertial = True
    added.mass, added.inertia = _MASS_KG, [_MASS_KG] * 3
    added.ipos = list(T_link_joint.position_m)
    for part, kind in (
        (_SLIDE, mujoco.mjtJoint.mjJNT_SLIDE),
        (_SPIN, mujoco.mjtJoint.mjJNT_HINGE),
    ):
        added.add_joint(
            name=joint_part(joint, part), type=kind, pos=list(T_link_joint.position_m), axis=axis
        )
    return added


def copy_contact_weights(model: Any, link_of_slip_body: Sequence[tuple[str, str]]) -> None:
    """Make contacts of a slip body as hard as those of the wheel: its own lightness is a device."""
    for name, link in link_of_slip_body:
        model.body_invweight0[model.body(name).id] = model.body_invweight0[model.body(link).id]


def described_slips(world: World) -> dict[str, Slip]:
    """Return the slip that files give to the collisions of wheels, by wheel joint.

    A wheel is a cylinder or sphere on a joint that turns. ``slip1`` acts along ``fdir1``, which
    must be the axle; without a direction both must be equal.
    """
    found: dict[str, Slip] = {}
    for model in world.models:
        for joint in () if model.static else model.joints:
            link = model.link(joint.child)
            if link is not None and joint.type.is_hinge:
                slips = (_described(link, joint, collision) for collision in link.collisions)
                slip = next((item for item in slips if item is not None), None)
                if slip is not None:
                    found[scoped(model.name, joint.name)] = slip
    return found


def _described(link: Link, joint: Joint, collision: Collision) -> Slip | None:
    surface, shape = collision.surface, collision.shape
    first, second = surface.slip1 or 0.0, surface.slip2 or 0.0
    if max(first, second) <= 0 or not isinstance(shape, Cylinder | Sphere):
        return None
    if surface.fdir1 is not None:
        T_link_joint = link.T_model_link.inverse() @ joint.T_model_joint
        axle = T_link_joint.rotate((joint.axis or JointAxis()).xyz)
        along = collision.T_link_collision.rotate(surface.fdir1)
        if abs(float(np.dot(axle, along))) > _ALONG * float(np.linalg.norm(along)):
            return Slip(first, second, shape.radius_m)
    return Slip(first, first, shape.radius_m) if first == second else None


class WheelSlips:
    """Slip of all wheels; survives recompiles."""

    def __init__(self) -> None:
        self.slips: dict[str, Slip] = {}
        self._spins: NDArray[np.intp] = np.zeros(0, dtype=np.intp)
        self._slides: NDArray[np.intp] = np.zeros(0, dtype=np.intp)
        self._offsets: NDArray[np.intp] = np.zeros(0, dtype=np.intp)
        self._changed = False

    def set(self, joint: str, slip: Slip) -> bool:
        """Set a wheel's slip; returns whether its slip body must be built first."""
        new = joint not in self.slips
        self._changed = self._changed or self.slips.get(joint) != slip
        self.slips[joint] = slip
        return new

    def slips_in(self, world: World) -> dict[str, Slip]:
        """Return the slip of all wheels of a world; commands come before its files."""
        return {**described_slips(world), **self.slips}

    def forget(self, prefix: str) -> None:
        """Drop the wheels of a deleted model."""
        self.slips = {k: v for k, v in self.slips.items() if not k.startswith(prefix)}

    def bind(self, model: Any, world: World) -> None:
        """Find the slip bodies in a newly compiled world."""
        self.slips = self.slips_in(world)
        spins = [model.joint(joint_part(joint, _SPIN)).id for joint in self.slips]
        slides = [model.joint(joint_part(joint, _SLIDE)).id for joint in self.slips]
        self._spins = model.jnt_dofadr[spins].astype(np.intp)
        self._slides = model.jnt_dofadr[slides].astype(np.intp)
        self._offsets = model.jnt_qposadr[slides].astype(np.intp)
        self._changed = bool(self.slips)

    def prepare(self, model: Any, data: Any, step_s: float) -> None:
        """Centre the slip bodies, and write dampers that have changed."""
        data.qpos[self._offsets] = 0.0
        if not self._changed:
            return
        values = np.array(list(self.slips.values()), dtype=np.float64)
        lateral, longitudinal = np.maximum(values[:, :2], _MIN_SLIP).T
        for dofs, damping in (
            (self._slides, 1.0 / lateral),
            (self._spins, values[:, 2] ** 2 / longitudinal),
        ):
            model.dof_damping[dofs] = damping
            model.dof_armature[dofs] = implicit_damping(damping, step_s)
        self._changed = False
