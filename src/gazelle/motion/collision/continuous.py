"""Whole motions of a robot checked at once."""

from __future__ import annotations

import copy
import math
from collections.abc import Mapping, Sequence
from enum import Enum
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from gazelle.geometry import Pose
from gazelle.motion.collision.collision_model import CollisionBody, may_touch
from gazelle.motion.collision.convex_solids import ConvexRows, Solid, rows_of
from gazelle.motion.collision.gjk_kernels import (
    APART,
    CENTRE,
    FIRST_VERTEX,
    FRAME,
    HULL,
    KIND,
    RADIUS,
    SLACK,
)
from gazelle.motion.collision.sweep_arguments import (
    PASSING,
    Bodies,
    GroupVariables,
    Motions,
    PlacedSolids,
    SweepArguments,
)
from gazelle.motion.collision.sweep_kernels import (
    COLLIDES,
    FREE,
    MAX_STEPS,
    TOO_LONG,
    pair_clear,
    sweep,
)
from gazelle.motion.joint_space import FloatArray
from gazelle.motion.kinematics import link_poses
from gazelle.motion.kinematics.chain import LinkTree, link_tree
from gazelle.motion.kinematics.kernels import tree
from gazelle.motion.model import JointGroup, JointKind, RobotJoint
from gazelle.motion.scene import PlanningScene

__all__ = ["Sweeper", "Verdict"]

IntArray = NDArray[np.int64]

_UNLIMITED_M = 1e9
_MAX_DOUBTS = 256
_SCRATCH = (10, 4)


class Verdict(Enum):
    """What is known of a motion."""

    FREE = "free"
    COLLIDES = "collides"
    DOUBTFUL = "doubtful"


