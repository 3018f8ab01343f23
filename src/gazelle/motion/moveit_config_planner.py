"""Planning with a robot's MoveIt config package, without a graph."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from gazelle.description.moveit import MoveItConfig, read_moveit_config
from gazelle.diagnostics import Diagnostics, nearest_names
from gazelle.errors import NotFoundError
from gazelle.geometry import Pose
from gazelle.motion.collision import CollisionChecker, CollisionContact
from gazelle.motion.constraints import Constrained, PathConstraint
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.kinematics import Patience, Solver, link_poses
from gazelle.motion.model import JointGroup, RobotModel
from gazelle.motion.planning import ErrorCode, Path, PlanningError, Search, configured, plan
from gazelle.motion.scene import PlanningScene
from gazelle.motion.timing import Trajectory, method_of, parameterise
from gazelle.rich_display import shown_by
from gazelle.workspace import Workspace

__all__ = ["Goal", "PlannedMotion", "Planner", "Search"]

Goal = str | Mapping[str, float] | Pose | FloatArray
"""A named state, positions by joint, or a pose of the tip (a 4×4 array or a `Pose`)."""

_GOALS = 8
_DRAWS = 40
_USUAL = Search()


@shown_by("joint_motions:motion_bundle")
@dataclass(frozen=True)
class PlannedMotion:
    """A motion of a group.

    Attributes:
        group: what moves.
        path: where along.
        trajectory: when where.
        notes: what was done otherwise than asked.
    """

    group: str
    path: Path
    trajectory: Trajectory
    notes: tuple[str, ...] = ()


class Planner:
    """Plans, solves inverse kinematics and looks for collisions in a planning scene.

    ``Planner.load("panda_moveit_config").plan("ready", group="panda_arm").trajectory`` is a
    motion to a named state.

    Attributes:
        config: what the package says.
        robot: joints and groups.
        scene: what there is; set another one to plan around other things.
        diagnostics: what is wrong with the package's files.
    """

    def __init__(self, config: MoveItConfig, diagnostics: Diagnostics | None = None) -> None:
        self.config = config
        self.diagnostics = Diagnostics() if diagnostics is None else diagnostics
        self.robot = RobotModel.from_config(config, diagnostics=self.diagnostics)
        self.scene = PlanningScene.of(self.robot)
        self._checkers: dict[str, CollisionChecker] = {}
        self._solvers: dict[str, Solver] = {}

    @classmethod
    def load(
        cls,
        source: str | os.PathLike[str],
        *,
        workspace: Workspace | None = None,
        robot_name: str = "",
        mappings: Mapping[str, str] | None = None,
    ) -> Planner:
        """Read a MoveIt config package.

        Args:
            source: the package's name or folder.
            workspace: where packages are; found around the package or the current folder if None.
            robot_name: of the SRDF, for packages with several.
            mappings: values of xacro arguments by name.

        Raises:
            NotFoundError: there is no such package.
            UserFileError: there is no robot in it; says all that is wrong.
        """
        diagnostics = Diagnostics()
        config = read_moveit_config(
            source,
            workspace=workspace,
            diagnostics=diagnostics,
            robot_name=robot_name,
            mappings=mappings,
        )
        diagnostics.raise_if_errors()
        assert config is not None, "a missing robot is reported as an error"
        return cls(config, diagnostics)

    @property
    def groups(self) -> tuple[str, ...]:
        """Names of the planning groups."""
        return tuple(self.robot.groups)

    def states(self, group: str = "") -> Mapping[str, Mapping[str, float]]:
        """Return the named states of a group, positions by joint.

        Raises:
            NotFoundError: there is no such group.
        """
        return self._group(group).states

    def fk(self, positions: Mapping[str, float] | None = None, link: str = "") -> Pose:
        """Return the pose of a link in the robot's frame.

        Args:
            positions: of some joints, rad or m; all others stand where the scene has them.
            link: the tip of the only group when empty.

        Raises:
            NotFoundError: there is no such joint or link.
        """
        name = link or self._group("").tip_link
        if name not in self.robot.joint_above:
            known = self.robot.links
            hint = f"links of '{self.robot.name}': {', '.join(known)}"
            raise NotFoundError("link", name, nearest=nearest_names(name, known), hint=hint)
        full = self.robot.positions(positions or {}, self.scene.positions)
        return Pose.from_matrix(link_poses(self.robot, full, [name])[name])

    def ik(
        self,
        pose: Pose | FloatArray,
        *,
        group: str = "",
        link: str = "",
        seed: Mapping[str, float] | None = None,
        avoid_collisions: bool = True,
        timeout_s: float | None = None,
    ) -> dict[str, float] | None:
        """Return positions that bring a link to a pose, None when there are none.

        Args:
            pose: in the robot's frame, m; an array is (4, 4).
            group: whose joints move; the only group when empty.
            link: the group's tip when empty.
            seed: where to start from, positions by joint; the scene's when None.
            avoid_collisions: answers that collide do not count.
            timeout_s: gives up after so long; None for 100 attempts.

        Raises:
            NotFoundError: there is no such group, link or joint.
        """
        own = self._group(group)
        start = self.robot.positions(seed or {}, self.scene.positions)
        found = self._solver(own).ik(
            _matrix(pose),
            seed_q=own.take(start),
            validity=self._checker(own) if avoid_collisions else None,
            patience=Patience(timeout_s=timeout_s),
            link=link,
        )
        return None if found is None else dict(zip(own.variables, found.tolist(), strict=True))

    def collisions(
        self, positions: Mapping[str, float] | None = None, *, group: str = ""
    ) -> tuple[CollisionContact, ...]:
        """Return the pairs that collide, the deepest first.

        Args:
            positions: of some joints; all others stand where the scene has them.
            group: only pairs that it moves; all pairs when empty.

        Raises:
            NotFoundError: there is no such group or joint.
        """
        full = self.robot.positions(positions or {}, self.scene.positions)
        if not group:
            return self._checker(None).contacts(full)
        own = self._group(group)
        checker = self._checker(own).follow(self.scene.with_positions(full))
        return checker.contacts(own.take(full))

    def plan(
        self,
        goal: Goal,
        *,
        group: str = "",
        start: Mapping[str, float] | None = None,
        link: str = "",
        search: Search = _USUAL,
        velocity_scaling: float | None = None,
        acceleration_scaling: float | None = None,
        constraints: Sequence[PathConstraint] = (),
    ) -> PlannedMotion:
        """Plan a motion to a goal, past everything in the scene.

        Args:
            goal: a named state, positions by joint, or a pose of the tip in the robot's frame.
            group: what moves; the only group when empty.
            start: positions by joint; the scene's where it says nothing.
            link: what is brought to a pose; the group's tip when empty.
            search: how the path is looked for; its planner may be a configuration in
                ompl_planning.yaml, with the parameters there unless it has its own.
            velocity_scaling: share of the velocity limits, 0 to 1; joint_limits.yaml's when None.
            acceleration_scaling: the same of acceleration.
            constraints: what must hold all along the path.

        Raises:
            NotFoundError: there is no such group, state, joint or link.
            PlanningError: there is no plan, with MoveIt's error code and why.
        """
        own = self._group(group)
        pipeline = self.config.pipelines[self.config.default_pipeline]
        chosen = configured(pipeline, own.name, search.planner, own.space, self.diagnostics)
        scene = self.scene.with_positions(start or {})
        checker = self._checker(own).follow(scene)
        begin = own.take(scene.positions)
        goals = self._goals(goal, own, begin, checker, link, search.seed)
        path = plan(
            own.space,
            checker,
            begin,
            goals,
            search=replace(
                search, planner=chosen.planner, settings=search.settings or chosen.settings
            ),
            constraints=constraints,
        )
        method, notes = method_of((*pipeline.request_adapters, *pipeline.response_adapters))
        velocity, acceleration = self.config.velocity_scaling, self.config.acceleration_scaling
        trajectory = parameterise(
            path,
            own.space,
            velocity_scaling=velocity if velocity_scaling is None else velocity_scaling,
            acceleration_scaling=(
                acceleration if acceleration_scaling is None else acceleration_scaling
            ),
            method=method,
            validity=Constrained(checker, tuple(constraints)) if constraints else checker,
        )
        return PlannedMotion(own.name, path, trajectory, (*notes, *path.notes, *trajectory.notes))

    def _group(self, name: str) -> JointGroup:
        if not name and len(self.robot.groups) == 1:
            return next(iter(self.robot.groups.values()))
        return self.robot.group(name)

    def _goals(
        self,
        goal: Goal,
        group: JointGroup,
        start: FloatArray,
        checker: CollisionChecker,
        link: str,
        seed: int,
    ) -> list[FloatArray]:
        if isinstance(goal, str):
            if goal not in group.states:
                hint = f"states of '{group.name}': {', '.join(group.states) or 'none'}"
                near = nearest_names(goal, group.states)
                raise NotFoundError("named state", goal, nearest=near, hint=hint)
            goal = group.states[goal]
        if isinstance(goal, Mapping):
            full = self.robot.positions(goal, checker.scene.positions)
            return [group.take(full)]
        return self._configurations(_matrix(goal), group, start, checker, link, seed)

    def _configurations(
        self,
        pose: FloatArray,
        group: JointGroup,
        start: FloatArray,
        checker: CollisionChecker,
        link: str,
        seed: int,
    ) -> list[FloatArray]:
        """Return several answers of inverse kinematics, for any of them may be unreachable."""
        solver, rng = self._solver(group), np.random.default_rng(seed)
        first = solver.ik(pose, seed_q=start, rng=rng, link=link)
        if first is None:
            x, y, z = pose[:3, 3]
            reason = f"no configuration of group '{group.name}' brings"
            reason += f" '{link or solver.tip_link}' to ({x:.3f}, {y:.3f}, {z:.3f}) m as asked"
            raise PlanningError(ErrorCode.NO_IK_SOLUTION, reason)
        found: list[FloatArray] = [first] if checker.is_valid(first) else []
        for _ in range(_DRAWS):
            if len(found) >= _GOALS:
                break
            elsewhere, few = group.space.sample(rng), Patience(attempts=5)
            other = solver.ik(pose, seed_q=elsewhere, rng=rng, patience=few, link=link)
            if other is not None and checker.is_valid(other) and _is_new(other, found):
                found.append(other)
        if not found:
            reason = f"every configuration found for the pose collides: {checker.why(first)}"
            raise PlanningError(ErrorCode.GOAL_IN_COLLISION, reason)
        return found

    def _checker(self, group: JointGroup | None) -> CollisionChecker:
        name = "" if group is None else group.name
        known = self._checkers.get(name)
        if known is None:
            known = CollisionChecker(self.scene, group, diagnostics=self.diagnostics)
        elif known.scene is not self.scene:
            known = known.follow(self.scene)
        self._checkers[name] = known
        return known

    def _solver(self, group: JointGroup) -> Solver:
        settings = self.config.kinematics.get(group.name)
        known = self._solvers.get(group.name) or Solver(self.robot, group, settings=settings)
        self._solvers[group.name] = known.at(self.scene.positions)
        return self._solvers[group.name]


def _matrix(pose: Pose | FloatArray) -> FloatArray:
    matrix = pose.matrix() if isinstance(pose, Pose) else np.asarray(pose, dtype=np.float64)
    if matrix.shape != (4, 4):
        raise ValueError(f"a pose is a 4×4 array, this one has shape {matrix.shape}")
    return matrix


def _is_new(q: FloatArray, others: Sequence[FloatArray]) -> bool:
    return all(float(np.abs(q - other).max()) > 1e-2 for other in others)
