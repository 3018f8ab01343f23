"""The engine: a world that moves.

Handles of links and joints, and groups of joints, talk to `Engine`; what they need of it stands in
a section of its own.
"""

from __future__ import annotations

import copy
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Joint, Link, Model, World
from gazelle.diagnostics import Diagnostics, nearest_names
from gazelle.engine.compiler import Compiled, Extras, compile_world
from gazelle.engine.contact_readings import Contact, read_contacts, waking_copy
from gazelle.engine.divergence import (
    divergence_error,
    find_culprit,
    require_finite,
    require_finite_pose,
)
from gazelle.engine.joint_group import JointGroup
from gazelle.engine.joint_handles import JointHandle
from gazelle.engine.link_handles import LinkHandle, TimedWrench, WrenchTable
from gazelle.engine.motors import POSITION_STEPS, MotorCommand, Motors
from gazelle.engine.mujoco_library import drained_warnings, mujoco, report_library_warnings
from gazelle.engine.position_locks import PositionLocks
from gazelle.engine.scoped_names import joint_part, scoped
from gazelle.engine.state import (
    Snapshot,
    carry_over,
    hash_state,
    initial_data,
    joint_names_of,
    move_root,
    set_initial_positions,
    set_root_velocity,
)
from gazelle.engine.velocity_limits import VelocityLimits
from gazelle.engine.welds import Welds
from gazelle.engine.wheel_slip import CENTRING_STEPS, Slip, WheelSlips
from gazelle.errors import EngineError, NotFoundError
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
    motors: Motors
    locks: PositionLocks
    welds: Welds
    wheel_slips: WheelSlips
    wrenches: WrenchTable


