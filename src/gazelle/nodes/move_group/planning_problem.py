"""What a request asks, resolved: group, start, kinematics, collisions, constraints."""

from __future__ import annotations

import threading
from dataclasses import dataclass
from typing import Any

from gazelle.description.moveit import MoveItConfig
from gazelle.diagnostics import did_you_mean
from gazelle.geometry import Pose
from gazelle.motion import kinematics, planning
from gazelle.motion.collision import CollisionChecker
from gazelle.motion.constraints import PathConstraint
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.kinematics import Patience, Solver
from gazelle.motion.model import JointGroup, RobotModel
from gazelle.motion.planning.error_codes import ErrorCode
from gazelle.motion.scene import PlanningScene
from gazelle.nodes.move_group.collision_object_messages import FrameOf
from gazelle.nodes.move_group.constraint_messages import ConstraintReader
from gazelle.nodes.move_group.error_codes import MoveGroupError

__all__ = ["GroupProblem", "ProblemMaker"]


@dataclass(frozen=True)
class GroupProblem:
    """A group in a scene.

    Attributes:
        scene: with the robot where the motion starts.
        group: what moves.
        solver: its kinematics.
        checker: what it may not touch; for the thread that asked for it only.
        frame_of: resolves frames.
    """

    scene: PlanningScene
    group: JointGroup
    solver: Solver
    checker: CollisionChecker
    frame_of: FrameOf

    @property
    def start_q(self) -> FloatArray:
        """Where the group starts, rad and m, (variables of the group,)."""
        return self.group.take(self.scene.positions)

    def T_planning_frame(self, name: str) -> FloatArray:
        """Return the pose of a frame, 4×4.

        Raises:
            MoveGroupError: nobody knows it.
        """
        return self.frame_of(self.scene, name).matrix()

    def constraints(
        self, message: Any, code: ErrorCode = ErrorCode.INVALID_GOAL_CONSTRAINTS
    ) -> tuple[PathConstraint, ...]:
        """Return the constraints of a ``Constraints`` message.

        Raises:
            MoveGroupError: one of them makes no sense.
        """
        reader = ConstraintReader(self.scene.robot, self.group, self, self.solver.fk, code)
        return reader.read(message)

    def positions(self, q: FloatArray) -> FloatArray:
        """Return the robot's positions, (variables,), with the group at `q`; rad and m.

        Args:
            q: a configuration of the group, (variables of the group,).
        """
        return self.scene.robot.with_group(self.group, q, self.scene.positions)

    def link_pose(self, q: FloatArray, link: str) -> Pose:
        """Return where a link is in the planning frame with the group at a configuration.

        Args:
            q: the configuration, rad and m, (variables of the group,).
            link: its name.
        """
        return Pose.from_matrix(self.solver.fk(q, link))


class ProblemMaker:
    """Makes problems; collision models are kept as long as nothing but poses changes."""

    def __init__(self, config: MoveItConfig, robot: RobotModel) -> None:
        """Begin without any collision model."""
        self.config = config
        self.robot = robot
        self._lock = threading.Lock()
        self._checkers: dict[str, CollisionChecker] = {}
        self._solvers: dict[str, Solver] = {}

    def group(self, name: str) -> JointGroup:
        """Return a group.

        Raises:
            MoveGroupError: there is none of this name.
        """
        found = self.robot.groups.get(name)
        if found is None:
            hint = did_you_mean(name, self.robot.groups)
            there = ", ".join(self.robot.groups) or "none"
            text = f"there is no planning group '{name}' (there are: {there}); {hint}"
            raise MoveGroupError(ErrorCode.INVALID_GROUP_NAME, text)
        return found

    def problem(self, scene: PlanningScene, group: str, frame_of: FrameOf) -> GroupProblem:
        """Return a group in a scene.

        Raises:
            MoveGroupError: there is no such group.
        """
        own = self.group(group)
        solver = self._solver(own).at(scene.positions)
        return GroupProblem(scene, own, solver, self.checker(scene, group), frame_of)

    def checker(self, scene: PlanningScene, group: str = "") -> CollisionChecker:
        """Return a collision checker for the calling thread, of all groups when none is named."""
        own = self.group(group) if group else None
        with self._lock:
            known = self._checkers.get(group)
            made = CollisionChecker(scene, own) if known is None else known.follow(scene)
            self._checkers[group] = made
            return made.copy()

    def warm_up(self, scene: PlanningScene) -> None:
        """Build collision models and compile kernels, so that no request has to wait for them."""
        kinematics.warm_up()
        self.checker(scene)
        for group in self.robot.groups.values():
            planning.warm_up(group.space, self.checker(scene, group.name))
            if group.tip_link:
                solver, q = self._solver(group), group.take(scene.positions)
                solver.ik(solver.fk(q), seed_q=q, patience=Patience(attempts=1))
                solver.jacobian(q)

    def _solver(self, group: JointGroup) -> Solver:
        with self._lock:
            if group.name not in self._solvers:
                settings = self.config.kinematics.get(group.name)
                self._solvers[group.name] = Solver(self.robot, group, settings=settings)
            return self._solvers[group.name]
