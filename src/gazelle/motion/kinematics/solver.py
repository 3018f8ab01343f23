"""Forward and inverse kinematics of a planning group."""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Iterator
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from gazelle.description.moveit import KinematicsSettings
from gazelle.diagnostics import nearest_names
from gazelle.errors import NotFoundError
from gazelle.motion.joint_space import BoolArray, FloatArray, Validity
from gazelle.motion.kinematics.chain import Chain, Goal, LinkTree, chain_to, link_tree
from gazelle.motion.kinematics.kernels import chain_jacobian, chain_pose, solve, tree
from gazelle.motion.model import JointGroup, JointKind, RobotModel

__all__ = ["Patience", "Solver", "link_poses"]


def link_poses(
    robot: RobotModel, positions: FloatArray, links: Iterable[str] | None = None
) -> dict[str, FloatArray]:
    """Return 4×4 poses of links in the robot's frame.

    Args:
        robot: the robot.
        positions: of all its variables, rad or m, see `RobotModel.positions`.
        links: those that are wanted; all when None.

    Raises:
        KeyError: there is no such link.
    """
    arrays = _tree_of(robot)
    count = len(arrays.parents)
    R, p = np.empty((count, 3, 3)), np.empty((count, 3))
    tree(arrays, np.ascontiguousarray(positions, dtype=np.float64), R, p)
    poses = np.zeros((count, 4, 4))
    poses[:, :3, :3], poses[:, :3, 3], poses[:, 3, 3] = R, p, 1.0
    found = dict(zip(robot.links, poses, strict=True))
    return found if links is None else {name: found[name] for name in links}


@lru_cache(maxsize=8)
def _tree_of(robot: RobotModel) -> LinkTree:
    return link_tree(robot)


_STEPS = 60

_BATCH = 16

_TURN = 2.0 * math.pi

_IDENTITY = np.eye(4)


class Patience(NamedTuple):
    """How long inverse kinematics tries.

    Attributes:
        attempts: number of starts.
        timeout_s: gives up after so long; None for all attempts.
    """

    attempts: int = 100
    timeout_s: float | None = None


_USUAL = Patience()