class Engine:
    """A world that moves: steps in C, state by name, models come and go.

    Every name is full: ``model::link``, ``model::joint``. All times are simulated nanoseconds;
    the same world, commands and number of steps give the same state, to the bit.
    """

    def __init__(
        self, world: World, *, diagnostics: Diagnostics | None = None, seed: int = 0
    ) -> None:
        """Build a world.

        Args:
            world: what to simulate.
            diagnostics: takes what is mapped, clipped or ignored.
            seed: kept for reports; the engine itself draws no random numbers.

        Raises:
            EngineError: MuJoCo cannot build the world.
        """
        self.diagnostics = Diagnostics() if diagnostics is None else diagnostics
        self.seed = seed
        self.revision = 0
        self.iteration = 0
        self.time_ns = 0
        self._world = world
        self._step_ns = max(1, round(world.physics.max_step_size_s * _NS))
        self.motors = Motors()
        self.locks = PositionLocks()
        self._welds = Welds()
        self._wheel_slips = WheelSlips()
        self._velocity_limits = VelocityLimits()
        self._wrenches = WrenchTable()
        self._must_compile = False
        self._fresh = 0
        self._accelerated = [False, False]
        self._contacts: tuple[Contact, ...] | None = None
        self._everyone: Any = None
        self._adopt(self._compile(world), None)

    # --- what there is -------------------------------------------------------------------

    @property
    def world(self) -> World:
        """The world as it is now: spawned models in, deleted ones out."""
        return self._world

    @property
    def model(self) -> Any:
        """MuJoCo's model; replaced when `revision` grows."""
        return self._compiled.model

    @property
    def data(self) -> Any:
        """MuJoCo's data; replaced when `revision` grows."""
        return self._data

    @property
    def step_ns(self) -> int:
        """Length of a step."""
        return self._step_ns

    @property
    def gravity_m_s2(self) -> tuple[float, float, float]:
        """Acceleration of free fall, world frame."""
        return self._world.gravity_m_s2

    @property
    def link_names(self) -> tuple[str, ...]:
        """``model::link`` of every link, in the order of the world."""
        return self._compiled.link_names

    @property
    def joint_names(self) -> tuple[str, ...]:
        """``model::joint`` of every joint, fixed ones too."""
        return tuple(name for model in self._world.models for name in joint_names_of(model))

    def link(self, name: str) -> LinkHandle:
        """Return the handle of ``model::link``.

        Raises:
            NotFoundError: there is none, with the nearest names.
        """
        return LinkHandle(self, name)

    def joint(self, name: str, *, axis: int = 0) -> JointHandle:
        """Return the handle of ``model::joint``; `axis` 1 is a universal joint's second axis.

        Raises:
            NotFoundError: there is none, with the nearest names.
        """
        return JointHandle(self, name, axis)

    def joint_group(self, names: Sequence[str]) -> JointGroup:
        """Return several joints, ``model::joint``, read and driven with arrays.

        Raises:
            NotFoundError: there is no such joint, with the nearest names.
            EngineError: a joint has no single coordinate to drive.
        """
        return JointGroup(self, names)

    def description_of_link(self, name: str) -> Link:
        """Return the description of ``model::link``."""
        model_name, _, link_name = name.partition("::")
        model = self._world.model(model_name)
        link = model.link(link_name) if model is not None else None
        if link is None:
            raise NotFoundError("link", name, nearest=nearest_names(name, self.link_names))
        return link

    def description_of_joint(self, name: str) -> Joint:
        """Return the description of ``model::joint``."""
        model_name, _, joint_name = name.partition("::")
        model = self._world.model(model_name)
        joint = model.joint(joint_name) if model is not None else None
        if joint is None:
            raise NotFoundError("joint", name, nearest=nearest_names(name, self.joint_names))
        return joint

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
            if self._wheel_slips.slips:
                steps = min(steps, CENTRING_STEPS)
                self._wheel_slips.prepare(model, data, step_s)
            if self._wrenches.changed:
                self._write_wrenches()
            if is_limited := self._velocity_limits.concern(self._applied):
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
            drained_warnings()
            link = self.description_of_link(culprit.link)
            raise divergence_error(culprit, first, link.span)
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
        for bank in (self.motors, self.locks, self._welds, self._wheel_slips):
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
        if not kind.is_hinge:
            raise EngineError(f"joint '{joint}' ({kind.value}) carries no wheel that could slip")
        slip = Slip(lateral, longitudinal, radius_m)
        if not (all(map(math.isfinite, slip)) and min(slip) >= 0 and radius_m > 0):
            raise EngineError(
                f"wheel '{joint}' cannot slip like {slip}: positive numbers are needed"
            )
        if self._wheel_slips.set(joint, slip):
            self._must_compile = True

    def model_pose(self, name: str) -> Pose:
        """Return where a model's frame is: it moves with the canonical link.

        Raises:
            NotFoundError: there is no such model.
        """
        _, link = self._canonical(name)
        pose = self.link(scoped(name, link.name)).T_world_link()
        return pose @ link.T_model_link.inverse()

    def set_model_pose(self, name: str, T_world_model: Pose) -> None:
        """Put a model somewhere else; joints and velocities stay as they are.

        Raises:
            NotFoundError: there is no such model.
            EngineError: a number is not finite.
        """
        model, _ = self._canonical(name)
        require_finite_pose(T_world_model, f"model '{name}'")
        now = self.model_pose(name)
        roots = [self.body_id(scoped(name, link.name)) for link in model.links]
        if not move_root(self.model, self._data, roots, T_world_model @ now.inverse()):
            moved = tuple(
                replace(item, T_world_model=T_world_model) if item.name == name else item
                for item in self._world.models
            )
            self._rebuild(replace(self._world, models=moved))
        self.state_changed()

    def bring_to_rest(self, name: str) -> None:
        """Take all speed from a model and its joints.

        Raises:
            NotFoundError: there is no such model.
        """
        self._model_named(name)
        # By MuJoCo's bodies: rotors and the like are none of the links.
        for dof, body in enumerate(self.model.dof_bodyid):
            if self.model.body(int(body)).name.startswith(f"{name}::"):
                self._data.qvel[dof] = 0.0
        self.state_changed()

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
            self.locks.copy(), self._welds.copy(), copy.deepcopy(self._wheel_slips),
            self._wrenches.copy(),
        )  # fmt: skip

    def restore_state(self, state: EngineState) -> None:
        """Go back to a saved state, with the models there were."""
        self._world, self._step_ns = state.world, state.step_ns
        self.time_ns, self.iteration = state.time_ns, state.iteration
        self.motors, self._wrenches = copy.deepcopy(state.motors), state.wrenches.copy()
        self.locks, self._welds = state.locks.copy(), state.welds.copy()
        self._wheel_slips = copy.deepcopy(state.wheel_slips)
        self._compiled = replace(state.compiled, model=copy.copy(state.model))
        self._hold(copy.copy(state.data))
        self.locks.hold(self.model, self._data)
        self._welds.hold(self.model, self._data)
        self._velocity_limits.bind(self.model, self._world, self._step_ns / _NS)
        self._must_compile = False
        self.revision += 1
        self.state_changed()

    # --- for handles ---------------------------------------------------------------------

    def ensure_compiled(self) -> None:
        """Build what commands have asked for since the last step."""
        if self._must_compile:
            self._must_compile = False
            self._rebuild(self._world)

    def fresh_data(self) -> Any:
        """Return MuJoCo's data with the poses of now (a step leaves those of its start)."""
        if self._must_compile:
            self.ensure_compiled()
        if self._fresh < 1:
            mujoco.mj_kinematics(self.model, self._data)
            self._fresh = 1
        return self._data

    def data_with_velocities(self) -> Any:
        """Return MuJoCo's data with poses and velocities of now."""
        self.fresh_data()
        if self._fresh < 2:
            mujoco.mj_comPos(self.model, self._data)
            mujoco.mj_comVel(self.model, self._data)
            self._fresh = 2
        return self._data

    def data_with_accelerations(self, body: int) -> Any:
        """Return MuJoCo's data with a body's acceleration and joint reaction of the last step.

        MuJoCo leaves the accelerations of sleepers as if nothing held them, so theirs are those
        of the data in which everyone is awake.
        """
        if self.is_asleep(body):
            data = self.data_of_everyone()
            if not self._accelerated[1]:
                mujoco.mj_rnePostConstraint(self.model, data)
                self._accelerated[1] = True
            return data
        self.data_with_velocities()
        if not self._accelerated[0]:
            mujoco.mj_rnePostConstraint(self.model, self._data)
            self._accelerated[0] = True
        return self._data

    def data_of_everyone(self) -> Any:
        """Return MuJoCo's data with the contacts and constraints of sleepers too."""
        if self._everyone is None:
            self._everyone = waking_copy(self.model, self._data)
        return self._everyone

    def state_changed(self) -> None:
        """Forget what was computed from the state: someone changed it."""
        self._fresh, self._accelerated = 0, [False, False]
        self._contacts, self._everyone = None, None

    def body_id(self, name: str) -> int:
        """Return the MuJoCo body of a link.

        Raises:
            NotFoundError: there is none.
        """
        self.ensure_compiled()
        index = int(mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_BODY, name))
        if index <= 0 or name not in self._compiled.link_names:
            raise NotFoundError("link", name, nearest=nearest_names(name, self.link_names))
        return index

    def joint_address(self, name: str, axis: int) -> tuple[str, int, int]:
        """Return MuJoCo's name, position address and dof of a joint's axis; −1 for none."""
        self.ensure_compiled()
        self.description_of_joint(name)
        element = joint_part(name, "axis2") if axis else name
        index = int(mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_JOINT, element))
        kinds = (mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE)
        if index < 0 or self.model.jnt_type[index] not in [int(kind) for kind in kinds]:
            return element, -1, -1
        return element, int(self.model.jnt_qposadr[index]), int(self.model.jnt_dofadr[index])

    def is_asleep(self, body: int) -> bool:
        """Whether a body rests and is not computed."""
        return int(self._data.body_awake[body]) == int(mujoco.mjtSleepState.mjS_ASLEEP)

    def command_motor(self, element: str, command: MotorCommand | None) -> None:
        """Command or release the motor of a joint; it is built before the next step."""
        if self.motors.command(element, command):
            self._must_compile = True

    def steer_motor(self, element: str, command: MotorCommand) -> None:
        """Command a motor at every step; see `command_motor`."""
        if self.motors.steer(element, command):
            self._must_compile = True

    def install_locks(self, elements: Sequence[str]) -> None:
        """Build the locks of joints, all at once; those that are there stay."""
        if self.locks.install(elements):
            self._must_compile = True
        self.ensure_compiled()

    def release_lock(self, element: str) -> None:
        """Let a joint move that a lock holds."""
        if element in self.locks.installed:
            self.ensure_compiled()
            self.locks.release(self.locks.places([element]))

    def motor_effort(self, element: str) -> float:
        """Return what a joint's motor and lock delivered in the last step."""
        data = self.data_of_everyone()
        effort = self.motors.effort(element, data)
        if element in self.locks.installed:
            effort += float(self.locks.efforts(data)[self.locks.installed.index(element)])
        return effort

    def add_wrench(
        self, link: str, force_n: Array, torque_nm: Array, duration_ns: int | None
    ) -> TimedWrench:
        """Let a wrench about a link's centre of mass act for a time; None for ever.

        Args:
            link: ``model::link``.
            force_n: (3,), world frame.
            torque_nm: (3,), world frame.
            duration_ns: at least one step.

        Raises:
            EngineError: a number is not finite.
        """
        require_finite((*force_n, *torque_nm), f"the wrench on link '{link}'")
        until = None
        if duration_ns is not None:
            steps = max(1, -(-duration_ns // self._step_ns))
            until = self.iteration + steps
        item = TimedWrench(link, force_n, torque_nm, until)
        self._wrenches.add(item)
        return item

    def end_wrench(self, wrench: TimedWrench) -> None:
        """End one wrench before its time; see `LinkHandle.apply_wrench`."""
        self._wrenches.remove(wrench)

    def clear_wrenches(self, link: str | None = None) -> None:
        """End the wrenches on a link, or all."""
        self._wrenches.clear(None if link is None else frozenset((link,)))

    def move_tree(self, body: int, now: Pose, wanted: Pose) -> None:
        """Move the robot that a body belongs to so that the body has a pose.

        Raises:
            EngineError: a number is not finite.
        """
        name = self.model.body(body).name
        require_finite_pose(wanted, f"link '{name}'")
        if not move_root(self.model, self._data, [body], wanted @ now.inverse()):
            name = name.partition("::")[0]
            self.set_model_pose(name, wanted @ now.inverse() @ self.model_pose(name))
        self.state_changed()

    def set_tree_velocity(self, body: int, linear_m_s: Array, angular_rad_s: Array) -> None:
        """Move the robot that a body belongs to so that the body's origin has a velocity.

        Args:
            body: MuJoCo's number.
            linear_m_s: (3,) of the body's origin, world frame.
            angular_rad_s: (3,), world frame.

        Raises:
            EngineError: it is fixed to the world, or a number is not finite.
        """
        handle = self.link(self.model.body(body).name)
        require_finite((*linear_m_s, *angular_rad_s), f"the velocity of link '{handle.name}'")
        now = handle.velocity_world()
        origin = np.asarray(handle.T_world_link().position_m)
        change = (linear_m_s - now.linear_m_s, angular_rad_s - now.angular_rad_s)
        if not set_root_velocity(self.model, self.fresh_data(), body, origin, change):
            raise EngineError(f"link '{handle.name}' is fixed to the world and cannot be pushed")
        self.state_changed()

    # --- inside --------------------------------------------------------------------------

    def _compile(self, world: World) -> Compiled:
        return compile_world(
            world,
            Extras(
                tuple(self.motors.installed),
                tuple(self.locks.installed),
                tuple(self._welds.pairs),
                frozenset(self._wheel_slips.slips_in(world)),
            ),
            step_s=self._step_ns / _NS,
            diagnostics=self.diagnostics,
        )

    def _rebuild(self, world: World) -> None:
        compiled = self._compile(world)
        self._world = world
        self._adopt(compiled, (self._compiled, self._data))

    def _adopt(self, compiled: Compiled, old: tuple[Compiled, Any] | None) -> None:
        data = initial_data(compiled.model, self._world)
        if old is not None:
            old_compiled, old_data = old
            carry_over(old_compiled.model, old_data, compiled.model, data)
        self._compiled = compiled
        self._hold(data)
        self._must_compile = False
        self.revision += 1
        self.motors.bind(compiled.model, compiled.motors)
        self.locks.bind(compiled.model, data, self._step_ns / _NS)
        self._welds.bind(compiled.model, data)
        self._wheel_slips.bind(compiled.model, self._world)
        self._velocity_limits.bind(compiled.model, self._world, self._step_ns / _NS)
        self._wrenches.changed = bool(self._wrenches.items)
        self.state_changed()

    def _hold(self, data: Any) -> None:
        """Keep MuJoCo's data and the views that every step reads (making one costs time)."""
        self._data = data
        self._views: tuple[Array, Array, Array] = (data.qpos, data.qvel, data.qacc_warmstart)
        self._applied: Array = data.qfrc_applied

    def _write_wrenches(self) -> None:
        self._data.xfrc_applied[:] = 0.0
        for name, total in self._wrenches.sums().items():
            self._data.xfrc_applied[self.body_id(name)] = total
        self._wrenches.changed = False

    def _wake_all(self) -> None:
        self._data.qvel[self._data.qvel == 0] = -0.0

    def _model_named(self, name: str) -> Model:
        model = self._world.model(name)
        if model is None:
            names = [item.name for item in self._world.models]
            raise NotFoundError("model", name, nearest=nearest_names(name, names))
        return model

    def _canonical(self, name: str) -> tuple[Model, Link]:
        model = self._model_named(name)
        link = model.link(model.canonical_link) if model.canonical_link else None
        if link is None and not model.links:
            raise EngineError(f"model '{name}' has no links and so no pose of its own")
        return model, link or model.links[0]

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
            dofs, less = self._velocity_limits.held_back(
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
        idle = self._velocity_limits.overrun(self._views[1], self._applied, self.diagnostics)
        asked = self._applied[idle]
        self._applied[idle] = 0.0
        if not self._velocity_limits.throws(self._applied):
            self._advance(1)
        elif self.locks.steps_left:
            self.locks.advance(self._step_held_back, 1)
        else:
            self._step_held_back(self._compiled.model, self._data)
        self._applied[idle] = asked
