"""Joints held at a position whatever acts on them, as Gazebo's ``Joint::SetPosition`` does.

Gazebo Classic puts such a joint in its place again at every step. Here one equality constraint a
joint does it inside MuJoCo: from position q and speed q' at the start of a step of length h it
asks for the acceleration (target − q)/h² − q'/h, with which the semi-implicit step ends exactly on
the target. A target that moves is followed without delay, and the speed is that of the target.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.engine.contact_readings import constraint_forces
from gazelle.engine.mujoco_library import mujoco
from gazelle.engine.scoped_names import lock

__all__ = ["PositionLocks", "add_lock"]

Array = NDArray[np.float64]
Indices = NDArray[np.intp]

_MAX_SPEED = 20.0
"""Targets that would need a higher speed, rad/s or m/s, are taken up at once, as Gazebo does."""

_IMPEDANCE = 0.9999
"""MuJoCo's largest; what is left of a load a₀ is an error of (1 − d) h² a₀."""

_BY_PLACE = ("active", "_reference", "_goal", "_increment", "_left")


def add_lock(spec: Any, joint: str, step_s: float) -> None:
    """Add the constraint that can lock a joint; it is idle until commanded."""
    equality = spec.add_equality(
        type=mujoco.mjtEq.mjEQ_JOINT, objtype=mujoco.mjtObj.mjOBJ_JOINT, name1=joint
    )
    equality.name = lock(joint)
    equality.active = False
    equality.solref = [-1.0 / (step_s * step_s), -1.0 / step_s]
    equality.solimp = [_IMPEDANCE, _IMPEDANCE, 0.001, 0.5, 2.0]


