"""Several joints at once: state and commands as arrays, for controllers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gazelle.engine.contact_readings import constraint_forces
from gazelle.engine.motors import UNLIMITED_EFFORT, MotorCommand
from gazelle.engine.mujoco_library import mujoco
from gazelle.errors import EngineError

if TYPE_CHECKING:
    from gazelle.engine.engine import Engine

__all__ = ["JointGroup"]

Array = NDArray[np.float64]
Indices = NDArray[np.intp]

_LIGHT = 2.0
"""Feedback shakes a joint when h (h stiffness + 2 damping) / inertia is 4; poses change that."""


class JointGroup:
    """Joints of a running world in a fixed order; stays valid while the joints exist.

    All arrays are (N,), in rad, rad/s, N·m for turning joints and m, m/s, N for sliding ones.
    What a command sets lasts until the next one, so nothing need be sent again.

    Attributes:
        names: ``model::joint`` of each.
    """

    def __init__(self, engine: Engine, names: Sequence[str]) -> None:
        self.names = tuple(names)
        self._engine = engine
        self._handles = tuple(engine.joint(name) for name in names)
        self._everyone = np.arange(len(names))
        self._revision = -1
        self._locks: Indices | None = None
        self._velocities: list[float] | None = None
        self._limits_key: bytes | None = None
        self._limits: list[float] = []
        self._changes = -1
        self._resting_effort: Array | None = None
        self._read_limits()
        self._index()

    def __repr__(self) -> str:
        return f"JointGroup({list(self.names)!r})"

    # --- state ---------------------------------------------------------------------------

    def read(self, position: Array, velocity: Array) -> None:
        """Fill two arrays, (n,) in the order of the joints, with positions and velocities of now.

        They are rad and rad/s, m and m/s of joints that slide.
        """
        self._index()
        self._positions.take(self._qpos, out=position, mode="clip")
        self._speeds.take(self._dofs, out=velocity, mode="clip")

    def effort(self, out: Array) -> None:
        """Fill an array with what acts on each joint: applied effort, motor and lock.

        It is (n,), N·m, N of joints that slide.

        Motors and locks count with what they delivered in the last step.
        """
        self._index()
        self._applied.take(self._dofs, out=out, mode="clip")
        engine = self._engine
        held = self._locks is not None and engine.locks.is_holding
        driven = self._tendons is not None and bool(engine.motors.commands)
        if not held and not driven:
            return
        sleepers = self._sleepers()
        asleep = bool(sleepers.all())
        if asleep and self._resting_effort is not None:
            out[:] = self._resting_effort
            return
        # Who is awake is in the data of the step; waking the others costs a step of the world.
        data = engine.data_of_everyone() if sleepers.any() else engine.data
        if held:
            out += engine.locks.efforts(data)[self._locks]
        if driven and self._tendons is not None:
            kind = int(mujoco.mjtConstraint.mjCNSTR_FRICTION_TENDON)
            forces = constraint_forces(data, kind, engine.model.ntendon)
            out += np.where(self._tendons >= 0, forces[self._tendons], 0.0)
        self._resting_effort = out.copy() if asleep else None

    # --- commands ------------------------------------------------------------------------

    def set_effort(self, values: Array) -> None:
        """Apply efforts, each at most its joint's limit; NaN leaves a joint as it is.

        Args:
            values: (n,) in the order of the joints, N·m, N of joints that slide.

        Raises:
            EngineError: a value is infinite and the joint has no limit.
        """
        self._index()
        self._resting_effort = None
        clamped = self._clamped
        np.minimum(values, self._effort_limits, out=clamped)
        np.maximum(clamped, self._negative_limits, out=clamped)
        if math.isfinite(clamped.dot(clamped)):
            self._applied[self._dofs] = clamped
            return
        chosen = ~np.isnan(clamped)
        self._check_finite(clamped[chosen], chosen)
        self._applied[self._dofs[chosen]] = clamped[chosen]

    def is_light(self, stiffness: Array, damping: Array, period_s: float) -> NDArray[np.bool_]:
        """Return which joints (N,) a feedback computed every period would shake, as a mask.

        Args:
            stiffness: effort per position, of the feedback (N,).
            damping: effort per velocity.
            period_s: between two computations.
        """
        self._index()
        inverse = self._engine.model.dof_invweight0[self._dofs]
        share = period_s * inverse * (period_s * stiffness + 2.0 * damping)
        light: NDArray[np.bool_] = share > _LIGHT
        return light

    def set_feedback(
        self, places: list[int], efforts: Array, slopes: Array, low: Array, high: Array
    ) -> None:
        """Apply efforts that a joint's motion lessens within each step: effort − slope · speed.

        The speed is that at the end of the step, which no inertia is too small for. Lasts until
        the joint is commanded anew, like a motor's command.

        Args:
            places: k of the joints.
            efforts: (k,), on the joint at rest, N·m or N.
            slopes: (k,), what they lose per rad/s or m/s, positive.
            low: (k,), smallest effort; the joint's own limit counts as well.
            high: (k,), largest effort.
        """
        self._index()
        self._resting_effort = None
        limits = np.minimum(self._effort_limits[places], UNLIMITED_EFFORT)
        least, most = np.maximum(low, -limits), np.minimum(high, limits)
        middles, ranges = ((least + most) / 2.0).tolist(), ((most - least) / 2.0).tolist()
        for place, effort, slope, middle, limit in zip(
            places, efforts.tolist(), slopes.tolist(), middles, ranges, strict=True
        ):
            command = MotorCommand("effort", effort - middle, limit, slope=slope)
            self._applied[self._dofs[place]] = middle
            self._engine.steer_motor(self._elements[place], command)

    def end_feedback(self, places: Sequence[int]) -> None:
        """Let joints go that `set_feedback` drives."""
        self._index()
        self._release_motors(np.asarray(places, dtype=np.intp))

    def lock_position(self, values: Array, *, steps: int = 1) -> None:
        """Hold joints at positions whatever acts on them, as Gazebo's ``SetPosition``.

        There is no effort limit; position limits hold. A joint goes to its value evenly over the
        given number of steps, at the end of which it is there; controllers that run every n-th
        step pass n, so that joints move smoothly. What would be faster than 20 rad/s or m/s is
        put there at once, as Gazebo does. NaN leaves a joint as it is.

        Args:
            values: (n,) in the order of the joints, rad, m of joints that slide.
            steps: of the world.

        Raises:
            EngineError: a value is infinite, or `steps` is not positive.
        """
        if steps < 1:
            raise EngineError(f"a position needs at least one step to be reached, not {steps}")
        places = self._lock_places()
        targets = np.maximum(np.minimum(values, self._upper), self._lower)
        if math.isfinite(targets.dot(targets)):
            self._lock(self._everyone, places, targets, steps)
            return
        chosen = np.flatnonzero(~np.isnan(targets))
        self._check_finite(targets[chosen], chosen)
        self._lock(chosen, places[chosen], targets[chosen], steps)

    def set_velocity(self, values: Array, max_effort: Array) -> None:
        """Drive towards velocities with at most these efforts, as ODE's ``vel`` and ``fmax``.

        An infinite effort is Gazebo's kinematic ``SetVelocity``; finite ones respect the joint's
        own limit as `JointHandle.set_velocity_target` does. NaN leaves a joint as it is.

        Args:
            values: (n,) in the order of the joints, rad/s, m/s of joints that slide.
            max_effort: (n,), N·m or N; a joint whose effort is NaN is left as it is.

        Raises:
            EngineError: a velocity is infinite.
        """
        self._index()
        velocities, limits = values.tolist(), self._motor_limits(max_effort)
        sent = self._velocities
        if sent is None or self._changes != self._engine.motors.changes:
            sent = self._velocities = [math.nan] * len(velocities)
        for place, velocity in enumerate(velocities):
            if velocity == sent[place] or math.isnan(velocity) or math.isnan(limits[place]):
                continue
            if math.isinf(velocity):
                raise EngineError(f"joint '{self.names[place]}' was given an infinite value")
            if self._locks is not None:
                self._engine.locks.release(self._locks[place : place + 1])
            command = MotorCommand("velocity", velocity, limits[place])
            self._engine.command_motor(self._elements[place], command)
            sent[place] = velocity
        self._changes = self._engine.motors.changes

    def release(self, places: Sequence[int] | None = None) -> None:
        """Let joints move freely: motor and lock off, effort 0; all of them by default."""
        self._index()
        chosen = self._everyone if places is None else np.asarray(places, dtype=np.intp)
        self._unlock(chosen)
        self._release_motors(chosen)
        self._applied[self._dofs[chosen]] = 0.0

    # --- inside --------------------------------------------------------------------------

    def _lock(self, chosen: Indices, places: Indices, targets: Array, steps: int) -> None:
        self._release_motors(chosen)
        jumps = self._engine.locks.command(
            places, targets, lambda: self._positions[self._qpos[chosen]], steps
        )
        if jumps is not None:
            self._positions[self._qpos[chosen][jumps]] = targets[jumps]
            self._speeds[self._dofs[chosen][jumps]] = -0.0
            self._engine.state_changed()

    def _unlock(self, chosen: Indices) -> None:
        if self._locks is not None:
            self._engine.locks.release(self._locks[chosen])

    def _release_motors(self, chosen: Indices) -> None:
        self._velocities = None
        commands = self._engine.motors.commands
        if commands:
            for place in chosen:
                element = self._elements[place]
                if element in commands:
                    self._engine.command_motor(element, None)

    def _lock_places(self) -> Indices:
        self._index()
        if self._locks is None:
            self._engine.install_locks(self._elements)
            self._index()
        if self._locks is None:
            raise EngineError(f"the locks of {list(self.names)} are missing")
        return self._locks

    def _sleepers(self) -> NDArray[np.bool_]:
        """Tell of each joint's body whether it rests and is not computed."""
        asleep = int(mujoco.mjtSleepState.mjS_ASLEEP)
        return np.asarray(self._engine.data.body_awake[self._bodies] == asleep)

    def _check_finite(self, values: Array, chosen: Any) -> None:
        if not np.isfinite(values).all():
            names = np.asarray(self.names)[chosen][~np.isfinite(values)]
            raise EngineError(f"joint '{names[0]}' was given an infinite value")

    def _motor_limits(self, max_effort: Array) -> list[float]:
        """Return what motors get that are asked for these efforts, as `JointHandle.motor_limit`.

        New ones mean that all velocities are sent again.
        """
        key = max_effort.tobytes()
        if key != self._limits_key:
            own, asked = self._effort_limits, np.abs(max_effort)
            limits = np.where(own > 0, np.minimum(asked, own), asked)
            limits = np.where(np.isinf(max_effort), UNLIMITED_EFFORT, limits)
            self._limits_key, self._limits = key, limits.tolist()
            self._velocities = None
        return self._limits

    def _read_limits(self) -> None:
        limits = np.array([handle.effort_limit for handle in self._handles], dtype=np.float64)
        self._effort_limits, self._negative_limits = limits, -limits
        lower = [handle.lower for handle in self._handles]
        upper = [handle.upper for handle in self._handles]
        self._lower, self._upper = np.array(lower, dtype=float), np.array(upper, dtype=float)
        unordered = self._lower > self._upper
        self._lower[unordered], self._upper[unordered] = -np.inf, np.inf
        self._clamped = np.empty(len(self.names))

    def _index(self) -> None:
        """Find the joints in the compiled world, once a revision."""
        engine = self._engine
        if self._revision == engine.revision:
            return
        engine.ensure_compiled()
        found = [handle.addresses() for handle in self._handles]
        self._qpos, self._dofs = np.array(found, dtype=np.intp).reshape(-1, 2).T
        self._bodies = engine.model.dof_bodyid[self._dofs]
        data = engine.data
        self._positions, self._speeds, self._applied = data.qpos, data.qvel, data.qfrc_applied
        self._elements = elements = [handle.element for handle in self._handles]
        installed = set(engine.locks.installed)
        self._locks = engine.locks.places(elements) if installed.issuperset(elements) else None
        self._tendons = engine.motors.tendons(elements)
        self._resting_effort = self._velocities = None
        self._revision = engine.revision
