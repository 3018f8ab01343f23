"""The engine: a world that moves."""

from __future__ import annotations

import copy
import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import JointType, Model, World
from gazelle.engine.compiler import Compiled
from gazelle.engine.contacts import Contact, read_contacts
from gazelle.engine.core import EngineCore
from gazelle.engine.divergence import Culprit, find_culprit, require_finite, require_finite_pose
from gazelle.engine.link_handles import WrenchTable
from gazelle.engine.motors import POSITION_STEPS, MotorBank
from gazelle.engine.mujoco_library import drained_warnings, mujoco, report_library_warnings
from gazelle.engine.position_locks import LockBank
from gazelle.engine.scoped_names import scoped
from gazelle.engine.state import Snapshot, hash_state, set_initial_positions
from gazelle.engine.welds import WeldBank
from gazelle.engine.wheel_slip import CENTRING_STEPS, Slip, TyreBank
from gazelle.errors import EngineError, SimulationDivergedError
from gazelle.geometry import Pose, cross

__all__ = ["Engine", "EngineState"]

Array = NDArray[np.float64]
_NS = 1_000_000_000
_ABSURD_SPEED = 1e9
# Joints of one chain push each other: what counts of their efforts is found in few rounds.
_TRIES = 4


@dataclass(frozen=True, slots=True, eq=False)
class EngineState:
    """Everything `Engine.restore_state` needs; an opaque value for its callers."""

    world: World
    compiled: Compiled
    model: Any
    data: Any
    time_ns: int
    iteration: int
    step_ns: int
    motors: MotorBank
    locks: LockBank
    welds: WeldBank
    tyres: TyreBank
    wrenches: WrenchTable