class Sweeper:
    """Says of states and motions of a group whether they are free, where bounds can tell.

    Not for use in several threads at once; make a `copy` for each.

    Attributes:
        arguments: of `sweep_kernels.sweep`, which writes to some of them.
        has_constant_neighbours: there are two that nothing moves apart, and that may touch.
    """

    arguments: SweepArguments

    def __init__(
        self, scene: PlanningScene, group: JointGroup | None, bodies: Sequence[CollisionBody]
    ) -> None:
        robot = scene.robot
        self._group = group
        frames = _Frames(scene, group, bodies)
        self._variables = variables = robot.variables if group is None else group.variables
        rules = robot.followers_of(variables)
        members, solids = _rows_of_all(bodies, frames)
        reaches = _Reaches(scene, variables, bodies, frames.numbers)
        every = _pairs(scene, group, bodies)
        apart = reaches.apart(every)
        moved = apart.any(axis=1)
        pairs = every[moved]
        self._constant_pairs = every[~moved]
        arguments = SweepArguments(
            frames.tree,
            GroupVariables(
                np.array(scene.positions, dtype=np.float64),
                np.array([robot.variables.index(name) for name in variables], np.int64),
                np.array([rule[0] for rule in rules], np.int64),
                np.array([rule[1] for rule in rules], np.int64),
                np.array([rule[2:] for rule in rules], np.float64).reshape(-1, 2),
            ),
            reaches.motions,
            Bodies(members, pairs, apart[moved], np.zeros((len(pairs), 4)), np.arange(len(pairs))),
            solids,
            np.zeros(_SCRATCH),
            np.empty(_MAX_DOUBTS),
        )
        self.arguments = arguments
        self.has_constant_neighbours = self._has_constant_neighbours()
        # Compiled or loaded here, and not in the time that somebody has for planning.
        own = arguments.group
        self.state(own.positions[own.indices])

    def copy(self) -> Sweeper:
        """Return one of the same scene that another thread may use."""
        other = copy.copy(self)
        own = self.arguments
        group, bodies, solids = own.group, own.bodies, own.solids
        copied = own._replace(
            group=group._replace(positions=group.positions.copy()),
            bodies=bodies._replace(axes=bodies.axes.copy(), order=bodies.order.copy()),
            solids=solids._replace(
                rotations=solids.rotations.copy(), positions_m=solids.positions_m.copy()
            ),
            work=np.zeros(_SCRATCH),
            doubts=np.empty(_MAX_DOUBTS),
        )
        other.arguments = copied
        return other

    def follow(self, scene: PlanningScene, bodies: Sequence[CollisionBody]) -> Sweeper:
        """Return one of a scene with the same things elsewhere."""
        other = self.copy()
        own = other.arguments
        frames = _Frames(scene, self._group, bodies)
        positions = np.array(scene.positions, dtype=np.float64)
        followed = own._replace(
            links=frames.tree,
            group=own.group._replace(positions=positions),
            motions=_Reaches(scene, self._variables, bodies, frames.numbers).motions,
            solids=own.solids._replace(rotations=frames.R, positions_m=frames.p),
        )
        other.arguments = followed
        other.has_constant_neighbours = other._has_constant_neighbours()
        return other

    def state(self, q: FloatArray) -> Verdict:
        """Return what is known of a state (n,), rad or m."""
        return self._swept(q, np.zeros(len(q)), 1.0)[0]

    def motion(self, q0: FloatArray, q1: FloatArray, step: float) -> tuple[Verdict, FloatArray]:
        """Return what is known of a straight motion whose beginning is known to be free.

        Args:
            q0: where it begins.
            q1: where it ends.
            step: longest piece of which only the middle need be free, Euclidean, rad or m.

        Returns:
            the verdict, and the states that are in doubt, (m, n).

        Raises:
            ValueError: the step is not more than zero.
        """
        if not step > 0.0:
            raise ValueError(f"the step of a motion's check is {step:g}, not more than 0")
        way = q1 - q0
        pieces = math.ceil(float(np.sqrt(way @ way)) / (MAX_STEPS * step)) or 1
        doubtful = [np.empty((0, len(q0)))]
        for piece in range(pieces):
            begin = q0 + way * (piece / pieces)
            verdict, parts = self._swept(begin, way / pieces, step)
            if verdict is Verdict.COLLIDES:
                return verdict, doubtful[0]
            doubtful.append(begin + way * (parts[:, None] / pieces))
        states = np.concatenate(doubtful)
        return Verdict.DOUBTFUL if len(states) else Verdict.FREE, states

    def _swept(self, q0: FloatArray, way: FloatArray, step: float) -> tuple[Verdict, FloatArray]:
        q0 = np.ascontiguousarray(q0, dtype=np.float64)
        while True:
            found, value = sweep(q0, way, step, self.arguments)
            doubts = self.arguments.doubts
            if found != TOO_LONG:
                break
            self.arguments = self.arguments._replace(doubts=np.empty(2 * len(doubts)))
        if found == FREE:
            return Verdict.FREE, doubts[:0]
        if found == COLLIDES:
            return Verdict.COLLIDES, doubts[:0]
        return Verdict.DOUBTFUL, doubts[: int(value)].copy()

    def _has_constant_neighbours(self) -> bool:
        """Return whether a pair that nothing moves apart is not known to be apart."""
        pairs, own = self._constant_pairs, self.arguments
        if len(pairs):
            tree(own.links, own.group.positions, own.solids.rotations, own.solids.positions_m)
        bodies = own.bodies._replace(pairs=pairs, axes=np.zeros((len(pairs), 4)))
        for number in range(len(pairs)):
            state, _, _ = pair_clear(number, bodies, own.solids, 0.0, 0, _unknown(), own.work)
            if state != APART:
                return True
        return False


