"""What engine and handles share: the compiled world, its state and what is read from it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.description.model import Joint, Link, Model, World
from gazelle.diagnostics import Diagnostics, nearest_names
from gazelle.engine.compiler import Compiled, Extras, compile_world
from gazelle.engine.contacts import Contact, joint_reaction, waking_copy
from gazelle.engine.divergence import require_finite, require_finite_pose
from gazelle.engine.joint_group import JointGroup
from gazelle.engine.joint_handles import JointHandle
from gazelle.engine.link_handles import LinkHandle, TimedWrench, WrenchTable
from gazelle.engine.motors import MotorBank, MotorCommand
from gazelle.engine.mujoco_library import mujoco
from gazelle.engine.position_locks import LockBank
from gazelle.engine.scoped_names import joint_part, scoped
from gazelle.engine.state import (
    Wrench,
    carry_over,
    initial_data,
    joint_names_of,
    move_root,
    set_root_velocity,
)
from gazelle.engine.velocity_limits import SpeedLimits
from gazelle.engine.welds import WeldBank
from gazelle.engine.wheel_slip import TyreBank
from gazelle.errors import EngineError, NotFoundError
from gazelle.geometry import Pose

__all__ = ["EngineCore"]

Array = NDArray[np.float64]
_NS = 1_000_000_000


class EngineCore:
    """The compiled world behind `Engine`; handles talk to this."""

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
        self.motors = MotorBank()
        self.locks = LockBank()
        self._welds = WeldBank()
        self._tyres = TyreBank()
        self._speed_limits = SpeedLimits()
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

    def reaction_wrench(self, name: str) -> Wrench:
        """Return what a joint transmits; see `JointHandle.reaction_wrench`."""
        joint = self.description_of_joint(name)
        child = self.link(scoped(name.partition("::")[0], joint.child))
        body = self.body_id(child.name)
        data = self.data_with_accelerations(body)
        T_world_joint = (
            child.T_world_link() @ child.link.T_model_link.inverse() @ (joint.T_model_joint)
        )
        return joint_reaction(self.model, data, body, np.asarray(T_world_joint.position_m))

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

    # --- inside --------------------------------------------------------------------------

    def _compile(self, world: World) -> Compiled:
        return compile_world(
            world,
            Extras(
                tuple(self.motors.installed),
                tuple(self.locks.installed),
                tuple(self._welds.pairs),
                frozenset(self._tyres.slips_in(world)),
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
        self._tyres.bind(compiled.model, self._world)
        self._speed_limits.bind(compiled.model, self._world, self._step_ns / _NS)
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