class PositionLocks:
    """All locks: which joints have one, and where it holds them; survives recompiles.

    A lock has a place in every array, in the order of the first commands. Its reference is where
    it holds the joint now; while it ramps, the reference moves by an equal amount every step.

    Attributes:
        installed: joints with a lock, by place.
        active: which of them hold.
        steps_left: rest of the ramp that ends first; 0 when all references stand still.
    """

    def __init__(self) -> None:
        self.installed: list[str] = []
        self.active: NDArray[np.bool_] = np.zeros(0, dtype=bool)
        self.steps_left = 0
        self._reference: Array = np.zeros(0)
        self._goal: Array = np.zeros(0)
        self._increment: Array = np.zeros(0)
        self._left: Indices = np.zeros(0, dtype=np.intp)
        self._equalities: Indices = np.zeros(0, dtype=np.intp)
        self._dofs: Indices = np.zeros(0, dtype=np.intp)
        self._fastest = 0.0
        self._holding = False
        self._model: Any = None
        self._data: Any = None
        self._column: Array = np.zeros(0)
        self._speeds: Array = np.zeros(0)

    @property
    def is_holding(self) -> bool:
        """Whether any joint is held."""
        return self._holding

    # --- which joints --------------------------------------------------------------------

    def install(self, joints: Sequence[str]) -> bool:
        """Give joints a place; returns whether the world must be built again."""
        new = [joint for joint in joints if joint not in self.installed]
        self.installed += new
        zeros = np.zeros(len(new))
        for name in _BY_PLACE:
            old = getattr(self, name)
            setattr(self, name, np.concatenate((old, zeros.astype(old.dtype))))
        return bool(new)

    def places(self, joints: Sequence[str]) -> Indices:
        """Return the places of installed joints, (joints,)."""
        return np.array([self.installed.index(joint) for joint in joints], dtype=np.intp)

    def forget(self, prefix: str) -> None:
        """Drop the locks of a deleted model."""
        kept = [i for i, joint in enumerate(self.installed) if not joint.startswith(prefix)]
        self.installed = [self.installed[i] for i in kept]
        for name in _BY_PLACE:
            setattr(self, name, getattr(self, name)[kept])
        self._find_next_end()

    # --- the compiled world --------------------------------------------------------------

    def bind(self, model: Any, data: Any, step_s: float) -> None:
        """Find the locks in a newly compiled world and set those that hold."""
        joints = [model.joint(name).id for name in self.installed]
        found = [model.equality(lock(name)).id for name in self.installed]
        self._equalities = np.array(found, dtype=np.intp)
        self._dofs = model.jnt_dofadr[joints].astype(np.intp)
        self._fastest = _MAX_SPEED * step_s
        self.hold(model, data)
        self._column[:] = self._reference
        self._write_active()

    def hold(self, model: Any, data: Any) -> None:
        """Act on these from now on: the world as it was bound, or a copy of it."""
        self._model, self._data, self._speeds = model, data, data.qvel
        first = int(self._equalities[0]) if len(self._equalities) else 0
        self._column = model.eq_data[first : first + len(self._equalities), 0]

    def copy(self) -> PositionLocks:
        """Return a copy for a saved state; it needs `hold` before it acts."""
        other = PositionLocks()
        for name, value in vars(self).items():
            setattr(other, name, value.copy() if isinstance(value, np.ndarray) else value)
        other.installed = list(self.installed)
        other._model = other._data = None
        return other

    # --- commands ------------------------------------------------------------------------

    def command(
        self, places: Indices, targets: Array, positions: Callable[[], Array], steps: int
    ) -> NDArray[np.bool_] | None:
        """Hold joints at targets, reached evenly over some steps.

        Args:
            places: of the locks, (n,).
            targets: (n,), rad or m.
            positions: tells where the joints are, (n,), rad or m.
            steps: 1 for the end of the next step.

        Returns:
            Which joints must be put to their targets at once, (n,); None for none.
        """
        if not self.active.take(places).all():
            self._engage(places, positions())
        start = self._reference.take(places)
        gap = targets - start
        farthest = self._fastest * steps
        square = float(gap.dot(gap))
        jumps = np.abs(gap) > farthest if square > farthest * farthest else None
        if steps > 1 or self.steps_left:
            self._ramp(
                places, targets, start if jumps is None else np.where(jumps, targets, start), steps
            )
        else:
            self._reference[places] = targets
            self._column[places] = targets
        if square:
            self._wake(places)
        return jumps if jumps is not None and jumps.any() else None

    def move(self, joint: str, position: float) -> None:
        """Hold a joint that was put somewhere there, if it is held at all."""
        if joint in self.installed:
            place = self.installed.index(joint)
            self._reference[place] = position
            self._increment[place] = self._left[place] = 0
            if place < len(self._column):
                self._column[place] = position
            self._find_next_end()

    def release(self, places: Indices | None = None) -> None:
        """Let joints move freely; all of them by default, else those of these places, (n,)."""
        chosen = np.arange(len(self.installed)) if places is None else places
        if not self.active[chosen].any():
            return
        self.active[chosen] = False
        self._left[chosen] = 0
        self._increment[chosen] = 0.0
        self._find_next_end()
        self._write_active()
        self._wake(chosen)

    def advance(self, step: Callable[[Any, Any], None], steps: int) -> None:
        """Make steps in which references move; at most `steps_left`."""
        model, data, column, increment = self._model, self._data, self._column, self._increment
        for _ in range(steps):
            np.add(column, increment, out=column)
            step(model, data)
        ended = (self._left > 0) & (self._left <= steps)
        self._left = np.maximum(self._left - steps, 0)
        increment[ended] = 0.0
        column[ended] = self._goal[ended]
        self._reference[:] = column
        self._find_next_end()

    def efforts(self, data: Any) -> Array:
        """Return what each lock delivered in the last step, (locks,) by place, N·m or N."""
        kind = int(mujoco.mjtConstraint.mjCNSTR_EQUALITY)
        forces = constraint_forces(data, kind, self._model.neq)[self._equalities]
        result: Array = np.where(self.active, forces, 0.0)
        return result

    # --- inside --------------------------------------------------------------------------

    def _engage(self, places: Indices, positions: Array) -> None:
        start = np.where(self.active[places], self._reference[places], positions)
        self.active[places] = True
        self._reference[places] = start
        self._column[places] = start
        self._write_active()

    def _ramp(self, places: Indices, targets: Array, start: Array, steps: int) -> None:
        """Move references evenly; those that start at their target stand."""
        self._reference[places] = start
        self._column[places] = start
        self._goal[places] = targets
        self._increment[places] = (targets - start) / steps
        self._left[places] = np.where(targets != start, steps, 0)
        self._find_next_end()

    def _find_next_end(self) -> None:
        moving = self._left[self._left > 0]
        self.steps_left = int(moving.min()) if len(moving) else 0

    def _write_active(self) -> None:
        self._holding = bool(self.active.any())
        if self._data is not None and len(self._equalities):
            self._data.eq_active[self._equalities] = self.active

    def _wake(self, places: Indices) -> None:
        """Wake sleeping trees: MuJoCo looks for bytes that are not 0, minus zero is one."""
        dofs = self._dofs[places]
        speeds = self._speeds[dofs]
        if not speeds.all():
            speeds[speeds == 0.0] = -0.0
            self._speeds[dofs] = speeds