def _unknown() -> NDArray[np.void]:
    """Return one `PASSING` of which nothing is known."""
    return np.full(PASSING.itemsize // 8, np.inf).view(PASSING)


def _rows_of_all(bodies: Sequence[CollisionBody], frames: _Frames) -> tuple[IntArray, PlacedSolids]:
    """Return the `Bodies.members` and the rows of all, below each other."""
    solids, kinds, vertices, members = [], [], [], []
    first_row = first_vertex = 0
    for number, body in enumerate(bodies):
        rows = _rows(body)
        own = rows.kinds.copy()
        own[:, FRAME] = frames.of_body[number]
        own[:, FIRST_VERTEX] += first_vertex
        members.append((first_row, first_row + len(own) - rows.own, rows.own))
        solids.append(rows.solids)
        kinds.append(own)
        vertices.append(rows.vertices)
        first_row += len(own)
        first_vertex += len(rows.vertices)
    placed = PlacedSolids(
        np.concatenate(solids) if solids else np.zeros((0, 24)),
        np.concatenate(kinds) if kinds else np.zeros((0, 4), np.int64),
        np.ascontiguousarray(np.concatenate([*vertices, np.zeros((1, 3))]).T),
        frames.R,
        frames.p,
    )
    return np.array(members, np.int64).reshape(-1, 3), placed


@lru_cache(maxsize=512)
def _kept_rows(solids: tuple[Solid, ...], margin_m: float) -> ConvexRows:
    return rows_of(solids, margin_m)


def _rows(body: CollisionBody) -> ConvexRows:
    """Return a body's rows in its frame; those of links are kept, as solids are the same ones."""
    if body.owner.kind != "link":
        pose = Pose() if body.is_object else body.T_frame_body
        return rows_of([Solid(one, pose @ own) for one, own in body.solids], body.margin_m)
    return _kept_rows(body.solids, body.margin_m)


class _Frames:
    """Where solids are: links that move, links that stand still, and things.

    Attributes:
        tree: the links that move.
        R: rotations of all frames; those of links that move come first and are written over.
        p: positions of all frames.
        of_body: number of the frame of each body.
        numbers: of the frames of links.
    """

    def __init__(
        self, scene: PlanningScene, group: JointGroup | None, bodies: Sequence[CollisionBody]
    ) -> None:
        robot = scene.robot
        poses = link_poses(robot, scene.positions)
        names = set(robot.links if group is None else group.moved_links)
        moving = [place for place, link in enumerate(robot.links) if link in names]
        self.tree = _part(link_tree(robot), moving, [poses[link] for link in robot.links])
        numbers = {robot.links[place]: number for number, place in enumerate(moving)}
        self.numbers = numbers
        matrices = [np.eye(4) for _ in moving]
        self.of_body: list[int] = []
        for body in bodies:
            if body.is_object:
                self.of_body.append(len(matrices))
                matrices.append(body.T_frame_body.matrix())
                continue
            if body.link not in numbers:
                numbers[body.link] = len(matrices)
                matrices.append(poses[body.link])
            self.of_body.append(numbers[body.link])
        stacked = np.array(matrices).reshape(-1, 4, 4)
        self.R = np.ascontiguousarray(stacked[:, :3, :3])
        self.p = np.ascontiguousarray(stacked[:, :3, 3])


def _part(whole: LinkTree, kept: list[int], poses: Sequence[FloatArray]) -> LinkTree:
    """Return some links of a tree; those whose parent is left out start where it stands."""
    place = {old: new for new, old in enumerate(kept)}
    A, a = whole.A[kept].copy(), whole.a[kept].copy()
    parents = np.full(len(kept), -1, np.int64)
    for new, old in enumerate(kept):
        above = int(whole.parents[old])
        if above in place:
            parents[new] = place[above]
        elif above >= 0:
            pose = poses[above]
            a[new] = pose[:3, :3] @ a[new] + pose[:3, 3]
            A[new] = pose[:3, :3] @ A[new]
    return LinkTree(
        parents, A, a, whole.kinds[kept], whole.axes[kept], whole.places[kept],
        whole.B[kept], whole.b[kept],
    )  # fmt: skip


def _pairs(
    scene: PlanningScene, group: JointGroup | None, bodies: Sequence[CollisionBody]
) -> IntArray:
    """Return the numbers of bodies that must not touch, where the group moves one of them."""
    moved = None if group is None else set(group.moved_links)
    active = [not body.is_object if moved is None else body.owner.link in moved for body in bodies]
    found = [
        (first, second)
        for first in range(len(bodies))
        for second in range(first + 1, len(bodies))
        if (active[first] or active[second])
        and not may_touch(scene, bodies[first].owner, bodies[second].owner)
    ]
    return np.array(found, np.int64).reshape(-1, 2)


class _Reaches:
    """How far points of bodies move at most when a variable changes by one.

    Attributes:
        motions: by joint, those without a variable left out.
    """

    def __init__(
        self,
        scene: PlanningScene,
        variables: Sequence[str],
        bodies: Sequence[CollisionBody],
        frames: Mapping[str, int],
    ) -> None:
        self._robot = robot = scene.robot
        self._positions = scene.positions
        self._places = {name: place for place, name in enumerate(variables)}
        self._joints = [
            joint
            for joint in robot.joints
            if any(robot.mimic_of(name)[0] in self._places for name in joint.variables)
        ]
        self._number = {joint.name: number for number, joint in enumerate(self._joints)}
        shape = len(bodies), len(self._joints)
        self._above = np.zeros(shape, np.bool_)
        self._moves = np.zeros((*shape, len(variables)))
        for number, body in enumerate(bodies):
            if not body.is_object:
                self._climb(number, body)
        turning = [joint.kind is JointKind.REVOLUTE for joint in self._joints]
        self.motions = Motions(
            np.array(
                [
                    frames.get(joint.child, -1) if turns else -1
                    for joint, turns in zip(self._joints, turning, strict=True)
                ],
                np.int64,
            ),
            np.array([_line(joint) for joint in self._joints]).reshape(-1, 6),
            np.array([self._turned(joint) for joint in self._joints]).reshape(-1, len(variables)),
            self._moves,
            self._above,
        )

    def apart(self, pairs: IntArray) -> NDArray[np.bool_]:
        """Return which joints move one body of a pair and not both."""
        return np.asarray(self._above[pairs[:, 0]] ^ self._above[pairs[:, 1]])

    def _climb(self, number: int, body: CollisionBody) -> None:
        points, extra = _points(_rows(body))
        link = body.link
        while link:
            joint = self._robot.joint_above[link]
            points = points @ _rotation(joint.T_joint_child).T + joint.T_joint_child.position_m
            place = self._number.get(joint.name)
            reach = float((np.linalg.norm(points, axis=1) + extra).max())
            flat = points - np.outer(points @ joint.axis, joint.axis)
            turn = float((np.linalg.norm(flat, axis=1) + extra).max())
            if place is not None:
                self._above[number, place] = True
                self._moves[number, place] = self._moved(joint, reach, turn)
            # From the next joint on, all of it is within a ball around this one.
            points = np.array([joint.T_parent_joint.position_m])
            extra = np.array([reach + self._travel_m(joint)])
            link = joint.parent

    def _turned(self, joint: RobotJoint) -> FloatArray:
        """Return how far a joint turns when a variable changes by one; 0 where it does not turn."""
        found = np.zeros(len(self._places))
        leader, factor, _ = self._robot.mimic_of(joint.variables[0])
        if joint.kind is JointKind.REVOLUTE and leader in self._places:
            found[self._places[leader]] = factor
        return found

    def _moved(self, joint: RobotJoint, reach: float, turn: float) -> FloatArray:
        found = np.zeros(len(self._places))
        for nth, name in enumerate(joint.variables):
            leader, factor, _ = self._robot.mimic_of(name)
            if leader not in self._places:
                continue
            if joint.kind is JointKind.REVOLUTE:
                metres = turn
            elif joint.kind is JointKind.PLANAR and nth == 2:
                metres = reach
            elif joint.kind is JointKind.FLOATING and nth >= 3:
                metres = _UNLIMITED_M
            else:
                metres = 1.0
            found[self._places[leader]] += abs(factor) * metres
        return found

    def _travel_m(self, joint: RobotJoint) -> float:
        """Return how far a joint's sliding carries what it moves at most."""
        if joint.kind in {JointKind.PLANAR, JointKind.FLOATING}:
            return _UNLIMITED_M
        if joint.kind is not JointKind.PRISMATIC:
            return 0.0
        leader, factor, offset = self._robot.mimic_of(joint.variables[0])
        if leader not in self._places:
            # It stands where it is, within its limits or not.
            return abs(float(self._positions[joint.first]))
        limit = next(one for one in self._robot.joints if leader in one.variables).limits[0]
        most = abs(factor) * max(abs(limit.lower), abs(limit.upper)) + abs(offset)
        return min(most, _UNLIMITED_M)


def _line(joint: RobotJoint) -> FloatArray:
    """Return a joint's axis and a point of it in the frame of the link it carries."""
    T_child_joint = joint.T_joint_child.inverse()
    return np.array([*T_child_joint.rotate(joint.axis), *T_child_joint.position_m])


def _points(rows: ConvexRows) -> tuple[FloatArray, FloatArray]:
    """Return balls around all solids: centres and radii."""
    own = rows.solids[-rows.own :]
    hull = rows.kinds[-rows.own :, KIND] == HULL
    points = [own[~hull, CENTRE:RADIUS]]
    extra = [np.minimum(own[~hull, RADIUS], _UNLIMITED_M)]
    for row, (_, _, first, count) in zip(own[hull], rows.kinds[-rows.own :][hull], strict=True):
        points.append(rows.vertices[first : first + count])
        extra.append(np.full(count, row[SLACK]))
    return np.concatenate(points), np.concatenate(extra)


def _rotation(pose: Pose) -> FloatArray:
    return np.asarray(pose.matrix()[:3, :3])