class Solver:
    """Poses of a group's links and configurations that bring its tip to a pose.

    All poses are 4×4 and in the robot's frame (`RobotModel.frame`). Joints outside the group
    stand still at `positions`.

    Attributes:
        robot: the robot.
        group: whose joints move.
        tip_link: what is brought to a pose unless another link is named.
        settings: tolerance and weights, as kinematics.yaml has them.
        positions: of the whole robot.
    """

    def __init__(
        self,
        robot: RobotModel,
        group: str | JointGroup,
        *,
        tip_link: str = "",
        settings: KinematicsSettings | None = None,
        positions: FloatArray | None = None,
    ) -> None:
        self.robot = robot
        self.group = robot.group(group) if isinstance(group, str) else group
        self.settings = settings or KinematicsSettings()
        self.positions = robot.default_positions() if positions is None else positions
        self.tip_link = tip_link or next(iter(self.settings.tips), "") or self.group.tip_link
        self._outside = np.ones(len(robot.variables), dtype=np.bool_)
        self._outside[self.group.indices] = False
        self._chains: dict[tuple[str, bytes], Chain] = {}
        self._check_link(self.tip_link or self.group.tip_links[0])

    def at(self, positions: FloatArray) -> Solver:
        """Return the same solver with the joints outside the group at a robot's positions (v,)."""
        if np.array_equal(positions[self._outside], self.positions[self._outside]):
            return self
        return Solver(
            self.robot,
            self.group,
            tip_link=self.tip_link,
            settings=self.settings,
            positions=positions,
        )

    def fk(self, q: FloatArray, link: str = "") -> FloatArray:
        """Return the pose, (4, 4), of a link in the robot's frame.

        Args:
            q: configuration of the group, rad or m.
            link: any link of the robot; the tip when empty.

        Raises:
            NotFoundError: there is no such link.
        """
        R, p, _, _ = self._at(self._chain(link, _IDENTITY), q)
        return _pose(R, p)

    def jacobian(
        self, q: FloatArray, link: str = "", *, T_link_tool: FloatArray | None = None
    ) -> FloatArray:
        """Return the 6×n Jacobian of a link's origin, or of a point fixed to it.

        Rows are linear velocity x, y, z (m/s) and angular velocity x, y, z (rad/s) in the robot's
        frame; columns are the group's variables, a floating joint's quaternion being three turns
        about x, y, z.
        """
        chain = self._chain(link, _IDENTITY if T_link_tool is None else T_link_tool)
        _, p, frames, origins = self._at(chain, q)
        found = np.empty((6, len(chain.dof_variables)))
        chain_jacobian(chain, frames, origins, p, found)
        return found

    def ik(
        self,
        T_base_tip: FloatArray,
        *,
        seed_q: FloatArray | None = None,
        patience: Patience = _USUAL,
        validity: Validity | None = None,
        rng: np.random.Generator | None = None,
        link: str = "",
        T_link_tool: FloatArray | None = None,
        position_only: bool | None = None,
    ) -> FloatArray | None:
        """Return a configuration that brings the tip to a pose, None when none was found.

        The first attempt starts at `seed_q`, all others at random configurations; so the answer
        is the one nearest to the seed in most cases, and a redundant arm moves as little as it
        can. Joints stay within their limits; those that can turn further than once come as near
        to the seed as whole turns allow.

        Args:
            T_base_tip: 4×4 pose in the robot's frame, m.
            seed_q: where to start; the middle of all ranges when None.
            patience: how long it is tried.
            validity: refuses solutions, such as those that collide.
            rng: draws the random starts; one with a fixed seed when None.
            link: what is brought to the pose; the group's tip when empty.
            T_link_tool: 4×4 pose of a tool in the link's frame, which is brought there instead.
            position_only: the orientation does not matter; as kinematics.yaml has it when None.

        Raises:
            NotFoundError: there is no such link, or the group has several tips and none is named.
            ValueError: the pose is not finite.
        """
        chain = self._chain(link, _IDENTITY if T_link_tool is None else T_link_tool)
        target = np.ascontiguousarray(T_base_tip, dtype=np.float64)
        if not np.isfinite(target).all():
            raise ValueError("the pose has numbers that are not finite")
        alone = self.settings.position_only if position_only is None else position_only
        weight = 0.0 if alone else self.settings.orientation_vs_position or 1.0
        seed = self._middle() if seed_q is None else np.array(seed_q, dtype=np.float64)
        for q in self._solutions(chain, target, weight, seed, patience, rng):
            found = self._near(q, seed)
            if validity is None or validity.is_valid(found):
                return found
        return None

    def _solutions(
        self,
        chain: Chain,
        target: FloatArray,
        weight: float,
        seed: FloatArray,
        patience: Patience,
        rng: np.random.Generator | None,
    ) -> Iterator[FloatArray]:
        """Yield one solution per attempt that succeeds."""
        timeout_s, attempts = patience.timeout_s, patience.attempts
        end_s = math.inf if timeout_s is None else time.monotonic() + timeout_s
        space, settings = self.group.space, self.settings
        lower = np.where(space.continuous, -np.inf, space.lower)
        upper = np.where(space.continuous, np.inf, space.upper)
        steps = min(_STEPS, settings.max_iterations)
        goal = Goal(
            np.ascontiguousarray(target[:3, :3]),
            np.ascontiguousarray(target[:3, 3]),
            float(weight),
            float(settings.epsilon),
            float(settings.epsilon),
            steps,
        )
        out = np.empty(space.size)
        starts = np.clip(seed, lower, upper)[None]
        done = 0
        while True:
            number = solve(chain, goal, lower, upper, starts, out)
            if number >= 0:
                yield out.copy()
            used = number + 1 if number >= 0 else len(starts)
            done += used
            starts = starts[used:]
            if done >= attempts or time.monotonic() >= end_s:
                return
            if not len(starts):
                rng = np.random.default_rng(0) if rng is None else rng
                count = min(_BATCH, attempts - done)
                starts = rng.uniform(space.low, space.high, (count, space.size))

    def _near(self, q: FloatArray, seed: FloatArray) -> FloatArray:
        """Take whole turns off or on, so that turning joints come near the seed."""
        space = self.group.space
        turned = q + _TURN * np.round((seed - q) / _TURN)
        turning = self._turning()
        fits = turning & (space.continuous | ((turned >= space.lower) & (turned <= space.upper)))
        return np.where(fits, turned, q)

    def _turning(self) -> BoolArray:
        kinds = {
            name: joint.kind is JointKind.REVOLUTE or name.endswith("/theta")
            for joint in self.robot.joints
            for name in joint.variables
        }
        return np.array([kinds[name] for name in self.group.variables], dtype=np.bool_)

    def _middle(self) -> FloatArray:
        space = self.group.space
        middle = 0.5 * (space.low + space.high)
        bounded = ~space.continuous & np.isfinite(space.lower) & np.isfinite(space.upper)
        # The middle of a quaternion's range is no rotation.
        bounded &= np.array(["/rot_" not in name for name in space.names], dtype=np.bool_)
        return np.where(bounded, middle, self.group.take(self.positions))

    def _at(
        self, chain: Chain, q: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        count = len(chain.kinds)
        R, p = np.empty((3, 3)), np.empty(3)
        frames, origins = np.zeros((count, 3, 3)), np.zeros((count, 3))
        values = np.ascontiguousarray(q, dtype=np.float64)
        chain_pose(chain, values, R, p, frames, origins)
        return R, p, frames, origins

    def _chain(self, link: str, offset: FloatArray) -> Chain:
        name = link or self.tip_link
        if not name:
            tips = ", ".join(self.group.tip_links)
            hint = f"group '{self.group.name}' has several tips, name one of them: {tips}"
            raise NotFoundError("tip", self.group.name, hint=hint)
        key = (name, np.asarray(offset, dtype=np.float64).tobytes())
        if key not in self._chains:
            self._check_link(name)
            if len(self._chains) >= 32:
                self._chains.clear()
            self._chains[key] = chain_to(self.robot, self.group, name, self.positions, offset)
        return self._chains[key]

    def _check_link(self, name: str) -> None:
        if name not in self.robot.joint_above:
            near = nearest_names(name, self.robot.links)
            hint = f"links of '{self.robot.name}': {', '.join(self.robot.links)}"
            raise NotFoundError("link", name, nearest=near, hint=hint)


def _pose(R: FloatArray, p: FloatArray) -> FloatArray:
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = R, p
    return pose