class Engine(EngineCore):
    """A world that moves: steps in C, state by name, models come and go.

    Every name is full: ``model::link``, ``model::joint``. All times are simulated nanoseconds;
    the same world, commands and number of steps give the same state, to the bit.
    """

    # --- time ----------------------------------------------------------------------------

    def step(self, count: int = 1) -> None:
        """Make steps, in C without a pause as long as no wrench ends on the way.

        Raises:
            SimulationDivergedError: the state is no longer finite; names link and place. The
                engine is back where it was, as the time tells.
        """
        self.ensure_compiled()
        model, data = self._compiled.model, self._data
        qpos, qvel, warm_start = self._views
        before = (qpos.copy(), qvel.copy(), warm_start.copy())
        first, left, step_s = self.iteration, count, self._step_ns / _NS
        while left > 0:
            steps = self._wrenches.steps_until_change(self.iteration, left)
            if self.motors.has_positions:
                steps = min(steps, POSITION_STEPS)
            if self._tyres.slips:
                steps = min(steps, CENTRING_STEPS)
                self._tyres.prepare(model, data, step_s)
            if self._wrenches.changed:
                self._write_wrenches()
            if is_limited := self._speed_limits.concern(self._applied):
                steps = 1
            self.motors.drive(model, data, step_s, steps)
            if self.locks.steps_left:
                steps = min(steps, self.locks.steps_left)
            if is_limited:
                self._advance_within_limits()
            else:
                self._advance(steps)
            self.iteration += steps
            left -= steps
            self._wrenches.expire(self.iteration)
        self.time_ns += count * self._step_ns
        self.state_changed()
        if not (qvel.dot(qvel) < _ABSURD_SPEED**2 and math.isfinite(qpos.dot(qpos))):
            culprit = find_culprit(model, data, before, self.iteration - first)
            qpos[:], qvel[:], warm_start[:] = before
            self.iteration = first
            self.time_ns -= count * self._step_ns
            self.state_changed()
            self._raise_diverged(culprit, first)
        report_library_warnings(self._world, self.diagnostics, model)

    def reset(self, *, time: bool = True, poses: bool = True) -> None:
        """Go back to the start: time to 0, poses and joints as they were loaded or spawned.

        Efforts, wrenches, motors, locks and attachments end. Spawned models stay.
        """
        self.ensure_compiled()
        if time:
            self.time_ns = 0
            self.iteration = 0
        self._wrenches.clear()
        self.motors.release()
        self.locks.release()
        self._welds.release()
        if poses:
            mujoco.mj_resetData(self.model, self._data)
            set_initial_positions(self.model, self._world, self._data)
        self._data.qfrc_applied[:] = 0.0
        self._data.xfrc_applied[:] = 0.0
        self.motors.bind(self.model, self._compiled.motors)
        self.state_changed()

    # --- models --------------------------------------------------------------------------

    def spawn(
        self, model: Model, *, name: str | None = None, T_world_model: Pose | None = None
    ) -> str:
        """Add a model; everything else keeps its state. Returns its name.

        Raises:
            EngineError: the name is taken, a place is beyond all bounds, or MuJoCo cannot build
                the model.
        """
        name = name or model.name
        if self._world.model(name) is not None:
            raise EngineError(
                f"a model named '{name}' is in the world already; choose another name or delete it"
                f" first (ROS/Gazebo says: SpawnModel: Failure - model name {name} already exist.)"
            )
        pose = model.T_world_model if T_world_model is None else T_world_model
        require_finite_pose(pose, f"model '{name}'")
        for link in model.links:
            require_finite_pose(pose @ link.T_model_link, f"link '{scoped(name, link.name)}'")
        added = replace(model, name=name, T_world_model=pose)
        self._rebuild(replace(self._world, models=(*self._world.models, added)))
        return name

    def delete(self, name: str) -> None:
        """Remove a model; everything else keeps its state.

        Raises:
            NotFoundError: there is no such model.
        """
        self._model_named(name)
        for bank in (self.motors, self.locks, self._welds, self._tyres):
            bank.forget(f"{name}::")
        kept = tuple(model for model in self._world.models if model.name != name)
        gone = frozenset(item for item in self.link_names if item.startswith(f"{name}::"))
        self._wrenches.clear(gone)
        self._rebuild(replace(self._world, models=kept))

    def attach(self, link_a: str, link_b: str) -> None:
        """Hold two links together where they are now, until `detach`; as a weld would.

        Raises:
            NotFoundError: there is no such link.
            EngineError: it is the same link twice.
        """
        if link_a == link_b:
            raise EngineError(f"link '{link_a}' cannot be attached to itself")
        first, second = self.link(link_a).T_world_link(), self.link(link_b).T_world_link()
        if self._welds.attach((link_a, link_b), first.inverse() @ second):
            self._must_compile = True
        self.state_changed()

    def detach(self, link_a: str, link_b: str) -> None:
        """Let two links go that `attach` holds together; else nothing happens."""
        self.ensure_compiled()
        self._welds.detach((link_a, link_b))
        self._welds.detach((link_b, link_a))
        self.state_changed()

    def set_wheel_slip(
        self, joint: str, lateral: float, longitudinal: float, radius_m: float
    ) -> None:
        """Let a wheel slip against the ground in proportion to the force on it.

        The first time the world is built anew; after that it costs next to nothing.

        Args:
            joint: ``model::joint``, the wheel's axle; its child carries the tread.
            lateral: speed along the axle per force, m/s per N; ODE's ``slip1`` with ``fdir1``
                along the axle.
            longitudinal: speed in the rolling direction per force, m/s per N; ODE's ``slip2``.
            radius_m: of the wheel.

        Raises:
            NotFoundError: there is no such joint.
            EngineError: the joint does not turn, or a value is negative or not finite.
        """
        kind = self.description_of_joint(joint).type
        if kind not in (JointType.REVOLUTE, JointType.CONTINUOUS):
            raise EngineError(f"joint '{joint}' ({kind.value}) carries no wheel that could slip")
        slip = Slip(lateral, longitudinal, radius_m)
        if not (all(map(math.isfinite, slip)) and min(slip) >= 0 and radius_m > 0):
            raise EngineError(
                f"wheel '{joint}' cannot slip like {slip}: positive numbers are needed"
            )
        if self._tyres.set(joint, slip):
            self._must_compile = True

    def model_velocity(self, name: str) -> tuple[Array, Array]:
        """Return linear (m/s) and angular (rad/s) velocity of a model's frame, (3,), world."""
        _, link = self._canonical(name)
        handle = self.link(scoped(name, link.name))
        linear, angular = handle.velocity_world()
        origin = np.asarray(self.model_pose(name).position_m)
        arm = origin - np.asarray(handle.T_world_link().position_m)
        return linear + cross(angular, arm), angular

    def set_model_velocity(
        self,
        name: str,
        linear_m_s: tuple[float, float, float] | Array,
        angular_rad_s: tuple[float, float, float] | Array,
    ) -> None:
        """Give the canonical link's origin a velocity, world frame; the robot moves along.

        Args:
            name: of the model.
            linear_m_s: (3,), world frame.
            angular_rad_s: (3,), world frame.
        """
        _, link = self._canonical(name)
        self.link(scoped(name, link.name)).set_velocity(linear_m_s, angular_rad_s)

    # --- what is sensed ------------------------------------------------------------------

    def contacts(self) -> tuple[Contact, ...]:
        """Return everything that touches, of the last step; sleeping bodies touch too."""
        self.ensure_compiled()
        if self._contacts is None:
            self._contacts = read_contacts(
                self.model, self.data_of_everyone(), self._compiled.collision_names
            )
        return self._contacts

    def snapshot(self) -> Snapshot:
        """Return where every link is."""
        data = self.fresh_data()
        ids = self._compiled.body_ids
        poses = np.empty((len(ids), 7))
        poses[:, :3] = data.xpos[ids]
        poses[:, 3:6] = data.xquat[ids, 1:]
        poses[:, 6] = data.xquat[ids, 0]
        poses.flags.writeable = False
        return Snapshot(self.time_ns, self.revision, self._compiled.link_names, poses)

    def state_hash(self) -> str:
        """Return a hash of time, positions, velocities and everything that acts (SHA-256)."""
        self.ensure_compiled()
        return hash_state(self.model, self._data, self.iteration)

    # --- settings ------------------------------------------------------------------------

    def set_gravity(self, gravity_m_s2: tuple[float, float, float]) -> None:
        """Change the acceleration of free fall; wakes everything.

        Raises:
            EngineError: a number is not finite.
        """
        require_finite(gravity_m_s2, "gravity")
        self._world = replace(self._world, gravity_m_s2=gravity_m_s2)
        self.model.opt.gravity = gravity_m_s2
        self._wake_all()

    def set_step_size(self, step_ns: int) -> None:
        """Change the length of a step; contacts and joints are made for the new one.

        Raises:
            EngineError: it is not positive.
        """
        if step_ns <= 0:
            raise EngineError(f"the step must be longer than 0 ns, not {step_ns}")
        physics = replace(self._world.physics, max_step_size_s=step_ns / _NS)
        self._step_ns = step_ns
        self._rebuild(replace(self._world, physics=physics))

    def save_state(self) -> EngineState:
        """Return a copy of everything; `restore_state` goes back to it, to the bit."""
        self.ensure_compiled()
        return EngineState(
            self._world, self._compiled, copy.copy(self.model), copy.copy(self._data),
            self.time_ns, self.iteration, self._step_ns, copy.deepcopy(self.motors),
            self.locks.copy(), self._welds.copy(), copy.deepcopy(self._tyres),
            self._wrenches.copy(),
        )  # fmt: skip

    def restore_state(self, state: EngineState) -> None:
        """Go back to a saved state, with the models there were."""
        self._world, self._step_ns = state.world, state.step_ns
        self.time_ns, self.iteration = state.time_ns, state.iteration
        self.motors, self._wrenches = copy.deepcopy(state.motors), state.wrenches.copy()
        self.locks, self._welds = state.locks.copy(), state.welds.copy()
        self._tyres = copy.deepcopy(state.tyres)
        self._compiled = replace(state.compiled, model=copy.copy(state.model))
        self._hold(copy.copy(state.data))
        self.locks.hold(self.model, self._data)
        self._welds.hold(self.model, self._data)
        self._speed_limits.bind(self.model, self._world, self._step_ns / _NS)
        self._must_compile = False
        self.revision += 1
        self.state_changed()

    def _advance(self, steps: int) -> None:
        if self.locks.steps_left:
            self.locks.advance(mujoco.mj_step, steps)
        else:
            mujoco.mj_step(self._compiled.model, self._data, steps)

    def _step_held_back(self, model: Any, data: Any) -> None:
        """Do what ``mj_step`` does, with less of the efforts that would throw a joint."""
        mujoco.mj_forward(model, data)
        asked = self._applied.copy()
        positions, speeds, _ = self._views
        for _ in range(_TRIES):
            dofs, less = self._speed_limits.held_back(
                positions, speeds, data.qacc, self._applied, self.diagnostics
            )
            if not len(dofs):
                break
            self._applied[dofs] = less
            mujoco.mj_forwardSkip(model, data, int(mujoco.mjtStage.mjSTAGE_VEL), 1)
        if model.opt.integrator == int(mujoco.mjtIntegrator.mjINT_EULER):
            mujoco.mj_Euler(model, data)
        else:
            mujoco.mj_implicit(model, data)
        self._applied[:] = asked

    def _advance_within_limits(self) -> None:
        """Make one step in which efforts do not push joints beyond their limits."""
        idle = self._speed_limits.overrun(self._views[1], self._applied, self.diagnostics)
        asked = self._applied[idle]
        self._applied[idle] = 0.0
        if not self._speed_limits.throws(self._applied):
            self._advance(1)
        elif self.locks.steps_left:
            self.locks.advance(self._step_held_back, 1)
        else:
            self._step_held_back(self._compiled.model, self._data)
        self._applied[idle] = asked

    def _raise_diverged(self, culprit: Culprit, first: int) -> None:
        drained_warnings()
        link = self.description_of_link(culprit.link)
        place = f" ({link.span})" if link.span else ""
        raise SimulationDivergedError(
            f"the simulation diverged in step {first + culprit.step}: link '{culprit.link}'{place}"
            f" {culprit.what}. Usual reasons: an inertia far too small for the forces on it,"
            " effort or gains far too large, collisions that start inside each other",
            link=culprit.link,
        )
